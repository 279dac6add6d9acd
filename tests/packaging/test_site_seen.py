"""Each page of the site in a real browser at two widths: nothing is cut off, missing or in error.

SALTUS_SHOTS names a folder for pictures of the pages, to be looked at. It skips without Chromium.
"""

import os
from pathlib import Path

import pytest
from browser import Browser, chromium

if chromium() is None:
    pytest.skip("there is no Chromium", allow_module_level=True)

WIDE, NARROW = 1280, 390  # [px] a laptop, a telephone
SEEN = """(async () => {
  const pictures = [...document.images];
  pictures.forEach(i => i.loading = 'eager');
  await Promise.all(pictures.map(i => i.decode().catch(() => 0)));
  await document.fonts.ready;
  const room = document.documentElement.clientWidth;
  const box = e => e.getBoundingClientRect();
  const scrolled = e => { for (; e && e !== document.body; e = e.parentElement)
    if (/auto|scroll|hidden|clip/.test(getComputedStyle(e).overflowX)) return true; return false };
  const main = document.querySelector('.md-content');
  return {
    room, scroll: document.documentElement.scrollWidth,
    missing: pictures.filter(i => !i.naturalWidth).map(i => i.src),
    beyond: [...main.querySelectorAll('*')]
      .filter(e => box(e).width && box(e).right > room + 1 && !scrolled(e))
      .map(e => e.tagName + ' ' + e.textContent.trim().slice(0, 60)),
    squeezed: pictures.filter(i => main.contains(i) && box(i).width && Math.abs(
      box(i).width / box(i).height / (i.naturalWidth / i.naturalHeight) - 1) > 0.05
      && getComputedStyle(i).objectFit === 'fill').map(i => i.src),
    over: [...main.querySelectorAll('td')]
      .filter(c => box(c).width && c.scrollWidth > c.clientWidth + 1)
      .map(c => c.textContent.trim().slice(0, 60)),
    formulas: [...main.querySelectorAll('math')].filter(m => box(m).height < 5).length,
  };
})()"""


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    browser = Browser(tmp_path_factory.mktemp("browser"))
    yield browser
    browser.close()


def photograph(browser, page, width):
    if folder := os.environ.get("SALTUS_SHOTS"):
        name = str(page).replace("/", "-").removesuffix(".html")
        Path(folder).mkdir(parents=True, exist_ok=True)
        browser.picture(Path(folder) / f"{name}-{width}.png")


def faults(seen, messages):
    """What is wrong with a page, in words."""
    if seen["scroll"] > seen["room"]:
        yield f"it is {seen['scroll']} px wide in {seen['room']}"
    for name in ("missing", "beyond", "squeezed", "over"):
        if seen[name]:
            yield f"{name}: {seen[name][:3]}"
    if seen["formulas"]:
        yield f"{seen['formulas']} formulas have no height"
    yield from messages


@pytest.mark.parametrize("width", [WIDE, NARROW])
def test_every_page_is_whole(site, browser, width):
    # what a server shows for an unknown address names its files from the root of the server
    pages = sorted(set(site.glob("**/*.html")) - {site / "404.html"})
    browser.width(width)
    wrong = []
    for page in pages:
        browser.open(page.as_uri())
        found = list(faults(browser.value(SEEN), browser.messages))
        photograph(browser, page.relative_to(site), width)
        wrong += [f"{page.relative_to(site)} at {width} px: {fault}" for fault in found]
    assert len(pages) > 80
    assert not wrong, "\n".join(wrong)


BAD = """<div class="md-content"><p style="width:3000px">wide</p><img src="nowhere.png">
<table><tr><td style="width:20px;max-width:20px"><code>a_long_name_of_one_word</code></td></tr></table>
<script>console.error("wrong")</script></div>"""


def test_a_bad_page_is_noticed(browser, tmp_path):
    (tmp_path / "bad.html").write_text(BAD)
    browser.width(NARROW)
    browser.open((tmp_path / "bad.html").as_uri())
    found = " ".join(faults(browser.value(SEEN), browser.messages))
    assert "px wide" in found and "missing" in found and "beyond" in found and "wrong" in found
    assert "over: ['a_long_name_of_one_word']" in found


def test_a_word_is_found(site, browser):
    """The search works where the pages are opened from a disk."""
    browser.width(WIDE)
    for word, page in (
        ("Zeno", "semantics.html"),
        ("backlash", "backlash"),
        ("Sum block", "blocks.html"),
    ):
        browser.open((site / "index.html").as_uri() + f"?q={word.replace(' ', '%20')}")
        found = browser.value(
            """new Promise(done => { const end = Date.now() + 15000; const look = () => {
              const links = [...document.querySelectorAll('.md-search-result__link')]
                .map(a => a.href);
              links.length || Date.now() > end ? done(links) : setTimeout(look, 100) }; look() })"""
        )
        assert any(page in link for link in found), f"{word}: {found[:5]}"
