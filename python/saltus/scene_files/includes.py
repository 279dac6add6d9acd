"""Other files that a scene includes: each becomes a system of it, under a name."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from saltus.scene_files.names import require_part_name, text_at
from saltus.scene_files.reading import read_file, tree_of
from saltus.scene_files.root import ROOT_KEYS, require_root
from saltus.scene_files.source import Source
from saltus.scene_files.systems import SYSTEM_KEYS
from saltus.scene_files.wrong import Path as Keys
from saltus.scene_files.wrong import Wrong, table_at

__all__ = ["with_includes"]

MOST_FILES = 1000


def with_includes(
    source: Source, folder: Path | None, file: Path | None, sources: dict[Keys, Source]
) -> dict[str, Any]:
    """The tree of a source with its included files as systems; notes the source of each part."""
    return _with_includes((), source, folder, (file,) if file else (), sources)


def _with_includes(
    at: Keys,
    source: Source,
    folder: Path | None,
    inside: tuple[Path, ...],
    sources: dict[Keys, Source],
) -> dict[str, Any]:
    try:
        tree = tree_of(source)
        require_root(tree)
        included = table_at(("include",), tree.pop("include", {}), "{ wheel = 'wheel.toml' }")
        systems = table_at(("systems",), tree.get("systems", {}), "{ wheel = { states = ... } }")
    except Wrong as wrong:
        raise Wrong((*at, *wrong.path), wrong.message, wrong.offset) from None
    for name, value in included.items():
        here = (*at, "include", name)
        require_part_name(here, name, "system")
        if name in systems:
            raise Wrong(here, f"'{name}' is a system of this file already; choose another name")
        path = _path_of(here, text_at(here, value, "wheel.toml"), folder, inside)
        if len(sources) > MOST_FILES:
            raise Wrong(here, f"expected at most {MOST_FILES} included files")
        there = (*at, "systems", name)
        sources[there] = read_file(path, str(path))
        inner = _with_includes(there, sources[there], path.parent, (*inside, path), sources)
        systems = {**systems, name: _as_system(inner)}
        tree["systems"] = systems
    return tree


def _path_of(at: Keys, text: str, folder: Path | None, inside: tuple[Path, ...]) -> Path:
    if folder is None:
        raise Wrong(at, "a text without a file cannot include another file; load it from a file")
    try:
        path = (folder / text).resolve()
        exists = path.is_file()
    except (OSError, ValueError, RuntimeError) as error:
        raise Wrong(at, f"no file '{text}': {error}") from None
    if not exists:
        raise Wrong(at, f"there is no file '{text}' in {folder}")
    if path in inside:
        chain = " includes ".join(p.name for p in (*inside[inside.index(path) :], path))
        raise Wrong(at, f"a file cannot include itself: {chain}")
    return path


def _as_system(tree: dict[str, Any]) -> dict[str, Any]:
    """The tables of a scene that is a part of another one, without its runs."""
    system = {key: value for key, value in tree.items() if key in SYSTEM_KEYS}
    if "title" in tree and "description" not in system:
        system["description"] = tree["title"]
    assert not tree.keys() - ROOT_KEYS - set(SYSTEM_KEYS)
    return system
