"""The Zeno zoom: events that accumulate, over the logarithm of the time that is left."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from saltus.errors import ModelError
from saltus.results.charts.chart import Chart, Layer
from saltus.results.charts.numbers import Which, curve, with_unit
from saltus.results.events import Event
from saltus.results.record import FIRINGS

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["chart_of"]

ROUNDING = 1e-9  # part of the largest value; a negative height within it is zero


def chart_of(results: Results, name: str | None, signal: Which | None) -> Chart:
    """The chart for `Results.plot_zeno`."""
    hold = _hold(results, name)
    times = _before(results, hold)
    label = "time to the accumulation, t* - t [s]"
    if signal is None:
        number = np.arange(1.0, len(times) + 1.0)
        layer = Layer(hold.predicted - times, number, "filled")
        return Chart(label, "number of the event", [layer], x_log=True, backwards=True)
    drawn = curve(results, signal)
    begin = _release_before(results, hold)
    rows = (drawn.time >= begin) & (drawn.time < hold.predicted) & (drawn.time <= hold.time)
    left, value = hold.predicted - drawn.time[rows], drawn.value[rows]
    finite = value[np.isfinite(value)]
    positive = bool(np.all(finite >= -ROUNDING * np.max(finite, initial=0.0)))
    if positive:  # a height is zero, or rounding, at the events: no logarithm shows that
        value = np.where(np.isin(drawn.time[rows], times) | (value <= 0.0), np.nan, value)
    layer = Layer(left, value, "line")
    y_label = with_unit(results, drawn.label)
    return Chart(label, y_label, [layer], x_log=True, y_log=positive, backwards=True)


def _hold(results: Results, name: str | None) -> Event:
    """The first hold of the events of this name."""
    if name is not None:
        results.events.times(name)  # refuses an unknown name
    for e in results.events:
        if e.kind == "zeno_enter" and name in (None, e.name, f"{e.block}.{e.name}"):
            if np.isfinite(e.predicted) and len(_before(results, e)):
                return e
    of = "event" if name is None else f"event '{name}'"
    raise ModelError(
        f"plot_zeno: no {of} accumulated in this run; a hold begins when the gaps between events "
        "have shrunk to zeno_tolerance, so a longer run may have one"
    )


def _before(results: Results, hold: Event) -> np.ndarray:
    """[s] The events of the guard before its hold, after any hold before that."""
    begin = _release_before(results, hold)
    return np.array(
        [
            e.time
            for e in results.events
            if e.kind in FIRINGS
            and _same(e, hold)
            and begin < e.time < hold.predicted
            and e.time <= hold.time
        ]
    )


def _release_before(results: Results, hold: Event) -> float:
    """[s] The end of the hold before this one, or the begin of time."""
    ends = [e.time for e in results.events
            if e.kind == "zeno_release" and _same(e, hold) and e.time < hold.time]  # fmt: skip
    return max(ends, default=-np.inf)


def _same(e: Event, hold: Event) -> bool:
    return (e.block, e.name, e.entry) == (hold.block, hold.name, hold.entry)
