"""What can be wrong with a scene as a whole: it does not compile, or its tables do not fit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from saltus import _core
from saltus._signals import blocks_in
from saltus.errors import ModelError
from saltus.scene_files.wrong import Path as Keys
from saltus.scene_files.wrong import Wrong, placed
from saltus.simulation import Simulator
from saltus.system import System

if TYPE_CHECKING:
    from saltus.scene_files.scene import FileScene

__all__ = ["require_compiles", "require_swept", "require_updates"]


def require_compiles(scene: FileScene) -> None:
    """Compiles the system, which finds shapes that do not fit and loops."""
    try:
        Simulator(scene.system, scene.options)
    except (ModelError, TypeError, ValueError) as error:
        raise Wrong(_named(str(error), scene.tree), str(error)) from None


def _named(message: str, tree: dict[str, Any]) -> Keys:
    """The path of the block, or of the option, that a message is about."""
    for key, value in tree.get("run", {}).items():
        if f"'{value}'" in message or message.startswith((f"{key}:", f"option {key}:")):
            return ("run", key)
    for name in message.split("'")[1::2]:
        path: Keys = ()
        inside = tree
        for part in name.split("."):
            block = inside.get("blocks", {}).get(part)
            if block is None:
                break
            path = (*path, "blocks", part)
            system = block.get("system")
            inside = tree.get("systems", {}).get(system, {}) if system else {}
            if system:
                return path
        if path:
            return path
    return ("blocks",) if "blocks" in tree else ()


def require_swept(scene: FileScene) -> None:
    """Wrong for a name of the table `sweep` that the scene does not have."""
    for name in scene.swept.values:
        if name not in scene.parameters:
            with placed(("sweep", "values", name)):
                _require_value(scene, name)


def _require_value(scene: FileScene, name: str) -> None:
    try:
        _core.find_entry(scene.context, scene.entry_named(name))
    except ModelError as error:
        if "unknown" not in str(error):
            raise
        names = list(dict.fromkeys([*scene.parameters, *_core.entry_names(scene.context)]))
        hint = _core.known_names(name, names)
        raise ModelError(f"unknown parameter or state '{name}'{hint}") from None


def require_updates(system: System, begin: float) -> None:
    """Wrong for updates of a block that all come before the run begins."""
    for path, last in getattr(system, "last", ()):
        if last < begin:
            raise Wrong(
                path, f"expected a time from {begin:g} s on, the begin of the run, found {last:g}"
            )
    for block in blocks_in(system):
        require_updates(block, begin)
