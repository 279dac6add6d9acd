"""Every public name says what it is and shows it: a docstring with an example that runs."""

import doctest
import inspect
import sys

import numpy as np
import pytest
import saltus
from saltus import drawings, library, report, scene_files
from saltus.results import event_pictures, films, pictures
from saltus.system import drawn, named_ports

NEEDED = {"saltus.jax_function": "jax", "saltus.torch_function": "torch"}
"""name -> the package of its example, which `./dev test` does not install"""
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def public_objects():
    """(name, object) of everything in the public lists, once each."""
    modules = {
        "saltus": saltus,
        "saltus.drawings": drawings,
        "saltus.library": library,
        "saltus.report": report,
        "saltus.results.pictures": pictures,  # what `Results` inherits
        "saltus.results.event_pictures": event_pictures,
        "saltus.results.films": films,
        "saltus.scene_files": scene_files,
        "saltus.system.drawn": drawn,  # what `System` inherits
        "saltus.system.named_ports": named_ports,
    }
    found = {}
    for path, module in modules.items():
        for name in module.__all__:
            thing = getattr(module, name)
            if not inspect.ismodule(thing) and name != "__version__":
                found.setdefault(id(thing), (f"{path}.{name}", thing))
    return list(found.values())


def members(path, cls):
    """(name, object) of the public methods and properties that the class itself brings."""
    for name, thing in vars(cls).items():
        function = getattr(thing, "__func__", thing)
        if not name.startswith("_") and (callable(function) or isinstance(thing, property)):
            yield f"{path}.{name}", thing


OBJECTS = public_objects()
CLASSES = [(path, thing) for path, thing in OBJECTS if inspect.isclass(thing)]
MEMBERS = [member for path, cls in CLASSES for member in members(path, cls)]
DOCUMENTED = {path: inspect.getdoc(thing) or "" for path, thing in [*OBJECTS, *MEMBERS]}
EXAMPLES = [path for path, text in DOCUMENTED.items() if ">>>" in text]


def test_every_public_name_has_a_docstring():
    silent = sorted(path for path, text in DOCUMENTED.items() if not text.strip())
    assert not silent, f"{len(silent)} without a docstring: {', '.join(silent)}"


def test_every_public_name_has_an_example():
    """Of its own; for a method or a property, being used in that of its class will do."""
    classes = {f"{path}.": DOCUMENTED[path] for path, _ in CLASSES}

    def shown(path):
        owner, _, name = path.rpartition(".")
        return ">>>" in DOCUMENTED[path] or f".{name}" in classes.get(f"{owner}.", "")

    def is_property(path):
        return any(path == p and isinstance(thing, property) for p, thing in MEMBERS)

    bare = sorted(path for path in DOCUMENTED if not shown(path) and not is_property(path))
    assert not bare, f"{len(bare)} without an example: {', '.join(bare)}"


@pytest.mark.parametrize("path", EXAMPLES)
@pytest.mark.filterwarnings("error")
def test_the_example_runs(path, tmp_path, monkeypatch):
    """As it stands there, with `saltus` and `np` imported; files it writes go elsewhere."""
    if path in NEEDED:
        pytest.importorskip(NEEDED[path])
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    globs = {"saltus": saltus, "np": np, "__name__": "example"}
    test = doctest.DocTestParser().get_doctest(DOCUMENTED[path], globs, path, None, None)
    said = []
    runner = doctest.DocTestRunner(optionflags=FLAGS, verbose=False)
    runner.run(test, out=said.append)
    if "matplotlib.pyplot" in sys.modules:
        sys.modules["matplotlib.pyplot"].close("all")  # or it warns of the twentieth figure
    assert not runner.failures, "".join(said)
