"""The site of the documents builds without a warning, fetches nothing, and leaves nothing out."""

import json
import re
import sys
from pathlib import Path

import pytest

pytest.importorskip("mkdocs")

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs" / "site"))

import cpp_reference  # noqa: E402

FETCHED = re.compile(
    r'<(?:script|img|iframe)\b[^>]*\bsrc="(https?:)?//|<link\b[^>]*\bhref="https?://'
)


def test_it_fetches_nothing(site):
    pages = list(site.glob("**/*.html"))
    assert len(pages) > 50
    for page in pages:
        found = FETCHED.search(page.read_text())
        assert not found, f"{page.relative_to(site)}: {found[0]}"
    for style in site.glob("**/*.css"):
        assert not re.search(r"url\(['\"]?(https?:)?//", style.read_text()), style.name


def test_it_can_be_searched(site):
    index = json.loads((site / "search" / "search_index.json").read_text())
    places = {entry["location"].split("#")[0] for entry in index["docs"] if "Zeno" in entry["text"]}
    assert {"semantics.html", "blocks.html", "api/runs.html"} <= places


def test_every_page_has_the_version(site):
    import saltus

    bare = [
        p.name
        for p in site.glob("**/*.html")
        if f"Saltus {saltus.__version__}" not in p.read_text()
    ]
    assert not bare


def test_names_of_other_programs_lead_to_ours(site):
    text = re.sub(r"</?code>", "", (site / "names.html").read_text())
    for name, program, here in (
        ("Sum", "Simulink", "Adder"),
        ("Unit Delay", "Simulink", "UnitDelay"),
        ("ConstantVectorSource", "Drake", "Constant"),
        ("Nonlinear.Limiter", "Modelica", "Saturate"),
        ("FeedthroughBlock", "Collimator", "FunctionBlock"),
        ("MakeWitnessFunction with an event", "Drake", "declare_zero_crossing(guard"),
    ):
        row = (
            rf"<td>{re.escape(name)}.*?</td>\s*<td>[^<]*{program}[^<]*</td>\s*<td>{re.escape(here)}"
        )
        assert re.search(row, text), f"{name} of {program} is not {here}"


def test_every_public_name_is_in_the_reference(site):
    import saltus

    text = "".join(page.read_text() for page in (site / "api").glob("*.html"))
    names = set(saltus.__all__) - {"__version__", "library", "sbml", "scene_files", "simulation"}
    missing = [name for name in names if not re.search(rf'id="saltus\.([\w.]+\.)?{name}"', text)]
    assert not missing, f"docs/api/ does not show {', '.join(sorted(missing))}"


def test_links_to_the_checkout_are_text(site):
    for page in set(site.glob("**/*.html")) - {site / "404.html"}:
        broken = [
            link
            for link in re.findall(r'href="([^"#?]+)[^"]*"', page.read_text())
            if "://" not in link and not (page.parent / link).exists()
        ]
        assert not broken, f"{page.relative_to(site)} links to {', '.join(broken[:3])}"


HEADER = """// First words.
#pragma once
#include <vector>
namespace saltus {
namespace detail {
struct Hidden {};
}  // namespace detail
/// A thing.
class Thing {
 public:
  explicit Thing(int n) : n_{n} {}
  int n() const { return n_; }  ///< how many // there are
  std::vector<double> values = {1.0};

 private:
  void secret();
  int n_;
};
inline void Thing::secret() {}
/// Free.
inline double twice(double x) { return 2.0 * x; }
}  // namespace saltus
"""


def test_a_header_becomes_its_declarations():
    assert cpp_reference.digest(HEADER).split("\n") == [
        "/// A thing.",
        "class Thing {",
        " public:",
        "  explicit Thing(int n);",
        "  int n() const;  ///< how many // there are",
        "  std::vector<double> values = {1.0};",
        "};",
        "/// Free.",
        "double twice(double x);",
    ]


def test_each_header_is_read_to_its_end():
    """Braces and parentheses of what is shown balance, for every header of the reference."""
    for path, text in cpp_reference.pages(ROOT):
        code = "\n".join(re.findall(r"```cpp\n(.*?)```", text, re.S))
        code = re.sub(r"//[^\n]*", "", code)
        for opened, closed in ("{}", "()"):
            assert code.count(opened) == code.count(closed), f"{path}: {opened}{closed}"
        assert "private" not in code
