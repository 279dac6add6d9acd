"""Signals over time, by matplotlib."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus._core import known_names
from saltus.errors import ModelError
from saltus.results.charts.numbers import with_unit
from saltus.results.curves import Curve, curves_of, holds_of
from saltus.results.tables import extra

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["chosen", "plot", "wide_jumps"]

FEW = 60  # the number of jumps with full markers; more markers would cover the curve
TINY = 0.02  # part of the range of the curve; the markers of a smaller jump would cover each other
GUARDS = ("zero_crossing", "terminal", "executed")  # kinds of events
MANY = 400  # the number of times with a tick each
Panels = list[tuple[str, list[Curve]]]


def plot(results: Results, names: tuple[str, ...], ax: Any, style: dict[str, Any]) -> Any:
    """Draws the signals for `Results.plot`."""
    panels = chosen(results, names)
    if ax is not None:
        alone = len(panels) == 1 and not ax.has_data()
        curves = panels[0][1] if len(panels) == 1 else _labelled(results, panels)
        _draw(ax, results, curves, panels[0][0] if len(panels) == 1 else "", style)
        if alone:
            _name_modes(ax, results, curves)
        ax.set_xlabel("time [s]")
        return ax
    plt = extra("matplotlib.pyplot", "plot", ", or install Saltus with the extra [plot]")
    count = len(panels)
    size = (7.0, 3.6 if count == 1 else 1.2 + 1.9 * count)
    _, axes = plt.subplots(count, 1, sharex=True, squeeze=False, figsize=size, layout="constrained")
    for each, (title, curves) in zip(axes[:, 0], panels, strict=True):
        _draw(each, results, curves, title, style)
        _name_modes(each, results, curves)
    axes[-1, 0].set_xlabel("time [s]")
    axes[0, 0].figure.align_ylabels()
    return axes[0, 0] if count == 1 else axes[:, 0]


def chosen(results: Results, names: tuple[str, ...]) -> Panels:
    """The curves of each axes, with a title."""
    if not results.outputs:
        raise ModelError(
            "nothing was recorded, so there is nothing to draw: give recorded_signals="
            "['block.port'] to the run, or the system an output"
        )
    signals = curves_of(results)
    entries = {curve.label: [curve] for curves in signals.values() for curve in curves}
    known = signals | {label: curve for label, curve in entries.items() if label not in signals}
    for name in names:
        if name not in known:
            hint = known_names(str(name), list(known))
            raise ModelError(f"nothing was recorded under {name!r}{hint}")
    return [titled(results, name, known[name]) for name in (names or signals)]


def titled(results: Results, name: str, curves: list[Curve]) -> tuple[str, list[Curve]]:
    """The title with the unit of all curves, or each label with its own."""
    labels = [with_unit(results, curve.label) for curve in curves]
    units = {label[len(c.label) :] for label, c in zip(labels, curves, strict=True)}
    if len(units) == 1:
        return name + units.pop(), curves
    return name, [replace(c, label=label) for label, c in zip(labels, curves, strict=True)]


def _labelled(results: Results, panels: Panels) -> list[Curve]:
    """The curves of several panels for one axes: each label has its unit, which no title says."""
    curves = [curve for _, group in panels for curve in group]
    return [replace(curve, label=with_unit(results, curve.label)) for curve in curves]


def _name_modes(ax: Any, results: Results, curves: list[Curve]) -> None:
    """Names of modes in place of their numbers, on axes that show nothing else."""
    names = results.mode_names.get(curves[0].label, ()) if len(curves) == 1 else ()
    if names:
        ax.set_yticks(range(len(names)), names)


def _draw(
    ax: Any, results: Results, curves: list[Curve], title: str, style: dict[str, Any]
) -> None:
    for begin, end in holds_of(results):
        ax.axvspan(begin, end, color="0.5", alpha=0.13, linewidth=0, zorder=0)
    for curve in curves:
        look = {"linewidth": 1.5, "label": curve.label} | style
        (line,) = ax.plot(curve.time, curve.value, **look)
        _mark_jumps(ax, curve, line)
    _mark_events(ax, results)
    if title:
        ax.set_ylabel(title)
    if len(curves) > 1:
        # above the axes, where no curve is
        ax.legend(
            loc="lower right",
            bbox_to_anchor=(1.0, 1.0),
            frameon=False,
            ncols=min(len(curves), 6),
            fontsize="small",
            borderaxespad=0.1,
        )
    ax.spines[["top", "right"]].set_visible(False)
    ax.margins(x=0.01)


def wide_jumps(curve: Curve) -> np.ndarray:
    """Which jumps are wide enough for markers."""
    leap = np.abs(curve.after[:, 1] - curve.before[:, 1])
    finite = curve.value[np.isfinite(curve.value)]
    return np.asarray(leap > TINY * (np.ptp(finite) if finite.size else 0.0))


def _mark_jumps(ax: Any, curve: Curve, line: Any) -> None:
    """Draws a hollow marker before each jump and a filled marker after it."""
    wide = wide_jumps(curve)
    if not wide.any():
        return
    color, size = line.get_color(), 5.0 if np.count_nonzero(wide) <= FEW else 2.0
    shared = {"linestyle": "none", "marker": "o", "markersize": size, "markeredgecolor": color}
    ax.plot(*curve.before[wide].T, **shared, markerfacecolor="white", markeredgewidth=1.1, zorder=3)
    ax.plot(*curve.after[wide].T, **shared, markerfacecolor=color, markeredgewidth=0.0, zorder=3)


def _firings(results: Results) -> list[float]:
    """The times at which guards fired."""
    log = results.events
    return sorted({event.time for event in log if event.kind in GUARDS})


def _mark_events(ax: Any, results: Results) -> None:
    """A tick at the bottom for each event of a guard; ticks of clocks would hide them."""
    times = _firings(results)
    if not 0 < len(times) <= MANY:
        return
    across = ax.get_xaxis_transform()  # x in seconds, y in parts of the axes
    ax.vlines(times, 0.0, 0.03, transform=across, color="0.35", linewidth=0.8, zorder=1)
