"""The plots of results."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from saltus.results.charts.by_matplotlib import by_matplotlib
from saltus.results.charts.by_plotly import by_plotly
from saltus.results.charts.chart import Chart, checked_backend

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["draw_phase", "draw_raster", "draw_section", "draw_signals", "draw_zeno"]

Style = dict[str, Any]
Names = tuple[str, ...]
Which = str | int


def _drawn(chart: Chart, ax: Any, backend: str, style: Style) -> Any:
    """The chart, drawn by one of the libraries."""
    return by_matplotlib(chart, ax, style) if backend == "matplotlib" else by_plotly(chart, style)


def draw_signals(results: Results, names: Names, ax: Any, backend: str, style: Style) -> Any:
    """Draws the signals for `Results.plot`."""
    checked_backend(backend, ax)
    if backend == "plotly":
        from saltus.results.charts.signals_plotly import plot

        return plot(results, names, style)
    from saltus.results.charts.signals import plot as plot_axes

    return plot_axes(results, names, ax, style)


def draw_phase(results: Results, x: Which, y: Which, ax: Any, backend: str, style: Style) -> Any:
    from saltus.results.charts.phase import chart_of

    checked_backend(backend, ax)
    return _drawn(chart_of(results, x, y), ax, backend, style)


def draw_raster(results: Results, names: Names, ax: Any, backend: str, style: Style) -> Any:
    from saltus.results.charts.raster import chart_of

    checked_backend(backend, ax)
    return _drawn(chart_of(results, names), ax, backend, style)


def draw_zeno(
    results: Results, name: str | None, signal: Which | None, ax: Any, backend: str, style: Style
) -> Any:
    from saltus.results.charts.zeno import chart_of

    checked_backend(backend, ax)
    return _drawn(chart_of(results, name, signal), ax, backend, style)


def draw_section(
    results: Results,
    name: str,
    chosen: tuple[Which, Which],
    side: str,
    ax: Any,
    backend: str,
    style: Style,
) -> Any:
    from saltus.results.charts.section import chart_of

    checked_backend(backend, ax)
    return _drawn(chart_of(results, name, chosen, side), ax, backend, style)
