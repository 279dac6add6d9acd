"""The derivatives of the values of a run, and the places where there are none."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple, NoReturn

import numpy as np

from saltus._evaluate import rates
from saltus.differentiable.values import RunValues, leaves
from saltus.errors import SimulationError
from saltus.results import Results
from saltus.results.record import FIRINGS
from saltus.results.sensitivities import Gap
from saltus.system import System

__all__ = ["Derivatives", "derivatives_of", "raise_for_gap"]

AT_ROW = "the event moves, and it happens at a time at which values are returned"
AT_ZENO = "the run ended where events accumulate, after a number of them that may change"
ROUNDING = 1e-12
"""relative distance of two times that are one: a root is located to some roundings of the time"""


class Derivatives(NamedTuple):
    """The derivatives of each value, with the parameters along the last axis; nan after a gap."""

    columns: RunValues
    gaps: tuple[Gap, ...]


def derivatives_of(system: System, results: Results, counts: Mapping[str, int]) -> Derivatives:
    """The derivatives of the values of a run."""
    found = results.sensitivities
    end, state = _end(system, results)
    columns = RunValues(
        {name: np.array(found[name]) for name in found},
        state,
        np.array(found.discrete_state),
        end,
        {name: results.events.dt_dp(name)[:count] for name, count in counts.items()},
    )
    return Derivatives(columns, (*found.gaps, *_lost(results, columns)))


def _end(system: System, results: Results) -> tuple[np.ndarray, np.ndarray]:
    """The derivatives of the end and of the last state. If a guard ended the run, those of the
    state are total ones: S at a fixed time, and f times the derivative of the end.
    """
    found = results.sensitivities
    state = np.array(found.continuous_state)
    if results.status != "terminal":
        return np.zeros(len(found.parameters)), state
    end = results.events.dt_dp(kind="terminal")[-1]
    return end, state + np.outer(rates(system, results.context), end)


def _lost(results: Results, columns: RunValues) -> Iterator[Gap]:
    """Replaces by nan what has no derivative although the run has, and says why."""
    for time, event, name, parameter in _moving(results):
        rows = np.isclose(results.time, time, rtol=ROUNDING, atol=0.0)
        ends = results.status == "reached_end" and np.isclose(
            results.context.time, time, rtol=ROUNDING, atol=0.0
        )
        for array in columns.outputs.values():
            array[rows, ..., parameter] = np.nan
        if ends:
            columns.continuous_state[:, parameter] = np.nan
            columns.discrete_state[:, parameter] = np.nan
        if ends or rows.any():
            yield Gap(time, event, name, AT_ROW)
    if results.status == "zeno_stop":
        yield from _at_zeno(results, columns)


def _moving(results: Results) -> Iterator[tuple[float, str, str, int]]:
    """(time, path, parameter, its place) of each event whose time has a derivative that is not 0.

    At such a time the row before the event and the row after it have two derivatives.
    """
    fired = [event for event in results.events if event.kind in FIRINGS]
    names = results.sensitivities.parameters
    for event, slopes in zip(fired, results.events.dt_dp(), strict=True):
        for place in np.flatnonzero(slopes != 0.0):
            yield event.time, f"{event.block}.{event.name}", names[place], int(place)


def _at_zeno(results: Results, columns: RunValues) -> Iterator[Gap]:
    for array in (columns.continuous_state, columns.discrete_state, columns.end_time):
        array[...] = np.nan
    last = results.events[-1]
    for name in results.sensitivities.parameters:
        yield Gap(last.time, f"{last.block}.{last.name}", name, AT_ZENO)


def raise_for_gap(where: str, found: Derivatives, parameters: tuple[str, ...]) -> None:
    """Raises SimulationError for the first value without a derivative, with the gap behind it."""
    for name, array in leaves(found.columns):
        missing = ~np.isfinite(array)
        if missing.any():
            parameter = parameters[int(np.argwhere(missing)[0, -1])]
            _refuse(where, name, parameter, found.gaps)


def _refuse(where: str, value: str, parameter: str, gaps: tuple[Gap, ...]) -> NoReturn:
    own = sorted((gap for gap in gaps if gap.parameter == parameter), key=lambda gap: gap.time)
    gap = own[0] if own else Gap(np.nan, "", parameter, "the derivative is not finite")
    at = f"t = {gap.time} s: " if own else ""
    event = f" from the event '{gap.event}' on" if gap.event else ""
    raise SimulationError(
        f"{where}: {at}'{value}' has no derivative by '{parameter}'{event}: {gap.reason}; leave "
        "that parameter out of wrt, return values of other times only, or say gaps='nan' for nan",
        gap.time,
        gap.event.rpartition(".")[0],
    )
