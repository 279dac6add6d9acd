"""`Island`: a part of a scene that stepped apart, with its rows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NoReturn

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.results.record import same
from saltus.results.statistics import Statistics

if TYPE_CHECKING:
    from saltus.results.record import Record

__all__ = ["Island", "islands_of", "refuse_common_rows", "rows_of"]


@dataclass(frozen=True, eq=False)
class Island:
    """One island of a run with the option `islands`."""

    name: str
    """the path of its first block"""
    blocks: int
    """the number of its blocks, with the sources that it reads"""
    time: np.ndarray
    """[s] of its rows; never decreases. Empty if all signals have one table"""
    jump: np.ndarray
    """distinguishes rows of one time; counted in this island alone"""
    statistics: Statistics
    """the counts of this island alone"""
    signals: tuple[str, ...]
    """the recorded signals that have its rows"""

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Island) and same(vars(self), vars(other))

    def __hash__(self) -> int:
        return hash((self.name, self.signals))


def islands_of(record: Record) -> tuple[Island, ...]:
    return tuple(
        Island(name, blocks, time, jump, Statistics(**counts), signals)
        for name, blocks, time, jump, counts, signals in record.islands
    )


def refuse_common_rows(record: Record, asked: str) -> NoReturn:
    """Where one time for all is `asked` for, but the signals have times of their own."""
    first = next(iter(record.outputs))
    raise ModelError(
        f"{asked}: the islands of this run have rows of their own, so there is no common time; "
        f"read results.time_of({first!r}), or run it with save_at=[...] and event_rows=False, "
        "which gives all signals one table"
    )


def rows_of(record: Record, name: str) -> tuple[np.ndarray, np.ndarray]:
    """[s] time, and jump, of each row of a recorded signal."""
    outputs = record.outputs
    if name not in outputs:
        raise ModelError(
            f"nothing was recorded under {name!r}{_core.known_names(str(name), list(outputs))}"
        )
    if not record.apart:
        return record.time, record.jump
    _, _, time, jump, _, _ = next(one for one in record.islands if name in one[5])
    return time, jump
