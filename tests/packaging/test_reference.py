"""The reference of the site shows every public name. This test reads the pages without MkDocs."""

import importlib
import re
from pathlib import Path

import pytest
import saltus

ROOT = Path(__file__).parents[2]
PAGES = sorted((ROOT / "docs" / "api").glob("*.md"))
SHOWN = [line for page in PAGES for line in re.findall(r"^::: (\S+)", page.read_text(), re.M)]
WITHOUT = {"__version__", "library", "sbml", "scene_files", "simulation"}
"""a number, and modules whose names are shown one by one"""


def shown_names():
    """The last names of all that is shown."""
    return {name.rpartition(".")[2] for name in SHOWN}


def test_there_are_pages():
    assert len(PAGES) >= 5 and len(SHOWN) >= 80


@pytest.mark.parametrize("name", sorted(set(saltus.__all__) - WITHOUT))
def test_every_public_name_is_shown(name):
    assert name in shown_names(), (
        f"saltus.{name} is in saltus.__all__ and on no page of docs/api/; add a line "
        f"'::: saltus.{name}' to one of them"
    )


@pytest.mark.parametrize("path", SHOWN)
def test_what_is_shown_exists(path):
    module, found, rest = path, None, []
    while found is None:
        try:
            found = importlib.import_module(module)
        except ModuleNotFoundError:
            module, _, last = module.rpartition(".")
            assert module, f"docs/api/ shows {path}, which is not there"
            rest.insert(0, last)
    for name in rest:
        found = getattr(found, name)
    assert found.__doc__


def test_no_name_is_shown_twice():
    assert sorted(set(SHOWN)) == sorted(SHOWN)


def shown_classes():
    """(class, whether the members of its bases are shown with it) of each class that is shown."""
    for page in PAGES:
        text = page.read_text() + "\n"
        for path, options in re.findall(r"^::: (\S+)\n((?:    .*\n)*)", text, re.M):
            module, _, name = path.rpartition(".")
            found = getattr(importlib.import_module(module), name, None) if module else None
            if isinstance(found, type):
                yield found, "inherited_members: true" in options


def test_members_of_bases_are_shown():
    """A class that is put together from several files is shown with all of its members: by its
    bases, or by the option inherited_members.
    """
    classes = list(shown_classes())
    shown = {c for c, _ in classes}.union(*(c.__mro__ for c, inherited in classes if inherited))
    missing = [
        f"{c.__name__} has {', '.join(members[:3])} of {base.__module__}.{base.__name__}"
        for c in shown
        for base in c.__mro__
        if base not in shown
        and base.__module__.startswith("saltus.")
        and base.__module__ != "saltus._core"
        if (members := [n for n, value in vars(base).items() if n[0] != "_" and callable(value)])
    ]
    assert not missing, "; ".join(missing)
