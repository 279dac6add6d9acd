"""What random scenes found and the engine does not do yet: left out of the random ones, and an
expected failure each in test_found.py. To be emptied.
"""

from __future__ import annotations

from typing import Any

from scene import Scene


def is_known(scene: Scene) -> bool:
    return (
        without_zeno(scene)  # a block at rest fires for ever
        or throws(scene)  # what a reset throws far from its surface is held, or fires again
    )


def throws(scene: Scene) -> bool:
    return any(guard["reset"] in ("add", "set") for guard in guards(scene))


def guards(scene: Scene) -> list[dict[str, Any]]:
    return [guard for part in scene.parts for guard in part.arguments.get("guards", [])]


def without_zeno(scene: Scene) -> bool:
    places = [scene.options, *(part.arguments for part in scene.parts), *guards(scene)]
    return any(place.get("zeno_tolerance") == 0.0 for place in places)
