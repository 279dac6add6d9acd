"""`periodic_orbit`: limit cycles by Newton's method on the return of a state."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus._engine import core_context
from saltus._whole import is_whole
from saltus.errors import ModelError, SimulationError
from saltus.orbits.arc import Arc
from saltus.orbits.closing import Closing
from saltus.orbits.fixed_period import FixedPeriod
from saltus.orbits.free_period import FreePeriod
from saltus.orbits.guess import guess_period
from saltus.orbits.multipliers import multipliers_of
from saltus.orbits.newton import Found, search
from saltus.orbits.orbit import PeriodicOrbit
from saltus.orbits.runs import Runs
from saltus.orbits.section import Section
from saltus.orbits.stamps import first_arc
from saltus.system import OutputPort, System

__all__ = ["periodic_orbit"]

WHERE = "periodic_orbit"
SAME = 1e-6
"""the part of the size of the states, times the growth in a period, by which two runs may differ"""


def periodic_orbit(
    system: System,
    context: _core.Context | None = None,
    section: str | None = None,
    *,
    period: float | None = None,
    firings: int = 1,
    max_period: float = 1e4,
    transient: float = 0.0,
    wrt: Sequence[str] = (),
    rtol: ArrayLike = 1e-10,
    atol: ArrayLike = 1e-12,
    tolerance: float = 1e-8,
    max_iterations: int = 30,
    ode_solver_method: str = "auto",
    recorded_signals: Mapping[str, OutputPort | str] | Sequence[str] | None = None,
    **options: Any,
) -> PeriodicOrbit:
    """Finds a state x that returns to itself, P(x) = x, by Newton's method.

    P is one of three maps:

    - with `section`: from just after a firing of this guard to just after its n-th next one
      (`firings`), through all events on the way. The system must be autonomous.
    - with `period`: the state after this time, for a driven system.
    - with neither: the state after a time that is an unknown too, for an autonomous system.

    The derivative of P is that of the runs, with the jump at each event (docs/derivatives.md);
    its eigenvalues are the Floquet multipliers (P. Mueller, Chaos, Solitons & Fractals 5 (1995)
    1671; R. Leine, H. Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems, 2004,
    chapter 7). A Newton step that leaves the domain, or that does not bring the return closer to
    the start, is halved. Stable and unstable orbits are found alike.

    A discrete state z that keeps the time of an event returns if t - z does. It is found by its
    runs: the same start at another time, with z moved by as much, must end moved by as much.

    Parameters
    ----------
    system : System
        A leaf or a diagram with at most 200 continuous states.
    context : Context, optional
        The start of the search; by default `system.create_context()`. The nearer to the orbit the
        better.
    section : str, optional
        A guard, 'wheel.spoke' or 'spoke', that does not end the run.
    period : float, optional
        [s] The period of the drive, or a multiple of it.
    firings : int
        The orbit closes at this firing of the section after its start.
    max_period : float
        [s] The time in which the first return is looked for.
    transient : float
        [s] A run before the search: a way towards a stable orbit.
    wrt : list of str
        Parameters by which `dperiod` and `dx0` of the orbit differentiate, with the names of the
        option `sensitivity`.
    rtol, atol, ode_solver_method
        As for `simulate`.
    tolerance : float
        The search ends when a Newton step is smaller than this part of the size of each state.
    max_iterations : int
        Newton steps at most.
    recorded_signals
        As for `simulate`: the signals of the run of one period in `results`.
    **options
        Further options of `simulate`, such as `zeno_tolerance`.

    Returns
    -------
    PeriodicOrbit
        Also if the search does not converge; `status` says so, `message` why.

    Raises
    ------
    ModelError
        For an argument that makes no sense, a name that is unknown, a system with a part that has
        no derivatives, and a section or a free period where the time itself moves the system.
    SimulationError
        If the section is not reached, a mode or a discrete state does not return, or the first
        return has no derivative (a guard that grazes zero, for example); the message has the event
        and the time. From a run that ends badly as from `simulate`.

    Examples
    --------
    A wheel of spokes loses half of a deviation with each step:

    >>> import saltus
    >>> wheel = saltus.scene("rimless-wheel")
    >>> orbit = saltus.periodic_orbit(wheel.system, wheel.context, "wheel.spoke")
    >>> orbit.x0.round(6), orbit.multipliers.real.round(6)
    (array([-0.312699,  0.349754]), array([0.5]))

    Van der Pol's oscillator has no guard:

    >>> oscillator = saltus.system_of(lambda t, x: [x[1], (1 - x[0]**2) * x[1] - x[0]], [2.0, 0.0])
    >>> orbit = saltus.periodic_orbit(oscillator)
    >>> round(orbit.period, 6)
    6.663287
    """
    solver = {"rtol": rtol, "atol": atol, "ode_solver_method": ode_solver_method}
    runs = Runs(WHERE, system, solver | options)
    _require_numbers(period, firings, max_period, transient, tolerance, max_iterations)
    if section is not None and period is not None:
        raise ModelError(f"{WHERE}: expected a section or a period, found both; leave one out")
    start = core_context(system.create_context() if context is None else context)
    if transient:
        start = runs.plain(start, start.time + transient).context
    closing = _closing(runs, start, section, period, firings, max_period)
    _require_parameters(closing, wrt)
    if closing.autonomous:
        _require_same(closing, first_arc(closing))
    found = search(closing, tolerance, max_iterations)
    notes = [found.message] if found.status == "converged" and found.message else []
    if found.status == "converged" and not closing.autonomous:
        _require_same(closing, found.arc)
    return _orbit(closing, found, notes, tuple(wrt), recorded_signals)


def _closing(
    runs: Runs,
    start: _core.Context,
    section: str | None,
    period: float | None,
    firings: int,
    max_period: float,
) -> Closing:
    if not len(start.continuous_state) + len(start.discrete_state):
        raise ModelError(f"{WHERE}: '{runs.system.name}' has no states; expected some that return")
    if section is not None:
        return Section(runs, start, section, firings, max_period)
    if firings != 1:
        raise ModelError(f"{WHERE}: firings={firings} counts those of a section; give its name")
    if period is not None:
        return FixedPeriod(runs, start, period)
    return FreePeriod(runs, *guess_period(runs, start, max_period))


def _orbit(
    closing: Closing,
    found: Found,
    notes: list[str],
    wrt: tuple[str, ...],
    recorded_signals: Mapping[str, OutputPort | str] | Sequence[str] | None,
) -> PeriodicOrbit:
    arc, converged = found.arc, found.status == "converged"
    context = closing.on_section(arc) if isinstance(closing, Section) else arc.begin
    spectrum = multipliers_of(closing, arc)
    notes += spectrum.notes if converged else []
    signals = {"dense_output": True, "recorded_signals": recorded_signals}
    count = len(closing.states.continuous)
    by, names = _implicit(closing, arc, context, wrt, spectrum.isolated)
    return PeriodicOrbit(
        context=context,
        x0=np.array(context.continuous_state),
        names=tuple(closing.states.continuous),
        period=arc.period,
        multipliers=spectrum.values if converged else np.full_like(spectrum.values, np.nan),
        trivial=spectrum.trivial,
        monodromy=arc.monodromy[np.ix_(closing.active, closing.active)],
        return_map=arc.by_start[np.ix_(closing.active, closing.active)],
        residual=float(np.max(np.abs(arc.end - arc.start), initial=0.0)),
        status=found.status,
        message="" if converged else found.message,
        iterations=found.iterations,
        notes=tuple(notes),
        results=closing.runs.plain(context, context.time + arc.period, **signals),
        parameters=names,
        _by=lambda: tuple(each[:count] if each.ndim == 2 else each for each in by()),
    )


def _implicit(
    closing: Closing, arc: Arc, context: _core.Context, wrt: tuple[str, ...], isolated: bool
) -> tuple[Callable[[], tuple[np.ndarray, np.ndarray]], tuple[str, ...]]:
    """A function for the derivatives of start and period by parameters, and the names of these."""
    full = closing.arc(arc.begin, np.append(arc.start[closing.active], arc.period), wrt)

    @cache
    def by() -> tuple[np.ndarray, np.ndarray]:
        if not isolated:
            raise SimulationError(
                f"{WHERE}: t = {context.time} s: a multiplier is 1, so the orbit is one of many "
                "and has no derivative by a parameter; expected an isolated orbit",
                context.time,
            )
        start, time = closing.implicit(full)
        if isinstance(closing, Section):
            start = closing.to_section(context, full, start)
        return start, time

    return by, full.parameters


def _require_same(closing: Closing, arc: Arc) -> None:
    """Refuses a system that does not do the same at another time."""
    other = closing.again(arc)
    growth = max(1.0, float(np.linalg.norm(arc.by_start[np.ix_(closing.active, closing.active)])))
    bound = SAME * growth * closing.sizes(arc)[closing.active]
    change = np.abs(other.end - arc.end)[closing.active]
    moved = abs(other.period - arc.period) > SAME * growth * arc.period
    if not moved and np.all(change <= bound) and arc.final.modes == other.final.modes:
        return
    name = closing.states.names[closing.active[int(np.argmax(change - bound))]]
    time = other.begin.time
    if closing.autonomous:
        raise ModelError(
            f"{WHERE}: t = {time} s: the same start leads elsewhere ('{name}') than at "
            f"t = {arc.begin.time} s, so the time moves the system; expected an autonomous one: "
            "give period=..., the period of the drive. A discrete state that keeps a time must "
            "keep the time of an event itself"
        )
    raise ModelError(
        f"{WHERE}: t = {time} s: '{name}' returns after the first {arc.period} s and not after the "
        "second, so this is no period of the drive; expected its period or a multiple of it"
    )


def _require_parameters(closing: Closing, wrt: Sequence[str]) -> None:
    if isinstance(wrt, str):
        raise ModelError(f"{WHERE}: wrt: expected a list of names, found {wrt!r}; give [{wrt!r}]")
    for name in wrt:
        if str(name).split("[")[0].split(".")[-1] in ("x", "z"):
            raise ModelError(
                f"{WHERE}: wrt: '{name}' is a start value, which the search finds; "
                "expected a parameter"
            )


def _require_numbers(
    period: float | None,
    firings: int,
    max_period: float,
    transient: float,
    tolerance: float,
    max_iterations: int,
) -> None:
    positive = {"period": 1.0 if period is None else period, "max_period": max_period}
    for name, value in (positive | {"tolerance": tolerance}).items():
        if not (isinstance(value, (int, float, np.number)) and 0.0 < value < np.inf):
            raise ModelError(f"{WHERE}: {name}: expected a positive number, found {value!r}")
    if not (isinstance(transient, (int, float, np.number)) and 0.0 <= transient < np.inf):
        raise ModelError(f"{WHERE}: transient: expected a time of 0 s or more, found {transient!r}")
    for name, count in {"firings": firings, "max_iterations": max_iterations}.items():
        if not (is_whole(count) and count >= 1):
            raise ModelError(f"{WHERE}: {name}: expected an integer of 1 or more, found {count!r}")
