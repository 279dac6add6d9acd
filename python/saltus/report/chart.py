"""The chart of a work-precision report. Imported by `WorkPrecision.plot`: it needs matplotlib."""

from __future__ import annotations

import io
import math
import re
import textwrap
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib  # type: ignore[import-not-found,unused-ignore]
from matplotlib.figure import Figure  # type: ignore[import-not-found,unused-ignore]

if TYPE_CHECKING:
    from saltus.report.table import WorkPrecision

__all__ = ["draw", "panel", "save"]

# one colour for each method in every chart (Okabe and Ito: the colour-blind can distinguish them)
COLOURS = {
    "dopri5": "#0072B2",
    "dop853": "#56B4E9",
    "adams": "#009E73",
    "bdf": "#D55E00",
    "radau": "#CC79A7",
    "taylor": "#E69F00",
    "auto": "#000000",
}
OTHERS = ("#999999", "#F0E442", "#8B4513")
MARKERS = "ovs^Dp<h>*"  # one for each tolerance, the loosest first
LEAST = 1e-17  # errors below it, zero among them, are drawn here
STYLE: dict[Any, Any] = {
    "font.size": 8,
    "axes.titlesize": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "0.92",
    "lines.linewidth": 1.1,
    "lines.markersize": 4.5,
    "legend.frameon": False,
    "svg.fonttype": "none",  # words stay words: a third of the size, and they can be searched
    "svg.hashsalt": "saltus",  # a chart has the same bits each time it is drawn
    "savefig.facecolor": "white",
}


def draw(table: WorkPrecision) -> Figure:
    """Error against time; beside it event-time error against time, where there is any."""
    panels = [("error", "max error of the states", "bound")]
    if any(_is_number(row["event_error"]) for row in table):
        panels.append(("event_error", "max error of event times [s]", "event_bound"))
    with matplotlib.rc_context(STYLE):
        failures = _failures(table)
        height = 3.5 + 0.14 * len(failures)
        figure = Figure(figsize=(1.7 + 3.4 * len(panels), height), layout="constrained")
        axes = figure.subplots(1, len(panels), sharey=True, squeeze=False)[0]
        for axis, (key, label, bound) in zip(axes, panels, strict=True):
            panel(axis, table, key, table.reference.get(bound, math.nan))
            axis.set_xlabel(label)
        axes[0].set_ylabel("run time, warm")
        _times(axes[0])
        _legend(figure, table)
        _words(figure, table, failures)
    return figure


def save(figure: Figure, path: str | PathLike[str]) -> None:
    """Writes the figure. An SVG of one table has the same bits each time, and coordinates with two
    digits of a pixel, which is more than anybody sees.
    """
    with matplotlib.rc_context(STYLE):
        if Path(path).suffix != ".svg":
            figure.savefig(path, dpi=150)
            return
        text = io.StringIO()
        figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    Path(path).write_text(re.sub(r"(\d\.\d\d)\d+", r"\1", text.getvalue()))


def panel(axis: Any, table: WorkPrecision, key: str, bound: float) -> None:
    """Draws into axes of matplotlib: `key` ("error", "event_error", ...) across, warm run time up,
    a line for each method. Below `bound`, grey, the reference itself may be wrong.
    """
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.minorticks_off()
    for method in table.methods:
        rows = [r for r in table if r["method"] == method]
        good = [r for r in rows if _is_number(r["seconds"]) and _is_number(r[key])]
        colour = _colour(table, method)
        errors = [max(r[key], LEAST) for r in good]
        axis.plot(errors, [r["seconds"] for r in good], color=colour, zorder=2)
        for error, row in zip(errors, good, strict=True):
            _point(axis, table, error, row, colour)
    axis.margins(0.08)
    left, right = axis.get_xlim()
    if _is_number(bound) and bound > left:  # left of it the chart says only that the error is small
        axis.axvspan(left, bound, color="0.93", lw=0, zorder=0)
        axis.set_xlim(left, max(right, 2 * bound))
    _margin(axis, table)


def _times(axis: Any) -> None:
    """Labels run times with their own units, and between decades too if there are few decades."""
    from matplotlib.ticker import (  # type: ignore[import-not-found,unused-ignore]
        EngFormatter,
        LogLocator,
    )

    low, high = axis.get_ylim()
    axis.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 200 * low else (1,)))
    axis.yaxis.set_major_formatter(EngFormatter(unit="s"))


def _point(axis: Any, table: WorkPrecision, error: float, row: dict[str, Any], colour: str) -> None:
    """A marker for each tolerance; open, with the number, if events are missing or too many."""
    off = row["event_mismatch"]
    axis.plot(
        error, row["seconds"], _marker(table, row["rtol"]), color=colour,
        mfc="white" if off else colour, zorder=3,
    )  # fmt: skip
    low, high = row["seconds_quartile1"], row["seconds_quartile3"]
    axis.plot([error, error], [low, high], color=colour, lw=0.8, zorder=1)
    if off:
        axis.annotate(f"{off} off", (error, row["seconds"]), (4, 4), textcoords="offset points",
                      fontsize=6, color=colour)  # fmt: skip


def _margin(axis: Any, table: WorkPrecision) -> None:
    """Failed runs: crosses at the right margin, a column for each method, a line for each
    tolerance.
    """
    failed = [row for row in table if not _is_number(row["seconds"])]
    methods = list(dict.fromkeys(row["method"] for row in failed))
    for row in failed:
        x = 1.03 + 0.035 * methods.index(row["method"])
        y = 0.97 - 0.045 * [r for r in failed if r["method"] == row["method"]].index(row)
        axis.plot(x, y, "x", color=_colour(table, row["method"]), transform=axis.transAxes,
                  clip_on=False, ms=4)  # fmt: skip
    if failed:
        axis.text(1.03, 1.01, "failed", transform=axis.transAxes, fontsize=6, color="0.3")


def _legend(figure: Figure, table: WorkPrecision) -> None:
    from matplotlib.lines import Line2D  # type: ignore[import-not-found,unused-ignore]

    methods = [
        Line2D([], [], color=_colour(table, m), label=_name(table, m)) for m in table.methods
    ]
    rtols = sorted({row["rtol"] for row in table}, reverse=True)
    marks = [
        Line2D([], [], color="0.4", ls="", marker=_marker(table, rtol), label=f"rtol {rtol:.0e}")
        for rtol in rtols
    ]
    figure.legend(handles=methods + marks, loc="outside right upper")


def _name(table: WorkPrecision, method: str) -> str:
    order = table.orders.get(method, math.nan)
    return f"{method}, order {order:.1f}" if _is_number(order) else method


def _words(figure: Figure, table: WorkPrecision, failures: Sequence[str]) -> None:
    """The scene and the reference above; failures, machine and versions below."""
    e = table.environment
    kind, says = table.reference["kind"], table.reference["provenance"]
    against = textwrap.fill(f"errors against ({kind}): {says}", 110)
    name = f"{table.scene}: {table.title}" if table.title else table.scene
    figure.suptitle(f"{textwrap.fill(name, 100)}\n{against}", x=0.01, ha="left", fontsize=8)
    build = "" if e["build"] == "optimised" else f" ({e['build']})"
    machine = (
        f"{e['cpu']}, {e['cores']} cores; {e['compiler']}{build}, SUNDIALS {e['sundials']}, "
        f"Saltus {e['saltus']}"
    )
    figure.supxlabel("\n".join([*failures, machine]), x=0.01, ha="left", fontsize=6, color="0.3")


def _failures(table: WorkPrecision) -> list[str]:
    """A line for each reason, with the methods and tolerances that it ended; at most eight."""
    by_reason: dict[str, list[dict[str, Any]]] = {}
    for row in table:
        if not _is_number(row["seconds"]):
            same = row["method"] if row["status"] == "interrupted" else row["message"]
            by_reason.setdefault(same, []).append(row)
    lines = []
    for rows in by_reason.values():
        methods = ", ".join(dict.fromkeys(row["method"] for row in rows))
        rtols = ", ".join(dict.fromkeys(f"{row['rtol']:.0e}" for row in rows))
        says = textwrap.shorten(rows[0]["message"], 110)
        lines.append(f"x {methods} at rtol {rtols}: {rows[0]['status']}: {says}")
    return lines[:8] + ([f"... and {len(lines) - 8} more"] if len(lines) > 8 else [])


def _colour(table: WorkPrecision, method: str) -> str:
    if method in COLOURS:
        return COLOURS[method]
    others = [m for m in table.methods if m not in COLOURS]
    return OTHERS[others.index(method) % len(OTHERS)]


def _marker(table: WorkPrecision, rtol: float) -> str:
    rtols = sorted({row["rtol"] for row in table}, reverse=True)
    return MARKERS[rtols.index(rtol) % len(MARKERS)]


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not math.isnan(value)
