"""The faces of numpy, math and the builtins, which a traced function sees."""

from __future__ import annotations

import builtins
import contextlib
import functools
import itertools
import math
import operator
from collections.abc import Callable
from types import BuiltinFunctionType, ModuleType
from typing import Any

import numpy as np

from saltus.tracing.numbers import (
    SymbolArray,
    array,
    call_function,
    call_ufunc,
    has_symbols,
    kind_of_type,
    owned,
    plain,
    reduce_ufunc,
)
from saltus.tracing.refusal import refuse
from saltus.tracing.sandbox.foreign import Foreign
from saltus.tracing.sandbox.math_face import MATH_FACE, math_function
from saltus.tracing.sandbox.plain_builtins import REPLACED, SAFE

__all__ = ["BUILTINS", "face_of"]

SAFE_MODULES = {"operator", "itertools", "_operator"}


class Ufunc:
    """A ufunc of numpy, for symbols and numbers."""

    def __init__(self, ufunc: np.ufunc):
        self._ufunc = ufunc
        self.__name__ = ufunc.__name__

    def __call__(self, *arguments: Any, **options: Any) -> Any:
        if options or has_symbols(arguments):
            return call_ufunc(self._ufunc, *arguments, **options)
        result = self._ufunc(*plain(arguments))
        return owned(result)

    def _method(self, method: str) -> Callable[..., Any]:
        return lambda *a, **options: reduce_ufunc(self._ufunc, method, *a, **options)

    def __getattr__(self, name: str) -> Any:
        if name in ("reduce", "accumulate", "outer"):
            return self._method(name)
        refuse(f"uses np.{self.__name__}.{name}", "use the function itself")


class NumpyType:
    """np.float64 and similar objects: a type, and a function that converts."""

    def __init__(self, kind: type):
        self.type = kind
        if not kind.__subclasses__():  # not an abstract one, such as np.floating
            self.dtype = np.dtype(kind)  # numpy uses the dtype of any object that has one
        self.__name__ = kind.__name__

    def __call__(self, value: Any = 0) -> Any:
        if not has_symbols(value):
            return self.type(plain(value))
        return array(value, kind_of_type(self.type))[()]


def _function(function: Callable[..., Any]) -> Callable[..., Any]:
    def call(*arguments: Any, **options: Any) -> Any:
        return call_function(function, arguments, options)

    return functools.update_wrapper(call, function, ("__name__", "__doc__"), ())


@functools.cache
def _numpy_value(name: str, value: Any) -> Any:
    if isinstance(value, np.ufunc):
        return Ufunc(value)
    if name == "errstate":
        return lambda *arguments, **options: contextlib.nullcontext()
    if isinstance(value, type):
        if value is np.ndarray:
            return SymbolArray
        if value in (np.ndindex, np.finfo, np.iinfo, np.dtype):
            return value
        return NumpyType(value) if issubclass(value, np.generic) else Foreign(f"np.{name}")
    return _function(value) if callable(value) else value


class Numpy:
    """The functions of numpy, or numpy.linalg, that have a symbolic form; the use of any other is
    refused.
    """

    def __init__(self, module: ModuleType, words: str):
        self._module = module
        self._words = words

    def __getattr__(self, name: str) -> Any:
        value = getattr(self._module, name)  # AttributeError as numpy has it
        if value is np.linalg:
            return LINALG
        if isinstance(value, ModuleType):
            hint = "random numbers differ from call to call" if name == "random" else ""
            return Foreign(f"{self._words}.{name}", hint)
        return _numpy_value(name, value) if callable(value) else value

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_"):
            refuse(f"writes {self._words}.{name}")
        object.__setattr__(self, name, value)


LINALG = Numpy(np.linalg, "np.linalg")
NUMPY = Numpy(np, "np")


class PlainModule:
    """A module whose functions take symbols as they are."""

    def __init__(self, module: ModuleType, names: list[str]):
        self._module = module
        self._names = names

    def __getattr__(self, name: str) -> Any:
        value = getattr(self._module, name)
        return value if name in self._names else Foreign(f"{self._module.__name__}.{name}")

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_"):
            refuse(f"writes {self._module.__name__}.{name}")
        object.__setattr__(self, name, value)


PLAIN_MODULES: dict[Any, Any] = {
    operator: PlainModule(operator, dir(operator)),
    itertools: PlainModule(itertools, dir(itertools)),
    functools: PlainModule(functools, ["partial", "reduce"]),
}


def _is_numpy(value: Any) -> bool:
    module = getattr(value, "__module__", None)
    return isinstance(module, str) and module.split(".")[0] == "numpy"


def face_of(value: Any) -> Any:
    """The face of a module, function or type of numpy, math or Python; None if it has none."""
    if isinstance(value, ModuleType):
        known: dict[Any, Any] = {np: NUMPY, np.linalg: LINALG, math: MATH_FACE, **PLAIN_MODULES}
        return known.get(value)
    if isinstance(value, np.ufunc):
        return _numpy_value(value.__name__, value)
    if isinstance(value, BuiltinFunctionType) and value.__module__ == "math":
        return math_function(value.__name__)
    if _is_numpy(value) and callable(value) and not isinstance(value, np.generic):
        return _of_numpy(value)
    return _of_python(value)


def _of_numpy(value: Any) -> Any:
    name = getattr(value, "__name__", "")
    for module in (np, np.linalg):
        if getattr(module, name, None) is value:
            return _numpy_value(name, value)
    return None


def _of_python(value: Any) -> Any:
    name = getattr(value, "__name__", "")
    if getattr(builtins, name, None) is value:
        return BUILTINS[name]
    module = getattr(value, "__module__", None)
    function = isinstance(value, (BuiltinFunctionType, type))  # no iterator that is under way
    return value if function and (module in SAFE_MODULES or value is functools.reduce) else None


def _import(
    name: str, globals: Any = None, locals: Any = None, fromlist: Any = (), level: int = 0
) -> Any:
    """`import numpy` inside a function."""
    root = {"numpy": NUMPY, "math": MATH_FACE}
    root.update({module.__name__: face for module, face in PLAIN_MODULES.items()})
    root["numpy.linalg"] = LINALG if fromlist else NUMPY
    if level or name not in root:
        return Foreign(name, "import it at the top of the file")
    return root[name]


EFFECTS = {
    "print": "it prints",
    "open": "it opens a file",
    "input": "it asks the user",
    "breakpoint": "it stops",
}


def _table() -> dict[str, Any]:
    table: dict[str, Any] = {}
    for name, value in vars(builtins).items():
        if name in SAFE or not callable(value):
            table[name] = value
        elif isinstance(value, type) and issubclass(value, BaseException):
            table[name] = value
        else:
            table[name] = Foreign(name, EFFECTS.get(name, ""))
    table.update(REPLACED)
    table["__import__"] = _import
    return table


BUILTINS = _table()
