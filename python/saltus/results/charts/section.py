"""The Poincare section: numbers at the events of one name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from saltus._core import known_names
from saltus.errors import ModelError
from saltus.results.charts.chart import Chart, Layer
from saltus.results.charts.numbers import Which, label_of, number_at, with_unit

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["chart_of"]


def chart_of(results: Results, name: str, chosen: tuple[Which, Which], side: str) -> Chart:
    """The chart for `Results.plot_section`."""
    if side not in ("left", "right"):
        raise ModelError(f"side: unknown side {side!r}{known_names(str(side), ['left', 'right'])}")
    times = results.events.times(name)  # refuses an unknown name
    if not len(times):
        raise ModelError(f"plot_section: '{name}' never happened in this run")
    x, y = (number_at(results, which, times, side) for which in chosen)
    labels = [with_unit(results, label_of(results, which)) for which in chosen]
    return Chart(f"{labels[0]} at {name}", labels[1], [Layer(x, y, "filled")])
