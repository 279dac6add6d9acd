"""`Plans`: the plans that a system keeps, by their options."""

from __future__ import annotations

from typing import Any

from saltus import _core

__all__ = ["Key", "Plans"]

Key = tuple[Any, ...]
"""options as values that can be compared"""

MOST = 4
"""plans that a system keeps: few programs use more sets of options"""
LARGE = 1000
"""blocks; a larger plan is the only one kept, because it takes some kilobytes for each block"""


class Plans:
    """The last few plans of a system with its present traces.

    A plan keeps neither its system nor a function of the user alive. It never changes, so any
    number of runs use it at once.
    """

    def __init__(self) -> None:
        self._kept: tuple[tuple[Key, int, _core.Plan], ...] = ()

    def find(self, key: Key, version: int) -> _core.Plan | None:
        """The plan for these options and this version of the callbacks."""
        for known, made_for, plan in self._kept:
            if made_for == version and known == key:
                return plan
        return None

    def keep(self, key: Key, version: int, plan: _core.Plan) -> None:
        """Adds a plan, and drops the plans of other versions and the oldest plan.

        If another thread adds a plan at the same time, one of the plans may be lost, and is made
        again.
        """
        others = [one for one in self._kept if one[1] == version and one[0] != key]
        most = 1 if plan.blocks > LARGE else MOST
        self._kept = ((key, version, plan), *others[: most - 1])

    def clear(self) -> None:
        """Drops all plans."""
        self._kept = ()
