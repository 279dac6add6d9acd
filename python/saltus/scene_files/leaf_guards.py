"""The zero crossings of a leaf: `guards`, and `edges` of its inputs."""

from __future__ import annotations

from typing import Any

from saltus.scene_files.expression import Expression
from saltus.scene_files.leaf_parts import LeafParts
from saltus.scene_files.names import chosen, truth_at, whole_at
from saltus.scene_files.vocabulary import ON_ZENO
from saltus.scene_files.wrong import Path, Wrong, require_keys, table_at

__all__ = ["GUARD_KEYS", "declare_edge", "declare_guard"]

GUARD_KEYS = (
    "guard", "direction", "from", "to", "set", "terminal", "max_count", "zeno_tolerance",
    "at_start", "on_zeno", "delay", "priority", "persistent", "initial_value",
    "use_values_from_trigger_time",
)  # fmt: skip
QUEUE_TRUTHS = ("persistent", "initial_value", "use_values_from_trigger_time")
DIRECTIONS = (
    "crosses_zero", "both", "positive_then_non_positive", "falling", "negative_then_non_negative",
    "rising", "edge_detection", "none",
)  # fmt: skip
AT_START = ("auto", "ignore", "fire", "error")


def declare_guard(parts: LeafParts, path: Path, name: str, value: Any) -> None:
    value = table_at(path, value, "{ guard = 'y', direction = 'falling' }")
    require_keys(path, value, GUARD_KEYS, ("guard",))
    waits = value.get("at_start", "auto") in ("auto", "ignore")
    waits = waits and value.get("initial_value") is not False  # else it fires at the start
    guard, doubts = parts.scope.guard((*path, "guard"), value["guard"], waits)
    parts.leaf.doubts += tuple(doubts)
    effect, read = parts.effect(path, value)
    queue = {
        key: parts.scope.expression((*path, key), value[key])
        for key in ("delay", "priority")
        if key in value
    }
    inputs = parts.scope.inputs_of([guard, *read, *queue.values()])
    direction = value.get("direction", "crosses_zero")
    parts.leaf.declare_zero_crossing(
        parts.scope.function(guard.tree, inputs, [guard]),
        None if effect is None else parts.scope.function(effect, inputs, read),
        name=name,
        direction=chosen((*path, "direction"), direction, DIRECTIONS, "direction"),
        requires_inputs=inputs,
        **{
            key: _queued(parts, (*path, key), value[key], each, inputs)
            for key, each in queue.items()
        },
        **_guard_options(parts, path, value),
    )


def _queued(parts: LeafParts, path: Path, value: Any, made: Expression, inputs: list[int]) -> Any:
    """A delay or a priority: a number, or a function."""
    if isinstance(value, str):
        return parts.scope.function(made.tree, inputs, [made])
    return parts.number(path, value)


def _guard_options(parts: LeafParts, path: Path, value: dict[str, Any]) -> dict[str, Any]:
    """The options of a zero crossing, as its declaration calls them."""
    if "to" in value and "mode" in value.get("set", {}):
        raise Wrong((*path, "to"), "the mode is set already; keep one of 'to' and 'set.mode'")
    names = ("terminal", "max_count", "at_start", "on_zeno", *QUEUE_TRUTHS)
    options: dict[str, Any] = {name: value[name] for name in names if name in value}
    for name in ("terminal", *QUEUE_TRUTHS):
        truth_at((*path, name), value.get(name, True))
    if "max_count" in value:
        whole_at((*path, "max_count"), value["max_count"])
    if "at_start" in value:
        chosen((*path, "at_start"), value["at_start"], AT_START, "choice")
    if "on_zeno" in value:
        chosen((*path, "on_zeno"), value["on_zeno"], [*ON_ZENO, *parts.scope.modes], "choice")
    if options.get("on_zeno") in parts.scope.modes:
        options["on_zeno"] = parts.mode((*path, "on_zeno"), options["on_zeno"])
    if "zeno_tolerance" in value:
        at = (*path, "zeno_tolerance")
        options["zeno_tolerance"] = parts.number(at, value["zeno_tolerance"])
    for key, option in (("from", "start_mode"), ("to", "end_mode")):
        if key in value:
            options[option] = parts.mode((*path, key), value[key])
    return options


def declare_edge(parts: LeafParts, path: Path, name: str, value: Any) -> None:
    value = table_at(path, value, "{ input = 'trigger', set = { x = 0 } }")
    require_keys(path, value, ("input", "edge", "set"), ("input", "set"))
    effect, read = parts.effect(path, value)
    inputs = parts.scope.inputs_of(read)
    names = list(parts.scope.inputs)
    parts.leaf.declare_edge_reset(
        parts.scope.function(effect, inputs, read),
        input=names.index(chosen((*path, "input"), value["input"], names, "input")),
        edge=value.get("edge", "rising"),
        name=name,
        requires_inputs=inputs,
    )
