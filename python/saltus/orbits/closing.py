"""`Closing`: the equations whose solution is a periodic orbit.

Each kind of orbit has a class of its own: `Section` (the return to a guard), `FreePeriod` (a smooth
autonomous system) and `FixedPeriod` (a driven one).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from saltus import _core
from saltus.orbits.arc import Arc, derivatives_of, refuse_gap
from saltus.orbits.runs import Runs
from saltus.orbits.states import States
from saltus.results import Results

__all__ = ["Closing"]

ELSEWHERE = 0.381966
"""part of the period by which a check shifts the time: no simple fraction of a drive's"""


class Closing:
    """F(u) = P(s) - s for the unknowns u, which are the active states of s, and more in some kinds.

    All states are active but for labels. These are discrete states that are whole numbers at both
    ends and do not depend on the active ones, such as a count or a side, and those that nothing
    reads or writes.

    Discrete states that keep the time of an event (`stamps`) are relative to the time: s = z - t,
    with s' = -1 between events. In these coordinates an autonomous system stays one.
    """

    autonomous = True

    def __init__(self, runs: Runs, context: _core.Context):
        self.runs, self.base = runs, context
        self.states = States(context)
        self.stamps = np.zeros(len(self.states), dtype=bool)
        self.values = self.of(context)
        self.labels = np.zeros(len(self.states), dtype=bool)

    @property
    def active(self) -> np.ndarray:
        """(m,) the indices of the active states."""
        return np.flatnonzero(~self.labels)

    @property
    def names(self) -> list[str]:
        """The names of the states s: 'm.z[0] - t' for one that keeps a time."""
        known = zip(self.states.names, self.stamps, strict=True)
        return [f"{name} - t" if stamp else name for name, stamp in known]

    @property
    def unknowns(self) -> np.ndarray:
        """The unknowns of the present start."""
        return np.asarray(self.values[self.active])

    def start(self, unknowns: np.ndarray) -> _core.Context:
        """The context with the unknowns as its active states."""
        values = self.values.copy()
        values[self.active] = unknowns[: len(self.active)]
        return self.put(self.base, values)

    def of(self, context: _core.Context) -> np.ndarray:
        """(n,) the states s of a context."""
        return np.asarray(self.states.of(context) - self.stamps * context.time)

    def put(self, context: _core.Context, values: np.ndarray) -> _core.Context:
        """The context with the states s."""
        return self.states.put(context, values + self.stamps * context.time)

    def flow(self, context: _core.Context) -> np.ndarray:
        """(n,) ds/dt."""
        return self.runs.flow(context) - self.stamps

    def take_stamps(self, stamps: np.ndarray) -> None:
        """Makes the values relative to the time where they keep one."""
        self.values = self.values + (1.0 * self.stamps - stamps) * self.base.time
        self.stamps = stamps

    def at(self, unknowns: np.ndarray, parameters: Sequence[str] = ()) -> Arc:
        """The run from these unknowns to its return, with its derivatives."""
        return self.arc(self.start(unknowns), unknowns, parameters)

    def arc(
        self, start: _core.Context, unknowns: np.ndarray, parameters: Sequence[str] = ()
    ) -> Arc:
        raise NotImplementedError

    def residual(self, arc: Arc) -> np.ndarray:
        """F at the start of the arc."""
        return np.asarray((arc.end - arc.start)[self.active])

    def matrix(self, arc: Arc) -> np.ndarray:
        """The derivatives of F by the unknowns."""
        square = np.ix_(self.active, self.active)
        return np.asarray(arc.by_start[square] - np.eye(len(self.active)))

    def scale(self, arc: Arc) -> np.ndarray:
        """The size of each unknown on the orbit: its value and the way it moves in a period."""
        return np.asarray(self.sizes(arc)[self.active])

    def sizes(self, arc: Arc) -> np.ndarray:
        """(n,) the same for all states."""
        way = np.abs(arc.flow_start) * arc.period / (2.0 * np.pi)
        return np.asarray(np.maximum(np.abs(arc.start), np.abs(arc.end)) + way)

    def implicit(self, arc: Arc) -> tuple[np.ndarray, np.ndarray]:
        """(n, p) and (p,): the derivatives of the start and of the period by parameters.

        The implicit function theorem: F_u du/dp + F_p = 0.
        """
        by = np.linalg.solve(self.matrix(arc), -arc.by_parameters[self.active])
        start = np.zeros((len(self.states), by.shape[1]))
        start[self.active] = by
        return start, arc.period_by_start[self.active] @ by + arc.period_by_parameters

    def again(self, arc: Arc, stamps: np.ndarray | None = None) -> Arc:
        """The same start at another time, at which an autonomous system does the same. The states
        `stamps`, by default those of the closing, move with the time.
        """
        shift = ELSEWHERE * arc.period
        return self.elsewhere(arc, arc.begin.with_time(arc.begin.time + shift), stamps)

    def elsewhere(self, arc: Arc, context: _core.Context, stamps: np.ndarray | None) -> Arc:
        """The start of the arc at the time of a context, and with its modes."""
        by = (self.stamps if stamps is None else stamps) * (context.time - arc.begin.time)
        start = self.states.put(context, self.states.of(arc.begin) + by)
        return self.arc(start, np.append(arc.start[self.active], arc.period))

    def move_to_end(self, arc: Arc) -> None:
        """Begins anew at the end of the arc, with its modes and labels."""
        self.base, self.values = arc.final, arc.end.copy()

    def take_labels(self, arc: Arc, untouched: bool = True) -> None:
        """Finds the labels among the discrete states, with or without those that nothing writes."""
        whole = (arc.start % 1.0 == 0.0) & (arc.end % 1.0 == 0.0)
        whole[: len(self.states.continuous)] = False
        self.labels = whole & ~np.any(arc.by_start[:, ~whole] != 0.0, axis=1)
        if untouched:
            self.labels |= self._untouched(arc)

    def _untouched(self, arc: Arc) -> np.ndarray:
        """(n,) the discrete states that keep their value, and on which nothing else depends."""
        own = np.eye(len(self.states))
        alone = np.all(arc.by_start == own, axis=0) & np.all(arc.by_start == own, axis=1)
        alone[: len(self.states.continuous)] = False
        return np.asarray(alone & (arc.start == arc.end))

    def made(
        self,
        start: _core.Context,
        results: Results,
        period: float,
        moved: float,
        times: np.ndarray | None,
        parameters: Sequence[str],
    ) -> Arc:
        """The arc of a run whose return is `moved` seconds after its end; `times` are the
        derivatives of the time of return, None where it is fixed.
        """
        known = results.sensitivities.parameters
        n, names = len(self.states), known[len(self.states) :]
        by = derivatives_of(results)
        times = np.zeros(len(known)) if times is None else times
        self._require(results, by, times)
        flow = self.flow(results.context)
        total = by + np.outer(flow, times)
        return Arc(
            start=self.of(start),
            end=self.of(results.context) + moved * flow,
            period=period,
            monodromy=by[:, :n],
            by_start=total[:, :n],
            by_parameters=total[:, n:],
            period_by_start=times[:n],
            period_by_parameters=times[n:],
            flow_start=self.flow(start),
            flow_end=flow,
            begin=start,
            final=results.context,
            parameters=tuple(names),
            results=results,
        )

    def _require(self, results: Results, by: np.ndarray, times: np.ndarray) -> None:
        """Refuses a gap, but for derivatives by labels, which nobody reads."""
        names = np.array(results.sensitivities.parameters)
        read = np.ones(len(names), dtype=bool)
        first, n = len(self.states.continuous), len(self.states)
        read[first:n] = ~np.isfinite(self.values[first:]) | (self.values[first:] % 1.0 != 0.0)
        refuse_gap(
            self.runs.where, results, list(names[read]), np.vstack([by, times[None]])[:, read]
        )
