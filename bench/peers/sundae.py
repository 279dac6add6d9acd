"""scikit-sundae: CVODE from Python, initialised again after each reset."""

import numpy as np
from common import main
from scenes import SCENES
from sksundae.cvode import CVODE


def solver(scene, rtol, mode):
    guards = [g for g in scene.guards if g.mode in (None, mode)]

    def rhs(t, x, xdot):
        xdot[:] = scene.flow(np, t, x, mode)

    def events(t, x, out):
        for i, guard in enumerate(guards):
            out[i] = guard.g(np, t, x)

    events.terminal = [guard.reset is not None for guard in guards]
    events.direction = [guard.direction for guard in guards]
    extra = {"eventsfn": events, "num_events": len(guards)} if guards else {}
    method = "BDF" if scene.stiff else "Adams"
    made = CVODE(
        rhs, method=method, rtol=rtol, atol=rtol * scene.atol, max_num_steps=10**7, **extra
    )
    return made, guards


def make(scene, rtol):
    solvers = {mode: solver(scene, rtol, mode) for mode in {scene.mode, 0}}
    seen = dict.fromkeys(solvers, 0)
    return lambda: run(scene, solvers, seen)


def run(scene, solvers, seen):
    """A solver continues its lists of events when it is used again, so the new events are at the
    end.
    """
    t, x, mode, times = 0.0, np.array(scene.start), scene.mode, []
    while t < scene.end:
        cvode, guards = solvers[mode]
        done = cvode.solve(np.array([t, scene.end]), x)
        if not done.success:
            raise RuntimeError(done.message)
        t, x = done.t[-1], done.y[-1]
        found = 0 if done.t_events is None else len(done.t_events) - seen[mode]
        if found == 0:
            continue
        seen[mode] += found
        times.extend(done.t_events[-found:])
        for guard, fired in zip(guards, np.atleast_2d(done.i_events)[-1], strict=True):
            if fired and guard.reset is not None and t < scene.end:
                x, mode = guard.reset(np, t, x)
                x = np.array(x, float)
    return sorted(times), x


if __name__ == "__main__":
    main("scikit-sundae", {"CVODE": make}, SCENES)
