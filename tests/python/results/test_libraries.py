"""What is said where a library is not installed."""

import sys

import pytest
from saltus.results.tables import extra

LIBRARIES = ["control", "scipy", "scipy.optimize", "scipy.signal"]


@pytest.mark.parametrize("library", LIBRARIES)
def test_a_missing_library_is_named_as_pip_installs_it(monkeypatch, library):
    """pip installs a library, not a module of it: 'pip install scipy.optimize' finds nothing."""
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(ImportError) as caught:
        extra(library, "this")
    name = library.split(".")[0]
    assert str(caught.value) == f"this needs {name}, which is not installed: pip install {name}"
