"""`period_map`: the linear map of a sampled system over one period."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from saltus import _core
from saltus._core import known_names
from saltus._engine import core_context
from saltus._signals import signals_in
from saltus.errors import ModelError
from saltus.orbits.arc import Arc
from saltus.orbits.fixed_period import FixedPeriod
from saltus.orbits.linear_map import PeriodMap
from saltus.orbits.runs import Runs
from saltus.orbits.stamps import first_arc
from saltus.system import OutputPort, System

__all__ = ["period_map"]

WHERE = "period_map"
SAME = 1e-6
"""the part of the size of the states, times the growth in a period, by which two runs may differ"""
ROUNDING = 1e-11
"""what the values of a state whose size is zero may differ by: ten times the default atol"""


def period_map(
    system: System,
    period: float,
    context: _core.Context | None = None,
    *,
    inputs: Sequence[str] = (),
    outputs: Mapping[str, OutputPort | str] | Sequence[str] | None = None,
    rtol: float = 1e-10,
    atol: float = 1e-12,
    **options: Any,
) -> PeriodMap:
    """The map x[k+1] = x1 + Phi (x[k] - x0) + Gamma (u[k] - u0) over one period, through all
    events.

    x are the continuous and the discrete states just after the instant at the start of a period,
    and u are parameters that stay constant during it. Phi and Gamma are the derivatives of a run
    (docs/derivatives.md) of one period, from x0 to x1. At a fixed point x1 = x0; elsewhere they are
    those of a moving state.

    Parameters
    ----------
    system : System
        A plant with a sampled controller, for example.
    period : float
        [s] The sample time, or a multiple that all clocks have in common.
    context : Context, optional
        The start; what happens at its time happens first. By default `system.create_context()`.
    inputs : list of str
        Dynamic parameters, by the names of `sensitivity`. An open input needs a block, such as
        `Constant`, whose parameter is named here.
    outputs : dict of str to OutputPort or str, or list of str, optional
        The outputs at the start of a period, as in `linearize`; by default all states.
    rtol, atol, **options
        As for `simulate`.

    Returns
    -------
    PeriodMap

    Raises
    ------
    ModelError
        For a period that is not positive or not one of the clocks, an unknown name, and a mode that
        has another value after the period.
    SimulationError
        If a derivative does not exist (a guard that grazes zero, for example), with the event and
        the time; from a run that ends badly as from `simulate`.

    Examples
    --------
    A state that is sampled each 0.5 s, x' = -z with z = x at the last sample:

    >>> class Loop(saltus.LeafSystem):
    ...     def __init__(self):
    ...         super().__init__(name="loop")
    ...         self.declare_continuous_state([1.0], ode=lambda t, s: -s.discrete_state)
    ...         self.declare_discrete_state([0.0])
    ...         self.declare_periodic_update(
    ...             lambda t, s: s.with_discrete_state(s.continuous_state), period=0.5
    ...         )
    >>> saltus.period_map(Loop(), 0.5).multipliers().real.round(6)
    array([0.5, 0. ])
    """
    if not (isinstance(period, (int, float, np.number)) and 0.0 < period < np.inf):
        raise ModelError(f"{WHERE}: period: expected a positive time, found {period!r}")
    runs = Runs(WHERE, system, {"rtol": rtol, "atol": atol} | options)
    start = core_context(system.create_context() if context is None else context)
    if not len(start.continuous_state) + len(start.discrete_state):
        raise ModelError(f"{WHERE}: '{system.name}' has no states; expected some")
    names = _inputs(system, start, inputs)
    closing = FixedPeriod(runs, start, float(period))
    arc = first_arc(closing, names)
    _require_return(closing, arc)
    closing.take_labels(arc, untouched=outputs is None)  # an output may read such a state
    _require_same(closing, arc)
    return _made(closing, arc, outputs)


def _inputs(system: System, context: _core.Context, inputs: Any) -> list[str]:
    if isinstance(inputs, str) or not all(isinstance(name, str) for name in inputs):
        raise ModelError(f"{WHERE}: inputs: expected a list of names, found {inputs!r}")
    known = list(context.parameters)
    for name in inputs:
        if name in system.input_names:
            raise ModelError(
                f"{WHERE}: '{name}' is an open input; connect a Constant to it, and name the "
                "parameter of that"
            )
        if name.split("[")[0].split(".")[-1] in ("x", "z", "mode"):
            raise ModelError(
                f"{WHERE}: '{name}' is a state; expected a parameter{known_names(name, known)}"
            )
    return list(inputs)


def _require_return(closing: FixedPeriod, arc: Arc) -> None:
    """Refuses a mode that changes: the next period has another map."""
    changed = arc.unreturned(closing.states, np.zeros(len(closing.states), dtype=bool))
    if changed:
        raise ModelError(
            f"{WHERE}: t = {arc.final.time} s: {changed}; expected the same mode after one period: "
            "begin elsewhere, or give a longer period"
        )


def _require_same(closing: FixedPeriod, arc: Arc) -> None:
    """Refuses a period after which the same start leads elsewhere."""
    other = closing.again(arc)
    square = np.ix_(closing.active, closing.active)
    growth = max(1.0, float(np.linalg.norm(arc.by_start[square])))
    change = np.abs(other.end - arc.end)[closing.active]
    bound = SAME * growth * closing.scale(arc)
    # at rest the ends are the same after any time, and the derivatives are not
    turned = np.linalg.norm((other.by_start - arc.by_start)[square], axis=1)
    bound = np.where(turned > SAME * growth, -1.0, bound + ROUNDING)
    if np.any(change > bound):
        name = closing.states.names[closing.active[int(np.argmax(change - bound))]]
        raise ModelError(
            f"{WHERE}: t = {arc.final.time} s: the same start leads elsewhere ('{name}') in the "
            f"second {closing.period} s than in the first, so this is no period of the clocks; "
            "expected their sample time or a common multiple of it"
        )


def _made(closing: FixedPeriod, arc: Arc, outputs: Any) -> PeriodMap:
    active = closing.active
    names = tuple(closing.names[i] for i in active)
    values = [closing.of(c)[active] for c in (arc.begin, arc.final)]
    found = _outputs(closing, arc, outputs)
    labels = {closing.names[i]: float(arc.start[i]) for i in np.flatnonzero(closing.labels)}
    c, d, y, rows = found or (
        np.eye(len(active)),
        np.zeros((len(active), len(arc.parameters))),
        values[0],
        names,
    )
    return PeriodMap(
        Phi=arc.monodromy[np.ix_(active, active)],
        Gamma=arc.by_parameters[active],
        C=c,
        D=d,
        states=names,
        inputs=arc.parameters,
        outputs=tuple(rows),
        x0=values[0],
        x1=values[1],
        y=y,
        frozen=labels,
        period=closing.period,
        context=arc.begin,
        size=closing.scale(arc),
    )


def _outputs(
    closing: FixedPeriod, arc: Arc, outputs: Any
) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[str]] | None:
    """C, D, y and the names of the outputs at the start; None if none were asked for."""
    if outputs is None:
        return None
    system, n = closing.runs.system, len(closing.states)
    signals = signals_in(system, outputs)
    names = [*closing.states.names, *arc.parameters]
    time = arc.begin.time
    run = closing.runs.plain(arc.begin, time, sensitivity=names, recorded_signals=signals)
    by, values, rows = [], [], []
    for name in signals:
        last = np.atleast_1d(run[name][-1])
        by.append(np.reshape(run.sensitivities[name][-1], (len(last), len(names))))
        values.append(last)
        rows += [name] if np.ndim(run[name]) == 1 else [f"{name}[{i}]" for i in range(len(last))]
    whole = np.vstack(by)
    return whole[:, closing.active], whole[:, n:], np.concatenate(values), rows
