"""The index "Called X there": each name of other programs and what it is here, from our tables.

They are "Names elsewhere" of docs/blocks.md and the first table of each page of docs/coming_from.
"""

import re

PROGRAMS = ("collimator", "drake", "simulink", "scipy")
NAME = re.compile(r"`[^`]*`")
CELL = re.compile(r"(?<!\\)\|")
TEXT = """# Called X there

What is called X in Drake, Simulink, Collimator, Modelica or SciPy, and its name here. The search
finds these names too. Names of Modelica are without `Modelica.Blocks.`. [Blocks](blocks.md) has the
equations; the pages "Coming from" say what differs.
"""


def rows(text):
    """The cells of the first table of a text."""
    table = re.search(r"(?:^\|.*\n)+", text, re.M)[0]
    return [[c.strip() for c in CELL.split(line)[1:-1]] for line in table.splitlines()]


def split(cell):
    """Parts of a cell at commas that are in no brackets and no code."""
    return re.findall(r"(?:`[^`]*`|\([^()]*\)|[^,`(])+", cell)


def of_blocks(text):
    """(name, program, name here) of the blocks."""
    head, _, *body = rows(text[text.index("\n## Names elsewhere") :])
    for here, *there in body:
        for program, cell in zip(head[1:], there, strict=True):
            for name in split(cell):
                if name.strip(" .-"):
                    yield name.strip(), program, here


def of_program(text):
    """(name, program, name here) of a page for those who come from a program."""
    head, _, *body = rows(text)
    for there, here, *_ in body:
        for name, our in pairs(there, here):
            if re.match(r"[`A-Za-z]", name):
                yield name, head[0], our


def pairs(there, here):
    """Names in a row of a table and what each is; the whole row if it says more than names."""
    names, ours = ([part.strip() for part in split(cell)] for cell in (there, here))
    only = all(map(NAME.fullmatch, names))
    if here == "the same" and only:
        return zip(names, names, strict=True)
    if len(names) == len(ours) and (only or len(names) > 5) and all(map(NAME.fullmatch, ours)):
        return zip(names, ours, strict=True)
    return [(there, here)] if len(names) < 5 else []  # blocks, which have a table of their own


def key(row):
    return re.sub(r"[^\w ]", "", row[0]).lower(), row[1]


def index(root):
    """All rows, by name; programs that give a thing one name share a row."""
    found = list(of_blocks((root / "docs" / "blocks.md").read_text()))
    for program in PROGRAMS:
        text = (root / "docs" / "coming_from" / f"{program}.md").read_text()
        found += of_program(text.replace("](../", "]("))
    merged = {}
    for name, program, here in found:
        merged.setdefault((name.strip("`"), here), []).append((name, program))
    rows = []
    for (_, here), there in merged.items():
        programs = ", ".join(dict.fromkeys(program for _, program in there))
        rows.append((there[0][0], programs, here))
    return sorted(rows, key=key)


def page(root):
    """(path, markdown) of the index, a heading for each letter."""
    lines, letter = [TEXT], None
    for name, program, here in index(root):
        first = key((name, program))[0][:1].upper()
        if (first := "0-9" if first.isdigit() else first) != letter:
            letter = first
            lines.append(f"\n## {letter}\n\n| there | in | here |\n| --- | --- | --- |")
        lines.append(f"| {name} | {program} | {here} |")
    return "names.md", "\n".join(lines) + "\n"
