"""A sweep of a scene: its values by the names of a context, and the system of its runs."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import TYPE_CHECKING, Any

from saltus.ensemble.job import Following
from saltus.ensemble.table import table_of
from saltus.errors import ModelError
from saltus.scene_files.followed import Structural, followed
from saltus.scene_files.followed_columns import FollowedColumns
from saltus.scene_files.wrong import Wrong

if TYPE_CHECKING:
    from saltus.scene_files.scene import FileScene

__all__ = ["one_system", "recorded_paths", "system_swept", "values_swept"]


def values_swept(scene: FileScene, values: Any, how: dict[str, Any]) -> tuple[Any, dict[str, Any]]:
    """The values by the names of a context, and the arguments; those of the table `sweep`, if there
    are no `values`.
    """
    if values is None:
        if not scene.swept.values:
            raise ModelError(f"scene '{scene.name}' says nothing to vary; write a table 'sweep'")
        values, how = scene.swept.values, {"paired": scene.swept.paired} | how
    return _renamed(values, scene.entry_named), how


def system_swept(scene: FileScene, values: Any, how: Mapping[str, Any]) -> Any:
    """The system of all runs, or a function that makes one for each run."""
    own = scene.parameters.keys() & _names(values)
    if how.get("executor") == "processes":  # a function that makes a system can be sent there
        return scene.maker()
    if not own:
        return scene.system
    return one_system(scene, values, frozenset(own), how) or scene.maker()


def one_system(
    scene: FileScene, values: Any, own: frozenset[str], how: Mapping[str, Any]
) -> Following | None:
    """The system with the values that follow from parameters of the scene; None if each run
    needs a system of its own, also because the file does not allow one of the values.
    """
    if how.get("store") is not None:  # what a store holds is named by the function
        return None
    try:
        follow = FollowedColumns(scene.tree, followed(scene.tree, scene.system, own), own)
        columns = table_of(values, bool(how.get("paired"))).columns
        states = follow(columns).keys() - columns.keys() - scene.context.parameters.keys()
    except (Structural, Wrong, ModelError, TypeError, ValueError):
        return None
    given = columns.keys() - own - scene.context.parameters.keys()
    if _share(states, given):
        return None  # two names of one state, of which that of the block wins
    return Following(scene.system, follow)


def _share(some: Collection[str], others: Collection[str]) -> bool:
    """Whether there is a block of which both have states."""
    return bool({n.rpartition(".")[0] for n in some} & {n.rpartition(".")[0] for n in others})


def _names(values: Any) -> list[str]:
    """The names of a dict, of a list of dicts, or of a DataFrame."""
    if isinstance(values, (list, tuple)):
        return list(dict.fromkeys(name for row in values for name in row))
    return list(values)


def _renamed(values: Any, rename: Callable[[str], str]) -> Any:
    """Values by the names of a context; also of a DataFrame."""
    if isinstance(values, Mapping):
        return {rename(name): column for name, column in values.items()}
    if isinstance(values, (list, tuple)) and all(isinstance(row, Mapping) for row in values):
        return [{rename(name): value for name, value in row.items()} for row in values]
    if hasattr(values, "rename"):
        return values.rename(columns=rename)
    return values


def recorded_paths(scene: FileScene) -> dict[str, str]:
    """The signals to record, by their paths, which are valid also in a system that is made anew."""
    return {name: _path_in(scene, name) for name in scene.options.recorded_signals or {}}


def _path_in(scene: FileScene, name: str) -> str:
    record = scene.tree.get("run", {}).get("record")
    return str(record[name]) if isinstance(record, dict) else name
