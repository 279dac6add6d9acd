"""The phase portrait: one number over another, with jumps dashed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from saltus.results.charts.chart import Chart, Layer
from saltus.results.charts.numbers import Which, label_of, labels_of, with_unit
from saltus.results.curves import refined

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["chart_of"]

ROUNDING = 1e-9  # part of the range; a smaller jump is invisible


def chart_of(results: Results, x: Which, y: Which) -> Chart:
    """The chart for `Results.plot_phase`."""
    labels = label_of(results, x), label_of(results, y)
    time, jump, columns = refined(results)
    flat = np.hstack([a.reshape(len(time), -1).astype(float) for a in columns.values()])
    names = labels_of(results)
    points = flat[:, [names.index(label) for label in labels]]
    layers = []
    if len(points):
        leap = _leaps(time, jump, points)
        flow = np.insert(points, leap, np.nan, axis=0)
        layers = [_layer(flow, "line"), *_jumps(points[leap - 1], points[leap])]
        layers.append(_layer(points[:1], "square"))
    return Chart(with_unit(results, labels[0]), with_unit(results, labels[1]), layers)


def _layer(points: np.ndarray, kind: str) -> Layer:
    return Layer(points[:, 0], points[:, 1], kind)


def _leaps(time: np.ndarray, jump: np.ndarray, points: np.ndarray) -> np.ndarray:
    """The rows after each jump that changes the place in the picture."""
    size = np.ptp(np.where(np.isfinite(points), points, 0.0), axis=0)
    moved = (np.abs(np.diff(points, axis=0)) > ROUNDING * size).any(axis=1)
    return np.flatnonzero((np.diff(jump) > 0) & (np.diff(time) == 0) & moved) + 1


def _jumps(before: np.ndarray, after: np.ndarray) -> list[Layer]:
    if not len(before):
        return []
    gap = np.full_like(before, np.nan)
    dashed = np.stack([before, after, gap], axis=1).reshape(-1, 2)[:-1]
    return [
        _layer(dashed, "jump"),
        _layer(before, "hollow"),
        _layer(after, "filled"),
    ]
