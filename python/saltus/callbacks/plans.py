"""`Plans`: the plans that a system keeps, by the options they were made for."""

from __future__ import annotations

from typing import Any

from saltus import _core

__all__ = ["Key", "Plans"]

Key = tuple[Any, ...]
"""options as values that can be compared"""

MOST = 4
"""plans that a system keeps: few programs use more sets of options"""
LARGE = 1000
"""blocks; a plan of more is kept alone, for it takes some kilobytes a block"""


class Plans:
    """The last few plans that were made of the present traces of a system.

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
        """Adds a plan, and lets go of those of other versions and of the oldest one.

        Another thread that does the same may be lost: then a plan is made once more.
        """
        others = [one for one in self._kept if one[1] == version and one[0] != key]
        most = 1 if plan.blocks > LARGE else MOST
        self._kept = ((key, version, plan), *others[: most - 1])

    def clear(self) -> None:
        """Lets go of all plans."""
        self._kept = ()
