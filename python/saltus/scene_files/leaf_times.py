"""The time events of a leaf, and the events that reach it by event wires."""

from __future__ import annotations

import math
from typing import Any

from saltus.scene_files.leaf_parts import LeafParts
from saltus.scene_files.leaf_scope import WEIGHT
from saltus.scene_files.names import whole_at
from saltus.scene_files.wrong import Path, Wrong, require_keys, table_at

__all__ = ["declare_event_input", "declare_update"]

UPDATE_KEYS = ("period", "offset", "at", "end", "count", "set")


def declare_update(parts: LeafParts, path: Path, name: str, value: Any) -> None:
    value = table_at(path, value, "{ period = 0.1, set = { k = 'k + 1' } }")
    require_keys(path, value, UPDATE_KEYS, ("set",))
    if not {"period", "offset", "at"} & value.keys():
        raise Wrong(path, "expected times: a 'period', an 'offset', or times 'at', in seconds")
    effect, read = parts.effect(path, value)
    callback = parts.scope.function(effect, range(len(parts.scope.inputs)), read)
    count = value.get("count")
    if count is not None:
        whole_at((*path, "count"), count)
    times = {
        key: parts.number((*path, key), value[key])
        for key in ("period", "offset", "end")
        if key in value
    }
    if times.keys() <= {"period", "offset"} and "period" in times and len(value) == len(times) + 1:
        parts.leaf.declare_periodic_update(callback, name=name, **times)
        return
    at = _times(parts, (*path, "at"), value["at"]) if "at" in value else None
    if at is not None or "end" in times:
        key = "at" if at is not None else "end"
        last = min(max(at or [math.inf]), times.get("end", math.inf))
        parts.leaf.last.append(((*path, key), last))
    parts.leaf.declare_time_event(callback, times=at, count=count, name=name, **times)


def _times(parts: LeafParts, path: Path, value: Any) -> list[float]:
    """One time, or a list of times."""
    if not isinstance(value, list):
        return [parts.number(path, value)]
    if not value:
        raise Wrong(path, "expected times [s] such as [1.0, 2.5], found an empty list")
    return [parts.number((*path, i), time) for i, time in enumerate(value)]


def declare_event_input(parts: LeafParts, path: Path, name: str, value: Any) -> None:
    value = table_at(path, value, "{ set = { v = 'v + weight' } }")
    require_keys(path, value, ("set", "size"), ("set",))
    size = whole_at((*path, "size"), value.get("size", 1))
    with parts.scope.with_delivery(path, "size" in value):
        effect, read = parts.effect(path, value)
    inputs = parts.scope.inputs_of(read)
    parts.leaf.declare_event_input(
        parts.scope.function(effect, inputs, read, (WEIGHT,)),
        name=name,
        size=size,
        requires_inputs=inputs,
    )
