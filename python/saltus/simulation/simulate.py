"""`simulate`: a whole run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from saltus import _core
from saltus._engine import core_context
from saltus._porting import OPTIONS, refuse
from saltus._signals import quantities_of
from saltus._span import rows_within, span_of
from saltus.options import SimulatorOptions
from saltus.results import Results
from saltus.simulation.whole import prepared, run_whole
from saltus.system import OutputPort, System

__all__ = ["simulate"]


def simulate(
    system: System,
    context: _core.Context | tuple[float, float] | None = None,
    time_span: tuple[float, float] | None = None,
    options: SimulatorOptions | None = None,
    recorded_signals: Mapping[str, OutputPort | str] | Sequence[str] | None = None,
    **option_overrides: Any,
) -> Results:
    """Runs `system` from the values of `context`: ``simulate(system, context, (0.0, 1.0))``.

    Parameters
    ----------
    system : System
        A `LeafSystem` or a `Diagram`. It never changes.
    context : Context, optional
        The values at the beginning; by default those of ``system.create_context()``, as in
        ``simulate(system, (0.0, 1.0))``.
    time_span : (float, float)
        [s] begin and end.
    options : SimulatorOptions, optional
        The options of the run.
    recorded_signals : dict of str to OutputPort or str, or a list of str, optional
        The outputs to record, by name: ports, or paths such as "car.engine.torque". A list of paths
        names each signal by its path. By default the outputs of the system: those that a diagram
        exports, and those of a block, but for one of all states where the states have names;
        ``[]`` records nothing.
    **option_overrides
        Any option by name; it replaces the one in `options`: ``rtol=1e-9``,
        ``dense_output=True``, ``progress=True``, ...

    Returns
    -------
    Results
        The recorded signals, the events, the final context, the status and the statistics.

    Raises
    ------
    ModelError
        If the input is bad; it is raised before the run.
    SimulationError
        If the run ends badly; its attribute `results` has the run until then. An exception of a
        callback is raised unchanged.
    KeyboardInterrupt
        After Ctrl-C, or the stop button of a notebook. It is Python's own exception, so a script
        stops. Its attribute `results` has the run until then::

            try:
                results = saltus.simulate(...)
            except KeyboardInterrupt as stop:
                results = stop.results  # status 'interrupted'

        At a prompt and in a notebook ``sys.last_value.results`` has it afterwards. With
        ``throw=False`` neither exception is raised: the results are returned, and their status
        says how the run ended.

    Examples
    --------
    >>> import saltus
    >>> class Decay(saltus.LeafSystem):
    ...     def __init__(self):
    ...         super().__init__(name="decay")
    ...         self.declare_continuous_state([1.0], ode=lambda t, s: -s.continuous_state)
    ...         self.declare_continuous_state_output("x")
    >>> decay = Decay()
    >>> recorded = {"x": decay.output("x")}
    >>> results = saltus.simulate(
    ...     decay, decay.create_context(), (0.0, 1.0), recorded_signals=recorded, rtol=1e-9
    ... )
    >>> f"{results.outputs['x'][-1, 0]:.6f}"
    '0.367879'
    """
    if time_span is None and not isinstance(context, _core.Context):
        context, time_span = None, context  # simulate(system, (0.0, 1.0))
    if time_span is None:  # which is called t_span and stop_time elsewhere
        refuse("simulate", option_overrides, SimulatorOptions.__dataclass_fields__, OPTIONS)
    begin, end = span_of("simulate", time_span)
    if recorded_signals is not None:
        option_overrides["recorded_signals"] = recorded_signals
    run = prepared("Simulator", system, options, option_overrides)
    asked = option_overrides.get("recorded_signals", options and options.recorded_signals)
    known = quantities_of(system, asked)
    save_at = option_overrides.get("save_at", () if options is None else options.save_at)
    if len(save_at):
        rows = rows_within("simulate", save_at, (begin, end))
        if rows is not save_at:
            run = prepared("Simulator", system, options, {**option_overrides, "save_at": rows})
    context = core_context(system.create_context(begin) if context is None else context)
    # a context from the end of a run at this time records which events have happened already
    if context.time != begin:
        context = context.with_time(begin)
    return run_whole(
        run, context, end, lambda core, raised: (Results(core, raised, system, known), raised)
    )
