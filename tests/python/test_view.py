"""Pages about runs: their parts, and that they need nothing from elsewhere."""

import re
import shutil
from html.parser import HTMLParser

import pytest
import saltus
from saltus import ModelError
from systems import Ball

pytest.importorskip("matplotlib")
plt = pytest.importorskip("matplotlib.pyplot")
VOID = {"meta", "img", "input", "br", "link"}


class Nesting(HTMLParser):
    """Each tag is closed where it should be; `tags` counts them."""

    def __init__(self):
        super().__init__()
        self.open, self.headings, self.sources = [], [], []

    def handle_starttag(self, tag, attributes):
        self.sources += [value for name, value in attributes if name in ("src", "href")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        while self.open and self.open[-1] in ("p", "tr", "label") and self.open[-1] != tag:
            self.open.pop()  # HTML closes these itself
        if tag not in VOID and tag in self.open:
            assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == "h2":
            self.headings.append(data)


def read(path):
    text = path.read_text(encoding="utf-8")
    page = Nesting()
    page.feed(text)
    assert page.open == []
    assert "</html>" in text
    assert all(s.startswith("data:image/") for s in page.sources if s), page.sources
    outside = re.sub(r"base64,[A-Za-z0-9+/=\\\s]*", "", text)
    for sign in ("http://", "https://", "@import", "url(", "fetch(", "XMLHttpRequest", "/work/"):
        assert sign not in outside, sign
    return text, page


@pytest.fixture
def browser(monkeypatch):
    import webbrowser

    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda address: opened.append(address) or True)
    return opened


def test_a_scene_with_a_drawing(tmp_path, browser):
    open_before = plt.get_fignums()
    path = saltus.view("newtons-cradle", path=tmp_path / "cradle.html")
    text, page = read(path)
    assert page.headings == ["Film", "Plots", "Diagram", "Events", "Statistics"]
    assert "12 events" in text and "five balls" in text
    assert text.count("cradle.impact</td>") == 12
    assert browser == [] and plt.get_fignums() == open_before


def test_a_smooth_scene_has_neither_film_nor_events(tmp_path):
    text, page = read(saltus.view("hires", path=tmp_path / "r.html"))
    assert page.headings == ["Plots", "Diagram", "Events", "Statistics"]
    assert "No event happened." in text


def test_without_a_path_it_is_opened(browser):
    path = saltus.view("thermostat")
    assert browser == [path.as_uri()] and path.name == "run.html"
    shutil.rmtree(path.parent)


def test_a_system_needs_a_span(tmp_path):
    with pytest.raises(ModelError, match=r"give t_span=\(0.0, 10.0\)"):
        saltus.view(Ball())
    text, _ = read(saltus.view(Ball(), (0.0, 2.0), tmp_path / "b.html", title="A <ball> & more"))
    assert "<h1>A &lt;ball&gt; &amp; more</h1>" in text


def test_results_know_their_system(tmp_path):
    run = saltus.solve(lambda t, x: -x, (0, 1), [1.0], dense_output=True)
    _, page = read(run.view(tmp_path / "run.html"))
    assert page.headings == ["Plots", "Diagram", "Events", "Statistics"]
    _, page = read(saltus.view(run, path=tmp_path / "again.html"))
    assert "Diagram" in page.headings
    loaded = saltus.scene("two-walls", t_end=2.0).simulate()
    loaded.save(tmp_path / "run.npz")
    _, page = read(saltus.load(tmp_path / "run.npz").view(tmp_path / "l.html"))
    assert "Diagram" not in page.headings and "Plots" in page.headings


def test_a_run_that_failed_has_a_page_that_says_so(tmp_path):
    system = saltus.LeafSystem(name="grows")
    system.declare_continuous_state([1.0], ode=lambda t, s: s.continuous_state**2)
    system.declare_continuous_state_output("x")
    text, _ = read(saltus.view(system, (0.0, 2.0), tmp_path / "x.html"))
    assert ">failed</span>" in text


def test_a_long_log_is_cut_in_the_middle(tmp_path):
    scene = saltus.scene("two-walls", t_end=1500.0)
    text, _ = read(saltus.view(scene, path=tmp_path / "w.html", draw=None, speed=500.0))
    assert text.count("ball.wall</td>") == 1000 and "500 more" in text


def test_a_scene_file(tmp_path):
    file = tmp_path / "decay.toml"
    file.write_text(
        'version = 1\ntitle = "A decay"\nstates = { x = { start = 1.0, rate = "-x" } }\n'
        'outputs = { x = "x" }\nrun = { until = 1.0 }\n'
    )
    text, _ = read(saltus.view(file, path=tmp_path / "decay.html"))
    assert "A decay" in text


@pytest.mark.parametrize(
    ("what", "options", "says"),
    [
        ("bouncing-bal", {}, "did you mean 'bouncing-ball'"),
        (3, {}, "expected the name of a scene, a scene file, a system or results, found int"),
        ("thermostat", {"path": "x.pdf"}, "expected a name that ends in .html, found 'x.pdf'"),
        ("thermostat", {"rtoll": 1e-6}, "did you mean 'rtol'"),
    ],
)
def test_wrong_use_is_named(what, options, says):
    with pytest.raises(ModelError, match=says):
        saltus.view(what, **options)


def test_results_take_no_options(tmp_path):
    run = saltus.scene("two-walls", t_end=2.0).simulate()
    with pytest.raises(ModelError, match="rtol: these results come from a run that is over"):
        saltus.view(run, path=tmp_path / "x.html", rtol=1e-9)
