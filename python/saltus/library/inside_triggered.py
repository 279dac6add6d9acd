"""`refuse_edges`: what cannot be inside a `TriggeredSubsystem`, because it follows edges itself."""

from __future__ import annotations

from collections.abc import Iterator

from saltus.errors import BlockParameterError
from saltus.system import System

__all__ = ["edges_missed_by", "refuse_edges"]


def refuse_edges(name: str, system: System) -> None:
    """BlockParameterError for a subsystem inside the system that would miss its own edges.

    Parameters
    ----------
    name
        That of the `TriggeredSubsystem`.
    system
        What it executes. A part of it says in `_missed_edges` what it does at edges, and how to do
        without.
    """
    for path, part in _parts(system.name, system):
        if missed := getattr(part, "_missed_edges", ""):
            raise BlockParameterError(
                f"block '{name}.{path}': a TriggeredSubsystem executes its blocks at its triggers "
                f"only, and they see no edges of other signals; {missed}"
            )


def edges_missed_by(system: System, states: str, outputs: str) -> str:
    """What an `EnabledSubsystem` of a system would miss inside a triggered one, and the remedy."""
    if outputs != "reset" and system.output_names:
        return (
            "so it cannot hold its outputs when it is disabled: give outputs='reset', and hold a "
            "value by an IfThenElse, whose false branch is a UnitDelay(dt=-1) of its own output"
        )
    if states != "held" and _has_states(system):
        return "so it cannot reset its states when it is enabled: give states='held'"
    return ""


def _has_states(system: System) -> bool:
    context = system.create_context()
    return bool(context.num_continuous_states + context.num_discrete_states)


def _parts(path: str, system: System) -> Iterator[tuple[str, System]]:
    """The system and all parts of it, with their paths."""
    yield path, system
    for block in getattr(system, "blocks", ()):
        yield from _parts(f"{path}.{block.name}", block)
