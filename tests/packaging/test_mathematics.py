"""Formulas of the documents become MathML: all of them, and nothing else does."""

import re
import sys
from pathlib import Path

import pytest

pytest.importorskip("latex2mathml")

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs" / "site"))

import mathematics  # noqa: E402
from snippets import DOCUMENTS  # noqa: E402

CODE = re.compile(r"^```.*?^```\s*$|(`+)(?!`).*?(?<!`)\1(?!`)", re.S | re.M)
TEXT = re.compile(r"<(pre|code|script|style|annotation)\b.*?</\1>|<[^>]*>", re.S)


def formulas(markdown):
    found = []
    mathematics.take(CODE.sub("", markdown), found)
    return found


def test_a_formula_in_a_line_and_one_of_its_own():
    found = []
    text = mathematics.take("so $x_1 > 0$ and\n\n$$\n\\frac{a}{b}\n$$\n", found)
    assert "$" not in text and "\\" not in text
    html = mathematics.put("<p>" + text.replace("\n\n", "</p>\n<p>").strip() + "</p>", found)
    assert "<msub><mi>x</mi><mn>1</mn></msub>" in html
    assert '<div class="formula"><math' in html and "<mfrac>" in html
    assert "<p><div" not in html and "xFormula" not in html


def test_rows_are_aligned():
    assert (
        mathematics.mathml("\\begin{aligned} a &= b \\\\ c &= d \\end{aligned}").count("<mtr>") == 2
    )


def test_a_function_has_a_space_before_what_has_no_brackets():
    text = mathematics.mathml(r"a \sin x + \cos(x) + m \sin^2 y")
    assert re.sub(r"<mspace[^>]*>", "_", text).count("_") == 3
    assert "<mi>sin</mi><mspace" in text and "<msup><mi>sin</mi><mn>2</mn></msup>" in text


def test_the_sign_of_a_number_is_no_difference():
    assert '<mo form="prefix">' in mathematics.mathml("a = -b")
    assert '<mo form="prefix">' in mathematics.mathml("(-b)")
    assert "prefix" not in mathematics.mathml(r"a - b + \text{heater} - T")


@pytest.mark.parametrize("text", ["`$x$`", "``a ` $x$``", "5 $ and 6 $", "from $5 to $6", "$ x $"])
def test_what_is_no_formula_stays(text):
    found = []
    assert mathematics.take(text, found) == text and not found


@pytest.mark.parametrize("tex", [r"\nosuchcommand x", r"a & b", r"\begin{nosuch} x \end{nosuch}"])
def test_what_the_converter_does_not_know_is_refused(tex):
    with pytest.raises(ValueError, match="no MathML for"):
        mathematics.mathml(tex)


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_every_formula_of_a_document_converts(document):
    left = re.sub(
        r"\$\$.+?\$\$|\$(?=\S)[^$\n]+?(?<=\S)\$", "", CODE.sub("", document.read_text()), flags=re.S
    )
    assert "$" not in left, "a formula is not closed, or begins or ends with a space"
    formulas(document.read_text())


def test_every_formula_is_on_the_site(site):
    expected = sum(len(formulas(document.read_text())) for document in DOCUMENTS)
    pages = [page.read_text() for page in site.glob("**/*.html")]
    assert sum(page.count("<math ") for page in pages) >= expected > 80
    for page in site.glob("**/*.html"):
        text = TEXT.sub("", page.read_text())
        assert "xFormula" not in text
        for sign in "\\$":
            place = text.find(sign)
            assert place < 0, f"{page.relative_to(site)}: {text[max(place - 60, 0) : place + 60]}"
