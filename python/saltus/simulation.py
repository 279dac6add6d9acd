"""`simulate`, and `Simulator` for a run in pieces."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from saltus import _core
from saltus.errors import ModelError, SimulationError
from saltus.ladder import climbed
from saltus.porting import OPTIONS, refuse
from saltus.results import Results
from saltus.system import OutputPort, System

__all__ = ["Results", "Simulator", "SimulatorOptions", "simulate"]


def _refuse_unknown(cls: Any) -> Any:
    """Unknown names get the nearest one, or a hint, in place of a TypeError."""
    generated = cls.__init__

    @functools.wraps(generated)
    def __init__(self: Any, **options: Any) -> None:
        refuse(cls.__name__, options, (field.name for field in fields(cls)), OPTIONS)
        generated(self, **options)

    cls.__init__ = __init__
    return cls


@_refuse_unknown
@dataclass(frozen=True, kw_only=True)
class SimulatorOptions:
    """How a run is done. `dataclasses.replace(options, rtol=1e-9)` makes a changed copy."""

    rtol: float = 1e-6
    """relative tolerance of a minor step: the root mean square over the states of error / (atol +
    rtol |x|) stays below 1
    """
    atol: float = 1e-8
    """absolute tolerance, in the unit of the states"""
    ode_solver_method: str = "auto"
    """'auto' (dopri5 or dop853 by tolerance, BDF while the scene is stiff), 'dopri5', 'dop853',
    'adams', 'bdf'; also 'rk45', 'RK45', 'DOP853', 'non-stiff', 'stiff', 'BDF'
    """
    linear_solver: str = "auto"
    """how a stiff method solves its linear systems: 'auto' (by number of states and places of the
    Jacobian), 'dense', 'band', 'sparse', 'gmres'; `statistics.linear_solver` says what was chosen
    """
    max_major_steps: int | None = None
    """instants a run may have; more end it with the status 'step_limit'"""
    max_major_step_length: float | None = math.inf
    """[s] longest time from one instant to the next"""
    min_minor_step_size: float | None = 0.0
    """[s] bounds of a solver step. Rarely of use: the tolerance chooses the step"""
    max_minor_step_size: float | None = math.inf
    zeno_tolerance: float = 1e-6
    """[s] A guard whose firings follow each other this closely, with shrinking gaps, comes to rest:
    a Zeno hold. 0 switches the monitor off
    """
    event_scan_points: int = 3
    """interior points of a step at which guards are looked at, for two crossings in one step; 0
    turns that off
    """
    max_passes: int = 100
    """passes an instant may have before it counts as a loop without end"""
    recorded_signals: Mapping[str, OutputPort] | None = None
    """what is recorded, by name; nothing recorded costs nothing"""
    save_at: Sequence[float] = ()
    """[s] increasing times to record at. If there are any, solver steps are recorded only with
    save_steps=True
    """
    save_steps: bool | None = None
    record_events: bool = True
    """the event log; switching it off changes nothing else"""
    python: str = "traced"
    """'traced' makes expressions of the Python callbacks that allow it, which run without the
    interpreter; 'called' calls them all. See `system.explain()`
    """
    throw: bool = True
    """raise when a run does not end well; else return the results with the status"""
    interrupt: Callable[[], bool] | None = None
    """asked about every 20 ms; True ends the run with the status 'interrupted'. Ctrl-C does so
    anyway
    """


PYTHON_ONLY = ("recorded_signals", "python", "throw")
"""options that the engine does not have, or not in this form"""
RUNGS = ("traced", "called")

_UNBOUNDED = {
    "max_major_step_length": math.inf,
    "min_minor_step_size": 0.0,
    "max_minor_step_size": math.inf,
}


def _ports(signals: Mapping[str, OutputPort] | None) -> list[tuple[str, System, int]]:
    if not isinstance(signals, Mapping | None):
        raise ModelError(f"recorded_signals: expected a dict of names and ports, found {signals!r}")
    for name, port in (signals or {}).items():
        if not isinstance(port, OutputPort):
            raise ModelError(
                f"recorded signal '{name}': expected a port, such as block.output_ports[0], "
                f"found {port!r}"
            )
    return [(name, port.system, port.index) for name, port in (signals or {}).items()]


def core_options(options: SimulatorOptions) -> _core.SimulatorOptions:
    core = _core.SimulatorOptions()
    for field in fields(options):
        value = getattr(options, field.name)
        if field.name in PYTHON_ONLY:
            continue
        try:
            setattr(
                core,
                field.name,
                _UNBOUNDED[field.name] if value is None and field.name in _UNBOUNDED else value,
            )
        except TypeError:
            raise ModelError(
                f"option {field.name}: expected {field.type}, found {value!r}"
            ) from None
    if not isinstance(options.throw, (bool, np.bool_)):
        raise ModelError(f"option throw: expected bool, found {options.throw!r}")
    if options.python not in RUNGS:
        found = f"'{options.python}'{_core.known_names(str(options.python), RUNGS)}"
        raise ModelError(f"option python: unknown {found}")
    core.set_recorded_signals(_ports(options.recorded_signals))
    return core


def core_context(context: object) -> _core.Context:
    if not isinstance(context, _core.Context):
        raise ModelError(f"expected a context, such as system.create_context(), found {context!r}")
    return context


class Simulator:
    """A run that can be continued: `initialize(context)`, then `advance_to(t)` as often as you
    like.

    In pieces or at once, the events are the same. One simulator serves one thread at a time; it can
    be initialized again.
    """

    def __init__(self, system: System, options: SimulatorOptions | None = None, **overrides: Any):
        if not isinstance(system, System):
            raise ModelError(f"expected a system, found {system!r}")
        options = options or SimulatorOptions()
        if not isinstance(options, SimulatorOptions):
            raise ModelError(f"expected SimulatorOptions, found {options!r}")
        refuse(type(self).__name__, overrides, (field.name for field in fields(options)), OPTIONS)
        self.options = replace(options, **overrides)
        self.system = system  # the engine refers to it
        self._options = core_options(self.options)
        self._make()
        self._failed: Results | None = None

    def _make(self) -> None:
        """The engine's simulator, of the system as it runs."""
        self._runs, self._ladder = self.system, None
        if self.options.python == "traced":
            self._runs, self._ladder = climbed(self.system)
        self._core = _core.Simulator(self._runs, self._options)

    def initialize(self, context: _core.Context) -> None:
        """Begins a run with these values, at their time."""
        if self._ladder and (self._ladder.survey.stale or self._ladder.refresh()):
            self._make()
        self._core.initialize(core_context(context))
        self._failed = None

    def advance_to(self, time: float) -> str:
        """Goes on to `time` [s], or to where the run ends before; returns the status.

        Raises SimulationError with the partial results, what a callback raised, as it was raised,
        or KeyboardInterrupt with the partial results as its attribute `results`, unless the option
        `throw` is off.
        """
        return self._advance(time, take=False).status

    def _follow_changes(self) -> None:
        """What a traced callback was made from may have changed since the last piece of the run."""
        if not self._ladder or not self._ladder.refresh():
            return
        if not self._runs.replace(self._ladder.core_traces()):
            raise ModelError(
                f"t = {self.time} s: a callback depends on other values than when the run began; "
                "initialize again, or use the option python='called'"
            )

    def _advance(self, time: float, take: bool) -> Results:
        if not take:  # what simulate runs was made just now
            self._follow_changes()
        try:
            self._core.advance_to(time)
        except TypeError:
            raise ModelError(f"advance_to: expected a time in seconds, found {time!r}") from None
        core, raised = self._core.results(take)
        results = Results(core, raised)
        if results.status in ("failed", "interrupted"):
            self._failed = results
        if self.options.throw and results.status not in ("reached_end", "terminal", "zeno_stop"):
            self._raise(results, raised)
        return results

    def _raise(self, results: Results, error: BaseException | None) -> None:
        if error is None:
            error = SimulationError(results.message, results.context.time, results.block)
        if isinstance(error, (SimulationError, KeyboardInterrupt)):
            error.results = results  # type: ignore[union-attr]
        try:
            raise error
        finally:
            del error  # or it would hold this frame, and this frame it

    @property
    def time(self) -> float:
        """[s] where the run stands."""
        return self._core.time

    @property
    def context(self) -> _core.Context:
        """The values of now."""
        return self._core.context

    @property
    def results(self) -> Results:
        """All since `initialize`, as a copy of its own."""
        return self._failed or Results(*self._core.results(False))

    def describe(self) -> str:
        """What of the system is computed when, what is never computed, and why."""
        return self._core.describe()


def simulate(
    system: System,
    context: _core.Context,
    time_span: tuple[float, float],
    options: SimulatorOptions | None = None,
    recorded_signals: Mapping[str, OutputPort] | None = None,
    **option_overrides: Any,
) -> Results:
    """Runs `system` from the values of `context` over `time_span`, (begin, end) in seconds.

    `recorded_signals` names the outputs to record; any option can also be given here by name.
    Raises ModelError before the run for bad input; for what ends it badly see
    `Simulator.advance_to`.

    >>> recorded = {"y": ball.output_ports[0]}
    >>> results = saltus.simulate(ball, context, (0.0, 12.0), recorded_signals=recorded, rtol=1e-9)
    """
    try:
        begin, end = map(float, time_span)
    except (TypeError, ValueError):
        raise ModelError(
            f"simulate: expected a span (begin, end) in seconds, found {time_span!r}"
        ) from None
    if not end >= begin:
        raise ModelError(f"simulate: expected a span with begin <= end, found {begin} s to {end} s")
    if recorded_signals is not None:
        option_overrides["recorded_signals"] = recorded_signals
    simulator = Simulator(system, options, **option_overrides)
    context = core_context(context)
    # one that ended another run at this time knows what of it has happened already
    simulator.initialize(context if context.time == begin else context.with_time(begin))
    return simulator._advance(end, take=True)
