"""Formulas in TeX, as MathML made while the site is built: a reader's browser needs no script.

`$...$` is a formula in a line and `$$...$$` one of its own, as on a forge, so one source serves
both. Nothing here knows MkDocs: `take` puts a word in the place of each formula before Markdown is
read, and `put` puts the MathML in the place of each word afterwards.
"""

import re

from latex2mathml.converter import convert

# code in a line is passed over; a formula begins and ends with what is no space
FORMULA = re.compile(
    r"(?P<code>(`+)(?!`).*?(?<!`)\2(?!`))"
    r"|\$\$(?P<own>.+?)\$\$"
    r"|\$(?=\S)(?P<line>[^$\n]+?)(?<=\S)\$(?!\d)",
    re.S,
)
ALIGNED = re.compile(r"\\(begin|end)\{aligned\}")
# the converter drops the name of an environment that it does not know
OTHER = re.compile(r"\\begin\{(?!(?:aligned|cases|[pbv]?matrix)\})")
WORD = "xFormula{}x"
WORDS = re.compile(r"(<p>)?xFormula(\d+)x(?(1)</p>)")
ALIGN = re.compile(r'<mtd columnalign="(\w+)"')  # which Chromium does not read
UNREAD = re.compile(r"\\|<m[io]>&(amp;)?</m[io]>")  # commands that the converter does not know
# the space of TeX between a function and an argument without brackets, on either side
FUNCTION = r"(<mi>(?:arc)?(?:sin|cos|tan|exp|ln|log|sign)</mi>)"
BEFORE = re.compile(rf"(</m(?:i|n|row|sub|sup)>)((?:<msup>|<msub>)?{FUNCTION})")
AFTER = re.compile(rf"(?<!<msup>)(?<!<msub>){FUNCTION}(?=<m[inst])")
THIN = '<mspace width="0.17em" />'
# after these a minus is the sign of a number, no difference
SIGN = re.compile(r"(<mo[^>]*>(?:&#x0003D;|&#x02264;|&#x02265;|&#x00028;|,)</mo>)<mo>(?=&#x02212;)")


def mathml(tex, own=False):
    """TeX as MathML, `own` if it has lines of its own."""
    if OTHER.search(tex):
        raise refused(tex, "of environments, only aligned, cases and matrices are known")
    text = convert(ALIGNED.sub(r"\\\1{align*}", tex.strip()), display="block" if own else "inline")
    if unread := UNREAD.search(text):
        raise refused(tex, text[max(unread.start() - 20, 0) :][:60])
    text = AFTER.sub(rf"\1{THIN}", BEFORE.sub(rf"\1{THIN}\2", text))
    text = SIGN.sub(r'\1<mo form="prefix">', text)
    text = ALIGN.sub(r'\g<0> style="text-align: \1"', text)
    return f'<div class="formula">{text}</div>' if own else text


def refused(tex, why):
    return ValueError(f"no MathML for '{tex.strip()}': {why}")


def take(markdown, formulas):
    """Markdown with a word for each formula, which is appended to the list as MathML."""

    def word(match):
        if match["code"]:
            return match[0]
        formulas.append(mathml(match["own"] or match["line"], match["own"] is not None))
        return WORD.format(len(formulas) - 1)

    return FORMULA.sub(word, markdown)


def put(html, formulas):
    """HTML with each formula in the place of its word; one of its own is in no paragraph."""

    def formula(match):
        text = formulas[int(match[2])]
        return text if text.startswith("<div") or not match[1] else f"<p>{text}</p>"

    return WORDS.sub(formula, html)
