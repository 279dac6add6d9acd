"""A leaf system of the table of a scene: every expression becomes a callback that is traced."""

from __future__ import annotations

from typing import Any

from saltus.scene_files.leaf_guards import declare_edge, declare_guard
from saltus.scene_files.leaf_parts import LeafParts
from saltus.scene_files.leaf_scope import LeafScope
from saltus.scene_files.leaf_states import (
    declare_held_outputs,
    declare_modes,
    declare_output,
    declare_states,
)
from saltus.scene_files.leaf_times import declare_event_input, declare_update
from saltus.scene_files.names import require_part_name
from saltus.scene_files.scene_leaf import SceneLeaf
from saltus.scene_files.wrong import Path, placed, table_at

__all__ = ["LEAF_KEYS", "leaf_of"]

LEAF_KEYS = (
    "states", "discrete", "modes", "mode", "inputs", "variables", "outputs", "guards", "edges",
    "updates", "event_inputs",
)  # fmt: skip
TABLES = tuple(key for key in LEAF_KEYS if key not in ("modes", "mode", "inputs"))
NAMED = {
    "outputs": declare_output,
    "guards": declare_guard,
    "edges": declare_edge,
    "updates": declare_update,
    "event_inputs": declare_event_input,
}
"""table of parts with names -> how one of them is declared"""


def leaf_of(path: Path, table: dict[str, Any], name: str, parameters: dict[str, Any]) -> SceneLeaf:
    """The system of a table. Wrong for a mistake in it."""
    for key in TABLES:
        table_at((*path, key), table.get(key, {}), "{ name = ... }")
    scope = LeafScope(parameters=parameters)
    scope.add_table(path, table)
    parts = LeafParts(path, table, name, scope)
    _declare(parts)
    return parts.leaf


def _declare(parts: LeafParts) -> None:
    for name, size in parts.scope.inputs.items():
        with placed((*parts.path, "inputs")):
            parts.leaf.declare_input_port(name, shape=() if size is None else size)
    declare_states(parts)
    declare_modes(parts)
    for what, declare in NAMED.items():
        for name, value in parts.table.get(what, {}).items():
            path = (*parts.path, what, name)
            require_part_name(path, name, what[:-1].replace("_", " "))
            with placed(path):
                declare(parts, path, name, value)
    declare_held_outputs(parts)
    _declare_parameters(parts)
    parts.leaf.expressions = parts.scope.made


def _declare_parameters(parts: LeafParts) -> None:
    """Those that some expression reads, with what the file says about them."""
    read = parts.scope.read
    for name, value in parts.scope.parameters.items():
        if name in read:
            with placed((*parts.path, "parameters", name)):
                parts.leaf.declare_dynamic_parameter(name, value)
    keys = parts.started | parts.structural
    parts.leaf.structural = {name: key for name, key in keys.items() if name in read}
    parts.leaf.fixed, parts.leaf.read = frozenset(parts.structural), frozenset(read)
