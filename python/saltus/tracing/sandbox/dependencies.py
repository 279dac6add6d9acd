"""`Dependencies`: values that a traced function read from outside; whether they have changed."""

from __future__ import annotations

import math
import reprlib
import weakref
from collections.abc import Callable, Iterator, Mapping
from types import CodeType
from typing import Any

import numpy as np

__all__ = [
    "GONE",
    "LARGEST",
    "MISSING",
    "PLAIN",
    "AttributeOf",
    "Dependencies",
    "content",
    "entries",
    "same",
    "same_content",
]

MISSING: Any = type("Missing", (), {"__repr__": lambda self: "not there"})()

GONE = object()
"""the value of an attribute of an object that no longer exists: it cannot change"""

PLAIN = (bool, int, float, str, bytes, complex, type(None), np.generic)
"""values that never change"""

LARGEST = 10_000  # the largest number of entries; a comparison before every run has to be quick

Get = Callable[[Any, Any], Any]


def content(value: Any) -> Any:
    """The parts of a value that can change while it remains the same object, to be compared."""
    if isinstance(value, np.ndarray):
        return (value.shape, value.dtype.str, value.tobytes())
    if isinstance(value, (list, tuple)):
        return (type(value), *map(content, value))
    if isinstance(value, Mapping) and isinstance(value, dict):
        return (dict, *((key, content(entry)) for key, entry in value.items()))
    if not isinstance(value, PLAIN):
        return id(value)
    if isinstance(value, float) and value == 0.0:
        return (type(value), value, math.copysign(1.0, value))  # 0.0 and -0.0 differ,
    return (type(value), value)  # and so do 1, 1.0 and True


def entries(value: Any) -> int:
    """How many numbers a comparison of the value has to look at."""
    if isinstance(value, np.ndarray):
        return value.size
    if not isinstance(value, (list, tuple, dict)):
        return 1
    if len(value) > LARGEST:  # too many already
        return len(value)
    return sum(map(entries, value.values() if isinstance(value, dict) else value))


def _changes(value: Any) -> bool:
    return isinstance(value, (np.ndarray, list, tuple, dict))


def same(a: Any, b: Any) -> bool:
    """Whether two values are the same object, or equal numbers or texts of one type."""
    if type(a) is not type(b):
        return False
    if isinstance(a, (float, np.floating)):
        return (a == b and math.copysign(1.0, a) == math.copysign(1.0, b)) or (a != a and b != b)
    return bool(a == b) if isinstance(a, PLAIN) else a is b


def same_content(value: Any, inside: Any) -> bool:
    """Whether a container has the parts that one had when it was read: content(value) == inside. The
    comparison ends at the first difference: a list that callbacks append to may have become long.
    """
    if not isinstance(value, (list, tuple, dict)):
        return bool(content(value) == inside)
    kind = dict if isinstance(value, dict) else type(value)
    if not isinstance(inside, tuple) or len(inside) != len(value) + 1 or inside[0] is not kind:
        return False
    if not isinstance(value, dict):
        return all(map(same_content, value, inside[1:]))
    return all(
        key == name and same_content(entry, part)
        for (key, entry), (name, part) in zip(value.items(), inside[1:], strict=True)
    )


def _named(value: Any) -> str:
    """A value in few words."""
    if isinstance(value, CodeType):
        return f"compiled from line {value.co_firstlineno}"
    name = getattr(value, "__qualname__", None)
    return name if isinstance(name, str) else reprlib.repr(value)


class AttributeOf:
    """Attributes of an object, for a `Dependencies`, which should not keep the object alive."""

    def __init__(self, value: Any):
        try:
            self.object: Any = weakref.ref(value)
            """gives the object, or None if it is gone"""
        except TypeError:  # not every object can be referred to weakly
            self.object = lambda: value

    def moved(self, move: Callable[[Any], Any]) -> Any:
        """As above, for another object."""
        value = self.object()
        other = move(value)
        return self if other is value else type(self)(other)

    def __call__(self, name: str, default: Any) -> Any:
        value = self.object()
        return GONE if value is None else getattr(value, name, default)


def _moved_get(get: Get, move: Callable[[Any], Any]) -> Get:
    """The same look at another object."""
    if isinstance(get, AttributeOf):
        moved_attribute: Get = get.moved(move)
        return moved_attribute
    mapping = getattr(get, "__self__", None)
    if mapping is None:
        return get
    other = mapping.moved(move) if isinstance(mapping, AttributeOf) else move(mapping)
    moved: Get = other.get
    return moved


class Dependencies:
    """The values a tape was made from, by the words a user knows them by.

    It refers to objects weakly if possible, but to the variables of closures and their contents as
    the function does. So its owner should show it to the garbage collector.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> ball = SimpleNamespace(e=0.9)
    >>> dependencies = Dependencies()
    >>> dependencies.add("self.e", vars(ball).get, "e", 0.9)
    >>> dependencies.changed()
    >>> ball.e = 0.8
    >>> dependencies.changed()
    'self.e was 0.9, is 0.8'
    """

    def __init__(self) -> None:
        self._reads: list[tuple[str, Get, Any, Any, Any]] = []
        self._known: set[tuple[int, Any]] = set()

    def __len__(self) -> int:
        return len(self._reads)

    def add(self, words: str, get: Get, key: Any, value: Any) -> None:
        """Remember that get(key, default) gave `value`."""
        self._reads.append((words, get, key, value, content(value) if _changes(value) else None))

    def add_entry(self, words: str, mapping: Any, key: Any, value: Any) -> None:
        """Remember an entry of a dictionary, once."""
        if (id(mapping), key) not in self._known:
            self._known.add((id(mapping), key))
            self.add(words, mapping.get, key, value)

    def changed(self) -> str | None:
        """The first change since the trace was made, in words, or None.

        Returns
        -------
        str or None
            The change, such as "self.e was 0.9, is 0.8"; the tape must then be made anew.
        """
        for words, get, key, value, inside in self._reads:
            now = get(key, MISSING)
            if now is GONE:
                continue
            if now is value:
                if inside is None or same_content(now, inside):
                    continue
                return f"{words} changed in place"
            if not (same(value, now) if inside is None else same_content(now, inside)):
                return f"{words} was {_named(value)}, is {_named(now)}"
        return None

    def reads(self) -> Iterator[tuple[str, Any, Any]]:
        """The words, the place (a name, or a variable of a closure) and the value of each read."""
        for words, _, key, value, _ in self._reads:
            yield words, key, value

    def looks(self) -> Iterator[tuple[Get, Any, Any, Any]]:
        """Each read as get(key, default), the value that it gave, and the parts of a container."""
        for _, get, key, value, inside in self._reads:
            yield get, key, value, inside

    def moved(
        self, move: Callable[[Any], Any], equal: Callable[[Any, Any, Any], bool]
    ) -> Dependencies | None:
        """The same reads of other objects, if they give equal values now; or None.

        `move` gives the other object; `equal(value, other, inside)` compares what was read, with
        `inside` the parts of a container.
        """
        other = Dependencies()
        for words, get, key, value, inside in self._reads:
            moved_get, moved_key = _moved_get(get, move), move(key)
            now = moved_get(moved_key, MISSING)
            if now is GONE or not equal(value, now, inside):
                return None
            other.add(words, moved_get, moved_key, now)
        return other

    def merge(self, other: Dependencies) -> None:
        """Add the values of another `Dependencies`."""
        self._reads += other._reads
