"""What random scenes found and the engine does not do yet: left out of the random ones, and an
expected failure each in test_found.py. To be emptied.
"""

from __future__ import annotations

from typing import Any

from scene import Scene


def is_known(scene: Scene) -> bool:
    return (
        scene.span[1] == 0.0  # an instant at t = 0 that is also the end hangs
        or without_zeno(scene)  # a block at rest fires for ever
        or ends_at_a_tick(scene)  # CVODE refuses a distance of an ulp
        or any(guard["of"] == "pair" for guard in guards(scene))  # several guards in one
    )


def guards(scene: Scene) -> list[dict[str, Any]]:
    return [guard for part in scene.parts for guard in part.arguments.get("guards", [])]


def without_zeno(scene: Scene) -> bool:
    places = [scene.options, *(part.arguments for part in scene.parts), *guards(scene)]
    return any(place.get("zeno_tolerance") == 0.0 for place in places)


def ends_at_a_tick(scene: Scene) -> bool:
    """All but: an ulp before the end or behind it."""
    end, ticks = scene.span[1], [(0.7, 0.0)]  # of a pulse that stands for no source
    for part in scene.parts:
        given = part.arguments
        ticks += [(update["period"], update["offset"]) for update in given.get("updates", [])]
        if "dt" in given:
            ticks.append((given["dt"], 0.0))
        if part.kind == "Pulse":
            period, delay = given.get("period", 1.0), given.get("phase_delay", 0.0)
            ticks += [(period, delay), (period, delay + 0.5 * period)]
        if part.kind in ("Step", "Ramp"):
            time = given.get("step_time", given.get("start_time", 1.0))
            ticks.append((1e9, time))
    apart = [
        abs(round((end - offset) / period) * period + offset - end) for period, offset in ticks
    ]
    return scene.options.get("ode_solver_method") in ("adams", "bdf") and any(
        0.0 < distance < 1e-9 for distance in apart
    )
