"""Writes the places that a block of the library has, from templates: a block y = u to begin with.

    ./dev new-block NAME [GROUP]

NAME is the class, such as DeadZone; GROUP is a name in SECTIONS, that of a file of bindings and of
one in Python. The files are checked before any of them is written: a block that is there already is
refused.
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SECTIONS = {
    "arithmetic": "Arithmetic",
    "discrete": "Discrete",
    "discrete_linear": "Discrete",
    "linear": "Linear",
    "logic": "Logic",
    "mechanics": "State",
    "signals": "Sources",
    "sources": "Sources",
    "state": "State",
    "subsystems": "Subsystems",
}
"""the group -> its section in docs/blocks.md"""

HEADER = """\
// y = u, elementwise.
// in: any width. out: the same.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class NAME final : public LeafSystem {
 public:
  explicit NAME(std::string name);
};

}  // namespace saltus
"""
SOURCE = """\
// y = u, elementwise.
#include "saltus/library/FILE.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

NAME::NAME(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = elementwise,
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = [](const auto& at) { return at.u(0); }});
}

}  // namespace saltus
"""
TEST = """\
// NAME: its law, its width and its rate.
#include "library_support.hpp"

using namespace saltus;
using namespace library_test;

TEST_CASE("NAME gives its input", "[library]") {
  CHECK(Bench<NAME>({3.0}).output() == Numbers{3.0});
  CHECK(Bench<NAME>({Value{1.0, -2.0}}).output() == Numbers{1.0, -2.0});
  CHECK(Bench<NAME>({3.0}).node().rate == Rate::constant);
}
"""
PYTHON = '''

class NAME(Block, _core.NAME):
    """y = u, entry by entry.

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import NAME
    >>> saltus.response(NAME(), [1.0, 3.0])
    array([1., 3.])
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))
'''
BINDING = '  py::class_<NAME, System>(module, "NAME").def(py::init<std::string>());\n'
STUB = "class NAME(System):\n    def __init__(self, name: str, /) -> None: ...\n\n"
ROW = "| `NAME` | y = u | in: n. out: n | | as inputs |\n"


def snake(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def sorted_in(text: str, line: str, key: str, pattern: str, end: str | None = None) -> str:
    """`line` before the first match of `pattern` whose group sorts after `key`; else before the
    first `end` after the last match, or right after its line.
    """
    last = None
    for match in re.finditer(pattern, text, re.M):
        if match[1] > key:
            return text[: match.start()] + line + text[match.start() :]
        last = match
    if last is None:
        raise SystemExit(f"no place like {pattern!r} was found")
    place = text.index("\n", last.end()) + 1 if end is None else text.index(end, last.end())
    return text[:place] + line + text[place:]


def in_order(name: str) -> tuple[bool, str]:
    """The order in which ruff sorts names: those in capitals come first."""
    return not name.isupper(), name


def with_python_name(text: str, name: str, group: str) -> str:
    """The import of its group and __all__, as ruff formats them."""
    start = f"from saltus.library.{group} import "
    found = re.search(re.escape(start) + r"(\([^)]*\)|.*)", text)
    assert found
    names = sorted([*re.findall(r"\w+", found[1]), name], key=in_order)
    line = start + ", ".join(names)
    if len(line) > 100:
        line = f"{start}(\n" + "".join(f"    {each},\n" for each in names) + ")"
    text = text[: found.start()] + line + text[found.end() :]
    start = text.index("__all__ = [")
    end = text.index("]\n", start) + 2
    listed = sorted([*re.findall(r'"(\w+)"', text[start:end]), name], key=in_order)
    names = "".join(f'    "{each}",\n' for each in listed)
    return text[:start] + "__all__ = [\n" + names + "]\n" + text[end:]


def with_row(text: str, row: str, group: str) -> str:
    """The row at the end of the first table of a section of docs/blocks.md."""
    heading = text.index(f"\n## {SECTIONS[group]}\n")
    table = text.index("\n| --- ", heading)
    end = re.compile(r"\n(?!\|)").search(text, table + 1)
    assert end
    return text[: end.start() + 1] + row + text[end.start() + 1 :]


def places(root: Path, name: str, group: str) -> dict[Path, str]:
    """The text of each file that is new or changes."""
    file = snake(name)
    library = root / "include" / "saltus" / "library"
    bindings, package = root / "bindings" / f"bind_{group}.cpp", root / "python" / "saltus"
    include = f'#include "saltus/library/{file}.hpp"\n'
    included = r'^#include "saltus/library/(\w+)\.hpp"$'

    def changed(path: Path, change) -> tuple[Path, str]:
        return path, change(path.read_text())

    def bound(text: str) -> str:
        text = sorted_in(text, include, file, included)
        line = BINDING.replace("NAME", name)
        start = text.index(f"void bind_{group}(")  # helpers of some blocks may come before
        own = r"^  py::class_<(\w+), System>"
        return text[:start] + sorted_in(text[start:], line, name, own, "}\n\n}  // namespace")

    known = re.findall(r"^  py::class_<(\w+), System>", bindings.read_text(), re.M)
    stubs = r"^class (" + "|".join(known) + r")\(System\):$"
    return dict(
        [
            (library / f"{file}.hpp", HEADER.replace("NAME", name)),
            (
                root / "src" / "library" / f"{file}.cpp",
                SOURCE.replace("NAME", name).replace("FILE", file),
            ),
            changed(library / "library.hpp", lambda t: sorted_in(t, include, file, included)),
            changed(bindings, bound),
            changed(
                package / "library" / f"{group}.py", lambda t: t + PYTHON.replace("NAME", name)
            ),
            changed(
                package / "library" / "__init__.py", lambda t: with_python_name(t, name, group)
            ),
            changed(
                package / "_core.pyi",
                lambda t: sorted_in(t, STUB.replace("NAME", name), name, stubs, "class "),
            ),
            (root / "tests" / "unit" / f"library_{file}_test.cpp", TEST.replace("NAME", name)),
            changed(
                root / "docs/blocks.md", lambda t: with_row(t, ROW.replace("NAME", name), group)
            ),
        ]
    )


def main(arguments: list[str]) -> None:
    parser = argparse.ArgumentParser(prog="./dev new-block", description=__doc__.split("\n")[0])
    parser.add_argument("name", help="the class, such as DeadZone")
    parser.add_argument("group", nargs="?", default="arithmetic", choices=SECTIONS)
    given = parser.parse_args(arguments)
    if not re.fullmatch(r"([A-Z][a-z0-9]*)+", given.name):
        raise SystemExit(f"{given.name!r} is no name of a class; give one such as DeadZone")
    if (ROOT / "include" / "saltus" / "library" / f"{snake(given.name)}.hpp").exists():
        raise SystemExit(f"there is a block {given.name!r} already")
    for path, text in places(ROOT, given.name, given.group).items():
        print("changed" if path.exists() else "written", path.relative_to(ROOT))
        path.write_text(text)
    print(f"It gives y = u. Write its law in src/library/{snake(given.name)}.cpp.")


if __name__ == "__main__":
    main(sys.argv[1:])
