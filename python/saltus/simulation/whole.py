"""Whole runs, for `simulate` and `solve`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

from saltus import _core
from saltus._engine import core_options
from saltus._porting import OPTIONS, refuse
from saltus._signals import signals_of
from saltus._status import WELL
from saltus.callbacks import Callbacks, called_callbacks, planned
from saltus.callbacks.plans import Key
from saltus.errors import ModelError, SimulationError
from saltus.options import SimulatorOptions
from saltus.progress import Reporter, reporter_of
from saltus.results import Results
from saltus.simulation.failure import raise_for
from saltus.simulation.plan_key import key_of
from saltus.system import System

__all__ = [
    "Prepared",
    "advance",
    "checked_options",
    "functions_of",
    "prepared",
    "refuse_stale",
    "run_whole",
]

"""the statuses of runs that ended well"""

R = TypeVar("R", bound=Results)


@dataclass(frozen=True, slots=True)
class Prepared:
    """The plan of a run, with its options and its progress."""

    plan: _core.Plan
    callbacks: Callbacks | None = None
    """None: every function is called"""
    reporter: Reporter | None = None
    throw: bool = True


def prepared(
    where: str, system: System, options: SimulatorOptions | None, overrides: Mapping[str, Any]
) -> Prepared:
    """The plan that the system keeps for these options, if there is one, or a new one.

    A plan is kept while no block has declared more, and nothing has changed that a callback reads.
    """
    key = key_of(options, overrides)
    kept = None if key is None else _kept(system, key)
    if kept is not None:
        throw = overrides["throw"] if "throw" in overrides else options is None or options.throw
        return Prepared(*kept, None, throw)
    return _made(system, checked_options(where, system, options, overrides), key)


def _kept(system: System, key: Key) -> tuple[_core.Plan, Callbacks] | None:
    callbacks = getattr(system, "_callbacks", None)
    if not isinstance(callbacks, Callbacks) or callbacks.traces.stale:
        return None
    plan = callbacks.plans.find(key, callbacks.refresh())
    return None if plan is None else (plan, callbacks)


def _made(system: System, options: SimulatorOptions, key: Key | None) -> Prepared:
    reporter, core = reporter_of(options.progress), core_options(options, system)
    if options.python != "traced":
        plan = _core.Plan(system, core, called_callbacks(system), options.machine_code)
        return Prepared(plan, None, reporter, options.throw)
    versions = (0, 0)

    def make(callbacks: Callbacks) -> _core.Plan:
        nonlocal versions
        before = callbacks.version
        made = _core.Plan(system, core, callbacks, options.machine_code)
        versions = before, callbacks.version  # another thread may have traced anew meanwhile
        return made

    plan, callbacks = planned(system, make, functions_of(options))
    if key is not None and versions[0] == versions[1] == callbacks.version:
        callbacks.plans.keep(key, callbacks.version, plan)
    return Prepared(plan, callbacks, reporter, options.throw)


def checked_options(
    where: str, system: System, options: SimulatorOptions | None, overrides: Mapping[str, Any]
) -> SimulatorOptions:
    """The options, changed by those given by name. ModelError if `system` is no system, and for
    unknown names.
    """
    if not isinstance(system, System):
        raise ModelError(f"expected a system, found {system!r}")
    options = options or SimulatorOptions()
    if not isinstance(options, SimulatorOptions):
        raise ModelError(f"expected SimulatorOptions, found {options!r}")
    refuse(where, overrides, (field.name for field in fields(options)), OPTIONS)
    signals = signals_of(system, overrides.get("recorded_signals", options.recorded_signals))
    return replace(options, **{**overrides, "recorded_signals": signals})


def functions_of(options: SimulatorOptions) -> list[tuple[str, Any]]:
    """The functions of the user that a run calls beside the callbacks of its blocks."""
    progress = options.progress
    return [("the progress function", progress)] if callable(progress) else []


def advance(core: _core.Simulator, time: float, reporter: Reporter | None) -> str:
    """Advances a run, and reports the progress to the user; returns the status."""
    if reporter is None:
        return core.advance_to(time)
    with reporter.over(core.time, time, core.events) as report:
        status = core.advance_to(time)
        report(core.time, core.events)
    return status


def refuse_stale(callbacks: Callbacks | None, results: Callable[[], Results]) -> None:
    """Refuses a run in which a read value changed although no search had found a writer."""
    change = callbacks.written() if callbacks else None
    if change is None:
        return
    found = results()
    error = SimulationError(
        f"t = {found._ended_at} s: {change}: something wrote it during the run, and a traced "
        "callback that reads it used the old value; use the option python='called'",
        found._ended_at,
        "",
    )
    error.results = found
    raise error


def run_whole(
    run: Prepared,
    context: _core.Context,
    end: float,
    outcome: Callable[[_core.Results, BaseException | None], tuple[R, BaseException | None]],
) -> R:
    """One run, from the values of `context`. `outcome` makes its results, and the exception if it
    ends badly.
    """
    core = _core.Simulator(run.plan, run.reporter)
    core.initialize(context)
    status = advance(core, end, run.reporter)
    results, raised = outcome(*core.last_results())
    refuse_stale(run.callbacks, lambda: results)
    if run.throw and status not in WELL:
        raise_for(results, raised)
    return results
