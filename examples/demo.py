"""The four scenes of the bouncing-ball tutorial: error against run time, and a picture of each."""

import argparse
import math
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import saltus
from bouncing_ball import BouncingBall
from saltus.library import *

G = 9.81  # [m/s^2]


# --- the scenes -----------------------------------------------------------------------------------


class Leaf:
    """A ball of Python functions, dropped from 10 m on a floor at 0."""

    def __init__(self, title: str, e: float, end: float, **options: float):
        self.title, self.e, self.end, self.options = title, e, end, options
        self.y0, self.floor = 10.0, 0.0
        self.drop: tuple[float, float] | None = None
        self.system = BouncingBall(g=G, e=e)
        self.context = self.system.create_context().with_continuous_state([self.y0, 0.0])
        self.recorded = {"state": self.system.output("state")}

    def columns(self, results: saltus.Results) -> Any:
        return results.outputs["state"].T

    def bounces(self, results: saltus.Results) -> Any:
        return results.events.times("bounce")


class Blocks:
    """A ball of ready blocks, over a floor that drops to `lower` at time `drop`."""

    def __init__(
        self,
        title: str,
        e: float,
        y0: float,
        floor: float,
        lower: float,
        drop: float,
        end: float,
        **options: float,
    ):
        self.title, self.e, self.y0, self.end, self.options = title, e, y0, end, options
        self.floor, self.drop = floor, (drop, lower)
        builder = saltus.DiagramBuilder()
        v, y = (
            builder.add(Integrator(enable_reset=True, enable_external_reset=True, name=name))
            for name in ("velocity", "height")
        )
        weight, ground, below, rebound = builder.add(
            Constant(-G, name="weight"),
            Step(floor, lower, step_time=drop, name="floor"),
            ReduceBlock(2, lambda x: x[0] < x[1], name="below"),
            Gain(-e, name="rebound"),
        )
        for source, target in (
            (weight, v.input("in")),
            (v, y.input("in")),
            (y, below.input(0)),
            (ground, below.input(1)),
            (below, v.input("reset_trigger")),
            (below, y.input("reset_trigger")),
            (v, rebound.input()),
            (rebound, v.input("reset_value")),
            (ground, y.input("reset_value")),
        ):
            builder.connect(source.output(), target)
        self.system = builder.build()
        context = self.system.create_context()
        self.context = context.with_subcontext(y, context[y].with_continuous_state(y0))
        self.recorded = {"y": y.output(), "v": v.output()}

    def columns(self, results: saltus.Results) -> Any:
        return results.outputs["y"], results.outputs["v"]

    def bounces(self, results: saltus.Results) -> Any:
        events = (event for event in results.events if event.block == "height")
        return np.array([event.time for event in events if event.kind == "zero_crossing"])


def scenes() -> list[Leaf | Blocks]:
    leaf = {"rtol": 1e-10, "atol": 1e-12, "max_minor_step_size": 1e-3}
    blocks = {
        "rtol": 1e-6,
        "atol": 1e-8,
        "max_minor_step_size": 1e-3,
        "max_major_step_length": 0.1,
    }
    t1 = math.sqrt(2 * 10.0 / G)
    return [
        Leaf("1: elastic, in Python", 1.0, 6 * t1, **leaf),
        Leaf("2: inelastic, in Python", 0.9, 12.0, **leaf),
        Blocks("3: blocks, small", 0.8, 1e-3, 0.0, -1e-3, 1.0, 1.1, **blocks),
        Blocks("4: blocks, large", 0.9, 10.0, 5.0, 0.0, 10.0, 40.0, **blocks),
    ]


# --- the closed form ------------------------------------------------------------------------------


def flights(scene: Leaf | Blocks) -> Iterator[tuple[float, float, float, float]]:
    """(begin, y, v, gravity) of each flight, exactly; gravity 0 is rest on the floor."""
    floor, drop = scene.floor, scene.drop
    begin, y, v = 0.0, scene.y0, 0.0
    while begin < scene.end:
        yield begin, y, v, G
        impact = math.sqrt(v * v + 2 * G * (y - floor))
        landing = begin + (v + impact) / G
        if drop and landing >= drop[0]:  # the floor drops in flight
            s = drop[0] - begin
            begin, y, v = drop[0], y + v * s - G * s * s / 2, v - G * s
            floor, drop = drop[1], None
        elif scene.e * impact < 1e-12:
            yield landing, floor, 0.0, 0.0
            if not drop:
                return
            begin, y, v = drop[0], floor, 0.0
            floor, drop = drop[1], None
        else:
            begin, y, v = landing, floor, scene.e * impact


def errors(scene: Leaf | Blocks, results: saltus.Results) -> tuple[float, float]:
    """Worst error of the height of any row [m], and of the time of any bounce [s]."""
    pieces = np.array(list(flights(scene)))
    begin, y, v, g = pieces[np.searchsorted(pieces[:, 0], results.time, side="right") - 1].T
    s = results.time - begin
    height = np.abs(scene.columns(results)[0] - (y + v * s - g * s * s / 2)).max()
    found = scene.bounces(results)
    gaps = np.abs(pieces[:, 0] - found[:, None]).min(axis=1)  # to the nearest exact bounce
    return height, gaps.max(initial=0.0)


# --- error against run time -----------------------------------------------------------------------


def timed(scene: Leaf | Blocks, **options: Any) -> tuple[saltus.Results, float]:
    """The results, and the best time of a few runs [s]."""
    best, deadline = math.inf, time.perf_counter() + 0.3
    while best == math.inf or time.perf_counter() < deadline:
        start = time.perf_counter()
        results = saltus.simulate(
            scene.system,
            scene.context,
            (0.0, scene.end),
            recorded_signals=scene.recorded,
            **options,
        )
        best = min(best, time.perf_counter() - start)
    return results, best


def table(scene: Leaf | Blocks) -> saltus.Results:
    """Prints a row for the tutorial's settings, then others; returns the results of the first."""
    print(f"\nScene {scene.title}, e = {scene.e:g}, {scene.end:.3g} s")
    print(f"  {'method':<10} {'rtol':>6} {'steps':>6} {'bounces':>7} {'time error':>11}", end="")
    print(f" {'height error':>13} {'run time':>10}")
    kept: saltus.Results | None = None
    free: list[dict[str, Any]] = [
        {"ode_solver_method": method, "rtol": rtol, "atol": rtol / 100}
        for method, rtols in (("dopri5", (1e-4, 1e-8, 1e-12)), ("adams", (1e-4, 1e-8, 1e-12)))
        for rtol in rtols
    ]
    for options in (scene.options, *free):
        results, seconds = timed(scene, **options)
        height, late = errors(scene, results)
        name = results.statistics.method + (" *" if kept is None else "")
        print(
            f"  {name:<10} {options['rtol']:6.0e} {results.statistics.steps:6} "
            f"{len(scene.bounces(results)):7} {late:9.1e} s {height:11.1e} m "
            f"{seconds * 1e3:7.2f} ms"
        )
        kept = kept or results
    assert kept is not None
    for event in kept.events:
        if event.kind in ("zeno_enter", "zeno_release") and event.block in ("height", "ball"):
            what = "at rest from" if event.kind == "zeno_enter" else "released at"
            when = event.predicted if event.kind == "zeno_enter" else event.time
            print(f"  {what} t = {when:.12f} s")
    return kept


# --- pictures -------------------------------------------------------------------------------------


def broken(time: Any, values: Any, jump: Any) -> tuple[Any, Any]:
    """The columns with a gap wherever the state jumped, so that no line is drawn across."""
    at = np.flatnonzero(np.diff(jump)) + 1
    return np.insert(time, at, np.nan), np.insert(values, at, np.nan)


def holds(results: saltus.Results) -> Iterator[tuple[float, float]]:
    """(begin, end) of each rest [s]."""
    begin = None
    for event in results.events:
        if event.kind == "zeno_enter" and begin is None:
            begin = event.predicted
        elif event.kind == "zeno_release" and begin is not None:
            yield begin, event.time
            begin = None
    if begin is not None:
        yield begin, results.time[-1]


def draw(scene: Leaf | Blocks, results: saltus.Results, path: Path) -> None:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    y, v = scene.columns(results)
    unit, factor = ("m", 1.0) if scene.y0 >= 0.1 else ("mm", 1e3)
    figure, (top, bottom) = plt.subplots(
        2, 1, figsize=(8, 4.5), sharex=True, height_ratios=(3, 2), layout="constrained"
    )
    top.plot(results.time, factor * y, linewidth=1.2, color="tab:blue", label="ball")
    floor_time, floor = [0.0, scene.end], [scene.floor, scene.floor]
    if scene.drop:
        floor_time = [0.0, scene.drop[0], math.nan, scene.drop[0], scene.end]
        floor = [scene.floor, scene.floor, math.nan, scene.drop[1], scene.drop[1]]
    top.plot(floor_time, factor * np.array(floor), linewidth=1.2, color="0.35", label="floor")
    bottom.plot(*broken(results.time, factor * v, results.jump), linewidth=1.0, color="tab:orange")
    for begin, end in holds(results):
        for axes in (top, bottom):
            label = "Zeno hold" if axes is top else None
            axes.axvspan(begin, end, color="tab:green", alpha=0.15, linewidth=0, label=label)
    top.set_ylabel(f"height [{unit}]")
    bottom.set_ylabel(f"velocity [{unit}/s]")
    bottom.set_xlabel("time [s]")
    bottom.set_xlim(0.0, results.time[-1])
    top.set_title(f"Scene {scene.title}, e = {scene.e:g}", loc="left")
    top.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, frameon=False)
    for axes in (top, bottom):
        axes.grid(alpha=0.3)
    figure.savefig(path, dpi=150)
    plt.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("demo"), help="where the pictures go")
    parser.add_argument("--no-pictures", action="store_true", help="print the tables only")
    args = parser.parse_args()
    paths = []
    for number, scene in enumerate(scenes(), start=1):
        results = table(scene)
        if not args.no_pictures:
            args.out.mkdir(parents=True, exist_ok=True)
            paths.append(args.out / f"scene_{number}.png")
            draw(scene, results, paths[-1])
    print("\n  * the tutorial's tolerances and bounds of steps; the others have no bounds of steps")
    if paths:
        print("Pictures:", *paths)


if __name__ == "__main__":
    main()
