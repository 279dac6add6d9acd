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
    return scene.options.get("ode_solver_method") in ("adams", "bdf") and any(
        part.kind in ("Pulse", "UnitDelay", "ZeroOrderHold") or None in part.sources
        for part in scene.parts
    )
