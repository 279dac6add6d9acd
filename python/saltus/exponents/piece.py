"""`Pieces`: short runs with the derivative of the end by the start."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from saltus import _core
from saltus.errors import ModelError, SimulationError
from saltus.exponents.rest import at_rest
from saltus.orbits.arc import derivatives_of, refuse_gap
from saltus.orbits.runs import Runs
from saltus.orbits.states import States
from saltus.results import Results
from saltus.simulation import Simulator

__all__ = ["NotALabel", "Piece", "Pieces", "require_moving"]

ELSEWHERE = 0.381966
"""the part of a piece that is left where its end meets an event: no simple fraction"""
TRIES = 8
"""ends that are tried for one piece"""


class NotALabel(Exception):
    """Discrete states were taken for labels, and are none."""

    def __init__(self, states: np.ndarray):
        super().__init__(states)
        self.states = states
        """their indices"""


@dataclass(frozen=True)
class Piece:
    """A run from x to phi(x)."""

    matrix: np.ndarray
    """(m, m) d phi/dx of the active states, at a fixed time, through all events"""
    duration: float
    """[s]"""
    end: _core.Context
    has_events: bool
    rested: bool
    """whether a block came to rest in it: then nothing is left of its directions"""


class Pieces:
    """Pieces of one long run. The active states are the continuous ones and the discrete ones that
    are no labels, as counts and sides are: whole numbers that depend on no active state.
    """

    def __init__(self, runs: Runs, start: _core.Context, labels: np.ndarray):
        self.runs, self.states, self.labels = runs, States(start), labels
        self.active = np.flatnonzero(~labels)
        self.names = [self.states.names[i] for i in self.active]
        self._simulator = Simulator(
            runs.system, recorded_signals={}, sensitivity=self.names, **runs.options
        )

    def run(self, begin: _core.Context, duration: float, latest: float) -> Piece:
        """About `duration` seconds from `begin`. The piece ends elsewhere if an event is at its
        end, and later, but not after `latest`, if a block is at rest there.
        """
        for _ in range(TRIES):
            results = self._moving(begin, duration, latest)
            derivatives = derivatives_of(results)
            end = results.context
            if np.isfinite(derivatives).all() or not _ends_at_an_event(results):
                break
            duration *= ELSEWHERE
        refuse_gap(self.runs.where, results, self.names, derivatives)
        self._require_labels(derivatives, end)
        elapsed = end.time - begin.time
        rested = any(e.kind == "zeno_enter" for e in results.events)
        return Piece(derivatives[self.active], elapsed, end, len(results.events) > 0, rested)

    def _moving(self, begin: _core.Context, duration: float, latest: float) -> Results:
        """The run to the first end at which no block is at rest."""
        run, names = self._simulator.initialize(begin), self.states.continuous
        end = begin.time + duration
        while True:
            status = run.advance_to(end)
            results = run.results
            self.runs.require_reached(results, status)
            resting = at_rest(results.context, names)
            if not resting:
                return results
            if end >= latest:
                self._refuse_rest(resting, results)
            end = min(end + duration, latest)

    def _refuse_rest(self, resting: Sequence[str], results: Results) -> None:
        entered = [e for e in results.events if e.kind == "zeno_enter"]
        event = f" after '{entered[-1].block}.{entered[-1].name}'" if entered else ""
        at = results.context.time
        raise SimulationError(
            f"{self.runs.where}: t = {at} s: {', '.join(map(repr, resting))} came to rest{event} "
            "and did not move again; expected a system that goes on: a state at rest has no "
            "exponents",
            at,
            results=results,
        )

    def _require_labels(self, derivatives: np.ndarray, end: _core.Context) -> None:
        """Raises NotALabel if a label is not whole any more, or depends on an active state."""
        values = self.states.of(end)
        moved = (values % 1.0 != 0.0) | np.any(derivatives != 0.0, axis=1)
        if (wrong := np.flatnonzero(self.labels & moved)).size:
            raise NotALabel(wrong)


def require_moving(where: str, context: _core.Context, names: Sequence[str]) -> None:
    """Refuses a start at rest: the derivatives of a run take it for free."""
    if resting := at_rest(context, names):
        raise ModelError(
            f"{where}: t = {context.time} s: {', '.join(map(repr, resting))} is at rest at the "
            "start; expected a state in motion: begin elsewhere, or give another transient"
        )


def _ends_at_an_event(results: Results) -> bool:
    return any(gap.time == results.context.time for gap in results.sensitivity_gaps)
