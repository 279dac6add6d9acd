"""`Reads`: what one callback may read of the values that other callbacks write."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from saltus.tracing.effects.looks import Looks
from saltus.tracing.effects.reach import Reach
from saltus.tracing.effects.writes import Writes

__all__ = ["Reads", "reads_of"]


@dataclass(frozen=True)
class Reads:
    """The places that a called callback may read."""

    names: frozenset[str]
    """attributes and global variables"""
    cells: frozenset[int]
    """identities of variables of functions around it"""
    entries: frozenset[int]
    """identities of lists, dictionaries, sets and owners of arrays"""
    unknown: bool
    """whether it may read everything else"""
    looks: Looks
    """objects at which the search has looked"""

    def may_see(self, writes: Writes) -> bool:
        """Whether it may read something that another callback writes."""
        if self.unknown or writes.unknown:
            return writes.any
        return not (
            self.names.isdisjoint(writes.binds)
            and self.cells.isdisjoint(writes.cells)
            and self.entries.isdisjoint(writes.touched)
        )


def reads_of(roots: Iterable[object]) -> Reads:
    """The places that the functions and objects in `roots` may read when they are called."""
    reach = Reach(roots)
    found = frozenset(reach.names), frozenset(reach.variables), frozenset(reach.touched)
    return Reads(*found, bool(reach.unknown), reach.looks)
