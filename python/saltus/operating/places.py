"""`Place`: where a name is, in a context or among the open inputs of a system."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from saltus import _core
from saltus._entries import entry_names
from saltus.errors import ModelError
from saltus.fitting.coordinates import require_entry
from saltus.system import System

__all__ = ["Place", "open_inputs", "place_of", "split_entry", "state_names"]


@dataclass(frozen=True)
class Place:
    """A number that a system reads."""

    name: str
    """as the user spells it"""
    kind: str
    """'state', 'parameter' or 'input'"""
    index: int | None = None
    """of a state in the vector of all of them, or the entry of an open input that is a vector"""


def split_entry(name: str) -> tuple[str, int | None]:
    """'u[1]' as 'u' and 1, 'u' as 'u' and None."""
    found = re.fullmatch(r"(.*)\[(\d+)\]", name)
    return (found[1], int(found[2])) if found else (name, None)


def place_of(where: str, system: System, context: _core.Context, name: str) -> Place:
    """The place of a name. ModelError for an unknown one, a mode and a discrete state."""
    ports = system.input_names
    for port, entry in ((name, None), split_entry(name)):
        if port in ports:
            return Place(name, "input", entry)
    try:
        require_entry(where, system, context, name)
    except ModelError as error:
        raise ModelError(f"{error}{open_inputs(system, name)}") from None
    kind, index = _state_at(context, name)
    if kind == "discrete_state":
        raise ModelError(
            f"{where}: '{name}' is a discrete state, which keeps its value; expected a continuous "
            "state, a parameter or an open input; set it in the context"
        )
    return Place(name, "parameter") if index is None else Place(name, "state", index)


def open_inputs(system: System, name: str) -> str:
    """The open inputs of a system, with the nearest one to a name that is unknown."""
    ports = system.input_names
    return f"; open inputs{_core.known_names(name, ports)}" if ports else ""


def state_names(context: _core.Context) -> tuple[str, ...]:
    """The names of all continuous states, in the order of the context."""
    names: dict[int, str] = {}
    for name in _core.entry_names(context):
        size = _core.find_entry(context, name)
        if size == 0 or name.rpartition(".")[2] == "mode":
            continue
        entries = entry_names(name, () if size == 1 else (size,))
        kind, first = _state_at(context, entries[0])
        if kind == "continuous_state":
            assert first is not None
            names.update({first + i: entry for i, entry in enumerate(entries)})
    return tuple(names[i] for i in range(len(context.continuous_state)))


def _state_at(context: _core.Context, name: str) -> tuple[str, int | None]:
    """Which state a name means. Two numbers written under it show this, also beside nan."""
    one, two = (_core.with_entry(context, name, np.array([value])) for value in (1.0, 2.0))
    for kind in ("continuous_state", "discrete_state"):
        at = np.flatnonzero((getattr(one, kind) == 1.0) & (getattr(two, kind) == 2.0))
        if len(at):
            return kind, int(at[0])
    return "", None
