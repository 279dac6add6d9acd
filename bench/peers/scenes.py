"""Scenes of the shelf in plain Python, for programs that are not Saltus: the same equations,
parameters and spans. `m` is the module whose sin and sqrt are meant: numpy, heyoka, jax.numpy.
"""

from collections.abc import Callable
from dataclasses import dataclass, field


@dataclass
class Guard:
    """g(m, t, x) fires in `mode` (None: each) when it crosses zero in `direction`. A guard without
    `reset` is a monitor; `reset(m, t, x)` gives the state and the mode after it.
    """

    g: Callable
    direction: int = 0
    reset: Callable | None = None
    mode: int | None = None


@dataclass
class Scene:
    """x' = flow(m, t, x, mode) from `start` at t = 0 to `end` [s]; absolute tolerance is `atol`
    times the relative one.
    """

    flow: Callable
    start: list
    end: float
    guards: list = field(default_factory=list)
    mode: int = 0
    atol: float = 1e-2
    stiff: bool = False


def table(m, t):
    return 0.05 * m.sin(10.0 * t)


def on_table(m, t, x):
    speed = 0.5 * m.cos(10.0 * t)
    return [table(m, t), speed - 0.8 * (x[1] - speed)], 0


def planet(m, t, x, mode):
    r2 = x[0] * x[0] + x[1] * x[1]
    w = -1.0 / (r2 * m.sqrt(r2))
    return [x[2], x[3], w * x[0], w * x[1]]


def reaction(m, t, x, mode):
    decay, back, on = 0.04 * x[0], 1e4 * x[1] * x[2], 3e7 * x[1] * x[1]
    return [back - decay, decay - back - on, on]


SCENES = {
    "bouncing-ball": Scene(
        lambda m, t, x, mode: [x[1], -9.81 + 0.0 * x[1]], [10.0, 0.0], 12.0,
        [Guard(lambda m, t, x: x[0], -1, lambda m, t, x: ([abs(x[0]), -0.9 * x[1]], 0))],
    ),
    "ball-table": Scene(
        lambda m, t, x, mode: [x[1], -10.0 + 0.0 * x[1]], [1.0, 0.0], 7.7,
        [Guard(lambda m, t, x: x[0] - table(m, t), -1, on_table)], atol=1.0,
    ),
    "thermostat": Scene(
        lambda m, t, x, mode: [(10.0 + 30.0 * mode - x[0]) / 1800.0], [19.0], 43200.0,
        [Guard(lambda m, t, x: x[0] - 21.0, 1, lambda m, t, x: ([x[0]], 0), mode=1),
         Guard(lambda m, t, x: x[0] - 19.0, -1, lambda m, t, x: ([x[0]], 1), mode=0)], mode=1,
    ),
    "robertson": Scene(
        reaction, [1.0, 0.0, 0.0], 4e10,
        [Guard(lambda m, t, x: x[0] - 1e-4), Guard(lambda m, t, x: x[2] - 0.01)],
        atol=1e-8, stiff=True,
    ),
    "van-der-pol": Scene(
        lambda m, t, x, mode: [x[1], 1000.0 * (1.0 - x[0] * x[0]) * x[1] - x[0]], [2.0, 0.0], 2000.0,
        [Guard(lambda m, t, x: x[0])], stiff=True,
    ),
    "kepler": Scene(
        planet, [0.4, 0.0, 0.0, 2.0], 60.0,
        [Guard(lambda m, t, x: x[0] * x[2] + x[1] * x[3])], atol=1.0,
    ),
    "kepler-alone": Scene(planet, [0.4, 0.0, 0.0, 2.0], 60.0, atol=1.0),
}  # fmt: skip
