"""`FixedPeriod`: the equations of a driven system, whose drive has a known period."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.orbits.arc import Arc
from saltus.orbits.closing import Closing
from saltus.orbits.runs import Runs
from saltus.orbits.states import moved

__all__ = ["FixedPeriod"]

PART = 1e-3
"""the part of a parameter by which a check of the drive moves it"""
SAME = 1e-6
"""the part of the size of a state below which two ends are the same: far above the errors of runs
at the default tolerance, and far below PART, the change by a drive whose period has moved
"""


class FixedPeriod(Closing):
    """P(s) is the state after the period; the instant at the start has happened already."""

    autonomous = False

    def __init__(self, runs: Runs, context: _core.Context, period: float):
        super().__init__(runs, runs.plain(context, context.time).context)
        self.period = period

    def arc(
        self, start: _core.Context, unknowns: np.ndarray, parameters: Sequence[str] = ()
    ) -> Arc:
        names = [*self.states.names, *parameters]
        results = self.runs.derived(start, start.time + self.period, names)
        return self.made(start, results, self.period, 0.0, None, parameters)

    def again(self, arc: Arc, stamps: np.ndarray | None = None) -> Arc:
        """The same start one period later."""
        return self.elsewhere(arc, arc.final, stamps)

    def implicit(self, arc: Arc) -> tuple[np.ndarray, np.ndarray]:
        for name in arc.parameters:
            self._require_same_drive(arc, name)
        return super().implicit(arc)

    def _require_same_drive(self, arc: Arc, name: str) -> None:
        """Two periods from one start must have one end, also beside the value of the parameter."""
        starts = [self.put(moved(c, name, PART), arc.start) for c in (arc.begin, arc.final)]
        ends = [self.runs.plain(s, s.time + self.period).context for s in starts]
        change = np.abs(self.of(ends[1]) - self.of(ends[0]))
        square = np.ix_(self.active, self.active)
        growth = max(1.0, float(np.linalg.norm(arc.by_start[square])))
        if np.any(change[self.active] > SAME * growth * self.scale(arc)):
            raise ModelError(
                f"{self.runs.where}: '{name}' changes the period of the drive, so beside its value "
                f"there is no orbit of period {self.period} s; expected a parameter that does not: "
                "take the difference of two orbits, each with its own period"
            )
