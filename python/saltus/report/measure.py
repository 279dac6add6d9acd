"""`work_precision`: the error and the cost of each method at each tolerance."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from saltus import _core
from saltus._engine import core_context, core_options
from saltus._signals import signals_in
from saltus._span import span_of
from saltus.callbacks import called_callbacks, traced_callbacks
from saltus.errors import ModelError
from saltus.options import SimulatorOptions
from saltus.report.table import WorkPrecision
from saltus.results import Results
from saltus.scenes import Scene
from saltus.system import OutputPort, System

__all__ = ["work_precision"]

Row = NDArray[np.float64]
RowFunction = Callable[[float, Row], float]
POINTS = 100  # the number of output times of a known answer if save_at is not given


def work_precision(
    system: System | Scene,
    context: _core.Context | None = None,
    t_span: tuple[float, float] | None = None,
    *,
    methods: Sequence[str] | None = None,
    rtols: Sequence[float] = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12),
    atol_over_rtol: float | None = None,
    recorded_signals: Mapping[str, OutputPort | str] | Sequence[str] | None = None,
    exact: Callable[[float], ArrayLike] | None = None,
    reference: Results | tuple[ArrayLike, ArrayLike] | None = None,
    provenance: str = "",
    event_times: Mapping[str, ArrayLike] | None = None,
    invariants: Mapping[str, RowFunction] | None = None,
    gap: RowFunction | None = None,
    least_time: float = 0.1,
    most_repeats: int = 10000,
    time_limit: float = 5.0,
    **options: Any,
) -> WorkPrecision:
    """Runs a scene by each method at each tolerance and compares the results.

    A *row* is one vector: the numbers of the recorded signals one after the other. The known answer
    comes, in this order, from `exact`, from `reference`, or from two runs that the report makes by
    different methods, two orders tighter than the tightest of `rtols`. Each method is compared with
    the run of another method.

    Parameters
    ----------
    system
        A system of your own, with its `context` and `t_span`; or a `Scene` of the shelf, which
        brings these and its known answer along.
    context
        The values to start from.
    t_span
        [s] Begin and end.
    methods
        Names as for `ode_solver_method`; by default those that suit the scene.
    rtols
        Relative tolerances, each a row for each method.
    atol_over_rtol
        `atol` is this times each rtol; by default the ratio of the options, of the smallest ones
        where each state has its own.
    recorded_signals
        The signals of a row; by default the first output.
    exact
        `exact(t)` is the true row at time t [s]; runs are compared with it at `save_at`, or at 100
        even times.
    reference
        Rows computed elsewhere, as (times [s], rows) or as the `Results` of a better run.
    provenance
        Where the known answer comes from, for the table.
    event_times
        The true times [s] of guards by name; without it they come from the same two runs.
    invariants
        Functions f(t, row) that are constant along the solution, by name.
    gap
        `gap(t, row)` is the distance to a surface that must not be passed.
    least_time
        [s] Warm runs, of a simulator used before, are repeated for so long,
    most_repeats
        at most so often.
    time_limit
        [s] A longer run is stopped: like every run that fails it is a row with its reason.
    options
        Others of `SimulatorOptions`, by name.

    Returns
    -------
    WorkPrecision
        The table.

    Raises
    ------
    ModelError
        If an argument makes no sense, or if no answer is known and no method reaches the end.

    Examples
    --------
    >>> table = saltus.work_precision(
    ...     saltus.scene("bouncing-ball"), methods=["dopri5"], rtols=[1e-4, 1e-8], least_time=0.0
    ... )
    >>> table[1]["error"] < 1e-6
    True
    """
    work = _core.WorkOptions()
    work.rtols = [float(rtol) for rtol in rtols]
    work.atol_over_rtol = atol_over_rtol or 0.0
    work.least_time, work.most_repeats, work.time_limit = least_time, most_repeats, time_limit
    if isinstance(system, Scene):
        own = (context, t_span, recorded_signals, exact, reference, event_times, invariants, gap)
        if options or any(value is not None for value in own):
            raise ModelError(
                "work_precision: a scene brings its context, span, options and known answer along; "
                "give its system, context and span to change one of them"
            )
        work.methods = list(system.methods if methods is None else methods)
        return _run(system._core, work, system.name, system.title)
    work.methods = list(methods or ())
    known = _known(exact, reference, provenance, _span(t_span), options.get("save_at", ()))
    if len(known.times):
        options["save_at"] = list(known.times)
    scene = _scene(system, context, _span(t_span), recorded_signals, options)
    if len(known.times):
        _core.set_samples(scene, list(known.times), known.rows, exact is not None, known.provenance)
    if event_times is None and isinstance(reference, Results):
        event_times = _events_of(reference)
    if event_times is not None:
        times = [(name, np.atleast_1d(t).astype(float)) for name, t in event_times.items()]
        _core.set_event_times(scene, times)
    for name, value in (invariants or {}).items():
        _core.add_invariant(scene, name, value)
    if gap is not None:
        _core.set_gap(scene, gap)
    return _run(scene, work, system.name, "")


def _run(scene: _core.Scene, work: _core.WorkOptions, name: str, title: str) -> WorkPrecision:
    return WorkPrecision.from_json(_core.work_precision(scene, work, name, title))


def _scene(
    system: object,
    context: object,
    span: tuple[float, float],
    signals: Mapping[str, OutputPort | str] | Sequence[str] | None,
    options: dict[str, Any],
) -> _core.Scene:
    """The scene in the form that runs."""
    if not isinstance(system, System):
        raise ModelError(f"work_precision: expected a system or a scene, found {system!r}")
    if signals is not None:
        signals = signals_in(system, signals)
    else:
        signals = {system.output_names[0]: system.output(0)} if system.output_names else {}
    chosen = SimulatorOptions(recorded_signals=signals, **options)
    of = traced_callbacks if chosen.python == "traced" else called_callbacks
    return _core.user_scene(
        system, core_context(context), span, core_options(chosen, system), of(system)
    )


class _Known(NamedTuple):
    """Times, the true rows at these times, and their provenance; empty if nothing is known."""

    times: Row
    rows: list[Row]
    provenance: str


def _span(t_span: tuple[float, float] | None) -> tuple[float, float]:
    begin, end = span_of("work_precision", t_span)
    if begin == end:
        raise ModelError(f"work_precision: expected begin < end, found {begin} s to {end} s")
    return begin, end


def _known(
    exact: Callable[[float], ArrayLike] | None,
    reference: Results | tuple[ArrayLike, ArrayLike] | None,
    provenance: str,
    span: tuple[float, float],
    save_at: Sequence[float],
) -> _Known:
    if exact is not None and reference is not None:
        raise ModelError("work_precision: exact and reference are given; one of them is meant")
    if exact is not None:
        times = np.asarray(save_at if len(save_at) else np.linspace(*span, POINTS + 1)[1:], float)
        name = getattr(exact, "__name__", "exact")
        rows = [np.ravel(np.asarray(exact(float(t)), float)) for t in times]
        return _Known(times, rows, provenance or f"the function {name}")
    if isinstance(reference, Results):
        times, first = np.unique(reference.time, return_index=True)
        arrays = [a.reshape(len(reference.time), -1) for a in reference.outputs.values()]
        rows = list(np.hstack(arrays)[first].astype(float))
        return _Known(times, rows, provenance or f"a run of {reference.statistics.method}")
    if reference is not None:
        times = np.atleast_1d(np.asarray(reference[0], float))
        rows = [np.ravel(row) for row in np.asarray(reference[1], float).reshape(len(times), -1)]
        return _Known(times, rows, provenance or "rows given by the caller")
    return _Known(np.empty(0), [], "")


def _events_of(results: Results) -> dict[str, list[float]]:
    times: dict[str, list[float]] = {}
    for event in results.events:
        if event.kind in ("zero_crossing", "terminal"):
            times.setdefault(f"{event.block}.{event.name}", []).append(event.time)
    return times
