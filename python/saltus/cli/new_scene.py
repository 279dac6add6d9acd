"""saltus new: write a first scene file, a bouncing ball, to be changed into your own.

saltus new ball.toml
saltus new --schema scene.schema.json
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from saltus.errors import ModelError

__all__ = ["act", "add_arguments"]

NAME = "new"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", type=Path, nargs="?", metavar="FILE", help="scene.toml or .json")
    parser.add_argument(
        "--schema", type=Path, metavar="FILE", help="the JSON Schema of scenes, for an editor"
    )


def act(chosen: argparse.Namespace) -> int:
    if chosen.file is None and chosen.schema is None:
        raise ModelError("expected the name of a file to write, such as ball.toml")
    if chosen.file is not None:
        _write(chosen.file, _first(chosen.file))
    if chosen.schema is not None:
        from saltus import scene_files

        _write(chosen.schema, json.dumps(scene_files.schema(), indent=1) + "\n")
    return 0


def _first(file: Path) -> str:
    from saltus import scene_files

    kind = file.suffix.lower()
    if kind not in (".toml", ".json"):
        raise ModelError(f"expected a name that ends in .toml or .json, found '{file}'")
    if kind == ".json":
        return scene_files.dumps(scene_files.loads(scene_files.first_scene()), "json")
    return scene_files.first_scene(str(file))


def _write(file: Path, text: str) -> None:
    try:
        with open(file, "x", encoding="utf-8") as opened:
            opened.write(text)
    except FileExistsError:
        raise ModelError(f"'{file}' exists already; choose another name") from None
    print(f"wrote {file}")
