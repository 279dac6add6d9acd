"""Signals over time, by plotly."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from saltus.results.charts.by_plotly import AXIS, figure, scatter
from saltus.results.charts.chart import COLOURS
from saltus.results.charts.signals import chosen, wide_jumps
from saltus.results.curves import Curve, holds_of

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["plot"]

GAP = 0.06  # part of the height between two panels


def plot(results: Results, names: tuple[str, ...], style: dict[str, Any]) -> Any:
    """A figure with a panel for each signal, over one time axis."""
    panels = chosen(results, names)
    last = len(panels)
    drawn = figure(height=160 + 180 * last)
    drawn.update_layout(xaxis={**AXIS, "title": {"text": "time [s]"}, "anchor": f"y{last}"})
    for row, (title, curves) in enumerate(panels):
        axis = {**AXIS, "title": {"text": title}, "domain": _domain(row, last)}
        if len(curves) == 1 and (modes := results.mode_names.get(curves[0].label)):
            axis |= {"tickvals": list(range(len(modes))), "ticktext": list(modes)}
        drawn.update_layout({f"yaxis{row + 1}": axis})
        for number, each in enumerate(curves):
            _add(drawn, each, row, COLOURS[number % len(COLOURS)], len(curves) > 1, style)
    for begin, end in holds_of(results):
        drawn.add_vrect(x0=begin, x1=end, fillcolor="#888", opacity=0.13, line_width=0)
    return drawn


def _domain(row: int, count: int) -> list[float]:
    """The part of the height of a panel; the first is on top."""
    height = (1.0 - GAP * (count - 1)) / count
    low = (count - 1 - row) * (height + GAP)
    return [low, low + height]


def _add(
    drawn: Any, curve: Curve, row: int, usual: str, named: bool, style: dict[str, Any]
) -> None:
    colour = str(style.get("color", usual))
    more = {key: value for key, value in style.items() if key != "color"}
    place = {"xaxis": "x", "yaxis": f"y{row + 1}", "name": curve.label}
    drawn.add_trace(
        scatter(curve.time, curve.value, "line", colour, **place | {"showlegend": named} | more)
    )
    wide = wide_jumps(curve)
    for kind, points in (("hollow", curve.before[wide]), ("filled", curve.after[wide])):
        if len(points):
            drawn.add_trace(scatter(points[:, 0], points[:, 1], kind, colour, **place))
