"""Small log-log charts of the shelf, some scenes in one SVG."""

import math

import matplotlib
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import EngFormatter, LogLocator

from saltus.report import chart

COLUMNS = 4
GROUPS = {
    "Impacts": (
        "Error of the states across, warm run time up, each in powers of ten: lower left is better. A marker is a tolerance, the "
        "loosest a circle; an open one has a wrong number of events; a cross at the right margin is a run that failed. Grey: "
        "there the reference itself may be wrong. On parabolas every one-step method is exact, and only rounding shows.",
        ["bouncing-ball", "bouncing-ball-blocks", "ball-drag", "ball-table", "two-walls",
         "newtons-cradle", "rimless-wheel", "rocking-block"],
    ),
    "Modes and switches": (
        "Scenes whose equations change at events.",
        ["water-tanks", "thermostat", "integrate-and-fire", "stick-slip", "buck-converter",
         "stiff-contact", "buck-parasitics", "relay-circuit", "heat-rod"],
    ),
    "Stiff scenes": (
        "Only methods that suit: an explicit one would not come to the end, or take a thousand times longer.",
        ["robertson", "hires", "orego", "van-der-pol", "vdpol", "vdpol-1e6", "e5", "pollu",
         "ring-modulator", "brusselator", "b5", "beam", "cusp", "plate", "medakzo",
         "brusselator-2d", "emep"],
    ),
    "Smooth scenes": ("High order makes digits cheap.", ["kepler", "pleiades", "lorenz"]),
}  # fmt: skip


def draw_groups(reports, folder):
    """Yields title, words and file of each chart; scenes in no group come last."""
    folder.mkdir(parents=True, exist_ok=True)
    by_name = {report.scene: report for report in reports}
    grouped = {name for _, names in GROUPS.values() for name in names}
    others = {"Other scenes": ("", [name for name in by_name if name not in grouped])}
    for title, (words, names) in {**GROUPS, **others}.items():
        found = [by_name[name] for name in names if name in by_name]
        if found:
            file = folder / f"{title.lower().replace(' ', '_')}.svg"
            chart.save(draw(found), file)
            yield title, words, file


def draw(reports):
    rows = math.ceil(len(reports) / COLUMNS)
    with matplotlib.rc_context({**chart.STYLE, "font.size": 7, "axes.titlesize": 7.5}):
        figure = Figure(figsize=(2.45 * COLUMNS, 2.1 * rows + 0.4), layout="constrained")
        axes = list(figure.subplots(rows, COLUMNS, squeeze=False).flat)
        for axis, report in zip(axes, reports, strict=False):
            small(axis, report)
        for axis in axes[len(reports) :]:
            axis.set_axis_off()
        used = [m for m in chart.COLOURS if any(m in report.methods for report in reports)]
        handles = [Line2D([], [], color=chart.COLOURS[m], label=m) for m in used]
        figure.legend(handles=handles, loc="outside upper left", ncols=len(handles))
    return figure


def small(axis, report):
    known = any(not math.isnan(row["error"]) for row in report)
    key, bound = ("error", "bound") if known else ("event_error", "event_bound")
    chart.panel(axis, report, key, report.reference.get(bound, math.nan))
    low, high = axis.get_ylim()
    axis.yaxis.set_major_locator(
        LogLocator(subs=(1, 2, 5) if high < 100 * low else (1,), numticks=9)
    )
    axis.yaxis.set_major_formatter(EngFormatter(unit="s"))
    axis.xaxis.set_major_locator(LogLocator(numticks=5))
    axis.set_title(report.scene if known else f"{report.scene} (event times)", loc="left")
