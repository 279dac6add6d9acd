"""What do tapes cost? Scenes of the shelf, written in Python and traced, against the same scenes
in C++: tapes interpreted, and as machine code.

    python bench/jit.py [SCENE...]

A run is `initialize` and `advance_to` of the engine, warm, nothing recorded; the three take turns.
Processor time, medians. Then the time to compile the tapes of a scene.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import saltus

TURNS = 15
LEAST = 2e-3  # [s] a shorter run is repeated


class Model(saltus.LeafSystem):
    """A leaf of functions of the time, the state and the parameters."""

    def __init__(self, x, ode, guards=(), mode=None, **parameters):
        super().__init__(name="model")
        self.declare_continuous_state(x, ode=ode)
        for name, value in parameters.items():
            self.declare_dynamic_parameter(name, value)
        if mode is not None:
            self.declare_default_mode(mode)
        for guard in guards:
            self.declare_zero_crossing(**guard)


def kepler():
    return orbit(lambda square: np.sqrt(square) ** 3)


def kepler_power():
    return orbit(lambda square: square**1.5)


def orbit(cube):
    """Kepler's orbit; `cube` computes r^3 of r^2."""

    def ode(time, state, *, mu):
        x, y, vx, vy = state.continuous_state
        w = -mu / cube(x * x + y * y)
        return np.array([vx, vy, w * x, w * y])

    def apsis(time, state, *, mu):
        x, y, vx, vy = state.continuous_state
        return x * vx + y * vy

    return Model([0.4, 0.0, 0.0, 2.0], ode, [{"guard": apsis, "name": "apsis"}], mu=1.0)


def pleiades():
    start = saltus.scene("pleiades").context.continuous_state
    masses = np.arange(1.0, 8.0)

    def ode(time, state):
        s = state.continuous_state
        x, y = s[:7], s[7:14]
        dx = x[None, :] - x[:, None]
        dy = y[None, :] - y[:, None]
        r2 = dx * dx + dy * dy + np.eye(7)
        w = masses[None, :] / (r2 * np.sqrt(r2))
        return np.concatenate([s[14:], np.sum(w * dx, axis=1), np.sum(w * dy, axis=1)])

    return Model(start, ode)


def pleiades_loops():
    start = saltus.scene("pleiades").context.continuous_state

    def ode(time, state):
        s = state.continuous_state
        x, y = s[:7], s[7:14]
        ax, ay = [0.0] * 7, [0.0] * 7
        for i in range(7):
            for j in range(i):
                dx, dy = x[j] - x[i], y[j] - y[i]
                d2 = dx * dx + dy * dy
                w = 1.0 / (d2 * np.sqrt(d2))
                ax[i] += (j + 1.0) * w * dx
                ay[i] += (j + 1.0) * w * dy
                ax[j] -= (i + 1.0) * w * dx
                ay[j] -= (i + 1.0) * w * dy
        return np.array([*s[14:], *ax, *ay])

    return Model(start, ode)


def lorenz():
    def ode(time, state, *, sigma, rho, beta):
        x, y, z = state.continuous_state
        return np.array([sigma * (y - x), x * (rho - z) - y, x * y - beta * z])

    def section(time, state, *, sigma, rho, beta):
        return state.continuous_state[2] - (rho - 1.0)

    guards = [{"guard": section, "name": "section"}]
    return Model([0.0, 1.0, 0.0], ode, guards, sigma=10.0, rho=28.0, beta=8.0 / 3.0)


FALLS = "positive_then_non_positive"
RISES = "negative_then_non_negative"


def ball_drag():
    def ode(time, state):
        _, v = state.continuous_state
        return np.array([v, -9.81 - 0.05 * v * np.abs(v)])

    def floor(time, state):
        return state.continuous_state[0]

    def bounce(time, state):
        return state.with_continuous_state(np.array([0.0, -0.8 * state.continuous_state[1]]))

    guard = {"guard": floor, "reset_map": bounce, "name": "bounce", "direction": FALLS}
    return Model([10.0, 0.0], ode, [guard])


def ball_table():
    def ode(time, state):
        return np.array([state.continuous_state[1], -10.0])

    def table(time, state):
        return state.continuous_state[0] - 0.05 * np.sin(10.0 * time)

    def bounce(time, state):
        v = 0.05 * 10.0 * np.cos(10.0 * time)
        after = v - 0.8 * (state.continuous_state[1] - v)
        return state.with_continuous_state(np.array([0.05 * np.sin(10.0 * time), after]))

    guard = {"guard": table, "reset_map": bounce, "name": "bounce", "direction": FALLS}
    return Model([1.0, 0.0], ode, [guard])


def thermostat():
    def ode(time, state):
        return (np.where(state.mode == 1, 40.0, 10.0) - state.continuous_state) / 1800.0

    def warm(time, state):
        return state.continuous_state[0] - 21.0

    def cold(time, state):
        return state.continuous_state[0] - 19.0

    guards = [
        {"guard": warm, "name": "warm", "direction": RISES, "start_mode": 1, "end_mode": 0},
        {"guard": cold, "name": "cold", "direction": FALLS, "start_mode": 0, "end_mode": 1},
    ]
    return Model([19.0], ode, guards, mode=1)


def brusselator_2d():
    n = 32
    scene = saltus.scene("brusselator-2d")
    x, y = np.meshgrid(np.arange(1, n + 1) / n, np.arange(1, n + 1) / n)
    disc = (x - 0.3) ** 2 + (y - 0.6) ** 2 <= 0.1**2

    def ode(time, state, *, alpha):
        w = state.continuous_state.reshape(n, n, 2)
        u, v = w[:, :, 0], w[:, :, 1]
        d = alpha * n * n

        def spread(a):
            left, right = np.roll(a, 1, axis=1), np.roll(a, -1, axis=1)
            below, above = np.roll(a, 1, axis=0), np.roll(a, -1, axis=0)
            return d * (left + right + below + above - 4.0 * a)

        on = u * u * v
        source = np.where(state.mode == 1, 5.0 * disc, 0.0)
        du = 1.0 + on - 4.4 * u + spread(u) + source
        dv = 3.4 * u - on + spread(v)
        return np.stack([du, dv], axis=2).reshape(-1)

    model = Model(scene.context.continuous_state, ode, mode=0, alpha=0.1)
    model.declare_one_shot(lambda time, state, **_: state.with_mode(1), 1.1, name="source")
    return model


MODELS: dict[str, tuple[str, Callable[[], saltus.LeafSystem], dict[str, float]]] = {
    "kepler": ("kepler", kepler, {}),
    "kepler, r2**1.5": ("kepler", kepler_power, {}),
    "pleiades": ("pleiades", pleiades, {}),
    "pleiades, loops": ("pleiades", pleiades_loops, {}),
    "lorenz": ("lorenz", lorenz, {}),
    "ball-drag": ("ball-drag", ball_drag, {}),
    "ball-table": ("ball-table", ball_table, {}),
    "thermostat": ("thermostat", thermostat, {}),
    "brusselator-2d": ("brusselator-2d", brusselator_2d, {"rtol": 1e-4, "atol": 1e-6}),
}


class Runs:
    """One way to run a scene, and the times of its runs."""

    def __init__(self, system, context, span, options):
        self.simulator = saltus.Simulator(system, options)
        self.core = self.simulator._core  # without the cost of Python beside the run
        self.context, self.end = context.with_time(span[0]), span[1]
        self.seconds = []
        self.repeat = 1
        self.once()
        self.repeat = max(1, round(LEAST / self.once()))

    def once(self):
        start = time.thread_time()
        for _ in range(self.repeat):
            self.core.initialize(self.context)
            self.core.advance_to(self.end)
        return (time.thread_time() - start) / self.repeat

    def turn(self):
        self.seconds.append(self.once())

    @property
    def median(self):
        return statistics.median(self.seconds)


def runs_of(name, options):
    """In C++, interpreted, compiled; and the time to compile."""
    shelf, make, more = MODELS[name]
    scene = saltus.scene(shelf)
    options = replace(scene.options, save_at=(), **(options | more))
    options = replace(options, recorded_signals=None, machine_code="never")
    cpp = Runs(scene.system, scene.context, scene.t_span, options)
    model = make()
    interpreted = Runs(model, model.create_context(), scene.t_span, options)
    model = make()
    saltus.Simulator(model, options)  # which traces it
    start = time.process_time()
    before = saltus.Simulator(model, options)
    plan = time.process_time() - start
    del before
    start = time.process_time()
    compiled = saltus.Simulator(model, replace(options, machine_code="always"))
    compiled.initialize(model.create_context())
    seconds = time.process_time() - start - plan
    fast = Runs(
        model, model.create_context(), scene.t_span, replace(options, machine_code="always")
    )
    return (cpp, interpreted, fast), seconds


def main(names):
    import saltus.jit

    saltus.jit.functions("define void @saltus_tape_0() { ret void }", 1)  # loads the compiler
    head = ("scene", "C++ [us]", "interpreted", "compiled", "compiling [ms]")
    print(f"{head[0]:24} {head[1]:>10} {head[2]:>12} {head[3]:>9} {head[4]:>15}")
    for name in names or MODELS:
        for method, rtol in (("dopri5", 1e-6), ("dop853", 1e-9)):
            tolerances = {"rtol": rtol, "atol": 0.01 * rtol, "ode_solver_method": method}
            if name.startswith("brusselator"):
                tolerances["ode_solver_method"] = "auto"
            runs, compiling = runs_of(name, tolerances)
            for _ in range(TURNS):
                for run in runs:
                    run.turn()
            cpp, interpreted, fast = (run.median for run in runs)
            print(
                f"{name + ' ' + method:24} {cpp * 1e6:10.1f} {interpreted / cpp:12.2f}"
                f" {fast / cpp:9.2f} {compiling * 1e3:15.1f}",
                flush=True,
            )


if __name__ == "__main__":
    main(sys.argv[1:])
