"""A file that a scene was read from, and the error for a mistake in it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from saltus.errors import SceneError
from saltus.scene_files.places import places_of, start_of_text
from saltus.scene_files.wrong import Path, Wrong

__all__ = ["Source", "error_of", "place_of"]


@dataclass(frozen=True)
class Source:
    """A text, and its name in messages."""

    file: str
    text: str
    kind: str
    """'toml' or 'json'"""

    def place(self, path: Path, offset: int | None = None) -> tuple[int, int] | None:
        """Line and column of a key, or of its nearest parent; or of a character of its text."""
        places = places_of(self.text, self.kind)
        known = next((path[:n] for n in range(len(path), 0, -1) if path[:n] in places), None)
        if known is None:
            return None
        key, value = places[known]
        if offset is not None and known == path:
            return self._line_and_column(start_of_text(self.text, value) + offset)
        return self._line_and_column(key)

    def _line_and_column(self, at: int) -> tuple[int, int]:
        before = self.text[:at]
        return before.count("\n") + 1, at - (before.rfind("\n") + 1) + 1


def error_of(wrong: Wrong, sources: Mapping[Path, Source]) -> SceneError:
    """The error for a mistake, by the file of the longest part of its path that has one."""
    source, inside = _source_of(wrong.path, sources)
    place = source.place(inside, wrong.offset)
    key = "".join(f"[{k}]" if isinstance(k, int) else f".{k}" for k in inside).lstrip(".")
    line, column = place or (None, None)
    where = f"{source.file}:{line}:{column}" if line is not None else source.file
    said = f"{where}: {key}: {wrong.message}" if key else f"{where}: {wrong.message}"
    return SceneError(said, file=source.file, line=line, column=column, key=key)


def place_of(path: Path, sources: Mapping[Path, Source]) -> str:
    """file:line:column of the value of a key; empty if it is not known."""
    source, inside = _source_of(path, sources)
    place = source.place(inside, 0)
    return "" if place is None else f"{source.file}:{place[0]}:{place[1]}"


def _source_of(path: Path, sources: Mapping[Path, Source]) -> tuple[Source, Path]:
    """The file of the longest part of a path that has one, and the rest of the path."""
    base = next(path[:n] for n in range(len(path), -1, -1) if path[:n] in sources)
    return sources[base], path[len(base) :]
