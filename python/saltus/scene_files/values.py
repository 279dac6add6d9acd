"""The values of blocks by the names of a scene file: `ctl.I` is an entry of a context."""

from __future__ import annotations

import re
from typing import Any

from saltus._signals import blocks_in
from saltus.errors import ModelError
from saltus.scene_files.scene_leaf import SceneLeaf
from saltus.scene_files.state_machine import SceneMachine
from saltus.system import System

__all__ = ["entry_named", "leaf_of_block", "states_named"]

STATE = re.compile(r"state x\[(\d+)\] of block '([^']+)'")
RATE = re.compile(r"block '([^']+)'(.*?)xdot\[(\d+)\] = (\S+) where x = \[([^\]]*)\]")


def entry_named(system: System, tree: dict[str, Any], name: str) -> str:
    """The name in a context of a value: `ctl.z[1]` of the discrete state `ctl.I`; other names stay.

    ModelError for a parameter of which a new value would be half applied: it is in expressions, and
    in a start, a period or another number that was computed when the system was made.
    """
    path, leaf = _leaf_of(system, name)
    if not isinstance(leaf, (SceneLeaf, SceneMachine)):
        return name
    own = name.rpartition(".")[2]
    if own in leaf.structural:
        raise ModelError(
            f"'{name}' is in equations and in {leaf.structural[own]}, which a block has from its "
            f"start; a new value would reach the equations alone; {_remedy(tree, path, own)}"
        )
    if own in leaf.held:
        before = name.rpartition(".")[0]
        return ".".join([*([before] if before else []), f"z[{leaf.held[own]}]"])
    return name


def _leaf_of(system: System, name: str) -> tuple[list[str], System | None]:
    """The path of the block that has a value, and the block; None if there is none."""
    path = name.split(".")[:-1]
    if path and path[0] == system.name and not blocks_in(system):
        return [], system  # 'ball.T' of the scene 'ball'
    for part in path:
        inside = {block.name: block for block in blocks_in(system)}
        if part not in inside:
            return path, None
        system = inside[part]
    return path, system


def _remedy(tree: dict[str, Any], path: list[str], own: str) -> str:
    if not path:
        return f"set '{own}', the parameter of the scene"
    block = tree.get("blocks", {}).get(path[0], {}) if len(path) == 1 else {}
    said = block.get(own, block.get("parameters", {}).get(own))
    if isinstance(said, str):
        names = sorted(set(re.findall(r"[A-Za-z_]\w*", said)))
        known = [f"'{n}'" for n in names if n in tree.get("parameters", {})]
        if known:
            return f"set {' or '.join(known)}, the parameter of the scene from which it is computed"
    return (
        f"lead a parameter of the scene to it, as {own} = 'NAME' in the table of the block, and "
        "set that one"
    )


def _state_named(match: re.Match[str], system: System) -> str:
    leaf = leaf_of_block(system, match[2])
    if not isinstance(leaf, SceneLeaf) or int(match[1]) >= len(leaf.states):
        return match[0]
    return f"state '{leaf.states[int(match[1])]}' of block '{match[2]}'"


def leaf_of_block(system: System, block: str) -> System | None:
    """The block that a message names by its path; None if there is none."""
    return system if block == system.name else _leaf_of(system, f"{block}.x")[1]


def states_named(message: str, system: System) -> str:
    """The message of a run that failed, with the names of states in place of their positions."""
    message = STATE.sub(lambda match: _state_named(match, system), message)
    match = RATE.search(message)
    if match is None:
        return message
    block, between, position, rate, values = match.groups()
    leaf = leaf_of_block(system, block)
    if not isinstance(leaf, SceneLeaf) or int(position) >= len(leaf.states):
        return message
    shown = ", ".join(
        f"{name} = {value}" for name, value in zip(leaf.states, values.split(", "), strict=False)
    )
    name = leaf.states[int(position)]
    said = f"block '{block}'{between}the rate of '{name}' is {rate} where {shown}"
    return message[: match.start()] + said + message[match.end() :]
