"""A film of each scene that has a drawing, for its page and the gallery, and one of course models:
`python docs/models/films.py [NAME ...]`.
"""

import argparse
from pathlib import Path

import make  # noqa: F401  its style
import saltus
from make import plt
from saltus import drawings

HERE = Path(__file__).parent
SCENES = HERE.parents[1] / "examples" / "scenes"
SPEED = {  # seconds of the run in a second of the film
    "bouncing-ball": 2.0,
    "bouncing-ball-blocks": 0.05,
    "ball-drag": 1.5,
    "ball-table": 1.0,
    "two-walls": 1.0,
    "newtons-cradle": 0.25,
    "rimless-wheel": 1.0,
    "rocking-block": 2.0,
    "stick-slip": 4.0,
    "kepler": 3.0,
    "pleiades": 0.5,
}
LENGTH = 5.0  # [s] of a film
FPS = 12
SIZE, DPI = (3.0, 2.2), 72  # [inch], pixels an inch
COURSE = {  # drawing, recorded signals, speed
    "inverted_pendulum": (
        lambda: drawings.pendulum_on_cart("state[0]", "state[2]"), {"state": "cart.state"}, 0.6,
    ),
    "quarter_car": (
        lambda: drawings.quarter_car("body", "wheel", "road"),
        {"body": "car.body", "wheel": "car.wheel", "road": "road.out"}, 0.5,
    ),
}  # fmt: skip


def filmed(results, drawing, speed):
    _, axes = plt.subplots(figsize=SIZE, layout="constrained")
    return results.animate(drawing, speed=speed, fps=FPS, ax=axes)


def of_shelf(name):
    scene = saltus.scene(name)
    end = min(scene.t_span[1], scene.t_span[0] + LENGTH * SPEED[name])
    results = saltus.simulate(
        scene.system, scene.context, (scene.t_span[0], end), scene.options,
        save_at=[], dense_output=True,
    )  # fmt: skip
    drawing = drawings.of_scene(name, scene.parameters)
    return filmed(results, drawing, SPEED[name])


def of_course(name):
    make_drawing, signals, speed = COURSE[name]
    scene = saltus.load_scene(SCENES / f"{name}.toml")
    results = saltus.simulate(
        scene.system, scene.context, (0.0, LENGTH * speed), scene.options, signals,
        dense_output=True,
    )  # fmt: skip
    return filmed(results, make_drawing(), speed)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="scenes; all if none is given")
    parser.add_argument("--out", type=Path, default=HERE)
    arguments = parser.parse_args()
    for name in arguments.names or [*SPEED, *COURSE]:
        film = of_shelf(name) if name in SPEED else of_course(name)
        path = arguments.out / ("" if name in SPEED else "course") / f"{name}.gif"
        path.parent.mkdir(parents=True, exist_ok=True)
        film.save(path, dpi=DPI)
        plt.close(film.figure)
        print(f"{path} {path.stat().st_size / 1000:.0f} kB", flush=True)


if __name__ == "__main__":
    main()
