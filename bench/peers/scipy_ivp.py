"""SciPy's solve_ivp: a new call after each reset."""

import numpy as np
from common import main
from scenes import SCENES
from scipy.integrate import solve_ivp


def event(guard):
    def g(t, x):
        return guard.g(np, t, x)

    g.terminal, g.direction = guard.reset is not None, guard.direction
    return g


def maker(method):
    def make(scene, rtol):
        if scene.stiff != (method in ("Radau", "BDF", "LSODA")):
            return None
        return lambda: run(scene, rtol, method)

    return make


def run(scene, rtol, method):
    t, x, mode, times = 0.0, np.array(scene.start), scene.mode, []
    while t < scene.end:
        guards = [g for g in scene.guards if g.mode in (None, mode)]
        now = mode
        done = solve_ivp(
            lambda t, x: scene.flow(np, t, x, now), (t, scene.end), x, method=method,
            rtol=max(rtol, 1e-13), atol=rtol * scene.atol, events=[event(g) for g in guards] or None,
        )  # fmt: skip
        if done.status < 0:
            raise RuntimeError(done.message)
        t, x = done.t[-1], done.y[:, -1]
        for guard, found in zip(guards, done.t_events or [], strict=False):
            times.extend(found)
            if guard.reset is not None and len(found):
                x, mode = guard.reset(np, t, x)
    return sorted(times), x


if __name__ == "__main__":
    main("SciPy", {name: maker(name) for name in ("RK45", "DOP853", "LSODA", "Radau")}, SCENES)
