"""A `Chart` as axes of matplotlib."""

from __future__ import annotations

from typing import Any

from saltus.results.charts.chart import COLOURS, Chart, Layer
from saltus.results.tables import extra

__all__ = ["by_matplotlib"]

LOOKS: dict[str, dict[str, Any]] = {
    "line": {"linewidth": 1.5},
    "jump": {"linewidth": 0.9, "linestyle": "--", "alpha": 0.8},
    "hollow": {"linestyle": "none", "marker": "o", "markersize": 5.0, "markerfacecolor": "white",
               "markeredgewidth": 1.1, "zorder": 3},
    "filled": {"linestyle": "none", "marker": "o", "markersize": 5.0, "markeredgewidth": 0.0,
               "zorder": 3},
    "square": {"linestyle": "none", "marker": "s", "markersize": 6.0, "zorder": 3},
    "tick": {"linestyle": "none", "marker": "|", "markersize": 14.0, "markeredgewidth": 1.1},
    "bar": {"linewidth": 8.0, "alpha": 0.3, "solid_capstyle": "butt"},
}  # fmt: skip
FEW = 60  # markers of full size; more would cover the curve
ROW = 0.32  # [inch]


def by_matplotlib(chart: Chart, ax: Any, style: dict[str, Any]) -> Any:
    """Draws into the axes, or into new ones, and returns them."""
    if ax is None:
        plt = extra("matplotlib.pyplot", "this plot")
        height = 0.9 + ROW * len(chart.rows) if chart.rows else 4.0
        _, ax = plt.subplots(figsize=(7.0 if chart.rows else 5.2, height), layout="constrained")
    for layer in chart.layers:
        _add(ax, layer, style)
    _scales(ax, chart)
    ax.spines[["top", "right"]].set_visible(False)
    return ax


def _add(ax: Any, layer: Layer, style: dict[str, Any]) -> None:
    look: dict[str, Any] = {
        "color": COLOURS[layer.colour % len(COLOURS)],
        "label": layer.label or "_",
    }
    look |= LOOKS[layer.kind]
    if layer.kind in ("hollow", "filled") and len(layer.x) > FEW:
        look["markersize"] = 2.0
    chosen = dict(style)
    if "c" in chosen:
        chosen["color"] = chosen.pop("c")
    if layer.kind not in ("line", "tick", "filled"):  # the others follow in colour only
        chosen = {key: value for key, value in chosen.items() if key == "color"}
    ax.plot(layer.x, layer.y, **look | chosen)


def _scales(ax: Any, chart: Chart) -> None:
    ax.set_xlabel(chart.x_label)
    ax.set_ylabel(chart.y_label)
    if chart.x_log:
        ax.set_xscale("log")
    if chart.y_log:
        ax.set_yscale("log")
    if chart.span is not None and chart.span[1] > chart.span[0]:
        margin = 0.01 * (chart.span[1] - chart.span[0])
        ax.set_xlim(chart.span[0] - margin, chart.span[1] + margin)
    if chart.backwards:
        ax.xaxis.set_inverted(True)
    if chart.rows:
        ax.set_yticks(range(len(chart.rows)), chart.rows)
        ax.set_ylim(len(chart.rows) - 0.4, -0.6)
        ax.tick_params(axis="y", length=0)
        ax.spines["left"].set_visible(False)
