"""The record under results: the memory of a run, or a copy of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from saltus import _core
from saltus.errors import ModelError

__all__ = ["FIRINGS", "KINDS", "NOT_KEPT", "Columns", "KeptRun", "Record", "same"]

FIRINGS = ("zero_crossing", "terminal", "time", "executed")
"""kinds of events that say that a guard or a clock had its effect"""

NOT_KEPT = (
    "results that were loaded, or came from another process, keep no dense output; read it where "
    "the run was done"
)

Columns = dict[str, np.ndarray]


class Record(Protocol):
    """The data of a run that `Results` shows; `_core.Results` is a record."""

    @property
    def time(self) -> np.ndarray: ...
    @property
    def jump(self) -> np.ndarray: ...
    @property
    def outputs(self) -> Columns: ...
    @property
    def islands(self) -> list[tuple[Any, ...]]: ...
    @property
    def apart(self) -> bool: ...
    @property
    def context(self) -> _core.Context: ...
    @property
    def status(self) -> str: ...
    @property
    def message(self) -> str: ...
    @property
    def block(self) -> str: ...
    @property
    def statistics(self) -> dict[str, Any]: ...
    @property
    def event_count(self) -> int: ...
    @property
    def event_names(self) -> list[str]: ...
    @property
    def dense(self) -> bool: ...
    @property
    def span(self) -> tuple[float, float]: ...
    @property
    def joints(self) -> np.ndarray: ...
    @property
    def sensitivities(self) -> dict[str, Any] | None: ...

    def event(self, index: int, /) -> tuple[Any, ...]: ...
    def event_times(self, name: str, kind: str | None, /) -> np.ndarray: ...
    def at(self, times: Sequence[float], left: bool, /) -> tuple[np.ndarray, Columns]: ...
    def sensitivities_at(
        self, times: Sequence[float], left: bool, /
    ) -> tuple[np.ndarray, Columns]: ...


@dataclass(frozen=True)
class KeptRun:
    """A run as plain data, from a file or from another process."""

    time: np.ndarray
    jump: np.ndarray
    outputs: Columns
    context: _core.Context
    status: str
    message: str
    block: str
    statistics: dict[str, Any]
    events: list[tuple[Any, ...]]
    event_names: list[str]
    """'ball.bounce' of every event that could have been"""
    sensitivities: dict[str, Any] | None = None
    islands: list[tuple[Any, ...]] = field(default_factory=list)
    """as `_core.Results.islands`"""
    apart: bool = False
    dense = False
    span = (float("nan"), float("nan"))
    joints = np.empty(0)

    @classmethod
    def of(cls, record: Record) -> KeptRun:
        """A copy of a record, which needs no memory of the run."""
        return cls(
            time=np.array(record.time),
            jump=np.array(record.jump),
            outputs={name: np.array(array) for name, array in record.outputs.items()},
            context=record.context,
            status=record.status,
            message=record.message,
            block=record.block,
            statistics=record.statistics,
            events=[record.event(i) for i in range(record.event_count)],
            event_names=record.event_names,
            sensitivities=record.sensitivities,
            islands=[(*one[:2], *map(np.array, one[2:4]), *one[4:]) for one in record.islands],
            apart=record.apart,
        )

    @property
    def event_count(self) -> int:
        return len(self.events)

    def event(self, index: int, /) -> tuple[Any, ...]:
        return self.events[index]

    def event_times(self, name: str, kind: str | None, /) -> np.ndarray:
        path = name in self.event_names
        if not path and not any(full.endswith(f".{name}") for full in self.event_names):
            known = (
                self.event_names if "." in name else [n.split(".")[-1] for n in self.event_names]
            )
            known = list(dict.fromkeys(known))
            raise ModelError(f"no event is called '{name}'{_core.known_names(name, known)}")
        kinds = FIRINGS if kind is None else (kind,)
        return np.array(
            [
                e[0]
                for e in self.events
                if e[2] in kinds and name == (f"{e[4]}.{e[5]}" if path else e[5])
            ]
        )

    def at(self, times: Sequence[float], left: bool, /) -> tuple[np.ndarray, Columns]:
        raise ModelError(NOT_KEPT)

    sensitivities_at = at


KINDS: dict[str, Callable[[KeptRun, dict[str, Any]], Any]] = {}
"""kind in the header of a file -> makes the results of that kind of a run and the header"""


def same(a: Any, b: Any) -> bool:
    """Whether two values are equal: arrays by their shape and entries, and nan is equal to nan."""
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        if type(a) is not type(b) or a.shape != b.shape:
            return False
        return a.dtype.kind == b.dtype.kind and bool(((a == b) | ((a != a) & (b != b))).all())
    if isinstance(a, (tuple, list)) and isinstance(b, (tuple, list)):
        alike = isinstance(a, tuple) == isinstance(b, tuple) and len(a) == len(b)
        return alike and all(map(same, a, b))
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    return bool(a == b or (a != a and b != b))
