"""Whose code a function is: the user's, which is read, or that of a library, which is known."""

from __future__ import annotations

import sys
from types import FunctionType, ModuleType, SimpleNamespace
from typing import Any

import numpy as np

__all__ = ["NEVER", "changing_call", "harmless", "of_library", "only_attributes"]

LIBRARIES = frozenset(sys.stdlib_module_names) - {"__main__"} | set(
    """
    autograd casadi cupy cython dask jax jaxlib matplotlib numba numpy pandas pybind11 saltus scipy
    sympy tensorflow torch tqdm xarray
    """.split()
)
HARMLESS = set(
    """
    abc builtins cmath copy dataclasses enum fractions functools itertools math numbers numpy
    operator _operator saltus types typing
    """.split()
)
"""libraries that change no object they are given, but by the functions in `code.MUTATORS`"""

NO_OUT = set(
    """
    arange array asarray atleast_1d column_stack concatenate cross diag eye full full_like hstack
    interp linspace ones ones_like polyval reshape stack vstack where zeros zeros_like
    """.split()
)
"""functions of NumPy that fill no array they are given"""
NEVER = 10_000  # arguments
HEAP_TYPE = 1 << 9  # the flag of classes that a class statement made


def changing_call(function: Any) -> int:
    """With how many arguments a function of NumPy may fill the last of them."""
    if isinstance(function, np.ufunc):
        return function.nin + 1
    return NEVER if _root(function) != "numpy" or function.__name__ in NO_OUT else 3


def _root(value: Any) -> str:
    module = value.__name__ if isinstance(value, ModuleType) else getattr(value, "__module__", None)
    return module.split(".")[0] if isinstance(module, str) else "builtins"


def of_library(value: Any) -> bool:
    """Whether the code of a function, class or module is that of a library."""
    return _root(value) in LIBRARIES and not _wraps(value) and not _nameless(value)


def _wraps(value: Any) -> bool:
    """Code of this package that may call a function of the user, such as that of a SourceBlock."""
    solving = str(getattr(value, "__module__", "")).startswith("saltus.solving")
    inner = isinstance(value, FunctionType) and bool(value.__closure__)
    return solving or (inner and _root(value) == "saltus")


def _nameless(value: Any) -> bool:
    """Code of a user that was run without a module, by exec: Python counts it to the builtins."""
    made = isinstance(value, FunctionType) or (
        isinstance(value, type) and bool(value.__flags__ & HEAP_TYPE)
    )
    return made and _root(value) == "builtins"


def only_attributes(kind: type) -> bool:
    """Whether an object of this class is no more than its attributes."""
    return not of_library(kind) or kind is SimpleNamespace or _root(kind) == "saltus"


def harmless(value: Any) -> bool:
    """Whether a function or class of a library leaves its arguments unchanged."""
    return _root(value) in HARMLESS
