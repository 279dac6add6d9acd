"""The tables of docs/coming_from: each name of ours in them exists."""

import inspect
import re
from pathlib import Path

import pytest
import saltus
import saltus.errors
import saltus.library

PAGES = sorted((Path(__file__).parents[2] / "docs" / "coming_from").glob("*.md"))
CLASSES = (
    saltus.LeafSystem, saltus.DiagramBuilder, saltus.Diagram, saltus.Context, saltus.Simulator,
    saltus.SimulatorOptions, saltus.Results, saltus.Solution, saltus.Guard,
)  # fmt: skip


def parameters(function):
    try:
        return set(inspect.signature(function).parameters)
    except (TypeError, ValueError):
        return set()


def known():
    """The names of the package, of its classes, and of what their functions take."""
    modules = (saltus, saltus.library, saltus.errors)
    named = {name: getattr(module, name) for module in modules for name in module.__all__}
    found = {"True", *named, *saltus.SimulatorOptions.__annotations__}
    for value in [*named.values(), *CLASSES]:
        found |= parameters(value)
        if inspect.isclass(value):
            found |= set(dir(value))
            for name in dir(value):
                found |= parameters(getattr(value, name, None))
    return found


def names_in(page):
    """Names of several words in the column of Saltus, and where that says "the same", in the other.
    A text in quotes is a value, no name.
    """
    for line in page.read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("|") or len(cells) != 3:
            continue
        for cell in cells[:2] if cells[1].startswith("the same") else cells[1:2]:
            for span in re.findall(r"`([^`]*)`", cell):
                code = re.sub(r'"[^"]*"', "", span)
                yield from re.findall(r"\b(?:[A-Z][a-z]+\w*|[a-z]+_\w+)\b", code)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_each_name_in_the_table_exists(page):
    names = set(names_in(page))
    assert len(names) > 10
    assert names - known() == set()


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("declare_cache", "block 'tank': there is no cache; call a method of the block"),
        ("declare_static_parameter", "there are no static parameters; set an attribute"),
        ("declare_static_parameters", "there are no static parameters; set an attribute"),
    ],
)
def test_a_declaration_that_is_not_here_is_refused_with_the_remedy(name, words):
    with pytest.raises(saltus.ModelError, match=words):
        getattr(saltus.LeafSystem(name="tank"), name)(lambda time, state: 1.0, name="flow")
