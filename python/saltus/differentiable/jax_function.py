"""`jax_function`: a run as a differentiable function in JAX."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from saltus import _core
from saltus.differentiable.run import Run
from saltus.differentiable.values import RunValues
from saltus.options import SimulatorOptions
from saltus.results.tables import extra
from saltus.system import OutputPort, System

__all__ = ["jax_function"]


def jax_function(
    system: System,
    wrt: Sequence[str],
    time_span: tuple[float, float],
    *,
    context: _core.Context | None = None,
    options: SimulatorOptions | None = None,
    recorded_signals: Mapping[str, OutputPort | str] | Sequence[str] | None = None,
    save_at: Sequence[float] | None = None,
    events: Mapping[str, int] | Sequence[str] = (),
    gaps: str = "error",
    **option_overrides: Any,
) -> Callable[[Any], RunValues]:
    """A run as a function f(p) of JAX, through every event: ``jax.grad``, ``jvp``, ``vjp``,
    ``jacfwd``, ``jacrev``, ``vmap`` and ``jit`` work. Needs JAX: the extra ``saltus[jax]``.

    The derivatives dx/dp are those of the option `sensitivity`: forward columns S, by which the
    rule of ``jax.custom_jvp`` multiplies a tangent, and JAX's transposition of it a cotangent. So
    a gradient costs one run with n columns, whatever the number of returned values.

    Parameters
    ----------
    system : System
        The system, which does not change.
    wrt : list of str
        The parameters and start values that p has, by their names in `simulate`'s `sensitivity`:
        ``"e"``, ``"ball.g"``, ``"x[0]"``, or ``"x"`` for all entries.
    time_span : (float, float)
        [s] begin and end.
    context : Context, optional
        The values that p does not have; by default those of ``system.create_context()``.
    options : SimulatorOptions, optional
        The options of each run; they can also be given by name, such as ``rtol=1e-9``.
    recorded_signals : dict or list of str, optional
        The signals to return, as in `simulate`; by default the outputs that a diagram
        exports, or the states of a block that have names.
    save_at : list of float, optional
        [s] increasing times, in the time span, at which signals are returned; by default its end.
    events : dict of str to int, or list of str
        How many event times to return of each name, such as ``{"bounce": 2}``: the first ones. Of a
        list the first one of each name.
    gaps : {'error', 'nan'}
        What to do where a derivative does not exist. With 'nan' it is nan, and each sum that it
        enters is nan, also where JAX multiplies it by 0. So take the value that you need out of
        f(p), and differentiate that in reverse mode: then only its own derivatives enter.
    **option_overrides
        Single options, but for those that this function sets: `sensitivity`, `save_steps`,
        `event_rows`, `dense_output`, `record_events` and `throw`.

    Returns
    -------
    callable
        f(p). p is an array (n,) of float64 with the values in the order of `wrt`, or a dict of the
        names in `wrt` with a scalar each, or an array for a name of a vector. f returns a
        `RunValues`, which is a pytree: `outputs`, `continuous_state`, `discrete_state`, `end_time`,
        `events`. Its shapes do not depend on p. Threads may share f.

    Raises
    ------
    ImportError
        If JAX is not installed.
    ModelError
        For unknown names, wrong shapes, other types than float64 and integers, impossible options;
        and while JAX is without float64: say ``jax.config.update("jax_enable_x64", True)``. From
        derivatives of derivatives.
    SimulationError
        From f, if the run fails, has fewer events than `events` says, or ends before a time of
        `save_at`; from derivatives at a gap, with its time, event, parameter and reason. Under
        ``jit`` and ``vmap`` JAX raises a ``jax.errors.JaxRuntimeError`` with that text.

    Notes
    -----
    If a guard ends the run, the derivatives of the last state are total ones: dx/dp at a fixed time
    plus f times d(end_time)/dp.

    Examples
    --------
    >>> import jax, saltus
    >>> jax.config.update("jax_enable_x64", True)
    >>> ball = saltus.scene("bouncing-ball")
    >>> f = saltus.jax_function(
    ...     ball.system, ["g", "e"], (0, 12), context=ball.context, events={"bounce": 6}, rtol=1e-9
    ... )
    >>> slopes = jax.jacfwd(f)(jax.numpy.array([9.81, 0.9]))
    >>> [round(float(slope), 4) for slope in slopes.events["bounce"][5]]
    [-0.6092, 32.6305]
    """
    extra("jax", "jax_function", " or saltus[jax]")
    run = Run(
        "jax_function",
        system,
        wrt,
        time_span,
        context,
        options,
        recorded_signals,
        save_at,
        events,
        gaps,
        option_overrides,
    )
    from saltus.differentiable.jax_run import function_of

    return function_of(run)
