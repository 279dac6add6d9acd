"""`Simulator`: a run in pieces."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from saltus import _core
from saltus._engine import core_context, core_options
from saltus._porting import missing
from saltus._signals import quantities_of
from saltus._status import WELL
from saltus.callbacks import Callbacks, called_callbacks, planned
from saltus.errors import ModelError
from saltus.options import SimulatorOptions
from saltus.progress import reporter_of
from saltus.results import Results
from saltus.simulation.failure import raise_for
from saltus.simulation.turn import Turn
from saltus.simulation.whole import (
    advance,
    checked_options,
    functions_of,
    refuse_stale,
)
from saltus.system import System

__all__ = ["Reached", "Simulator"]


class Reached(str):
    """The status of an advanced run, as text, with the values that it has reached."""

    __slots__ = ("context",)

    context: _core.Context


OF_SIMULATOR = {
    **dict.fromkeys(
        ("run", "step", "advance", "AdvanceTo", "simulate"),
        "it is simulator.advance_to(time, context)",
    ),
    **dict.fromkeys(("result", "outputs"), "what the run gave is simulator.results"),
    **dict.fromkeys(("status", "events"), "it is that of simulator.results"),
    "t": "it is simulator.time",
}
"""names that are tried -> where it is here"""


class Simulator:
    """A run that can be continued: `initialize(context)`, then `advance_to(t)` as often as you
    like.

    The events of a run in pieces are those of the whole run. A simulator can be initialized again.

    One caller uses a simulator at a time. While it runs, each further call is an `Error` that
    changes nothing, from one of its own callbacks and from another thread alike; only `time` may be
    read.

    Parameters
    ----------
    system : System
        The system to run. It never changes.
    options : SimulatorOptions, optional
        The options of the run.
    **overrides
        Options by name, which replace those of `options`.

    Raises
    ------
    ModelError
        If the system or an option makes no sense.

    Examples
    --------
    >>> import saltus
    >>> scene = saltus.scene("bouncing-ball")
    >>> simulator = saltus.Simulator(scene.system, scene.options)
    >>> _ = simulator.initialize(scene.context)
    >>> simulator.advance_to(1.0), simulator.advance_to(3.0)
    ('reached_end', 'reached_end')
    >>> simulator.time
    3.0
    """

    def __init__(self, system: System, options: SimulatorOptions | None = None, **overrides: Any):
        self.options = checked_options(type(self).__name__, system, options, overrides)
        self.system = system  # the engine refers to it
        self._reporter = reporter_of(self.options.progress)
        self._options = core_options(self.options, system)
        self._others = functions_of(self.options)
        self._make()
        self._shown: Callable[[], Results | None] = _nothing  # the last results, while they live
        self._failed: Results | None = None
        self._turn = Turn()

    if not TYPE_CHECKING:  # a type checker knows the names that are there

        def __getattr__(self, name: str) -> Any:
            return missing(self, name, OF_SIMULATOR)

    def _make(self) -> None:
        """The engine's simulator, over a plan of its own."""
        self._callbacks: Callbacks | None = None
        if self.options.python == "traced":
            plan, self._callbacks = planned(self.system, self._plan, self._others)
        else:
            plan = self._plan(called_callbacks(self.system))
        self._core = _core.Simulator(plan, self._reporter)
        self._version = self._callbacks.version if self._callbacks else 0
        self._fixes = _core.fixes()

    def _plan(self, callbacks: Callbacks | None) -> _core.Plan:
        return _core.Plan(self.system, self._options, callbacks, self.options.machine_code)

    def initialize(self, context: _core.Context) -> Simulator:
        """Begins a run with these values, at their time. Returns the simulator itself, which has
        the `context`.

        With the context at the end of an earlier run, the new run continues that run. Raises
        ModelError for a context of another system.
        """
        with self._turn.of("initialize", self._core):
            self._initialize(context)
        return self

    def _initialize(self, context: _core.Context) -> None:
        callbacks = self._callbacks
        if self._fixes != _core.fixes() or (
            callbacks
            and (callbacks.traces.stale or callbacks.refresh(self._others) != self._version)
        ):
            self._make()
        self._core.initialize(core_context(context))
        self._failed = None

    def _begin(self, context: _core.Context, end: float) -> None:
        """Begins a run that ends at `end`, which is not before its beginning."""
        begin = core_context(context).time
        if not end >= begin:
            raise ModelError(f"advance_to: expected a time of {begin} s or later, found {end} s")
        self._initialize(context)

    def advance_to(self, time: float, context: _core.Context | None = None) -> Reached:
        """Advances the run to `time`, or to an earlier end of the run.

        Parameters
        ----------
        time : float
            [s] The time to reach, not before the present time.
        context : Context, optional
            Begins a new run with these values first, as `initialize` does.

        Returns
        -------
        Reached
            The status as text, see `Results.status`; its attribute `context` has the present
            values.

        Raises
        ------
        ModelError
            If the time is not a number, or lies before the present time.
        SimulationError
            If the run ends badly; its attribute `results` has the run until then. An exception of
            a callback is raised unchanged.
        KeyboardInterrupt
            After Ctrl-C, or the stop button of a notebook; its attribute `results` has the run
            until then. With the option ``throw=False`` nothing is raised, and the status shows it.
        """
        with self._turn.of("advance_to", self._core):
            end = _seconds(time)
            if context is not None:
                self._begin(context, end)
            self._follow_changes()
            status = advance(self._core, end, self._reporter)
            results, raised = (None, None) if status in WELL else self._ended_badly()
            refuse_stale(self._callbacks, lambda: self._taken()[0])
        if results is not None:
            if self.options.throw:
                raise_for(results, raised)
            status = results.status
        reached = Reached(status)
        reached.context = self._core.context
        return reached

    def _follow_changes(self) -> None:
        """Replaces the traces whose sources have changed since the last piece of the run."""
        if not self._callbacks or self._callbacks.refresh(self._others) == self._version:
            return
        self._version = -1  # no version of the callbacks: a failure is tried again
        if not self._core.replace_traces():
            raise ModelError(
                f"t = {self.time} s: a callback depends on more than when the run began; "
                "initialize again, or use the option python='called'"
            )
        self._version = self._callbacks.version

    def _taken(self) -> tuple[Results, BaseException | None]:
        """The present results, made once, and the exception the first time."""
        core, raised = self._core.results()
        shown = self._shown()
        if shown is None or shown._core is not core:
            known = quantities_of(self.system, self.options.recorded_signals)
            shown = Results(core, raised, self.system, known)
            self._shown = weakref.ref(shown)
        return shown, raised

    def _ended_badly(self) -> tuple[Results, BaseException | None]:
        results, raised = self._taken()
        if results.status in ("failed", "interrupted"):
            self._failed = results
        return results, raised

    @property
    def time(self) -> float:
        """[s] The present time of the run."""
        return self._core.time

    @property
    def context(self) -> _core.Context:
        """The present values; after an error the last accepted values, from which `initialize` can
        continue.
        """
        self._turn.require_idle("context", self._core)
        return self._core.context

    @property
    def results(self) -> Results:
        """The run since `initialize`; it stays as it is when the run goes on."""
        self._turn.require_idle("results", self._core)
        return self._failed or self._taken()[0]

    def describe(self) -> str:
        """When each signal of the system is computed, which signals are never computed, and why.

        Examples
        --------
        >>> from saltus.library import Integrator
        >>> builder = saltus.DiagramBuilder()
        >>> x = builder.add(Integrator(1.0, name="x"))
        >>> builder.connect(x.output(), x.input())
        >>> print(saltus.Simulator(builder.build()).describe().splitlines()[0])
        plan: 1 block, 1 continuous and 0 discrete states
        """
        self._turn.require_idle("describe", self._core)
        return self._core.describe()


def _nothing() -> None:
    """A reference to results that do not live any more."""


def _seconds(time: float) -> float:
    try:
        return float(time)
    except (TypeError, ValueError):
        raise ModelError(f"advance_to: expected a time in seconds, found {time!r}") from None
