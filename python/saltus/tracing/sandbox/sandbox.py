"""`Sandbox`: copies of the user's functions that see the symbolic forms of the objects they use.

A copy has the code of the function and globals of its own: numpy, math and the builtins have faces
that take symbols; other functions are copied likewise when they are read; everything that is read
is a dependency; nothing outside can be written to.
"""

from __future__ import annotations

import functools
from types import (
    BuiltinMethodType,
    CellType,
    CodeType,
    FunctionType,
    MethodType,
    ModuleType,
)
from typing import Any

import numpy as np

from saltus.tracing.numbers import SymbolArray
from saltus.tracing.refusal import MARK, refuse
from saltus.tracing.sandbox.code import names_in, refuse_code
from saltus.tracing.sandbox.dependencies import (
    LARGEST,
    MISSING,
    PLAIN,
    AttributeOf,
    Dependencies,
    entries,
)
from saltus.tracing.sandbox.faces import BUILTINS, face_of
from saltus.tracing.sandbox.foreign import Foreign
from saltus.tracing.sandbox.frozen import FrozenDict, FrozenList, FrozenTuple
from saltus.tracing.sandbox.guarded import Guarded

__all__ = ["Sandbox"]

FOREIGN = set(
    """
    autograd casadi cupy cython dask jax jaxlib numba numpy pandas scipy sympy tensorflow torch
    xarray
    """.split()
)
INNER = {"_lru_cache_wrapper": "__wrapped__", "CPUDispatcher": "py_func"}
"""type of an object that wraps a Python function, functools' caches and numba's jit -> the name of
the function in it
"""

OUTSIDE = set("datetime io logging os random secrets socket subprocess sys time warnings".split())


def _read_cell(cell: CellType, default: Any) -> Any:
    try:
        return cell.cell_contents
    except ValueError:  # empty
        return default


def _get_cell(cell: Any, default: Any) -> Any:
    return _read_cell(cell, default)


def _library(value: Any) -> str:
    module = value.__name__ if isinstance(value, ModuleType) else getattr(value, "__module__", "")
    return (module if isinstance(module, str) else "").split(".")[0]


def _flat(container: Any) -> list[Any]:
    if isinstance(container, dict):
        return [part for item in container.items() for part in item]
    return list(container)


class Sandbox:
    """The copies made for one trace, and the `Dependencies` over the objects they read."""

    def __init__(self) -> None:
        self.dependencies = Dependencies()
        self._copies: dict[int, Any] = {}
        self._kept: list[Any] = []  # so that no id is used twice
        self._globals: dict[int, dict[str, Any]] = {}
        self._written: list[tuple[str, dict[str, Any], dict[str, Any]]] = []
        self._cells: list[tuple[str, CellType, Any]] = []
        self._frozen_ones: list[tuple[str, Any, Any]] = []

    def form_of(self, value: Any, words: str) -> Any:
        """The form of a value from outside during tracing; `words` says where it was read."""
        if isinstance(value, PLAIN):
            return value
        if id(value) not in self._copies:
            self._kept.append(value)
            self._copies[id(value)] = self._made(value, words)
        return self._copies[id(value)]

    def _made(self, value: Any, words: str) -> Any:
        face = face_of(value)
        if face is not None:
            return face
        library = _library(value)
        own = isinstance(value, (np.ndarray, MethodType))
        if not own and (library in FOREIGN or library in OUTSIDE):
            return Foreign(self._foreign_name(value, words), self._hint(library))
        if isinstance(value, FunctionType):
            return self.copy(value, words)
        if isinstance(value, MethodType):
            function = self.form_of(value.__func__, words)
            return functools.partial(function, self.form_of(value.__self__, words))
        inner = getattr(value, INNER.get(type(value).__name__, ""), None)
        if isinstance(inner, FunctionType):
            return self.form_of(inner, words)
        if isinstance(value, functools.partial):
            return self._partial(value, words)
        return self._container(value, words)

    @staticmethod
    def _hint(library: str) -> str:
        return "it differs from call to call" if library in OUTSIDE else "it does not take symbols"

    @staticmethod
    def _foreign_name(value: Any, words: str) -> str:
        if isinstance(value, ModuleType):
            return value.__name__
        name = getattr(value, "__qualname__", "")
        return f"{value.__module__}.{name}" if name else words

    def _container(self, value: Any, words: str) -> Any:
        if isinstance(value, (np.ndarray, list, tuple, dict)) and entries(value) > LARGEST:
            return Foreign(words, f"more than {LARGEST} entries are not watched for changes")
        if isinstance(value, np.ndarray):
            narrow = value.dtype.kind == "f" and value.dtype.itemsize < 8
            if value.dtype.kind not in "biuf" or narrow or type(value) is not np.ndarray:
                return Foreign(words, f"an array of {value.dtype}")
            kind = {"b": "b", "f": "f"}.get(value.dtype.kind, "i")
            return SymbolArray(value.astype(object), kind, words)
        if isinstance(value, tuple):
            items = [self.form_of(item, f"{words}[{i}]") for i, item in enumerate(value)]
            return type(value)(*items) if hasattr(value, "_fields") else FrozenTuple(items)
        if type(value) is list:
            items = [self.form_of(item, f"{words}[{i}]") for i, item in enumerate(value)]
            return self._frozen(FrozenList(items, words), items, words)
        if type(value) is dict:
            forms = {k: self.form_of(item, f"{words}[{k!r}]") for k, item in value.items()}
            return self._frozen(FrozenDict(forms, words), forms, words)
        if isinstance(value, (range, slice, frozenset)):
            return value
        return self._object(value, words)

    def _frozen(self, made: Any, items: Any, words: str) -> Any:
        """The form of a container. `refuse_writes` compares it with its first items, because its
        methods cannot refuse list.append(it, 1).
        """
        self._frozen_ones.append((words, made, items))
        return made

    def _object(self, value: Any, words: str) -> Any:
        if isinstance(value, BuiltinMethodType) or not (
            hasattr(value, "__dict__") or hasattr(type(value), "__slots__")
        ):
            kind = type(value).__name__
            return Foreign(words, f"a {kind}: no Python code that can be read")
        return Guarded(self, value, words)

    def _partial(self, value: functools.partial[Any], words: str) -> Any:
        arguments = [self.form_of(a, f"{words}.args") for a in value.args]
        options = {k: self.form_of(v, f"{words}.{k}") for k, v in value.keywords.items()}
        self.dependencies.add(words, AttributeOf(value), "args", value.args)
        self.dependencies.add(words, AttributeOf(value), "keywords", value.keywords)
        return functools.partial(self.form_of(value.func, words), *arguments, **options)

    def copy(self, function: FunctionType, words: str) -> FunctionType:
        """The function with globals, closure and defaults of its own."""
        refuse_code(function.__code__)
        code = function.__code__
        self.dependencies.add(words, AttributeOf(function), "__code__", code)
        copied = FunctionType(
            code,
            self._globals_of(function),
            function.__name__,
            None,
            self._closure(function, words),
        )
        self._copies[id(function)] = copied  # before its globals: it may call itself
        self._kept.append(function)
        self._fill_globals(function, code)
        self._fill_cells(function, copied, words)
        self._fill_defaults(function, copied, words)
        self._written.append((f"attributes of {words}", copied.__dict__, {}))
        return copied

    def _globals_of(self, function: FunctionType) -> dict[str, Any]:
        own = function.__globals__
        if id(own) not in self._globals:
            self._kept.append(own)
            made = {"__builtins__": BUILTINS, MARK: True, "__name__": own.get("__name__", "")}
            self._globals[id(own)] = made
            self._written.append(("global variables", made, {}))
        return self._globals[id(own)]

    def _fill_globals(self, function: FunctionType, code: CodeType) -> None:
        made, own = self._globals[id(function.__globals__)], function.__globals__
        before = next(entry for entry in self._written if entry[1] is made)[2]
        for name in names_in(code):
            value = own.get(name, MISSING)
            if name in made:
                continue
            if value is not MISSING:
                made[name] = before[name] = self.form_of(value, name)
            if value is not MISSING or name in BUILTINS:
                self.dependencies.add_entry(name, own, name, value)
        before.update({key: made[key] for key in ("__builtins__", MARK, "__name__")})

    def _closure(self, function: FunctionType, words: str) -> tuple[CellType, ...]:
        return tuple(CellType() for _ in function.__closure__ or ())

    def _fill_cells(self, function: FunctionType, copied: FunctionType, words: str) -> None:
        names = function.__code__.co_freevars
        cells = zip(names, function.__closure__ or (), copied.__closure__ or (), strict=True)
        for name, cell, mine in cells:
            value = _read_cell(cell, MISSING)
            self.dependencies.add(name, _get_cell, cell, value)
            if value is MISSING:
                continue
            mine.cell_contents = self.form_of(value, name)
            self._cells.append((name, mine, mine.cell_contents))

    def _fill_defaults(self, function: FunctionType, copied: FunctionType, words: str) -> None:
        defaults, named = function.__defaults__, function.__kwdefaults__
        self.dependencies.add(
            f"defaults of {words}", AttributeOf(function), "__defaults__", defaults
        )
        if defaults:
            copied.__defaults__ = tuple(self.form_of(v, f"a default of {words}") for v in defaults)
        if named:
            self.dependencies.add(
                f"defaults of {words}", AttributeOf(function), "__kwdefaults__", named
            )
            forms = {k: self.form_of(v, f"default {k} of {words}") for k, v in named.items()}
            copied.__kwdefaults__ = forms

    def refuse_writes(self) -> None:
        """Raise a Refusal if a copy wrote to a global, a closure or itself."""
        for words, now, before in self._written:
            for name in now:
                if name not in before or now[name] is not before[name]:
                    refuse(f"writes {words}: {name}", "what changes something outside is called")
        for words, made, items in self._frozen_ones:
            left, begun = _flat(made), _flat(items)
            if list(map(id, left)) != list(map(id, begun)):
                refuse(f"writes to {words}", "what changes something outside is called")
        for name, cell, value in self._cells:
            if _read_cell(cell, MISSING) is not value:
                refuse(f"writes the variable {name} of the function around it",
                       "what changes something outside is called")  # fmt: skip

    def close(self) -> None:
        """Drop everything but the dependencies: copies and their globals refer to each other."""
        for made in self._globals.values():
            made.clear()
        for _, cell, _ in self._cells:
            del cell.cell_contents
        for everything in (self._globals, self._copies):
            everything.clear()
        for kept in (self._cells, self._kept, self._written, self._frozen_ones):
            kept.clear()
