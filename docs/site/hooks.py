"""What MkDocs is told beyond mkdocs.yml: pages from outside docs/, links that hold on a site as in
a checkout, fences that carry notes for the tests, formulas.
"""

import logging
import posixpath
import re
import sys
from pathlib import Path

from mkdocs.structure.files import File

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(Path(__file__).parent))

import cpp_reference  # noqa: E402
import mathematics  # noqa: E402
import names  # noqa: E402

# parameters of compiled functions stand in the stubs, where griffe does not look for them
logging.getLogger("mkdocs.plugins.griffe").addFilter(
    lambda record: "/_core." not in record.getMessage()
)

# top files of the checkout that are pages of the site
PAGES = {
    "README.md": "index.md",
    "CHANGELOG.md": "changelog.md",
    "KNOWN_GAPS.md": "known_gaps.md",
    "CONTRIBUTING.md": "contributing.md",
}
FORMULAS = {}  # of the pages between their Markdown and their HTML
FENCE = re.compile(r"^(```+[a-z]+)[ \t][^\n]*$", re.M)  # ```python continue
CODE = re.compile(r"(^```.*?^```[ \t]*$)", re.M | re.S)
SCENE = re.compile(r"^\| \[([\w -]+)\]\(([\w/-]+)\.md\) \| (.*) \|\n", re.M)
TABLE = re.compile(r"<table(>.*?</table>)", re.S)
CELL = re.compile(r"<td.*?</td>", re.S)
BLOCK = re.compile(r'<h2 id="saltus\.library\.(\w+)".*?</p>', re.S)  # to its first sentence
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s#]*)(#[^)\s]*)?\)")


def on_config(config):
    version = re.search(
        r"^project\(saltus VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.M
    )
    config.copyright = f"Saltus {version[1]}"  # in the foot of each page
    return config


def on_files(files, config):
    for source, target in PAGES.items():
        files.append(File.generated(config, target, content=(ROOT / source).read_text()))
    for path, text in [*cpp_reference.pages(ROOT), names.page(ROOT)]:
        files.append(File.generated(config, path, content=text))
    return files


def on_page_markdown(markdown, page, config, files):
    source = next((s for s, target in PAGES.items() if target == page.file.src_uri), None)
    origin = source or f"docs/{page.file.src_uri}"  # where its links start
    if origin == "README.md":
        page.meta["hide"] = ["navigation"]
    if origin == "docs/models/README.md":
        markdown = gallery(markdown)
    markdown = re.sub(r"^```text output.*$", "``` {.text .output}", markdown, flags=re.M)
    parts = CODE.split(FENCE.sub(r"\1", markdown))
    for i in range(0, len(parts), 2):  # the others are code
        text = mathematics.take(parts[i], FORMULAS.setdefault(page.file.src_uri, []))
        parts[i] = LINK.sub(lambda link: rewritten(link, origin, page), text)
    return "".join(parts)


def on_page_content(html, page, config, files):
    html = TABLE.sub(marked, html)
    if page.file.src_uri == "api/blocks.md":
        html = BLOCK.sub(pictured, html)
    return mathematics.put(html, FORMULAS.pop(page.file.src_uri, []))


def pictured(block):
    """The begin of a block's part of the reference with the picture of its response."""
    name = block[1]
    if not (ROOT / "docs" / "pictures" / "blocks" / f"{name}.svg").exists():
        return block[0]
    words = f"A run of {name}: inputs grey, outputs black"
    return f'{block[0]}\n<img class="block" alt="{words}" src="../pictures/blocks/{name}.svg">'


def marked(table):
    """A table of many columns and long texts gets a mark: on a telephone its columns are wider."""
    cells = [re.sub(r"<[^>]*>", "", cell) for cell in CELL.findall(table[0])]
    many = table[0].partition("</tr>")[0].count("<th") > 3
    return f"<table data-wide{table[1]}" if many and max(map(len, cells)) > 60 else table[0]


def rewritten(link, origin, page):
    """A link as it must be on the site; text alone where its target is in the checkout only."""
    mark, text, target, anchor = link[1], link[2], link[3], link[4] or ""
    if not target or "://" in target or origin.startswith("docs/cpp_reference/"):
        return link[0]
    path = posixpath.normpath(posixpath.join(posixpath.dirname(origin), target))
    place = place_on_site(path)
    if place is None:
        return text
    here = posixpath.dirname(page.file.src_uri) or "."
    return f"{mark}[{text}]({posixpath.relpath(place, here)}{anchor})"


def place_on_site(path):
    """Where a file of the checkout is on the site, as MkDocs names its source."""
    if path in PAGES:
        return PAGES[path]
    if not path.startswith("docs/") or path.endswith(".py"):
        return None
    inside = path.removeprefix("docs/")
    return f"{inside}/README.md" if (ROOT / path).is_dir() else inside


def gallery(markdown):
    """The tables of scenes as cards with their films, or pictures where nothing is drawn."""

    def card(row):
        name, path, words = row.groups()
        moving = (ROOT / "docs" / "models" / f"{path}.gif").exists()
        return f"- [![]({path}.{'gif' if moving else 'svg'})<b>{name}</b><br>{words}]({path}.md)\n"

    rows = re.compile(r"^\| (?:scene|model) \| \|\n\| --- \| --- \|\n((?:\|.*\n?)+)", re.M)
    opened, closed = '<div class="gallery" markdown>\n\n', "\n</div>\n"
    return rows.sub(lambda table: opened + SCENE.sub(card, table[1]) + closed, markdown)
