"""What a run gives back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, overload

import numpy as np

from saltus import _core
from saltus.errors import ModelError

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped,import-not-found,unused-ignore]
    import xarray  # type: ignore[import-not-found,unused-ignore]

__all__ = ["Event", "EventLog", "Results", "Statistics"]


class Event(NamedTuple):
    """One event of a run."""

    time: float
    """[s]"""
    jump: int
    """how many passes had changed something when it was over: orders events of one time"""
    kind: str
    """'zero_crossing', 'time', 'zeno_enter', 'zeno_release' or 'terminal'"""
    direction: int
    """+1: its guard was rising, -1: falling, 0: no guard"""
    block: str
    name: str
    predicted: float
    """[s] when infinitely many resets would have happened, of 'zeno_enter'; else nan"""
    before: np.ndarray
    """continuous state of the block before it"""
    after: np.ndarray
    """and after it"""
    entry: int
    """which guard of a vector of them fired; 0 if there is one"""


class EventLog(Sequence[Event]):
    """Every event of a run, in order."""

    def __init__(self, core: _core.Results):
        self._core = core

    def __len__(self) -> int:
        return self._core.event_count

    @overload
    def __getitem__(self, index: int) -> Event: ...
    @overload
    def __getitem__(self, index: slice) -> list[Event]: ...
    def __getitem__(self, index: int | slice) -> Event | list[Event]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        count = len(self)
        if not -count <= index < count:
            raise IndexError(f"event {index} of {count}")
        return Event(*self._core.event(index % count))

    def times(self, name: str, kind: str = "zero_crossing") -> np.ndarray:
        """[s] when the events of one name ('bounce' or 'ball.bounce') and kind happened."""
        return self._core.event_times(name, kind)

    def __repr__(self) -> str:
        lines = [
            f"{e.time:<22.17g} {e.jump:>4}  {e.kind:<13}  {e.block}.{e.name}" for e in self[:20]
        ]
        more = [f"... and {len(self) - 20} more"] if len(self) > 20 else []
        return "\n".join([f"{len(self)} events", *lines, *more])


@dataclass(frozen=True)
class Statistics:
    """Counts, summed over the whole run."""

    method: str
    """the method that was used"""
    stretches: list[tuple[str, float, float, int]]
    """which method when, as (method, begin [s], end [s], steps): more than one with 'auto' only"""
    steps: int
    """accepted minor steps"""
    rejected: int
    restarts: int
    """how often the method had to begin anew"""
    right_hand_side_calls: int
    guard_calls: int
    """of all guards at once"""
    jacobian_calls: int
    linear_setups: int
    linear_solver: str
    """which one a stiff method used, for what size, and why; empty without a stiff method"""
    instants: int
    """major steps"""
    events: int
    """resets, updates and mode changes"""
    events_by_name: dict[str, int]
    """how often each event happened: ``{"ball.bounce": 6}``"""
    wall_time: float
    """[s]"""


class _Outputs(dict[str, np.ndarray]):
    """Recorded signals by name; an unknown name is answered with the known ones."""

    def __missing__(self, name: str) -> np.ndarray:
        raise ModelError(
            f"nothing was recorded under {name!r}{_core.known_names(name, list(self))}"
        )


class Results:
    """What was recorded, the event log, the final values, and how the run ended.

    The arrays show the memory of the run without a copy, and keep it as long as one of them lives.
    """

    time: np.ndarray
    """[s] of each row; never decreases. Each event has a row before and a row after it."""
    jump: np.ndarray
    """tells rows of one time apart: it goes up by one with each pass that changed something"""
    outputs: dict[str, np.ndarray]
    """recorded signals by name: one value a row for a scalar, a row of values for a vector"""
    events: EventLog
    context: _core.Context
    """the values at the end; a run can go on from here"""
    status: str
    """'reached_end', 'terminal', 'zeno_stop', 'step_limit', 'chattering', 'interrupted' or
    'failed'
    """
    message: str
    """why, where the status is none of the first three"""
    block: str
    """path of the block at fault, where it was one"""
    cause: BaseException | None
    """what was raised, where the status is 'failed'"""
    statistics: Statistics

    def __init__(self, core: _core.Results, raised: BaseException | None = None):
        self.time = core.time
        self.jump = core.jump
        self.outputs = _Outputs(core.outputs)
        self.events = EventLog(core)
        self.context = core.context
        self.status = core.status
        self.message = core.message
        self.block = core.block
        self.cause = raised if core.status == "failed" else None
        self.statistics = Statistics(**core.statistics)

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each (time, jump), a column for each number: 'y', or 'y[0]', 'y[1]', ... for a
        vector. Needs pandas.
        """
        import pandas

        columns = {}
        for name, array in self.outputs.items():
            if array.ndim == 1:
                columns[name] = array
            else:
                columns.update({f"{name}[{i}]": array[:, i] for i in range(array.shape[1])})
        index = pandas.MultiIndex.from_arrays([self.time, self.jump], names=["time", "jump"])
        return pandas.DataFrame(columns, index=index)

    def to_xarray(self) -> xarray.Dataset:
        """A variable for each signal over 'time', with 'jump' beside it; vectors have a second
        dimension of their own, called after them. Needs xarray.
        """
        import xarray

        signals = {
            name: (("time",) if array.ndim == 1 else ("time", f"{name}_entry"), array)
            for name, array in self.outputs.items()
        }
        coordinates = {"time": ("time", self.time, {"units": "s"}), "jump": ("time", self.jump)}
        return xarray.Dataset(signals, coordinates, {"status": self.status})

    def __repr__(self) -> str:
        span = f", t = {self.time[0]:g} to {self.time[-1]:g} s" if len(self.time) else ""
        signals = (
            ", ".join(f"{name} {array.shape}" for name, array in self.outputs.items())
            or "nothing recorded"
        )
        why = f"\n  {self.message}" if self.message else ""
        counts = (
            f"{len(self.events)} events, {self.statistics.steps} steps of {self.statistics.method}"
        )
        return f"<Results: {self.status}, {len(self.time)} rows{span}; {signals}; {counts}>{why}"
