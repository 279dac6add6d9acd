"""A picture of each scene of the shelf, from a run: `python docs/models/make.py [NAME ...]`."""

import argparse
import sys
import textwrap
from pathlib import Path

import numpy as np
import saltus

sys.path.insert(0, str(Path(__file__).parents[1] / "site"))

from style import mark_events, plt, save, with_gaps

LONG = 1e5  # [s] spans longer than this have a logarithmic time axis
MANY = 24  # more components than this are points in space
# scenes that an orbit shows better than its coordinates do: columns (x, y) of each curve
ORBITS = {
    "kepler": [(0, 1)],
    "lorenz": [(0, 2)],
    "pleiades": [(i, i + 7) for i in range(7)],
    "rocking-block": [(0, 1)],
}
# columns, where all would be too many to tell apart
SHOWN = {"ring-modulator": [0, 1, 6], "emep": [0, 1, 13, 14, 36, 38]}
LOG_FROM = {
    "hires": 1e-3,
    "pollu": 1e-4,
    "stiff-contact": 5e-3,
    "b5": 1e-3,
}  # [s] short spans seen better so
# of states (u_1, v_1, u_2, v_2, ...) the field u
EVERY = {"brusselator": 2, "brusselator-2d": 2, "cusp": 3, "medakzo": 2}
# [s] of the run that shows what happens, where all of it would be a hatching
WINDOW = {"thermostat": 2200.0, "two-walls": 10.0}
HALF = {"beam", "plate"}  # of states that end with their rates the first half
LINEAR = {"emep"}  # spans longer than LONG that are seen better over time as it is


def logarithmic(scene):
    return (scene.t_span[1] > LONG and scene.name not in LINEAR) or scene.name in LOG_FROM


def run(scene, rows=600):
    """A run with as many rows as a picture can show, evenly over its time axis."""
    begin, end = scene.t_span
    end = min(end, begin + WINDOW.get(scene.name, np.inf))
    steps = scene.simulate(save_at=[], save_steps=True, throw=False)
    first = LOG_FROM.get(scene.name, steps.time[steps.time > begin][0])
    even = np.geomspace(first, end, rows) if logarithmic(scene) else np.linspace(begin, end, rows)
    even[-1] = end  # not a rounding beyond it
    few = len(steps.time) < 5 * rows  # then they show what is quicker than the even rows
    return scene.simulate(save_at=even, save_steps=few, throw=False)


def columns(results):
    """Every recorded number as a column, and its name."""
    arrays = {name: a.reshape(len(results.time), -1) for name, a in results.outputs.items()}
    names = [
        name if a.shape[1] == 1 else f"{name}[{i}]"
        for name, a in arrays.items()
        for i in range(a.shape[1])
    ]
    return np.hstack(list(arrays.values())).astype(float), names


def scaled(values, names):
    """Components of very different size, each over its largest value."""
    most = np.nanmax(np.abs(values), axis=0)
    most[most == 0] = 1
    if most.max() < 50 * most.min():
        return values, names
    return values / most, [f"{name} / {m:.1e}" for name, m in zip(names, most, strict=True)]


def time_axis(axis, scene):
    if logarithmic(scene):
        axis.set_xscale("log")
        axis.set_xlim(LOG_FROM.get(scene.name))
    if scene.name in WINDOW:
        begin = scene.t_span[0]
        axis.set_xlim(begin, begin + WINDOW[scene.name])
    axis.set_xlabel("time t [s]")


def over_time(scene, results):
    values, names = columns(results)
    if scene.name in SHOWN:
        values, names = values[:, SHOWN[scene.name]], [names[k] for k in SHOWN[scene.name]]
    split = values.shape[1] <= 3  # a panel for each component
    panels = values.shape[1] if split else 1
    figure, axes = plt.subplots(
        panels, 1, figsize=(6.4, 0.7 + 1.15 * panels if split else 2.8), sharex=True,
        squeeze=False, layout="constrained",
    )  # fmt: skip
    if not split:
        values, names = scaled(values, names)
    times, values = with_gaps(results, values)
    if logarithmic(scene):  # no logarithm of the begin
        times, values = times[~(times <= 0)], values[~(times <= 0)]
    for k, axis in enumerate(axes[:, 0]):
        mark_events(axis, results, end=scene.t_span[0] + WINDOW.get(scene.name, np.inf))
        axis.plot(times, values[:, k] if split else values)
        axis.set_ylabel(names[k] if split else "")
    if not split and len(names) <= 12:
        axis.legend(
            axis.get_lines()[-len(names) :], names, loc="center left", bbox_to_anchor=(1, 0.5)
        )
    time_axis(axes[-1, 0], scene)
    return figure


def in_space(scene, results):
    """Time across, place along the grid upwards; of several signals the first."""
    name, field = next(iter(results.outputs.items()))
    if scene.name in HALF:
        field = field[:, : field.shape[1] // 2]
    field = field[:, :: EVERY.get(scene.name, 1)]
    seen = np.flatnonzero(results.time > 0) if logarithmic(scene) else np.arange(len(field))
    seen = seen[:: max(1, len(seen) // 300)]
    figure, axis = plt.subplots(figsize=(6.4, 2.6), layout="constrained")
    place = np.arange(1, field.shape[1] + 1)
    image = axis.pcolormesh(
        results.time[seen], place, field[seen].T, shading="nearest", cmap="viridis", rasterized=True
    )
    figure.colorbar(image, ax=axis, pad=0.01, label=name)
    axis.set_ylabel("node")
    time_axis(axis, scene)
    return figure


def orbit(scene, results, pairs):
    values, names = columns(results)
    _, values = with_gaps(results, values)
    figure, axis = plt.subplots(figsize=(4.2, 3.2), layout="constrained")
    for x, y in pairs:
        axis.plot(values[:, x], values[:, y], lw=0.7)
    if len(pairs) > 1 or scene.name == "kepler":
        axis.set_aspect("equal", adjustable="datalim")
    axis.set_xlabel(names[pairs[0][0]] if len(pairs) == 1 else "x")
    axis.set_ylabel(names[pairs[0][1]] if len(pairs) == 1 else "y")
    return figure


def picture(name):
    scene = saltus.scene(name)
    results = run(scene, 3000 if name in ORBITS else 600)
    if name in ORBITS:
        figure = orbit(scene, results, ORBITS[name])
    elif columns(results)[0].shape[1] > MANY and name not in SHOWN:
        figure = in_space(scene, results)
    else:
        figure = over_time(scene, results)
    width = 15 * figure.get_figwidth()  # in letters
    title = f"{name}: {scene.title}"
    if name in WINDOW:
        title += f"; the first {WINDOW[name]:g} s"
    figure.axes[0].set_title(textwrap.fill(title, int(width)))
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="scenes; all if none is given")
    parser.add_argument("--out", type=Path, default=Path(__file__).parent)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name in arguments.names or saltus.shelf():
        path = arguments.out / f"{name}.svg"
        save(picture(name), path)
        print(f"{path} {path.stat().st_size / 1000:.0f} kB", flush=True)


if __name__ == "__main__":
    main()
