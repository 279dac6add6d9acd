"""`Film`: the values of all frames; `Moment`: what a drawing sees of one of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus.errors import ModelError
from saltus.results.animation.schedule import Schedule
from saltus.results.values import Values

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["Film", "Moment", "film_of"]

LONGEST = 2.0  # [frames] between two rows, where values between rows are straight lines


class Moment(Values):
    """The values of one frame: those of `results(t)`, and which frame it is.

    Attributes
    ----------
    time : float
        [s]
    continuous_state : ndarray
        The state of all blocks; empty if the run kept no dense output.
    index : int
        The number of the frame, from 0.
    side : {'left', 'right'}
        'left' for the values before the event of this time.
    events : tuple of str
        The names of the events at this time, if the frame shows x- or x+ of them.
    film : Film
        All frames; ``film.values`` has their values.
    """

    def __init__(self, film: Film, index: int):
        outputs = {name: array[index] for name, array in film.values.items()}
        super().__init__(float(film.times[index]), film.values.continuous_state[index], outputs)
        self.film = film
        self.index = index
        self.side = "left" if film.left[index] else "right"
        self.events = film.names_at(index)

    def fired(self, name: str) -> int:
        """How many events of this name have had their effect up to this frame."""
        times = self.film.results.events.times(name)
        return int(np.searchsorted(times, self.time, side=self.side))  # type: ignore[call-overload]

    @property
    def results(self) -> Results:
        """The run."""
        return self.film.results


@dataclass(frozen=True)
class Film:
    """All frames: a sequence of `Moment`."""

    results: Results
    schedule: Schedule
    values: Values
    """the signals by name; the first dimension of each counts the frames"""
    names: dict[float, tuple[str, ...]]
    """[s] the names of the events that have frames of their own"""

    @property
    def times(self) -> np.ndarray:
        """[s] of each frame."""
        return self.schedule.times

    @property
    def left(self) -> np.ndarray:
        """Whether a frame shows the values before its event."""
        return self.schedule.left

    def names_at(self, index: int) -> tuple[str, ...]:
        return self.names.get(float(self.times[index]), ())

    def __len__(self) -> int:
        return len(self.schedule)

    def __getitem__(self, index: int) -> Moment:
        if not -len(self) <= index < len(self):
            raise IndexError(f"frame {index} of {len(self)}")
        return Moment(self, index % len(self))

    def __iter__(self) -> Iterator[Moment]:
        return (Moment(self, index) for index in range(len(self)))


def film_of(results: Results, schedule: Schedule, frame: float) -> Film:
    """The values of all frames, from dense output, or else between rows that are close enough.

    Parameters
    ----------
    frame : float
        [s] of the run that pass in one frame.
    """
    values = _dense(results, schedule) if results.dense else _rows(results, schedule, frame)
    wanted, names = set(schedule.events), dict[float, tuple[str, ...]]()
    for event in results.events:
        if event.time in wanted and event.name not in (known := names.get(event.time, ())):
            names[event.time] = (*known, event.name)
    return Film(results, schedule, values, names)


def _dense(results: Results, schedule: Schedule) -> Values:
    before, after = (results(schedule.times, side=side) for side in ("left", "right"))

    def chosen(left: Any, right: Any) -> np.ndarray:
        where = schedule.left.reshape(-1, *[1] * (np.ndim(left) - 1))
        return np.asarray(np.where(where, left, right))

    state = chosen(before.continuous_state, after.continuous_state)
    return Values(schedule.times, state, {n: chosen(before[n], after[n]) for n in before})


def _rows(results: Results, schedule: Schedule, frame: float) -> Values:
    time = results.time
    gap = float(np.max(np.diff(time), initial=0.0))
    if gap > LONGEST * frame * (1 + 1e-9):
        raise ModelError(
            f"animate: this run kept no dense output, and its rows are up to {gap:.3g} s apart, "
            f"while a frame is {frame:.3g} s; run it with dense_output=True, or with rows at "
            f"save_at times at most {LONGEST * frame:.3g} s apart"
        )
    columns = {name: _between(time, a, schedule) for name, a in results.outputs.items()}
    return Values(schedule.times, np.empty((len(schedule), 0)), columns)


def _between(time: np.ndarray, column: np.ndarray, schedule: Schedule) -> np.ndarray:
    """Straight lines between rows; of rows of one time the first is x-, the last is x+."""
    at = schedule.times
    first = np.searchsorted(time, at, side="left")  # the first row at or after the time
    last = np.searchsorted(time, at, side="right") - 1  # the last row at or before it
    row = first <= last  # there is a row at this time
    begin = np.clip(np.where(row & schedule.left, first, last), 0, len(time) - 1)
    end = np.clip(np.where(row, begin, first), 0, len(time) - 1)
    width = time[end] - time[begin]
    share = np.divide(at - time[begin], width, out=np.zeros_like(at), where=width > 0)
    share = share.reshape(-1, *[1] * (column.ndim - 1))
    return np.asarray((1.0 - share) * column[begin] + share * column[end])
