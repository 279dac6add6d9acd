"""The values of one system that follow from parameters of its scene.

A sweep over a parameter of a scene need not make the system anew for each run where the parameter
reaches only values of a context: parameters of blocks in the equations, and starts of states. The
tables are walked once for the names that vary. Whatever else such a name reaches, as a period or
the weight of an event wire, is `Structural`: then each run has a system of its own. The values come
from the functions with which the system was made, and so do the errors.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from saltus.scene_files.evaluation import evaluated
from saltus.scene_files.functions import number_of, value_of
from saltus.scene_files.library_block import SUBSYSTEMS, library_block
from saltus.scene_files.scene_leaf import SceneLeaf
from saltus.scene_files.state_machine import SceneMachine
from saltus.scene_files.systems import Systems, parameters_of, systems_in
from saltus.scene_files.wrong import Path
from saltus.system import System

__all__ = ["Followed", "Structural", "followed", "names_in"]

WORD = re.compile(r"(?<![\w.])[A-Za-z_]\w*")
Values = dict[str, Any]
"""the parameters of a system, by name"""


class Structural(Exception):
    """A name that varies reaches more than values of a context."""


@dataclass
class Followed:
    """A system of the scene: its values that follow, and those of the systems in it."""

    prefix: str
    """the path of the system in a context, with a dot behind it"""
    leaf: SceneLeaf | SceneMachine | None = None
    moved: frozenset[str] = frozenset()
    """its parameters that vary"""
    blocks: list[tuple[Path, dict[str, Any], str]] = field(default_factory=list)
    """the blocks of the library whose arguments vary: path, table and name"""
    inner: list[tuple[_Instance, Followed]] = field(default_factory=list)

    def entries(self, values: Values) -> Iterator[tuple[str, Any]]:
        """The names and values of a context for these parameters. Wrong as where it was made."""
        if isinstance(self.leaf, SceneLeaf):
            yield from self._of_leaf(self.leaf, values)
        elif self.leaf is not None:
            yield from self._parameters(self.leaf.read, values)
        for path, table, name in self.blocks:
            context = library_block(path, table, name, values).create_context()
            for own, value in context.parameters.items():
                yield f"{self.prefix}{name}.{own}", value
            for own, state in (("x", context.continuous_state), ("z", context.discrete_state)):
                if len(state):
                    yield f"{self.prefix}{name}.{own}", state
        for instance, each in self.inner:
            yield from each.entries(instance.values(values))

    def _of_leaf(self, leaf: SceneLeaf, values: Values) -> Iterator[tuple[str, Any]]:
        for path, text, made in leaf.expressions:
            if made.names & self.moved:  # its parts that are made of parameters alone
                evaluated(path, text, made.tree, values, whole=False)
        yield from self._parameters(leaf.read, values)
        names = leaf.state_names or [f"x[{i}]" for i in range(len(leaf.starts))]
        starts = list(zip(names, leaf.starts, strict=True))
        starts += [(f"z[{i}]", start) for i, start in enumerate(leaf.held_starts)]
        for own, (path, text) in starts:
            if names_in(text) & self.moved:
                yield self.prefix + own, number_of(path, text, values)

    def _parameters(self, read: frozenset[str], values: Values) -> Iterator[tuple[str, Any]]:
        for name in sorted(read & self.moved):
            yield self.prefix + name, values[name]


@dataclass(frozen=True)
class _Instance:
    """A block that is a system of the scene: the table of the system, and what the block gives."""

    path: Path
    at: Path
    table: dict[str, Any]
    given: dict[str, Any]

    def values(self, outer: Values) -> Values:
        made = {key: value_of((*self.path, key), text, outer) for key, text in self.given.items()}
        return parameters_of(self.at, self.table, made)


def followed(tree: dict[str, Any], system: System, names: frozenset[str]) -> Followed:
    """The values of a scene that follow from these parameters of it. Structural if that is not all
    that they reach.
    """
    own = tree.get("parameters", {})
    return _system(tree, (), {}, system, "", _moved(own, names, frozenset()))


def _system(
    table: dict[str, Any],
    path: Path,
    known: Systems,
    system: System,
    prefix: str,
    moved: frozenset[str],
) -> Followed:
    if "blocks" not in table:
        assert isinstance(system, SceneLeaf)
        _require_dynamic(system, moved)
        return Followed(prefix, system, moved)
    if names_in(table.get("event_wires", [])) & moved:
        raise Structural
    known = systems_in(known, path, table)
    made = Followed(prefix, None, moved)
    for name, block in table["blocks"].items():
        if (
            names_in({key: text for key, text in block.items() if key not in ("block", "system")})
            & moved
        ):
            _add(made, (*path, "blocks", name), block, name, known, system, moved)
    return made


def _add(
    made: Followed,
    path: Path,
    block: dict[str, Any],
    name: str,
    known: Systems,
    system: Any,
    moved: frozenset[str],
) -> None:
    """Adds what follows in a block that reads a name that varies."""
    part, inside = system[name], f"{made.prefix}{name}."
    if "system" in block and block.get("block") not in SUBSYSTEMS:
        at, table, home = known[block["system"]]
        given = {key: text for key, text in block.items() if key != "system"}
        instance = _Instance(path, at, table, given)
        own = table.get("parameters", {})
        behind = _moved(
            own, frozenset(k for k, t in given.items() if names_in(t) & moved), given.keys()
        )
        made.inner.append((instance, _system(table, at, home, part, inside, behind)))
    elif isinstance(part, SceneMachine):
        _require_dynamic(part, moved)
        made.inner.append((_Same(), Followed(inside, part, moved)))
    else:
        known_here = part.create_context().parameters if not hasattr(part, "blocks") else {}
        arguments = [
            key for key, text in block.items() if key != "block" and names_in(text) & moved
        ]
        if not known_here.keys() >= set(arguments):
            raise Structural
        made.blocks.append((path, block, name))


class _Same(_Instance):
    """A block that reads the parameters of the system around it."""

    def __init__(self) -> None:
        super().__init__((), (), {}, {})

    def values(self, outer: Values) -> Values:
        return outer


def _require_dynamic(leaf: SceneLeaf | SceneMachine, moved: frozenset[str]) -> None:
    """Structural if a name that varies is in a number that the block has from its making on."""
    if moved & leaf.fixed:
        raise Structural


def _moved(own: Mapping[str, Any], first: frozenset[str], given: Any) -> frozenset[str]:
    """The parameters of a table that vary with the first ones: those computed from them too."""
    moved = set(first)
    for name, text in own.items():
        if name not in given and names_in(_value(text)) & moved:
            moved.add(name)
    return frozenset(moved)


def _value(parameter: Any) -> Any:
    return parameter.get("value") if isinstance(parameter, dict) else parameter


def names_in(text: Any) -> frozenset[str]:
    """The words of an expression, or of all expressions in a list or a table."""
    if isinstance(text, str):
        return frozenset(WORD.findall(text))
    parts = text.values() if isinstance(text, dict) else text if isinstance(text, list) else ()
    return frozenset().union(*map(names_in, parts))
