"""A system of a table: a leaf or a diagram, with the systems that are defined in it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

from saltus._core import known_names
from saltus.diagram import DiagramBuilder
from saltus.errors import ModelError
from saltus.scene_files.event_wires import EVENT_KEYS, add_event_wires, export_events
from saltus.scene_files.functions import value_of
from saltus.scene_files.leaf import LEAF_KEYS, leaf_of
from saltus.scene_files.library_block import SUBSYSTEMS, library_block
from saltus.scene_files.names import (
    named_path,
    require_part_name,
    require_texts,
    require_word,
    text_at,
)
from saltus.scene_files.wires import wires_of
from saltus.scene_files.wiring import DiagramPart, Part, part_of
from saltus.scene_files.wrong import Path, Wrong, found, placed, require_keys, table_at
from saltus.system import System

__all__ = ["SYSTEM_KEYS", "Systems", "parameters_of", "system_of_table", "systems_in"]

DIAGRAM_KEYS = ("blocks", "wires", "inputs", "outputs", *EVENT_KEYS)
SHARED_KEYS = ("description", "parameters", "systems")
SYSTEM_KEYS = tuple(dict.fromkeys((*SHARED_KEYS, *DIAGRAM_KEYS, *LEAF_KEYS)))
MOST_BLOCKS = 100_000
MOST_LEVELS = 64
BLOCK = "{ block = 'Gain', gain = 2.0 }"


@dataclass
class Count:
    """The number of blocks that were made, which nested systems multiply, and their diagrams."""

    blocks: int = 0
    parts: dict[int, Part] = field(default_factory=dict)
    """the diagrams that were made, by the numbers of their systems"""

    def one_more(self, path: Path) -> None:
        self.blocks += 1
        if self.blocks > MOST_BLOCKS:
            raise Wrong(
                path,
                f"expected at most {MOST_BLOCKS} blocks, with those of nested systems; a larger "
                "scene is better made in Python, of vectors",
            )


Systems = dict[str, tuple[Path, dict[str, Any], Any]]
"""name -> path and table of a definition, and the definitions that its own blocks may use"""


@dataclass(frozen=True)
class Place:
    """The place where a system is defined: its path, and the systems that its blocks may use."""

    path: Path
    systems: Systems
    """the definitions that are known here"""
    inside: tuple[str, ...]
    """the definitions that are being made, from the outermost on"""
    count: Count


def parameters_of(path: Path, table: dict[str, Any], given: dict[str, Any]) -> dict[str, Any]:
    """The values of the parameters of a table: the given values, and its own, which may be
    expressions of earlier parameters.
    """
    path = (*path, "parameters")
    own = table_at(path, table.get("parameters", {}), "{ g = 9.81 }")
    values: dict[str, Any] = {}
    for name, value in own.items():
        require_word((*path, name), name, {}, "parameter")
        if isinstance(value, dict):
            require_keys((*path, name), value, ("value", "unit", "description"), ("value",))
            require_texts((*path, name), value)
            value = value["value"]
        value = given.get(name, value)
        if isinstance(value, bool):
            raise Wrong((*path, name), f"expected a number, found {found(value)}")
        values[name] = value_of((*path, name), value, values)
    return values


def system_of_table(
    table: dict[str, Any], name: str, values: dict[str, Any], place: Place | None = None
) -> System:
    """The system of a table whose parameters have these values. Wrong for a mistake in it."""
    place = place or Place((), {}, (), Count())
    if "blocks" not in table:
        for key in ("wires", "systems", "event_wires", "event_outputs"):
            if key in table:
                raise Wrong((*place.path, key), f"'{key}' of a scene without 'blocks'; write these")
        place.count.one_more(place.path)
        return leaf_of(place.path, table, name, values)
    for key in table:
        if key in LEAF_KEYS and key not in DIAGRAM_KEYS:
            raise Wrong(
                (*place.path, key),
                f"a diagram has no '{key}'; define a system with it, and a block of that system",
            )
    return _diagram(table, name, values, _with_systems(place, table))


def _with_systems(place: Place, table: dict[str, Any]) -> Place:
    path = (*place.path, "systems")
    own = table_at(path, table.get("systems", {}), "{ wheel = { states = ... } }")
    for name, inner in own.items():
        require_part_name((*path, name), name, "system")
        inner = table_at((*path, name), inner, "{ states = ... }")
        require_keys((*path, name), inner, SYSTEM_KEYS)
        require_texts((*path, name), {k: v for k, v in inner.items() if k == "description"})
    return replace(place, systems=systems_in(place.systems, place.path, table))


def systems_in(known: Systems, path: Path, table: dict[str, Any]) -> Systems:
    """The systems that blocks of a table may use: those known around it, and its own."""
    inside = dict(known)
    for name, inner in table.get("systems", {}).items():
        inside[name] = ((*path, "systems", name), inner, inside)
    return inside


def _diagram(table: dict[str, Any], name: str, values: dict[str, Any], place: Place) -> System:
    path = (*place.path, "blocks")
    blocks = table_at(path, table["blocks"], f"{{ name = {BLOCK} }}")
    if not blocks:
        raise Wrong(path, f"expected blocks, such as gain = {BLOCK}")
    builder = DiagramBuilder()
    made: dict[str, System] = {}
    for key, block in blocks.items():
        require_part_name((*path, key), key, "block")
        made[key] = _block((*path, key), table_at((*path, key), block, BLOCK), key, values, place)
        with placed((*path, key)):
            builder.add(made[key])
    sources: dict[str, str] = {}
    for at, source, destination in wires_of((*place.path, "wires"), table.get("wires", []), made):
        with placed(at):
            builder.connect(source, destination)
        sources[destination] = source
    wires = table.get("event_wires", [])
    add_event_wires((*place.path, "event_wires"), wires, made, values, builder)
    export_events(place.path, table, made, builder)
    ends: dict[str, dict[str, str]] = {"inputs": {}, "outputs": {}}
    for what, export in (("inputs", builder.export_input), ("outputs", builder.export_output)):
        at = (*place.path, what)
        for key, port in table_at(at, table.get(what, {}), "{ y = 'plant.y' }").items():
            require_part_name((*at, key), key, "port")
            text = text_at((*at, key), port, "plant.y")
            with placed((*at, key)):
                port = named_path((*at, key), text, made, what)
                export(port, key)
            ends[what][key] = port
    try:
        built = builder.build(name)
    except ModelError as error:
        raise Wrong(_named_in(str(error), path, made), str(error)) from None
    known = place.count.parts
    parts = {key: known.get(b.system_id) or part_of(b, blocks[key]) for key, b in made.items()}
    inputs = {port: key for key, port in ends["inputs"].items()}
    known[built.system_id] = DiagramPart(parts, sources, inputs, ends["outputs"])
    return built


def _named_in(message: str, path: Path, blocks: dict[str, System]) -> Path:
    """The path of the block that a message names."""
    named = next((n for n in message.split("'")[1::2] if n in blocks), None)
    return path if named is None else (*path, named)


def _block(
    path: Path, table: dict[str, Any], name: str, values: dict[str, Any], place: Place
) -> System:
    if table.get("block") in SUBSYSTEMS:
        return _subsystem(path, table, name, values, place)
    if ("block" in table) == ("system" in table):
        raise Wrong(
            path,
            "expected either 'block', the name of a block of the library, or 'system', that of a "
            f"system of this scene, found {', '.join(table) or 'no key'}",
        )
    if "block" in table:
        place.count.one_more(path)
        return library_block(path, table, name, values)
    wanted = text_at((*path, "system"), table["system"], "wheel")
    if wanted not in place.systems:
        known = known_names(wanted, sorted(place.systems)) if place.systems else "; none is defined"
        raise Wrong((*path, "system"), f"unknown system '{wanted}'{known}")
    return _instance(path, table, name, values, place, wanted)


def _subsystem(
    path: Path, table: dict[str, Any], name: str, values: dict[str, Any], place: Place
) -> System:
    """A system of this scene, with parameters of its own, that a control signal executes."""
    if "system" not in table:
        raise Wrong(path, f"{table['block']} needs 'system', the name of a system of this scene")
    at = (*path, "parameters")
    given = table_at(at, table.get("parameters", {}), "{ g = 9.81 }")
    inner = {"system": table["system"], **given}
    part = _block(path, inner, text_at((*path, "system"), table["system"], "wheel"), values, place)
    own = {key: value for key, value in table.items() if key not in ("system", "parameters")}
    place.count.one_more(path)
    return library_block(path, own, name, values, {"system": part})


def _instance(
    path: Path, table: dict[str, Any], name: str, values: dict[str, Any], place: Place, wanted: str
) -> System:
    """A system made of a definition, with parameters of its own."""
    at, inner, home = place.systems[wanted]
    label = ".".join(map(str, at))
    if label in place.inside:
        raise Wrong((*path, "system"), f"system '{wanted}' contains itself")
    if len(place.inside) >= MOST_LEVELS:
        raise Wrong((*path, "system"), f"expected at most {MOST_LEVELS} nested systems")
    own = table_at((*at, "parameters"), inner.get("parameters", {}), "{ g = 9.81 }")
    given = {}
    for key, value in table.items():
        if key == "system":
            continue
        if key not in own:
            known = known_names(key, list(own)) if own else "; it has none"
            raise Wrong((*path, key), f"system '{wanted}' has no parameter '{key}'{known}")
        given[key] = value_of((*path, key), value, values)
    there = replace(place, path=at, systems=home, inside=(*place.inside, label))
    return system_of_table(inner, name, parameters_of(at, inner, given), there)
