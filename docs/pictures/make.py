"""The pictures of docs/semantics.md, from runs: `python docs/pictures/make.py [--out FOLDER]`."""

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np
import scenes

INK, MID, PALE, SHADE = "black", "0.45", "0.75", "0.9"  # all that is used: it reads in grey
plt.rcParams.update(
    {
        "font.size": 8,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.titlesize": 8,
        "axes.titlelocation": "left",
        "lines.linewidth": 1.2,
        "legend.frameon": False,
        "svg.hashsalt": "saltus",  # the same bits each time it is drawn
        "savefig.facecolor": "white",
    }
)


def panels(count, width=6.4, height=2.1, **options):
    figure, axes = plt.subplots(1, count, figsize=(width, height), layout="constrained", **options)
    return figure, np.atleast_1d(axes)


def label(axis, x="time t [s]", y=None):
    axis.set_xlabel(x)
    if y:
        axis.set_ylabel(y)


def guard():
    """A guard is armed above zero, is looked at where steps end, and fires at zero."""
    figure, (axis,) = panels(1)
    fine, steps = scenes.ball_rows(fine=True), scenes.ball_rows(fine=False)
    bounces = fine.events.times("bounce")
    axis.axhline(0, color=PALE, lw=0.8)
    axis.plot(fine.time, fine.outputs["state"][:, 0], color=INK, label="guard g = y")
    axis.plot(steps.time, steps.outputs["state"][:, 0], "o", color=MID, ms=3, label="solver steps")
    axis.plot(bounces, 0 * bounces, "x", color=INK, ms=7, mew=1.5, label="fires")
    for begin, end in zip([0, *bounces], [*bounces, fine.time[-1]], strict=True):
        axis.plot([begin, end], [-0.09, -0.09], color=PALE, lw=4, solid_capstyle="butt")
    axis.text(0.02, -0.13, "armed on the positive side: g > 0", va="top", color=MID)
    axis.set_ylim(-0.28, 1.08)
    label(axis, y="g [m]")
    axis.legend(loc="upper right", ncols=3)
    return figure


def at_zero():
    """What a guard exactly at zero at the start does, four times."""
    figure, axes = panels(4, sharex=True)
    titles = ("placed at rest", "thrown up", "thrown down", "on its finish line")
    runs = (*(scenes.ball_from_floor(v) for v in (0, 4, -4)), scenes.orbit())
    says = (
        "rests: held at t0",
        "flies, then bounces",
        "contact: fires at t0",
        "waits for one turn",
    )
    for axis, title, run, says_it in zip(axes, titles, runs, says, strict=True):
        axis.axhline(0, color=PALE, lw=0.8)
        axis.plot(run.time, run.outputs["g"], color=INK)
        events = [e.time for e in run.events if e.kind in ("zero_crossing", "terminal")]
        axis.plot(events, np.zeros(len(events)), "x", color=INK, ms=6, mew=1.4)
        axis.set_title(f"{title}\n", loc="left")
        axis.text(0, 1.03, says_it, transform=axis.transAxes, color=MID)
        label(axis)
    axes[0].set_ylim(-0.1, 0.9)
    axes[1].set_ylim(-0.1, 0.9)
    axes[2].set_ylim(-0.1, 0.9)
    axes[0].set_ylabel("guard g")
    return figure


def passes():
    """Hybrid time: j goes up by one with each pass that changes something."""
    figure, (axis,) = panels(1)
    run = scenes.dominoes()
    axis.plot(run.time, run.jump, color=PALE)
    axis.plot(run.time, run.jump, "o", color=INK, ms=3)
    first = run.events.times("push")[0]
    for j in range(1, 6):
        says = (
            "first block reaches its guard" if j == 1 else f"commit of pass {j - 1} fires block {j}"
        )
        axis.text(
            first + 0.02, j + 0.1 * (j == 5), says, va="bottom" if j == 5 else "center", color=MID
        )
    axis.text(0.02, 0.35, "flow: t goes on, j stays", color=MID)
    axis.text(first - 0.02, 2.5, "instant:\nt stays, j goes on", color=MID, ha="right", va="center")
    axis.set_xlim(-0.02, 2.02)
    axis.set_ylim(-0.3, 5.8)
    label(axis, y="j [passes]")
    return figure


def cascade():
    """Who changed in which pass of the instant at which the first of five blocks fires."""
    figure, (axis,) = panels(1, height=2.0)
    run = scenes.dominoes()
    rows = np.flatnonzero(run.time == run.events.times("push")[0])
    j = run.jump[rows]
    for i in range(5):
        value = run.outputs[f"block {i + 1}"][rows].astype(float)
        axis.step(j, value * 0.7 + (4 - i), where="mid", color=INK)
        axis.axhline(4 - i, color=PALE, lw=0.6, zorder=0)
    axis.set_yticks([4 - i + 0.35 for i in range(5)], [f"block {i + 1}" for i in range(5)])
    axis.set_xticks(j)
    axis.set_xlim(-0.3, 5.3)
    label(axis, x="j, all at t = 1 s", y="discrete state, 0 or 1")
    return figure


def zeno():
    """Bounces that accumulate: the predicted time, and the hold."""
    figure, axes = panels(2, gridspec_kw={"width_ratios": [2, 1]})
    run = scenes.ball_rows(fine=True, end=3.2, e=0.7)
    enter = next(e for e in run.events if e.kind == "zeno_enter")
    bounces = run.events.times("bounce")
    axis, zoom = axes
    axis.axvspan(enter.time, run.time[-1], color=SHADE, lw=0)
    axis.plot(run.time, run.outputs["state"][:, 0], color=INK)
    axis.plot(enter.predicted, 0, "D", color=INK, ms=4, clip_on=False)
    axis.annotate(
        f"predicted:\nt = {enter.predicted:.6f} s",
        (enter.predicted, 0),
        (enter.predicted - 0.12, 0.55),
        ha="right",
        arrowprops={"arrowstyle": "->", "color": MID},
    )
    axis.text((enter.time + run.time[-1]) / 2, 0.85, "hold", ha="center", color=MID)
    axis.set_ylim(0, 1.05)
    label(axis, y="height y [m]")
    gaps = np.diff(bounces)
    zoom.semilogy(np.arange(1, len(gaps) + 1), gaps, "o", color=INK, ms=2.5)
    zoom.axhline(1e-6, color=MID, ls="--")
    zoom.text(1, 1.6e-6, "zeno_tolerance", color=MID)
    zoom.set_ylim(2e-7, 2)
    label(zoom, x="bounce k", y="gap to the one before [s]")
    return figure


def floor():
    """A floor that drops lets a resting ball go; one that rises carries it."""
    figure, axes = panels(2, sharey=True)
    for axis, after, title in zip(
        axes, (-0.5, 0.3), ("drops: release", "rises: carry"), strict=True
    ):
        run = scenes.ball_on_step(after)
        changes = [(e.time, e.kind) for e in run.events if e.kind.startswith("zeno")]
        ends = [t for t, kind in changes if kind == "zeno_release"]
        for begin in [t for t, kind in changes if kind == "zeno_enter"]:
            end = min([t for t in ends if t > begin], default=run.time[-1])
            axis.axvspan(begin, end, color=SHADE, lw=0)
        axis.plot(run.time, run.outputs["floor"], color=MID, ls="--", label="floor")
        axis.plot(run.time, run.outputs["state"][:, 0], color=INK, label="ball")
        axis.set_title(title)
        label(axis)
    axes[0].set_ylabel("height [m]")
    axes[0].legend(loc="upper right", title="shaded: hold")
    return figure


def monitor():
    """The same guard as a monitor, which changes nothing, and with a reset map."""
    figure, axes = panels(2, sharey=True)
    for axis, reset in zip(axes, (False, True), strict=True):
        run = scenes.swing(reset)
        times = run.events.times("axis")
        axis.axhline(0, color=PALE, lw=0.8)
        axis.plot(run.time, run.outputs["x"][:, 0], color=INK)
        axis.plot(times, 0 * times, "x", color=INK, ms=6, mew=1.4)
        restarts = run.statistics.restarts
        name = "with a reset map v := -v / 2" if reset else "monitor: logged, nothing moves"
        axis.set_title(f"{name}; restarts: {restarts}")
        label(axis)
    axes[0].set_ylabel("guard g = x [m]")
    return figure


def chattering():
    """A relay without hysteresis cannot leave its switching surface: the run ends there."""
    figure, axes = panels(2, sharey=True)
    for axis, width in zip(axes, (0.0, 0.05), strict=True):
        run = scenes.relay(width)
        axis.axhline(0, color=PALE, lw=0.8)
        axis.plot(run.time, run.outputs["x"][:, 0], color=INK)
        axis.plot(run.time[-1], run.outputs["x"][-1, 0], "s", color=INK, ms=4)
        axis.set_title(f"hysteresis {width:g}: {run.status}, {len(run.events)} events")
        axis.set_xlim(0, 1.03)
        label(axis)
    axes[0].set_ylabel("x")
    return figure


def rows():
    """One row before and one after a pass, at the same time."""
    figure, (axis,) = panels(1)
    fine, run = scenes.ball_rows(fine=True), scenes.ball_rows(fine=False)
    speed, first = run.outputs["state"][:, 1], run.events.times("bounce")[0]
    axis.plot(fine.time, fine.outputs["state"][:, 1], color=PALE)
    axis.plot(run.time, speed, "o", color=INK, ms=3)
    before, after = np.flatnonzero(run.time == first)
    for row, name, dy in ((before, "x⁻", -0.2), (after, "x⁺", 0.2)):
        says = f"{name}: t = {run.time[row]:.4f} s, j = {run.jump[row]}"
        axis.text(first + 0.03, speed[row] + dy, says, va="center")
    axis.set_ylim(-5.4, 4.8)
    label(axis, y="velocity v [m/s]")
    return figure


PICTURES = (guard, at_zero, passes, cascade, zeno, floor, monitor, chattering, rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent)
    folder = parser.parse_args().out
    folder.mkdir(parents=True, exist_ok=True)
    for picture in PICTURES:
        figure = picture()
        figure.savefig(folder / f"{picture.__name__}.svg", metadata={"Date": None, "Creator": None})
        plt.close(figure)
        print(folder / f"{picture.__name__}.svg")


if __name__ == "__main__":
    main()
