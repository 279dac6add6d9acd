"""What was measured in one experiment, and what a run says about it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.fitting.experiment import EventTimes
from saltus.fitting.tables import sigma_of
from saltus.results import Results

__all__ = [
    "EventSeries",
    "Model",
    "Observed",
    "Series",
    "event_series",
    "refuse_unknown_sigma",
    "series",
]


class Model(NamedTuple):
    """The values of a run in place of the data, and their derivatives."""

    values: np.ndarray
    derivatives: np.ndarray
    """(data, parameters); nan where there is none"""


class Observed(Protocol):
    """Data of one name: `data`, their standard deviations and times."""

    @property
    def name(self) -> str: ...
    @property
    def time(self) -> np.ndarray: ...
    @property
    def data(self) -> np.ndarray: ...
    @property
    def sigma(self) -> np.ndarray: ...
    @property
    def entry(self) -> np.ndarray: ...

    def model(self, results: Results, count: int) -> Model: ...


@dataclass(frozen=True)
class Series:
    """The finite data of one signal, in one row of numbers."""

    name: str
    recorded: str
    """the name under which the run records the signal"""
    time: np.ndarray
    data: np.ndarray
    sigma: np.ndarray
    row: np.ndarray
    """the row of the run for each value"""
    entry: np.ndarray
    """the entry of the signal for each value"""

    def model(self, results: Results, count: int) -> Model:
        """The values of the run at the times of the data, after the events at these times."""
        outputs = results.outputs[self.recorded]
        values = outputs.reshape(len(outputs), -1)[self.row, self.entry]
        if not count:
            return Model(values, np.empty((len(values), 0)))
        slopes = results.sensitivities[self.recorded]
        return Model(values, slopes.reshape(len(slopes), -1, count)[self.row, self.entry])


def series(
    where: str,
    name: str,
    recorded: str,
    entry: tuple[int, ...] | None,
    shape: tuple[int, ...],
    *columns: np.ndarray,
) -> Series:
    """The data of a signal, or of an entry of it. `columns` are the times, the rows of the run, the
    values and their standard deviations. ModelError if the shape is not that of the signal.
    """
    time, rows, values, sigma = columns
    width = math.prod(shape)
    first = 0 if entry is None else _place(f"{where}: '{name}'", entry, shape)
    wanted = 1 if entry is not None else width
    found = math.prod(values.shape[1:])
    if found != wanted:
        raise ModelError(
            f"{where}: '{name}': expected {wanted} numbers for each time, found {found}; an entry "
            "of a vector is called 'name[0]', of a matrix 'name[0,0]'"
        )
    values, sigma = values.reshape(-1, wanted), sigma.reshape(-1, wanted)
    at, which = np.nonzero(np.isfinite(values))
    return Series(
        name,
        recorded,
        time[at],
        values[at, which],
        sigma[at, which],
        rows[at],
        which + first,
    )


def _place(what: str, entry: tuple[int, ...], shape: tuple[int, ...]) -> int:
    """The place of an entry among all of a signal."""
    shape = shape or (1,)
    if len(entry) != len(shape) or any(i >= n for i, n in zip(entry, shape, strict=True)):
        first = ",".join("0" for _ in shape)
        raise ModelError(
            f"{what}: the signal has {math.prod(shape)} entries, the first is [{first}]"
        )
    return int(np.ravel_multi_index(entry, shape))


@dataclass(frozen=True)
class EventSeries:
    """The seen times of one event; `entry` is the number of each."""

    name: str
    kind: str | None
    data: np.ndarray
    sigma: np.ndarray
    entry: np.ndarray
    end: float
    """[s] of the run, where an event is taken that the run does not have"""

    @property
    def time(self) -> np.ndarray:
        return self.data

    def model(self, results: Results, count: int) -> Model:
        """The times of the events of the run with the same numbers."""
        times, slopes = self._found(results, self.kind, count)
        missing = int(self.entry.max(initial=-1)) + 1 - len(times)
        if missing > 0:
            last, slope = self._beyond(results, count)
            times = np.append(times, np.full(missing, last))
            slopes = np.concatenate([slopes, np.tile(slope, (missing, 1))])
        return Model(times[self.entry], slopes[self.entry])

    def lacking(self, results: Results) -> str:
        """Which events of the data the run does not have before its end, in words; empty if none.
        Those that accumulated before it are there.
        """
        wanted = int(self.entry.max(initial=-1)) + 1
        count = len(self._found(results, self.kind, 0)[0])
        if count >= wanted or self._beyond(results, 0)[0] != self.end:
            return ""
        return (
            f"the run has {count} of the {wanted} events '{self.name}' before its end at "
            f"t = {self.end:g} s; a missing one counts at the end, where it does not depend on "
            "parameters: make t_span longer, or give other start values"
        )

    def _found(
        self, results: Results, kind: str | None, count: int
    ) -> tuple[np.ndarray, np.ndarray]:
        log = results.events
        times = log.times(self.name, kind)
        slopes = log.dt_dp(self.name, kind) if count else np.empty((len(times), 0))
        if kind == "zeno_enter":
            times = np.array([e.predicted for e in log if e.kind == kind and self._is(e)])
        return times, slopes

    def _is(self, event: Any) -> bool:
        return self.name in (event.name, f"{event.block}.{event.name}")

    def _beyond(self, results: Results, count: int) -> tuple[float, np.ndarray]:
        """The time of an event that the run does not have, and its derivatives."""
        log = results.events
        if self.kind is None and not len(log.times(self.name, "zeno_release")):
            times, slopes = self._found(results, "zeno_enter", count)
            if len(times):
                return float(times[-1]), slopes[-1]
        return self.end, np.zeros(count)


def event_series(where: str, name: str, given: EventTimes, sigma: Any, end: float) -> EventSeries:
    """The seen times of an event, with their standard deviations and numbers."""
    times = np.asarray(given.times)
    if given.sigma is not None:
        sigma = given.sigma
    elif not isinstance(sigma, Mapping):
        sigma = None  # a number is meant for the signals
    deviations = sigma_of(where, sigma, name, times)
    seen = np.flatnonzero(np.isfinite(times))
    return EventSeries(name, given.kind, times[seen], deviations[seen], seen, end)


def refuse_unknown_sigma(where: str, sigma: Any, names: list[str]) -> None:
    """ModelError for a standard deviation of something that was not measured."""
    for name in sigma if isinstance(sigma, Mapping) else ():
        if name not in names:
            raise ModelError(
                f"{where}: sigma: the data have no '{name}'{_core.known_names(str(name), names)}"
            )
