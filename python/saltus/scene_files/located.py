"""The place in the file of the expression that a message of a run is about."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from saltus.scene_files.scene_leaf import SceneLeaf
from saltus.scene_files.source import Source, place_of
from saltus.scene_files.values import leaf_of_block, states_named
from saltus.scene_files.wrong import Path
from saltus.system import System

__all__ = ["explained"]

EFFECTS = ("guards", "edges", "updates", "event_inputs")
ABOUT = (
    (
        re.compile(r"block '(?P<block>[^']+)'.*?the rate of '(?P<name>[^']+)' is"),
        ("states", "rate"),
    ),
    (re.compile(r"state '(?P<name>[^']+)' of block '(?P<block>[^']+)'"), ("states", "rate")),
    (re.compile(r"output '(?P<block>[^']+)\.(?P<name>[^'.]+)'"), ("outputs", "")),
    (re.compile(r"guard '(?P<block>[^']+)\.(?P<name>[^'.]+)'"), ("guards", "guard")),
    (re.compile(r"'(?P<block>[^']+)\.(?P<name>[^'.]+)' set a state"), ("", "set")),
    (re.compile(r"block '(?P<block>[^']+)' moves fastest(?P<name>)"), ("states", "")),
)
"""a message of the engine -> the table of the leaf, and the key of the expression in its entry"""


def explained(
    message: str, system: System, tree: dict[str, Any], sources: Mapping[Path, Source]
) -> str:
    """The message of a run that failed, with the names of states in place of their positions, and
    the place of the expression at fault, if a leaf of the scene has it.
    """
    message = states_named(message, system)
    for pattern, (table, key) in ABOUT:
        match = pattern.search(message)
        leaf = match and leaf_of_block(system, match["block"])
        if not isinstance(leaf, SceneLeaf):
            continue
        assert match is not None
        inside = _at(tree, leaf.path)
        tables = [t for t in ([table] if table else EFFECTS) if match["name"] in inside.get(t, {})]
        if not match["name"] and table in inside:
            tables = [table]
        if tables:
            keys = [tables[0], *([match["name"]] if match["name"] else []), *([key] if key else [])]
            where = place_of((*leaf.path, *keys), sources)
            return f"{message} ({where}: {'.'.join(keys)})" if where else message
    return message


def _at(tree: Any, path: Path) -> dict[str, Any]:
    for key in path:
        tree = tree[key]
    found: dict[str, Any] = tree
    return found
