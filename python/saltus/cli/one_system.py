"""One system for all rows of a sweep of a scene file, where the values that vary allow it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from saltus.cli.scene_of import Chosen, chosen_scene, with_values
from saltus.errors import ModelError

if TYPE_CHECKING:
    from saltus.scene_files import FileScene

__all__ = ["OneSystem"]


class OneSystem:
    """Makes the scene of a row from that of the first row: the same system, other values.

    It is kept by the process that runs the rows. Pickled, it is empty.
    """

    def __init__(self) -> None:
        self._first: Chosen | None = None
        self._follows: Any = None  # None: each row needs a system of its own

    def __reduce__(self) -> tuple[Any, ...]:
        return OneSystem, ()

    def of(
        self, scene: str, file: FileScene, settings: Mapping[str, Any], row: Mapping[str, Any]
    ) -> Chosen | None:
        """The scene of a row; None if it has to be made anew, also for an impossible value, which
        is refused then.
        """
        own = frozenset(row.keys() & file.parameters.keys())
        if self._first is None:
            self._begin(scene, file, settings, own)
        if self._first is None or self._follows is None:
            return None
        try:
            made = self._follows.row({name: row[name] for name in own})
        except (ModelError, TypeError, ValueError):
            return None
        rest = {n: v for n, v in {**settings, **row}.items() if n not in file.parameters}
        context = with_values(self._first.context, made, set())
        values = file_entries(self._first, rest)
        return replace(self._first, context=with_values(context, values, set(file.parameters)))

    def _begin(
        self, scene: str, file: FileScene, settings: Mapping[str, Any], own: frozenset[str]
    ) -> None:
        plain = {name: value for name, value in settings.items() if name in file.parameters}
        self._first = chosen_scene(scene, plain, file)
        self._follows = self._first.made.following(own) if self._first.made else None


def file_entries(scene: Chosen, rest: Mapping[str, Any]) -> dict[str, Any]:
    """The values of a context by its own names."""
    assert scene.made is not None
    return {scene.made.entry_named(name): value for name, value in rest.items()}
