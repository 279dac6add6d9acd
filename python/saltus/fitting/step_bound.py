"""`StepBound`: ends a trial run that takes many more steps than the first run of a fit."""

from __future__ import annotations

from collections.abc import Callable

__all__ = ["FACTOR", "StepBound"]

POLL = 16
"""steps from one call of the option `interrupt` to the next"""
FACTOR = 100
"""steps of a trial run, in those of the first run: a fit moves within a few decades of its start"""
LEAST = 1600
"""steps that any trial run may take: those of a run that takes some milliseconds"""


class StepBound:
    """An option `interrupt` that counts: true after `FACTOR` times the steps of the first run.

    Steps are counted and not seconds, so that a fit gives the same values on any machine. The first
    run, at the start values, has no bound.
    """

    def __init__(self, interrupt: Callable[[], bool] | None):
        self._interrupt = interrupt
        self._polls = 0
        self._most: int | None = None
        self.reached = False

    def __call__(self) -> bool:
        self._polls += 1
        self.reached = self._most is not None and self._polls > self._most
        return self.reached or (self._interrupt is not None and self._interrupt())

    def begin(self) -> None:
        """A run begins."""
        self._polls, self.reached = 0, False

    def well(self) -> None:
        """The run came to its end. The first one that does sets the bound."""
        if self._most is None:
            self._most = FACTOR * max(self._polls, LEAST // POLL // FACTOR)

    @property
    def message(self) -> str:
        """What a run that was ended did."""
        return (
            f"the run was ended after {self._polls * POLL} steps, {FACTOR} times those of the first "
            "run of the fit"
        )
