"""`Reach`: the code that a callback may run, and the objects that it may change.

An object is reached from another one by an attribute if the code that was found names it anywhere,
by all its entries if it is a container, and by everything it refers to if it is an object of a
library. So the search finds too much rather than too little.
"""

from __future__ import annotations

import gc
from collections import deque
from collections.abc import Iterable, Iterator
from types import (
    BuiltinFunctionType,
    CellType,
    FunctionType,
    GeneratorType,
    MethodType,
    ModuleType,
)
from typing import Any

import numpy as np

from saltus.tracing.effects.code import MUTATORS, facts_of
from saltus.tracing.effects.libraries import (
    NEVER,
    changing_call,
    harmless,
    of_library,
    only_attributes,
)
from saltus.tracing.effects.looks import Looks
from saltus.tracing.sandbox import PLAIN, names_in

__all__ = ["CONTAINERS", "Reach", "memory_of"]

CONTAINERS = (list, tuple, dict, set, frozenset, deque, bytearray)
MOST = 5_000  # objects; beyond that nothing is known
MAKES = {"__init__", "__new__", "__init_subclass__", "__class_getitem__"}
CODE = (FunctionType, staticmethod, classmethod, property)
SETS = {"__setattr__", "__delattr__"}
WRAPPERS = {
    "property": ("fget", "fset", "fdel"),
    "staticmethod": ("__func__",),
    "classmethod": ("__func__",),
    "cached_property": ("func",),
}
"""types that wrap a function in a class -> the attributes with the function"""


def memory_of(array: np.ndarray) -> Any:
    """The object that owns the memory of an array: all views of it have the same."""
    owner: Any = array
    while getattr(owner, "base", None) is not None:
        owner = owner.base
    return owner


def _items(container: Any) -> Iterable[Any]:
    return [*container, *container.values()] if isinstance(container, dict) else container


def _generated(entry: Any) -> bool:
    """Whether dataclasses wrote a method: such a method compares, shows or freezes fields."""
    function = getattr(entry, "__wrapped__", entry)
    code = getattr(function, "__code__", None)
    return code is not None and code.co_filename == "<string>" and code.co_name != "__init__"


def _special(name: str) -> bool:
    return name.startswith("__") and name.endswith("__")


class Reach:
    """Follows everything from some roots."""

    def __init__(self, roots: Iterable[Any]):
        self.names: set[str] = set()
        self.binds: set[str] = set()
        self.cells: dict[int, CellType] = {}
        self.variables: set[int] = set()
        """identities of all variables of functions around those found, bound or read"""
        self.touched: dict[int, Any] = {}
        self.mutates = False
        self.unknown = ""
        """the reason why it may write everything; or nothing"""
        self.looks = Looks()
        """objects at which it has looked"""
        self._arguments = 0  # of the longest call
        self._fills = NEVER  # with so many arguments a function of NumPy may fill an array
        self._foreign = False  # a library that may call methods gets the objects
        self._seen: dict[int, Any] = {}
        self._waiting: deque[Any] = deque()
        self._holders: list[tuple[Any, set[str]]] = []
        for root in roots:
            self._visit(root)
        self._follow()

    def _follow(self) -> None:
        while self._waiting and not self.unknown:
            while self._waiting and not self.unknown:
                self._look(self._waiting.popleft())
            for holder, known in self._holders:
                for name in self.names - known:
                    self._attribute(holder, name)
                known |= self.names
        self.mutates |= self._arguments >= self._fills

    def _visit(self, value: Any) -> None:
        if isinstance(value, PLAIN) or id(value) in self._seen:
            return
        self._seen[id(value)] = value
        self._waiting.append(value)
        if len(self._seen) > MOST:
            self.unknown = f"it reaches more than {MOST} objects"

    def _visit_all(self, values: Iterable[Any]) -> None:
        for value in values:
            self._visit(value)

    def _look(self, value: Any) -> None:
        if isinstance(value, FunctionType):
            self._function(value)
        elif isinstance(value, MethodType):
            self._visit_all((value.__func__, value.__self__))
        elif isinstance(value, (BuiltinFunctionType, np.ufunc)):
            self._built_in(value)
        elif isinstance(value, (ModuleType, type)):
            self._class_or_module(value)
        elif isinstance(value, GeneratorType):
            self._generator(value)
        else:
            self._object(value)

    def _function(self, function: FunctionType) -> None:
        if of_library(function):
            self._of_library(function)
            return
        self.looks.function(function)
        names = self._code(function.__code__, function.__globals__)
        cells = zip(function.__code__.co_freevars, function.__closure__ or (), strict=True)
        for name, cell in cells:
            if name in names:
                self.cells[id(cell)] = cell
            self.variables.add(id(cell))
            self._visit_all(_content(cell))
        self._visit_all(function.__defaults__ or ())
        self._visit_all((function.__kwdefaults__ or {}).values())
        self._holders.append((function, set()))

    def _code(self, code: Any, variables: dict[str, Any]) -> frozenset[str]:
        """Notes what code does; returns the variables of functions around it that it binds."""
        facts = facts_of(code)
        self.names |= facts.names
        self.binds |= facts.binds
        self.mutates |= facts.mutates
        self._arguments = max(self._arguments, facts.arguments)
        if facts.dynamic:
            self.unknown = f"it uses {facts.dynamic}"
        for name in names_in(code):
            self.looks.entry(variables, name)
            if name in variables:
                self._visit(variables[name])
        return facts.cells

    def _generator(self, generator: GeneratorType[Any, Any, Any]) -> None:
        self.mutates = True
        self.looks.whole = False
        frame = generator.gi_frame
        if frame is None:
            return  # it has ended
        cells = self._code(generator.gi_code, frame.f_globals)
        if cells:
            self.unknown = "it runs a generator that binds variables of the function around it"
        self._visit_all(frame.f_locals.values())

    def _built_in(self, function: Any) -> None:
        owner = getattr(function, "__self__", None)
        if owner is not None and not isinstance(owner, ModuleType):
            self._visit(owner)
            self.mutates = True
        else:
            self._of_library(function)

    def _of_library(self, value: Any) -> None:
        if not harmless(value):
            self._foreign = True
        self.mutates |= self._foreign or value.__name__ in MUTATORS
        self._fills = min(self._fills, changing_call(value))

    def _class_or_module(self, value: Any) -> None:
        if of_library(value) and isinstance(value, type):
            self._of_library(value)
            return
        self._holders.append((value, set()))
        if isinstance(value, type):
            self._class(value, MAKES)
            self._class(type(value), set())

    def _class(self, kind: type, made: set[str]) -> None:
        """The methods that no name in the code shows: those of operators and conversions."""
        self.looks.parts(_bases, kind)
        for base in kind.__mro__:
            if of_library(base):
                continue
            self.looks.parts(_entries_of_class, base)
            for name, entry in vars(base).items():
                special = (
                    _special(name) and name not in SETS and (name not in MAKES or name in made)
                )
                code = isinstance(entry, CODE) and not _generated(entry)
                if code and (special or self._foreign):
                    self._visit(entry)

    def _object(self, value: Any) -> None:
        kind = type(value)
        if kind.__name__ in WRAPPERS and of_library(kind):
            self._visit_all(getattr(value, part) for part in WRAPPERS[kind.__name__])
        elif isinstance(value, (np.ndarray, *CONTAINERS)):
            self._container(value)
        elif not only_attributes(kind):
            self._of_library(value if callable(value) and hasattr(value, "__name__") else kind)
            self.looks.parts(gc.get_referents, value)
            parts = gc.get_referents(value)
            self._visit_all(p for p in parts if not isinstance(p, (type, ModuleType)))
        if only_attributes(kind):
            self.looks.kind(value)
            self._holders.append((value, set()))
            self._class(kind, set())

    def _container(self, value: Any) -> None:
        if isinstance(value, np.ndarray):
            self.touched[id(memory_of(value))] = value
            if value.dtype == object:
                self.looks.parts(_flat, value)
                self._visit_all(value.flat)
            return
        if not isinstance(value, (tuple, frozenset)):
            self.touched[id(value)] = value
            self.looks.parts(_listed, value)
        self._visit_all(_items(value))

    def _attribute(self, holder: Any, name: str) -> None:
        """An attribute, found without running code of its object."""
        self._look_at(holder, name)
        for entry in _entries(holder, name):
            if type(entry).__name__ in ("member_descriptor", "getset_descriptor"):
                self.looks.whole = False  # there is no dictionary to look at again
                self._visit_all(_of_slot(entry, holder))
            elif not (_special(name) and _generated(entry)):
                self._visit(entry)

    def _look_at(self, holder: Any, name: str) -> None:
        """Notes where `_entries` finds an attribute, or does not. Classes are noted by `_class`."""
        own = None if isinstance(holder, type) else getattr(holder, "__dict__", None)
        if own is not None:
            self.looks.entry(own, name)


def _bases(kind: type) -> list[Any]:
    return [kind.__mro__]


def _entries_of_class(base: type) -> list[Any]:
    return [*vars(base), *vars(base).values()]


def _flat(array: Any) -> list[Any]:
    return list(array.flat)


def _listed(container: Any) -> list[Any]:
    return list(_items(container))


def _content(cell: CellType) -> list[Any]:
    try:
        return [cell.cell_contents]
    except ValueError:  # empty
        return []


def _entries(holder: Any, name: str) -> Iterator[Any]:
    own = getattr(holder, "__dict__", None)
    if own is not None and name in own:
        yield own[name]
    if isinstance(holder, (ModuleType, FunctionType)):
        return
    for kind in {holder, type(holder)} if isinstance(holder, type) else {type(holder)}:
        for base in kind.__mro__:
            if name in vars(base):
                yield vars(base)[name]


def _of_slot(descriptor: Any, holder: Any) -> list[Any]:
    try:
        return [descriptor.__get__(holder, type(holder))]
    except (AttributeError, TypeError):  # not set, or set by another class
        return []
