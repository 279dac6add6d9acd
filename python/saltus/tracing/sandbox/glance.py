"""`Glance`: a quick look at the dependencies of several functions, before every run."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from saltus.tracing.sandbox.dependencies import (
    GONE,
    MISSING,
    AttributeOf,
    Dependencies,
    same,
    same_content,
)

__all__ = ["Glance"]


class Glance:
    """Whether the values that were read are the same objects still, or equal numbers, with the
    same parts.

    It may see a change where there is none, such as in an object that is gone. Then
    `Dependencies.changed` tells. It holds the same values.

    Examples
    --------
    >>> from saltus.tracing.sandbox import Dependencies
    >>> values = {"e": 0.9}
    >>> dependencies = Dependencies()
    >>> dependencies.add("e", values.get, "e", values["e"])
    >>> glance = Glance([dependencies])
    >>> glance.changed()
    False
    >>> values["e"] = 0.8
    >>> glance.changed()
    True
    """

    __slots__ = ("_attributes", "_contents", "_entries")

    def __init__(self, functions: Iterable[Dependencies]):
        self._entries: list[tuple[Any, Any, Any]] = []
        self._attributes: list[tuple[Any, str, Any]] = []
        self._contents: list[tuple[Any, Any, Any]] = []
        known: set[tuple[int, int, int]] = set()
        for dependencies in functions:
            for get, key, value, inside in dependencies.looks():
                place = (id(getattr(get, "__self__", get)), id(key), id(value))
                if place in known:
                    continue  # such as numpy, which every function reads
                known.add(place)
                if inside is not None:
                    self._contents.append((get, key, inside))
                elif type(get) is AttributeOf:
                    self._attributes.append((get.object, key, value))
                else:
                    self._entries.append((get, key, value))

    def changed(self) -> bool:
        """False: nothing has changed. True: something may have."""
        for get, key, value in self._entries:
            now = get(key, MISSING)
            if now is not value and not same(now, value):
                return True
        for owner_of, name, value in self._attributes:
            owner = owner_of()  # gone: it cannot change
            if owner is not None and getattr(owner, name, MISSING) is not value:
                return True
        for get, key, inside in self._contents:
            now = get(key, MISSING)
            if now is not GONE and not same_content(now, inside):
                return True
        return False
