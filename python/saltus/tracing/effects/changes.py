"""`Changes`: the values behind a trace that may change during a run, and their writers."""

from __future__ import annotations

from collections.abc import Iterator
from types import BuiltinFunctionType, CellType, CodeType, FunctionType, MethodType, ModuleType
from typing import Any, NamedTuple

import numpy as np

from saltus.tracing.effects.reach import CONTAINERS, memory_of
from saltus.tracing.effects.writes import Writes
from saltus.tracing.sandbox import MISSING, Dependencies

__all__ = ["Change", "Changes"]

FIXED = (FunctionType, MethodType, BuiltinFunctionType, CodeType, ModuleType, type)
"""values that are no data: only a callback that is known to write them changes them"""


class Change(NamedTuple):
    """A value that may change."""

    words: str
    """the user's words for it, such as "self.drag\""""
    writer: str
    """the callback that may write it"""
    unknown: str
    """the reason, if the code of the writer does not show the write; or nothing"""


def _memories(value: Any) -> Iterator[int]:
    """The identities of everything whose entries are in a value."""
    yield id(memory_of(value)) if isinstance(value, np.ndarray) else id(value)
    if isinstance(value, (list, tuple, dict)):
        for item in value.values() if isinstance(value, dict) else value:
            if isinstance(item, (np.ndarray, *CONTAINERS)):
                yield from _memories(item)


def _is_data(key: Any, value: Any) -> bool:
    """Whether unreadable code may change the value: it may if the value is no function, class or
    part of one.
    """
    inner = isinstance(key, str) and key.startswith("__")
    return not inner and value is not MISSING and not isinstance(value, FIXED)


class Changes:
    """Everything that the called callbacks of a run may write; `of` answers for one trace."""

    def __init__(self) -> None:
        self._binds: dict[str, str] = {}
        self._places: dict[int, str] = {}
        self._unknown: tuple[str, str] | None = None
        self._kept: list[Writes] = []  # so that no identity is used twice

    def add(self, writer: str, writes: Writes) -> None:
        """Adds a callback, with the user's words for it."""
        self._kept.append(writes)
        for name in writes.binds:
            self._binds.setdefault(name, writer)
        for place in (*writes.cells, *writes.touched):
            self._places.setdefault(place, writer)
        if writes.unknown and self._unknown is None:
            self._unknown = writer, writes.unknown

    def of(self, dependencies: Dependencies) -> Change | None:
        """The first of the values that may change."""
        if not (self._binds or self._places or self._unknown):
            return None
        for words, key, value in dependencies.reads():
            writer = self._writer(key, value)
            if writer is not None:
                return Change(words, writer, "")
        return self._change_unknown(dependencies)

    def _writer(self, key: Any, value: Any) -> str | None:
        if isinstance(key, str) and key in self._binds:
            return self._binds[key]
        if isinstance(key, CellType) and id(key) in self._places:
            return self._places[id(key)]
        if not isinstance(value, (np.ndarray, *CONTAINERS)):
            return None
        return next((self._places[m] for m in _memories(value) if m in self._places), None)

    def _change_unknown(self, dependencies: Dependencies) -> Change | None:
        if self._unknown is None:
            return None
        data = (words for words, key, value in dependencies.reads() if _is_data(key, value))
        return next((Change(words, *self._unknown) for words in data), None)
