"""A run of a scene: its span, and the tolerance that the file leaves open."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from saltus.errors import ModelError
from saltus.options import atol_beside

if TYPE_CHECKING:
    from saltus.scene_files.scene import FileScene

__all__ = ["span_of", "with_atol"]


def span_of(scene: FileScene) -> tuple[float, float]:
    """[s] Begin and end. ModelError for a scene without an end."""
    if scene.t_span is None:
        raise ModelError(
            f"scene '{scene.name}' says no end of the run; write until = ... [s] in its table 'run'"
        )
    return scene.t_span


def with_atol(scene: FileScene, options: dict[str, Any]) -> dict[str, Any]:
    """The options with atol = rtol/100, if they say `rtol` and neither they nor the file `atol`."""
    rtol = options.get("rtol")
    if "atol" in options or scene.writes_atol or not isinstance(rtol, (float, list, tuple)):
        return options
    return options | {"atol": atol_beside(rtol)}
