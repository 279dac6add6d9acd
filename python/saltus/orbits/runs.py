"""The runs of one search: whole ones with their derivatives, and the firings of a guard."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NoReturn

import numpy as np

from saltus import _core
from saltus.errors import ModelError, SimulationError
from saltus.results import EventLog, Results
from saltus.simulation import Simulator, simulate
from saltus.system import System

__all__ = ["Runs"]

OWN = {
    "sensitivity",
    "dense_output",
    "save_at",
    "save_steps",
    "event_rows",
    "record_events",
    "progress",
    "throw",
}
"""options that the functions of this folder set themselves"""
GROWTH = 2.0


class Runs:
    """Runs of one system with the same options. `where` begins the messages of refusals."""

    def __init__(self, where: str, system: System, options: Mapping[str, Any]):
        for name in options:
            if name in OWN:
                raise ModelError(f"{where}: the option '{name}' is set by it; leave it out")
        if not isinstance(system, System):
            raise ModelError(f"{where}: expected a system, found {system!r}")
        self.where, self.system, self.options = where, system, dict(options)
        self._looker: Simulator | None = None
        self._span = 0.0  # [s] of the last search for firings

    def plain(self, context: _core.Context, end: float, **more: Any) -> Results:
        """A run to `end` without derivatives; refused if it ends before."""
        options = {"recorded_signals": {}, **self.options, **more}
        results = simulate(self.system, context, (context.time, end), **options)
        self.require_reached(results, results.status)
        return results

    def derived(self, context: _core.Context, end: float, names: Sequence[str]) -> Results:
        """The same with the derivatives by these start values and parameters."""
        return self.plain(context, end, sensitivity=list(names))

    def flow(self, context: _core.Context) -> np.ndarray:
        """d/dt of all states: discrete ones do not move."""
        rates = self.system.eval_time_derivatives(context)
        return np.concatenate([rates, np.zeros(context.num_discrete_states)])

    def firings(
        self, context: _core.Context, section: str, count: int, longest: float, beyond: float = 0.0
    ) -> EventLog:
        """The events of a run in which the section fired `count` times, and that went on by the
        part `beyond` of its length. The run grows until then; refused after `longest` seconds.
        """
        if self._looker is None:
            self._looker = Simulator(self.system, recorded_signals={}, **self.options)
        run, begin = self._looker.initialize(context), context.time
        span = self._span or longest * GROWTH**-16
        while True:
            span = min(span, longest)
            status = run.advance_to(begin + span)
            log = run.results.events
            times = log.times(section)
            if len(times) >= count:
                break
            if status != "reached_end":
                self._ended_early(run.results, status)
            if span >= longest:
                self._refuse_unreached(section, len(times), count, begin, longest)
            span *= GROWTH
        tau = float(times[count - 1])
        self._require_zero_crossing(log, section)
        self._span = (1.0 + 0.01) * (tau - begin) or span
        if (further := tau + beyond * (tau - begin)) > run.time and status == "reached_end":
            run.advance_to(further)
        return run.results.events

    def require_reached(self, results: Results, status: str) -> None:
        """Refuses a run that an event ended."""
        if status != "reached_end":
            self._ended_early(results, status)

    def _ended_early(self, results: Results, status: str) -> NoReturn:
        at = results.context.time
        events = results.events
        cause = f" by the event '{events[-1].block}.{events[-1].name}'" if len(events) else ""
        raise SimulationError(
            f"{self.where}: t = {at} s: the run ended{cause}, with the status '{status}'; expected "
            "a system that goes on: choose another guard, or one that does not end the run",
            at,
            events[-1].block if len(events) else "",
            results,
        )

    def _refuse_unreached(
        self, section: str, found: int, count: int, begin: float, longest: float
    ) -> NoReturn:
        raise SimulationError(
            f"{self.where}: t = {begin + longest} s: the section '{section}' has fired {found} of "
            f"{count} times since t = {begin} s; expected {count} within {longest} s: give a "
            "larger max_period, another start, or another section",
            begin + longest,
        )

    def _require_zero_crossing(self, log: EventLog, section: str) -> None:
        kinds = {e.kind for e in log if section in (e.name, f"{e.block}.{e.name}")}
        if "terminal" in kinds:
            raise ModelError(
                f"{self.where}: the section '{section}' ends the run; expected a guard "
                "that does not"
            )
        if "time" in kinds:
            raise ModelError(
                f"{self.where}: the section '{section}' is a time event; expected a guard. Give "
                "period=... for a system that a clock drives"
            )
