"""The event raster: the times of events, a row for each name."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from saltus.errors import ModelError
from saltus.results.charts.chart import Chart, Layer
from saltus.results.events import Event
from saltus.results.record import FIRINGS

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["chart_of"]


def chart_of(results: Results, names: tuple[str, ...]) -> Chart:
    """The chart for `Results.plot_events`."""
    rows = list(names) or _happened(results)
    layers = []
    for row, name in enumerate(rows):
        times = results.events.times(name)  # refuses an unknown name
        layers.append(Layer(times, np.full(len(times), float(row)), "tick", row))
        spans = _holds(results, name)
        if spans:
            x = np.array([edge for begin, end in spans for edge in (begin, end, np.nan)])
            layers.append(Layer(x, np.full(len(x), float(row)), "bar", row))
    ends = sorted([float(results.time[0]), results._ended_at]) if len(results.time) else None
    span = None if ends is None else (ends[0], ends[1])
    return Chart("time [s]", "", layers, span=span, rows=rows)


def _happened(results: Results) -> list[str]:
    """The paths of all events with an effect, in the order in which they first happened."""
    paths = list(dict.fromkeys(_path(e) for e in results.events if e.kind in FIRINGS))
    paths += [p for p in dict.fromkeys(_path(e) for e in results.events) if p not in paths]
    if not paths:
        raise ModelError("no event happened in this run, or record_events=False kept none")
    return paths


def _holds(results: Results, name: str) -> list[tuple[float, float]]:
    """[s] The spans of the holds that began at an event of this name."""
    spans, open_since = [], dict[tuple[str, int], float]()
    for e in results.events:
        if name not in (e.name, _path(e)):
            continue
        key = (e.block, e.entry)
        if e.kind == "zeno_enter":
            open_since.setdefault(key, e.time)
        elif e.kind == "zeno_release" and key in open_since:
            spans.append((open_since.pop(key), e.time))
    return spans + [(begin, results._ended_at) for begin in open_since.values()]


def _path(event: Event) -> str:
    return f"{event.block}.{event.name}"
