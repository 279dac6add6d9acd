"""A `Chart` as a figure of plotly."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus.results.charts.chart import COLOURS, Chart, Layer
from saltus.results.tables import extra

__all__ = ["AXIS", "HOLLOW", "by_plotly", "figure", "scatter"]

HOLLOW = {"color": "white", "size": 7}
LOOKS: dict[str, dict[str, Any]] = {
    "line": {"mode": "lines", "line": {"width": 2}},
    "jump": {"mode": "lines", "line": {"width": 1, "dash": "dash"}, "hoverinfo": "skip"},
    "hollow": {"mode": "markers", "marker": HOLLOW},
    "filled": {"mode": "markers", "marker": {"size": 7}},
    "square": {"mode": "markers", "marker": {"size": 8, "symbol": "square"}},
    "tick": {"mode": "markers", "marker": {"size": 16, "symbol": "line-ns-open"}},
    "bar": {"mode": "lines", "line": {"width": 10}, "opacity": 0.3},
}
AXIS = {"showline": True, "linecolor": "#444", "ticks": "outside", "gridcolor": "#eee",
        "zeroline": False}  # fmt: skip


def figure(**layout: Any) -> Any:
    """An empty figure with the style of all."""
    objects = extra("plotly.graph_objects", "backend='plotly'", _EXTRA)
    margin = {"l": 60, "r": 20, "t": 30, "b": 50}
    plain = {"plot_bgcolor": "white", "margin": margin, "legend": {"orientation": "h", "y": 1.08}}
    return objects.Figure(layout=plain | layout)


def scatter(x: Any, y: Any, kind: str, colour: str, **more: Any) -> Any:
    """A trace that breaks at each nan."""
    objects = extra("plotly.graph_objects", "backend='plotly'", _EXTRA)
    look: dict[str, Any] = {**LOOKS[kind], "connectgaps": False, "showlegend": False}
    part = "line" if look["mode"] == "lines" else "marker"
    look[part] = {"color": colour, **look[part]}
    if kind == "hollow":
        look["marker"] = {**HOLLOW, "line": {"color": colour, "width": 1.5}}
    return objects.Scatter(x=np.asarray(x), y=np.asarray(y), **look | more)


_EXTRA = ", or install Saltus with the extra [plotly]"


def by_plotly(chart: Chart, style: dict[str, Any]) -> Any:
    """Draws into a new figure."""
    drawn = figure(xaxis=_axis(chart.x_label, chart.x_log), yaxis=_axis(chart.y_label, chart.y_log))
    for layer in chart.layers:
        drawn.add_trace(_trace(layer, style))
    if chart.span is not None and chart.span[1] > chart.span[0]:
        drawn.update_xaxes(range=list(chart.span))
    if chart.backwards:
        drawn.update_xaxes(autorange="reversed")
    if chart.rows:
        count = len(chart.rows)
        drawn.update_yaxes(tickvals=list(range(count)), ticktext=chart.rows, showline=False,
                           ticks="", range=[count - 0.4, -0.6])  # fmt: skip
        drawn.update_layout(height=140 + 34 * count)
    return drawn


def _axis(title: str, log: bool) -> dict[str, Any]:
    return {**AXIS, "title": {"text": title}, "type": "log" if log else "linear"}


def _trace(layer: Layer, style: dict[str, Any]) -> Any:
    chosen = style if layer.kind in ("line", "tick", "filled") else {}
    colour = str(style.get("color", COLOURS[layer.colour % len(COLOURS)]))
    named = {"name": layer.label, "showlegend": bool(layer.label)}
    more = {key: value for key, value in chosen.items() if key != "color"}
    return scatter(layer.x, layer.y, layer.kind, colour, **named | more)
