"""A system as the text of a tree."""

from __future__ import annotations

from saltus._signals import blocks_in
from saltus.system import System

__all__ = ["tree_of"]


def tree_of(system: System) -> list[str]:
    """A line for the system, with its class and its ports, then the lines of its blocks."""
    inputs, outputs = ", ".join(system.input_names), ", ".join(system.output_names)
    own = f"{system.name}  {type(system).__name__}  ({inputs}) -> ({outputs})"
    return [own, *("    " + line for block in blocks_in(system) for line in tree_of(block))]
