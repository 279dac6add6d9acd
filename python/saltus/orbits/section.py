"""`Section`: the equations of the return to a guard."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from saltus import _core
from saltus.errors import SimulationError
from saltus.orbits.arc import Arc, derivatives_of, refuse_gap
from saltus.orbits.closing import Closing
from saltus.orbits.runs import Runs

__all__ = ["Section"]

DELAY = 1e-6
"""part of the period between the firing and the start: far more than the error of the time of a
firing, so that a run to the start has seen it, and far less than the scale of the flow
"""
MOST_DELAY = 1e-2


class Section(Closing):
    """P(s) is the state a short delay after the n-th firing of the guard.

    With the delay d the start is clear of the guard, and P is defined beside the section too: P' =
    S + f dtau/ds, with S the derivatives at the fixed time tau + d. Along f, P' is 0; its other
    eigenvalues are those of the map of the section, x+ to x+, for each d.
    """

    def __init__(
        self, runs: Runs, context: _core.Context, section: str, firings: int, longest: float
    ):
        self.section, self.firings, self.longest = section, firings, longest
        log = runs.firings(context, section, 1 + firings, longest, beyond=2.0 * MOST_DELAY)
        times = log.times(section)
        first, last = float(times[0]), float(times[firings])
        after = [e.time for e in log if e.time > first]
        self.most = 0.5 * min((*after, last)) - 0.5 * first
        self.delay = min(DELAY * (last - first), self.most)
        super().__init__(runs, self._after(runs, context, first))

    def _after(self, runs: Runs, context: _core.Context, first: float) -> _core.Context:
        """The values a delay after the first firing."""
        while True:
            results = runs.plain(context, first + self.delay)
            if len(results.events.times(self.section)):
                return results.context
            self._wait_longer(first)

    def _wait_longer(self, time: float) -> None:
        """A run to just after a firing did not see it: its steps, and their errors, are others."""
        if self.delay >= self.most:
            raise SimulationError(
                f"{self.runs.where}: t = {time} s: the time of the section '{self.section}' "
                f"differs by more than {self.delay} s between two runs; give a smaller "
                "rtol and atol",
                time,
            )
        self.delay = min(10.0 * self.delay, self.most)

    def arc(
        self, start: _core.Context, unknowns: np.ndarray, parameters: Sequence[str] = ()
    ) -> Arc:
        names = [*self.states.names, *parameters]
        log = self.runs.firings(start, self.section, self.firings, self.longest)
        guess = float(log.times(self.section)[self.firings - 1])
        while True:
            results = self.runs.derived(start, guess + self.delay, names)
            times = results.events.times(self.section)
            if len(times) >= self.firings:
                break
            self._wait_longer(guess)
        tau = float(times[self.firings - 1])
        by = results.events.dt_dp(self.section)[self.firings - 1]
        period = tau + self.delay - start.time
        return self.made(start, results, period, tau - guess, by, parameters)

    def on_section(self, arc: Arc) -> _core.Context:
        """The values x+ just after the firing, at the end of an arc."""
        results = self.runs.plain(arc.begin, arc.results.context.time, dense_output=True)
        tau = float(results.events.times(self.section)[self.firings - 1])
        state = results(tau, side="right").continuous_state
        return results.context.with_time(tau).with_continuous_state(state)

    def to_section(self, plus: _core.Context, arc: Arc, by: np.ndarray) -> np.ndarray:
        """(n, p) the derivatives of x+ from those a delay after it: s = phi(x+, p), so ds =
        phi_x dx+ + phi_p.
        """
        n = len(self.states)
        names = [*self.states.names, *arc.parameters]
        results = self.runs.derived(plus, plus.time + self.delay, names)
        along, active = derivatives_of(results), self.active
        used = np.ix_(active, [*active, *range(n, len(names))])
        refuse_gap(self.runs.where, results, [names[i] for i in used[1][0]], along[used])
        out = np.zeros_like(by)
        square = along[np.ix_(active, active)]
        out[active] = np.linalg.solve(square, by[active] - along[active, n:])
        return out
