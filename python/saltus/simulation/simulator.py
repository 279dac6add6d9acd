"""`Simulator`: a run in pieces."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

from saltus import _core
from saltus._engine import core_context, core_options
from saltus._porting import OPTIONS, refuse
from saltus.callbacks import Callbacks, planned
from saltus.errors import ModelError, SimulationError
from saltus.options import SimulatorOptions
from saltus.progress import reporter_of
from saltus.results import Results
from saltus.simulation.failure import raise_for
from saltus.simulation.turn import Turn
from saltus.system import System

__all__ = ["Simulator"]


class Simulator:
    """A run that can be continued: `initialize(context)`, then `advance_to(t)` as often as you
    like.

    In pieces or at once, the events are the same. It can be initialized again.

    One caller uses a simulator at a time. While it runs, each further call is an `Error` that
    changes nothing, from one of its own callbacks and from another thread alike; only `time` may be
    read.

    Parameters
    ----------
    system : System
        The system to run. It never changes.
    options : SimulatorOptions, optional
        How.
    **overrides
        Options by name, which replace those of `options`.

    Raises
    ------
    ModelError
        For a system or an option that makes no sense.

    Examples
    --------
    >>> import saltus
    >>> scene = saltus.scene("bouncing-ball")
    >>> simulator = saltus.Simulator(scene.system, scene.options)
    >>> simulator.initialize(scene.context)
    >>> simulator.advance_to(1.0), simulator.advance_to(3.0)
    ('reached_end', 'reached_end')
    >>> simulator.time
    3.0
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
        self._reporter = reporter_of(self.options.progress)
        self._options = core_options(self.options)
        self._make()
        self._failed: Results | None = None
        self._turn = Turn()

    def _make(self) -> None:
        """The engine's simulator."""
        self._callbacks: Callbacks | None = None
        if self.options.python == "traced":
            self._core, self._callbacks = planned(self.system, self._core_simulator, self._others)
        else:
            self._core = self._core_simulator(None)
        self._version = self._callbacks.version if self._callbacks else 0

    def _core_simulator(self, callbacks: Callbacks | None) -> _core.Simulator:
        when = self.options.machine_code
        return _core.Simulator(self.system, self._options, self._reporter, callbacks, when)

    @property
    def _others(self) -> list[tuple[str, Any]]:
        """The functions of the user that a run calls beside the callbacks of its blocks."""
        progress = self.options.progress
        return [("the progress function", progress)] if callable(progress) else []

    def initialize(self, context: _core.Context) -> None:
        """Begins a run with these values, at their time.

        With the context at the end of an earlier run, the new run continues that run. Raises
        ModelError for a context of another system.
        """
        with self._turn.of("initialize", self._core):
            self._initialize(context)

    def _initialize(self, context: _core.Context) -> None:
        callbacks = self._callbacks
        if callbacks and (
            callbacks.traces.stale or callbacks.refresh(self._others) != self._version
        ):
            self._make()
        self._core.initialize(core_context(context))
        self._failed = None

    def advance_to(self, time: float) -> str:
        """Goes on to `time`, or to where the run ends before.

        Parameters
        ----------
        time : float
            [s] not before the present one.

        Returns
        -------
        str
            The status, see `Results.status`.

        Raises
        ------
        ModelError
            For a time that is not a number, or that lies before the present time.
        SimulationError
            If the run ends badly; its attribute `results` has the run until then. An exception of
            a callback is raised unchanged.
        KeyboardInterrupt
            After Ctrl-C, or the stop button of a notebook; its attribute `results` has the run
            until then. With the option ``throw=False`` nothing is raised, and the status says it.
        """
        return self._advance(time, take=False).status

    def _follow_changes(self) -> None:
        """Replaces the traces whose sources have changed since the last piece of the run."""
        if not self._callbacks or self._callbacks.refresh(self._others) == self._version:
            return
        self._version = self._callbacks.version
        if not self._core.replace_traces():
            self._version = -1  # never a version of the callbacks: the next run is made anew
            raise ModelError(
                f"t = {self.time} s: a callback depends on more than when the run began; "
                "initialize again, or use the option python='called'"
            )

    def _run(self, context: _core.Context, end: float) -> Results:
        """A whole run of a simulator that was made just now, so that its traces are right. The
        results take the recorded rows without a copy.
        """
        self._core.initialize(core_context(context))
        return self._advance(end, take=True)

    def _advance(self, time: float, take: bool) -> Results:
        with self._turn.of("advance_to", self._core):
            results, raised = self._advance_alone(time, take)
        if self.options.throw and results.status not in ("reached_end", "terminal", "zeno_stop"):
            self._raise(results, raised)
        return results

    def _advance_alone(self, time: float, take: bool) -> tuple[Results, BaseException | None]:
        if not take:  # simulate has made its traces just now
            self._follow_changes()
        try:
            time = float(time)
        except (TypeError, ValueError):
            raise ModelError(f"advance_to: expected a time in seconds, found {time!r}") from None
        if self._reporter is None:
            self._core.advance_to(time)
        else:
            self._report(time)
        core, raised = self._core.results(take)
        results = self._results(core, raised)
        self._refuse_stale(results)
        if results.status in ("failed", "interrupted"):
            self._failed = results
        return results, raised

    def _refuse_stale(self, results: Results) -> None:
        """The last resort, behind the search for writers that comes before the run."""
        change = self._callbacks.written() if self._callbacks else None
        if change is None:
            return
        error = SimulationError(
            f"t = {self.time} s: {change}: something wrote it during the run, and a traced "
            "callback that reads it used the old value; use the option python='called'",
            self.time,
            "",
        )
        error.results = results
        raise error

    def _outcome(self, core: _core.Results, raised: BaseException | None, asks: Any) -> Results:
        """The form in which a run is returned; `solve` has one of its own."""
        return Results(core, raised, asks)

    def _results(self, core: _core.Results, raised: BaseException | None) -> Results:
        return self._outcome(core, raised, self.system)

    def _report(self, time: float) -> None:
        """Advances and reports the progress to the user."""
        assert self._reporter is not None
        with self._reporter.over(self._core.time, time, self._core.events) as reporter:
            self._core.advance_to(time)
            reporter(self._core.time, self._core.events)

    def _raise(self, results: Results, error: BaseException | None) -> None:
        raise_for(results, error)

    @property
    def time(self) -> float:
        """[s] The present time of the run."""
        return self._core.time

    @property
    def context(self) -> _core.Context:
        """The present values; after an error the last accepted ones, from which
        `initialize` goes on.
        """
        self._turn.require_idle("context", self._core)
        return self._core.context

    @property
    def results(self) -> Results:
        """The run since `initialize`, as a copy."""
        self._turn.require_idle("results", self._core)
        return self._failed or self._results(*self._core.results(False))

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
