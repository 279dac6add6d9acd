"""heyoka: Taylor steps compiled by LLVM; resets are callbacks of terminal events."""

import heyoka as hy
import numpy as np
from common import main
from scenes import SCENES


DIRECTIONS = {
    -1: hy.event_direction.negative, 0: hy.event_direction.any, 1: hy.event_direction.positive
}  # fmt: skip


def make(scene, rtol, fp_type=float):
    """Modes are the parameter par[0]; a guard is ignored in modes that are not its own."""
    if scene.end > 1e9:
        return None  # explicit: it would not come to the end of 4e10 s
    x = hy.make_vars(*(f"x{i}" for i in range(len(scene.start))))
    x = list(x) if len(scene.start) > 1 else [x]
    flow = scene.flow(hy, hy.time, x, hy.par[0])
    times, resets, monitors = [], [], []

    def terminal(guard):
        def callback(ta, sign):
            if guard.mode not in (None, *ta.pars):
                return True
            times.append(ta.time)
            ta.state[:], ta.pars[:] = guard.reset(np, ta.time, ta.state)
            return True

        return callback

    for guard in scene.guards:
        g = guard.g(hy, hy.time, x)
        how = DIRECTIONS[guard.direction]
        if guard.reset is None:
            log = lambda ta, t, sign: times.append(t)  # noqa: E731
            monitors.append(hy.nt_event(g, log, direction=how, fp_type=fp_type))
        else:
            resets.append(hy.t_event(g, callback=terminal(guard), direction=how, fp_type=fp_type))
    ta = hy.taylor_adaptive(
        list(zip(x, flow, strict=True)), np.array(scene.start, dtype=fp_type), tol=fp_type(rtol),
        t_events=resets, nt_events=monitors, fp_type=fp_type,
    )  # fmt: skip

    def run():
        times.clear()
        ta.time, ta.state[:], ta.pars[:] = fp_type(0.0), scene.start, scene.mode
        if resets:
            ta.reset_cooldowns()
        ta.propagate_until(fp_type(scene.end))
        return list(times), ta.state.copy()

    return run


if __name__ == "__main__":
    main("heyoka", {"Taylor": make}, SCENES)
