"""`Writes`: what one callback may write."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from types import CellType
from typing import Any

from saltus.tracing.effects.looks import Looks
from saltus.tracing.effects.reach import Reach

__all__ = ["Writes", "writes_of"]


@dataclass(frozen=True)
class Writes:
    """The places that a callback may write."""

    binds: frozenset[str]
    """attributes and global variables, by name"""
    cells: dict[int, CellType]
    """variables of functions around it, by their identity"""
    touched: dict[int, Any]
    """lists, dictionaries, sets and owners of arrays whose entries it may change"""
    unknown: str
    """the reason why it may write everything else; or nothing"""
    looks: Looks
    """objects at which the search has looked"""

    @property
    def any(self) -> bool:
        """Whether it may write anything."""
        return bool(self.unknown or self.binds or self.cells or self.touched)


def writes_of(roots: Iterable[Any]) -> Writes:
    """The objects that the functions and objects in `roots` may write when they are called."""
    reach = Reach(roots)
    touched = reach.touched if reach.mutates or reach.unknown else {}
    return Writes(frozenset(reach.binds), reach.cells, touched, reach.unknown, reach.looks)
