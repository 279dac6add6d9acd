"""`Looks`: everything that a search for writers looked at, and whether it is still there."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from operator import is_not
from types import CellType, FunctionType
from typing import Any

from saltus.tracing.sandbox import MISSING, PLAIN

__all__ = ["Looks"]

Parts = Callable[[Any], list[Any]]


class Looks:
    """The objects that one search found, and where. While the same objects are in these places,
    another search would find the same. What libraries define counts as fixed, for the search too.
    """

    __slots__ = ("_entries", "_kinds", "_parts", "whole")

    def __init__(self) -> None:
        self.whole = True
        """False if something was looked at that cannot be looked at again"""
        self._entries: list[tuple[Any, Any, Any]] = []
        self._parts: list[tuple[Parts, Any, list[Any]]] = []
        self._kinds: list[tuple[Any, type]] = []

    def entry(self, mapping: Any, key: str) -> None:
        """An entry of a dictionary or of a class, also a missing entry."""
        self._entries.append((mapping.get, key, mapping.get(key, MISSING)))

    def parts(self, parts: Parts, value: Any) -> None:
        """All parts of a value, in order."""
        self._parts.append((parts, value, parts(value)))

    def function(self, function: FunctionType) -> None:
        """Code, defaults, and the variables of the functions around it."""
        self.parts(_of_function, function)

    def kind(self, value: Any) -> None:
        """The class of an object, which is not kept alive where that is possible."""
        try:
            self._kinds.append((weakref.ref(value), type(value)))
        except TypeError:
            self.parts(_of_object, value)

    def changed(self) -> bool:
        """Whether one of them is another object now. Numbers and texts may be others."""
        if not self.whole:
            return True
        for get, key, value in self._entries:
            now = get(key, MISSING)
            if now is not value and _differ(now, value):
                return True
        for parts, whole, then in self._parts:
            found = parts(whole)
            if len(found) != len(then):
                return True
            if any(map(is_not, found, then)) and any(map(_differ, found, then)):
                return True
        return any(type(owner()) is not kind for owner, kind in self._kinds)


def _differ(now: Any, value: Any) -> bool:
    """Whether values lead a search to other objects; a number or a text does not."""
    return now is not value and not (isinstance(now, PLAIN) and isinstance(value, PLAIN))


def _of_function(function: FunctionType) -> list[Any]:
    named = function.__kwdefaults__ or {}
    cells = [_content(cell) for cell in function.__closure__ or ()]
    return [function.__code__, *(function.__defaults__ or ()), *named, *named.values(), *cells]


def _content(cell: CellType) -> Any:
    try:
        return cell.cell_contents
    except ValueError:  # empty
        return MISSING


def _of_object(value: Any) -> list[Any]:
    return [type(value)]
