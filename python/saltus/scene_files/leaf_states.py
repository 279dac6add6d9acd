"""The states, the modes and the outputs of a leaf."""

from __future__ import annotations

from typing import Any

from saltus.scene_files.functions import list_of
from saltus.scene_files.leaf_parts import LeafParts
from saltus.scene_files.moving import NEVER
from saltus.scene_files.names import require_texts
from saltus.scene_files.wrong import Path, Wrong, placed, require_keys, table_at

__all__ = ["declare_held_outputs", "declare_modes", "declare_output", "declare_states"]

OTHER = ("x", "z", "mode")
"""names that mean something else in a context"""


def declare_states(parts: LeafParts) -> None:
    starts: list[tuple[Path, Any]] = []
    rates, units = [], []
    for name, value in parts.table.get("states", {}).items():
        path = (*parts.path, "states", name)
        value = table_at(path, value, "{ start = 1.0, rate = '-k * x' }")
        require_keys(path, value, ("start", "rate", "unit", "description"))
        require_texts(path, value)
        starts.append(((*path, "start"), value.get("start", 0.0)))
        units.append(value.get("unit", ""))
        rates.append(parts.scope.expression((*path, "rate"), value.get("rate", 0.0)))
    parts.leaf.starts, parts.leaf.state_names = starts, []
    if starts:
        inputs = parts.scope.inputs_of(rates)
        ode = parts.scope.function(list_of(rates), inputs, rates)
        parts.leaf.state_names = _state_names(parts)
        numbers = [parts.start(*each) for each in starts]
        with placed((*parts.path, "states")):
            parts.leaf.declare_continuous_state(
                numbers, ode=ode, requires_inputs=inputs, names=parts.leaf.state_names,
                units=units if any(units) else (),
            )  # fmt: skip
    _declare_held_states(parts)


def _declare_held_states(parts: LeafParts) -> None:
    path = (*parts.path, "discrete")
    held = [((*path, name), value) for name, value in parts.table.get("discrete", {}).items()]
    parts.leaf.held_starts = held
    if held:
        values = [parts.start(*each) for each in held]
        with placed(path):
            parts.leaf.declare_discrete_state(values)


def _state_names(parts: LeafParts) -> list[str]:
    """The names of the states, which are outputs and values of a context; none if a state cannot
    have its name there, or if the file has another output with the name of a state.
    """
    outputs = parts.table.get("outputs", {})
    names = list(parts.table["states"])
    free = all(name not in OTHER and outputs.get(name, name) == name for name in names)
    return names if free else []


def declare_modes(parts: LeafParts) -> None:
    if "mode" not in parts.table and not parts.scope.modes:
        return
    path = (*parts.path, "mode")
    if not parts.scope.modes:
        raise Wrong(path, "expected a list of 'modes' beside the mode at the start")
    start = parts.mode(path, parts.table.get("mode", parts.scope.modes[0]))
    parts.leaf.declare_default_mode(start, names=parts.scope.modes)


def declare_output(parts: LeafParts, path: Path, name: str, value: Any) -> None:
    if name in parts.leaf.output_names:
        return  # a state that shows itself
    many = isinstance(value, list)
    texts = [((*path, i), text) for i, text in enumerate(value)] if many else [(path, value)]
    made = [parts.scope.expression(place, text) for place, text in texts]
    inputs = parts.scope.inputs_of(made)
    moved = [parts.scope.motion_of(each) for each in made]
    parts.motions[name] = frozenset.intersection(*moved) if moved else NEVER
    parts.leaf.declare_output_port(
        parts.scope.function(list_of(made) if many else made[0].tree, inputs, made),
        name=name,
        requires_inputs=inputs,
        shape=len(made) if many else (),
        boolean=not many and made[0].boolean,
        reads=parts.scope.rates_of(made),
    )


def declare_held_outputs(parts: LeafParts) -> None:
    """The outputs that show a discrete state, the mode, and whether it is that of a name, for
    whoever records them. An output of the file with such a name stays what it is.
    """
    shown = set(parts.leaf.output_names)
    held = [(name, name, "discrete_state", False) for name in parts.scope.discrete]
    held += [(name, f"mode == {name}", "mode", True) for name in parts.scope.modes]
    for name, text, read, truth in held:
        if name not in shown:
            made = parts.scope.expression((*parts.path, name), text)
            parts.leaf.declare_output_port(
                parts.scope.function(made.tree, (), [made]),
                name=name,
                requires_inputs=(),
                shape=(),
                boolean=truth,
                reads=[read],
            )
    if parts.scope.modes and "mode" not in shown:
        parts.leaf.declare_mode_output("mode")
    parts.leaf.held_outputs = tuple(n for n in parts.leaf.output_names if n not in shown)
