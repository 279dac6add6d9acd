"""The event wires of a diagram, and the events that it shows to the diagram around it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from saltus.diagram import DiagramBuilder
from saltus.ports import EventInputPort, EventOutputPort
from saltus.scene_files.functions import number_of
from saltus.scene_files.names import named_path, require_part_name, text_at
from saltus.scene_files.wires import ends_of
from saltus.scene_files.wrong import Path, Wrong, found, placed, require_keys, table_at

__all__ = ["EVENT_KEYS", "add_event_wires", "export_events"]

EVENT_KEYS = ("event_wires", "event_inputs", "event_outputs")
WIRE_KEYS = ("wire", "weight", "delay")
EXAMPLE = "first.fire -> second.synapse"
TABLE = f"{{ wire = '{EXAMPLE}', weight = 0.5, delay = 0.001 }}"
ENTRY = re.compile(r"(.*)\[\s*(\d{1,6})\s*\]")


def add_event_wires(
    path: Path,
    wires: Any,
    blocks: Mapping[str, Any],
    values: Mapping[str, Any],
    builder: DiagramBuilder,
) -> None:
    """Adds the wires of a list: each a text, or a table with the weight and the delay [s] of the
    wire, which may be expressions of `values`. Wrong for a mistake in one.
    """
    if not isinstance(wires, list):
        raise Wrong(
            path,
            f"expected a list of event wires such as ['{EXAMPLE}'] or [{TABLE}], found "
            f"{found(wires)}",
        )
    for i, wire in enumerate(wires):
        at: Path = (*path, i)
        numbers: dict[str, float] = {}
        if not isinstance(wire, str):
            wire = table_at(at, wire, TABLE)
            require_keys(at, wire, WIRE_KEYS, ("wire",))
            for key in ("weight", "delay"):
                if key in wire:
                    numbers[key] = number_of((*at, key), wire[key], values)
            at, wire = (*at, "wire"), wire["wire"]
        source, ends = ends_of(at, wire, EXAMPLE)
        begin = _output(at, source, blocks)
        for end in ends:
            with placed(at):
                builder.connect_event(begin, _input(at, end, blocks), **numbers)


def export_events(
    path: Path, table: Mapping[str, Any], blocks: Mapping[str, Any], builder: DiagramBuilder
) -> None:
    """Makes events and event inputs of blocks those of the diagram, as its table says."""
    for key, text in _named((*path, "event_outputs"), table, "cell.fire"):
        at = (*path, "event_outputs", key)
        with placed(at):
            builder.export_event_output(_output(at, text, blocks), key)
    for key, text in _named((*path, "event_inputs"), table, "cell.synapse"):
        at = (*path, "event_inputs", key)
        with placed(at):
            builder.export_event_input(_input(at, text, blocks), key)


def _named(path: Path, table: Mapping[str, Any], example: str) -> list[tuple[str, str]]:
    ends = table_at(path, table.get(path[-1], {}), f"{{ name = '{example}' }}")
    for key in ends:
        require_part_name((*path, key), key, "event")
    return [(key, text_at((*path, key), text, example)) for key, text in ends.items()]


def _output(path: Path, text: str, blocks: Mapping[str, Any]) -> EventOutputPort:
    block, event, entry = _port(path, text, blocks, "event outputs")
    with placed(path):
        port: EventOutputPort = blocks[block].event_output(event, entry)
    return port


def _input(path: Path, text: str, blocks: Mapping[str, Any]) -> EventInputPort:
    block, name, entry = _port(path, text, blocks, "event inputs")
    with placed(path):
        port: EventInputPort = blocks[block].event_input(name, entry)
    return port


def _port(
    path: Path, text: str, blocks: Mapping[str, Any], what: str
) -> tuple[str, str, int | None]:
    """The block, the name and the entry of 'cells.fire[3]'; the entry is None if there is none."""
    match = ENTRY.fullmatch(text)
    named = named_path(path, text if match is None else match[1].strip(), blocks, what)
    block, _, name = named.partition(".")
    return block, name, None if match is None else int(match[2])
