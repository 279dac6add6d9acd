"""`torch_function`: a run as a differentiable function in PyTorch."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from saltus import _core
from saltus.differentiable.run import Run
from saltus.differentiable.values import RunValues
from saltus.options import SimulatorOptions
from saltus.results.tables import extra
from saltus.system import OutputPort, System

__all__ = ["torch_function"]


def torch_function(
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
    """A run as a function f(p) of PyTorch, through every event: ``backward``,
    ``torch.autograd.grad``, forward mode, and ``grad``, ``jvp``, ``vjp``, ``jacrev``, ``jacfwd``
    and ``vmap`` of ``torch.func`` work. Needs PyTorch: the extra ``saltus[torch]``.

    The derivatives dx/dp are those of the option `sensitivity`: forward columns S. A
    ``torch.autograd.Function`` gives v^T S for a cotangent v, and S dp for a tangent dp. f(p) makes
    a plain run, and each derivative one run with n columns, whatever the number of returned values.

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
        enters is nan, also where PyTorch multiplies it by 0. So take the value that you need out of
        f(p), and differentiate that in reverse mode: then only its own derivatives enter.
    **option_overrides
        Single options, but for those that this function sets: `sensitivity`, `save_steps`,
        `event_rows`, `dense_output`, `record_events` and `throw`.

    Returns
    -------
    callable
        f(p). p is a tensor (n,) of float64 on the CPU with the values in the order of `wrt`, or a
        dict of the names in `wrt` with a tensor of no dimension each, or of one for a name of a
        vector. f returns a `RunValues` of tensors: `outputs`, `continuous_state`,
        `discrete_state`, `end_time`, `events`. Its shapes do not depend on p. Threads may share f.

    Raises
    ------
    ImportError
        If PyTorch is not installed.
    ModelError
        For unknown names, wrong shapes, other types than float64, impossible options. From
        derivatives of derivatives.
    SimulationError
        From f, if the run fails, has fewer events than `events` says, or ends before a time of
        `save_at`; from derivatives at a gap, with its time, event, parameter and reason.

    Notes
    -----
    If a guard ends the run, the derivatives of the last state are total ones: dx/dp at a fixed time
    plus f times d(end_time)/dp.

    Examples
    --------
    >>> import saltus, torch
    >>> ball = saltus.scene("bouncing-ball")
    >>> f = saltus.torch_function(
    ...     ball.system, ["g", "e"], (0, 12), context=ball.context, events={"bounce": 6}, rtol=1e-9
    ... )
    >>> p = torch.tensor([9.81, 0.9], dtype=torch.float64, requires_grad=True)
    >>> f(p).events["bounce"][5].backward()
    >>> p.grad.numpy().round(4).tolist()
    [-0.6092, 32.6305]
    """
    extra("torch", "torch_function", " or saltus[torch]")
    run = Run(
        "torch_function",
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
    from saltus.differentiable.torch_run import function_of

    return function_of(run)
