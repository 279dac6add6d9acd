"""Load a scene from a file or a text, and write it."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from saltus import library
from saltus.errors import ModelError
from saltus.scene_files.includes import with_includes
from saltus.scene_files.library_block import SUBSYSTEMS, arguments_of
from saltus.scene_files.reading import read_file
from saltus.scene_files.scene import FileScene
from saltus.scene_files.source import Source, error_of
from saltus.scene_files.writing import text_of
from saltus.scene_files.wrong import Wrong

__all__ = ["dumps", "load", "loads", "schema"]

SCHEMA = Path(__file__).with_name("scene.schema.json")


def load(path: str | os.PathLike[str], /, **parameters: Any) -> FileScene:
    """The scene of a file; the same as `saltus.load_scene`.

    Examples
    --------
    >>> from saltus.scene_files import load
    >>> load("ball.tom")
    Traceback (most recent call last):
        ...
    saltus.errors.SceneError: ball.tom: expected a name that ends in .toml or .json
    """
    try:
        file = Path(path)
    except TypeError:
        raise ModelError(f"expected the path of a scene file, found {path!r}") from None
    source = read_file(file, os.fspath(path))
    return _scene(source, file.resolve(), parameters)


def loads(text: str, kind: str = "toml", /, **parameters: Any) -> FileScene:
    """The scene of a text.

    Parameters
    ----------
    text
        The content of a file. It includes no other file.
    kind
        'toml' or 'json'.
    parameters
        Values of parameters of the scene, in place of those in the text.

    Raises
    ------
    SceneError
        A ModelError with line and column, for a mistake in the text.

    Examples
    --------
    >>> from saltus.scene_files import dumps, loads
    >>> clock = loads('version = 1\\noutputs = { t = "t" }\\nrun = { until = 2.0 }')
    >>> loads(dumps(clock)) == clock == loads(dumps(clock, "json"), "json")
    True
    """
    if kind not in ("toml", "json") or not isinstance(text, str):
        raise ModelError(f"expected a text, and 'toml' or 'json', found {kind!r}")
    return _scene(Source("<text>", text, kind), None, parameters)


def _scene(source: Source, file: Path | None, parameters: dict[str, Any]) -> FileScene:
    name = "scene" if file is None else file.stem.replace(".", "_")  # a dot separates a path
    folder = None if file is None else file.parent
    sources = {(): source}
    try:
        tree = with_includes(source, folder, file, sources)
    except Wrong as wrong:
        raise error_of(wrong, sources) from None
    return FileScene(tree, sources, name, parameters)


def dumps(scene: FileScene, kind: str = "toml") -> str:
    """The text of a scene, with included files in it.

    Parameters
    ----------
    scene
        The scene, from `saltus.load_scene` or `loads`.
    kind
        'toml' or 'json'.

    Raises
    ------
    ModelError
        If the kind is unknown.

    Examples
    --------
    >>> from saltus.scene_files import dumps, first_scene, loads
    >>> print(dumps(loads(first_scene(), e=0.5)).splitlines()[0])
    version = 1
    """
    return text_of(scene.tree, kind)


def schema() -> dict[str, Any]:
    """The JSON Schema of scenes, with the names and arguments of the blocks of the library.

    Examples
    --------
    >>> from saltus.scene_files import schema
    >>> schema()["title"]
    'A scene of Saltus'
    """
    whole: dict[str, Any] = json.loads(SCHEMA.read_text(encoding="utf-8"))
    parts = whole["$defs"]
    parts["libraryBlock"] = {"oneOf": [_block(name) for name in sorted(library.__all__)]}
    return whole


def _block(name: str) -> dict[str, Any]:
    """A block of the library with the names of its arguments."""
    arguments = arguments_of(name)
    needed = [key for key, each in arguments.items() if each.default is each.empty]
    more = ["parameters"] if name in SUBSYSTEMS else []
    return {
        "properties": {"block": {"const": name}, **{key: {} for key in (*arguments, *more)}},
        "required": ["block", *needed],
        "additionalProperties": False,
    }
