"""`FreePeriod`: the equations of a smooth autonomous system, with its period among the unknowns."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from saltus import _core
from saltus.errors import SimulationError
from saltus.orbits.arc import Arc
from saltus.orbits.closing import Closing
from saltus.orbits.runs import Runs

__all__ = ["FreePeriod"]

RANGE = 4.0
"""a Newton step may change the first guess of the period by this factor, not more: towards zero all
states return
"""


class FreePeriod(Closing):
    """P(s) is the state after the time T, which is an unknown; the phase condition is f(s).ds = 0
    for a Newton step ds. The bordered matrix is regular although P'(s) has the eigenvalue 1 along f
    (E. Doedel, H. Keller, J. Kernevez, Int. J. Bifurcation and Chaos 1 (1991) 745, section 2).
    """

    def __init__(self, runs: Runs, context: _core.Context, guess: float):
        super().__init__(runs, context)
        self.guess = guess

    @property
    def unknowns(self) -> np.ndarray:
        return np.append(super().unknowns, self.guess)

    def arc(
        self, start: _core.Context, unknowns: np.ndarray, parameters: Sequence[str] = ()
    ) -> Arc:
        period = float(unknowns[-1])
        if not self.guess / RANGE < period < self.guess * RANGE:
            raise SimulationError(
                f"{self.runs.where}: the period went from the first guess of {self.guess} s to "
                f"{period} s",
                start.time,
            )
        names = [*self.states.names, *parameters]
        results = self.runs.derived(start, start.time + period, names)
        return self.made(start, results, period, 0.0, None, parameters)

    def residual(self, arc: Arc) -> np.ndarray:
        return np.append(super().residual(arc), 0.0)

    def matrix(self, arc: Arc) -> np.ndarray:
        flow, sizes = arc.flow_start[self.active], self.sizes(arc)[self.active]
        # the phase condition in units of the sizes, so that no state decides by its unit alone
        phase = np.divide(flow, sizes**2, out=np.zeros_like(flow), where=sizes > 0.0)
        phase /= np.linalg.norm(phase) or 1.0
        border = arc.flow_end[self.active][:, None]
        return np.block([[super().matrix(arc), border], [phase[None], np.zeros((1, 1))]])

    def scale(self, arc: Arc) -> np.ndarray:
        return np.append(super().scale(arc), arc.period)

    def implicit(self, arc: Arc) -> tuple[np.ndarray, np.ndarray]:
        count = arc.by_parameters.shape[1]
        right = np.vstack([arc.by_parameters[self.active], np.zeros((1, count))])
        by = np.linalg.solve(self.matrix(arc), -right)
        start = np.zeros((len(self.states), count))
        start[self.active] = by[:-1]
        return start, by[-1]

    def move_to_end(self, arc: Arc) -> None:
        super().move_to_end(arc)
        self.guess = arc.period
