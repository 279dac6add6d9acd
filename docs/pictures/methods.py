"""The picture of docs/choosing_a_solver.md: run time against achieved error of all methods on four
scenes, measured: `python docs/pictures/methods.py [--out FOLDER]`. It takes a minute. Times are
those of the machine, so it is not the same bits each time. The least of three lower quartiles is
drawn, which other programs on the machine disturb least.
"""

import argparse
from pathlib import Path

import matplotlib
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import EngFormatter, LogLocator

import saltus
from saltus.report import chart

METHODS = ("dopri5", "dop853", "adams", "bdf", "radau", "auto")
RTOLS = tuple(10.0**-k for k in range(3, 12))
SCENES = {
    "kepler": "smooth: a planet, e = 0.6",
    "orego": "stiff: the Oregonator",
    "b5": "stiff and oscillating: B5",
    "buck-converter": "hybrid: a buck converter",
}
OPTIONS = {"methods": METHODS, "rtols": RTOLS, "least_time": 0.02, "time_limit": 1.0}


def measured(name):
    """{method: [(error, seconds), ...]} of the runs that came to their end."""
    tables = [saltus.work_precision(saltus.scene(name), **OPTIONS) for _ in range(3)]
    points = {method: [] for method in METHODS}
    for same in zip(*tables, strict=True):
        row, times = same[0], [row["seconds_quartile1"] for row in same]
        if all(time > 0 for time in times):
            points[row["method"]].append((max(row["error"], chart.LEAST), min(times)))
    return points


def panel(axis, name, title):
    for method, points in measured(name).items():
        style = (
            {"ls": "--", "lw": 1.4, "zorder": 3} if method == "auto" else {"marker": "o", "ms": 2.5}
        )
        if points:
            axis.loglog(*zip(*points, strict=True), color=chart.COLOURS[method], **style)
    axis.minorticks_off()
    axis.invert_xaxis()  # more digits to the right
    axis.xaxis.set_major_locator(LogLocator(numticks=6))
    low, high = axis.get_ylim()
    axis.yaxis.set_major_locator(
        LogLocator(subs=(1, 2, 5) if high < 100 * low else (1,), numticks=9)
    )
    axis.yaxis.set_major_formatter(EngFormatter(unit="s"))
    axis.set_title(title, loc="left")


def draw():
    with matplotlib.rc_context({**chart.STYLE, "lines.linewidth": 1.0}):
        figure = Figure(figsize=(7.2, 5.0), layout="constrained")
        axes = figure.subplots(2, 2)
        for axis, (name, title) in zip(axes.flat, SCENES.items(), strict=True):
            panel(axis, name, title)
        for axis in axes[:, 0]:
            axis.set_ylabel("run time")
        for axis in axes[1]:
            axis.set_xlabel("achieved error")
        handles = [Line2D([], [], color=chart.COLOURS[m], label=m,
                          ls="--" if m == "auto" else "-") for m in METHODS]  # fmt: skip
        figure.legend(handles=handles, loc="outside upper left", ncols=len(handles))
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent)
    folder = parser.parse_args().out
    folder.mkdir(parents=True, exist_ok=True)
    chart.save(draw(), folder / "methods.svg")
    print(folder / "methods.svg")


if __name__ == "__main__":
    main()
