"""`lyapunov`: the spectrum of Lyapunov exponents, through events."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus._engine import core_context
from saltus._whole import is_whole
from saltus.errors import ModelError
from saltus.exponents.averages import running, standard_errors
from saltus.exponents.piece import NotALabel, Pieces, require_moving
from saltus.exponents.spectrum import LyapunovSpectrum
from saltus.exponents.walk import Growth, walk
from saltus.orbits.runs import Runs
from saltus.orbits.states import States
from saltus.system import System

__all__ = ["lyapunov"]

WHERE = "lyapunov"
PIECES = 200
"""pieces at least, so that the batches of the standard errors have some each"""
RESOLVED = 1e-6
"""a relative growth over the whole time that the errors of the derivatives hide"""


def lyapunov(
    system: System,
    context: _core.Context | None = None,
    *,
    time: float,
    transient: float = 0.0,
    every: float | None = None,
    count: int | None = None,
    tolerance: float = 0.02,
    rtol: ArrayLike = 1e-9,
    atol: ArrayLike = 1e-11,
    ode_solver_method: str = "auto",
    **options: Any,
) -> LyapunovSpectrum:
    """The Lyapunov exponents, the mean rates of ln |dx(t)| for small changes dx of a state.

    The run is made in pieces. The derivative D of the end of a piece by its start goes through
    all events, with the jump of each (docs/derivatives.md; P. Mueller, Chaos, Solitons & Fractals 5
    (1995) 1671). Orthonormal directions Q are carried on by D Q = Q' R, and the exponents are the
    sums of ln |r_ii| divided by the time (G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn,
    Meccanica 15 (1980) 9; I. Shimada, T. Nagashima, Prog. Theor. Phys. 61 (1979) 1605).

    The pieces are so short that two directions grow apart by 1000 or less in one. In the first
    tenth of the time the directions only turn towards their own ones; it does not count.

    Parameters
    ----------
    system : System
        A leaf or a diagram with at most 200 continuous states, autonomous or driven.
    context : Context, optional
        The start; by default `system.create_context()`.
    time : float
        [s] The length of the run, after the transient. The standard error falls as its root.
    transient : float
        [s] A run before, without derivatives: the way to the attractor.
    every : float, optional
        [s] The longest piece, by default a 200th of the time.
    count : int, optional
        The number of exponents, from the largest on; by default all.
    tolerance : float
        Converged is what has standard errors of at most this part of each exponent, or, where an
        exponent may be zero, of the smallest that is not.
    rtol, atol, ode_solver_method, **options
        As for `simulate`.

    Returns
    -------
    LyapunovSpectrum
        Also if the averages have not converged; `converged` says so, `message` why. Discrete states
        count as states, but for labels, whole numbers that depend on no other state.

    Raises
    ------
    ModelError
        For an argument that makes no sense, a system with a part that has no derivatives, and a
        start with a block at rest.
    SimulationError
        If a derivative does not exist (a guard that grazes zero, for example), with the event, the
        time and the reason; if the run ends before its time, or comes to rest for good. From a run
        that ends badly as from `simulate`.

    Examples
    --------
    >>> import saltus
    >>> lorenz = saltus.system_of(
    ...     lambda t, x: [
    ...         10 * (x[1] - x[0]), x[0] * (28 - x[2]) - x[1], x[0] * x[1] - 8 / 3 * x[2]
    ...     ],
    ...     [1.0, 1.0, 20.0],
    ... )
    >>> found = saltus.lyapunov(lorenz, time=200.0, transient=20.0)
    >>> round(found.sum, 5), bool(0.8 < found.exponents[0] < 1.0)  # exactly -(10 + 1 + 8/3)
    (-13.66667, True)
    """
    _require_numbers(time=time, transient=transient, every=every, tolerance=tolerance)
    solver = {"rtol": rtol, "atol": atol, "ode_solver_method": ode_solver_method}
    runs = Runs(WHERE, system, solver | options)
    start = core_context(system.create_context() if context is None else context)
    start = runs.plain(start, start.time + transient).context
    states = States(start)
    require_moving(WHERE, start, states.continuous)
    _require_count(count, len(states), system)
    longest = min(time / PIECES, time if every is None else every)
    growth, pieces = _measured(runs, start, states, float(time), longest, count)
    return _spectrum(growth, pieces, start.time, tolerance)


def _measured(
    runs: Runs,
    start: _core.Context,
    states: States,
    time: float,
    longest: float,
    count: int | None,
) -> tuple[Growth, Pieces]:
    """The growth with the labels that there are: it begins anew where one turns out to be none."""
    values = states.of(start)
    labels = values % 1.0 == 0.0
    labels[: len(states.continuous)] = False
    while True:
        _require_count(count, len(states) - int(np.sum(labels)) if count else 1, runs.system)
        pieces = Pieces(runs, start, labels)
        directions = count or len(pieces.active)
        try:
            return walk(pieces, start, time, longest, directions), pieces
        except NotALabel as found:
            labels = labels.copy()
            labels[found.states] = False


def _spectrum(growth: Growth, pieces: Pieces, begin: float, tolerance: float) -> LyapunovSpectrum:
    durations, logs = growth.durations[growth.aligned :], growth.logs[growth.aligned :]
    history, errors = running(durations, logs), standard_errors(durations, logs)
    order = np.argsort(-history[-1], kind="stable")
    history, errors = history[:, order], errors[order]
    message = _unconverged(history[-1], errors, float(np.sum(durations)), tolerance)
    values = pieces.states.of(growth.end)
    labels = {pieces.states.names[i]: float(values[i]) for i in np.flatnonzero(pieces.labels)}
    return LyapunovSpectrum(
        exponents=history[-1].copy(),
        errors=errors,
        converged=not message,
        message=message,
        begin=begin + float(np.sum(growth.durations[: growth.aligned])),
        times=begin + np.cumsum(growth.durations)[growth.aligned :],
        history=history,
        states=tuple(pieces.names),
        frozen=labels,
        context=growth.end,
    )


def _unconverged(exponents: np.ndarray, errors: np.ndarray, time: float, tolerance: float) -> str:
    """Which exponent is known worst, if that is not well enough: each one is compared with its own
    size, and one that may be zero with the smallest that is not.
    """
    sizes = np.abs(exponents)
    clear = sizes[np.isfinite(sizes) & (sizes > 2.0 * errors) & (sizes > RESOLVED / time)]
    least = float(np.min(clear)) if clear.size else 1.0 / time
    allowed = tolerance * np.where(np.isfinite(sizes), np.maximum(sizes, least), least)
    worst = int(np.argmax(errors / allowed))
    if errors[worst] <= allowed[worst]:
        return ""
    return (
        f"exponent {worst} has the standard error {errors[worst]:.1e} 1/s; expected at most "
        f"{allowed[worst]:.1e} 1/s: give a longer time, or a larger tolerance"
    )


def _require_count(count: int | None, most: int, system: System) -> None:
    if not most:
        raise ModelError(f"{WHERE}: '{system.name}' has no states; expected some that move")
    if count is not None and not (is_whole(count) and 1 <= count <= most):
        raise ModelError(
            f"{WHERE}: count: expected an integer from 1 to {most}, the number of states, found "
            f"{count!r}"
        )


def _require_numbers(
    *, time: float, transient: float, every: float | None, tolerance: float
) -> None:
    positive = {"time": time, "every": 1.0 if every is None else every, "tolerance": tolerance}
    for name, value in positive.items():
        if not (isinstance(value, (int, float, np.number)) and 0.0 < value < np.inf):
            raise ModelError(f"{WHERE}: {name}: expected a positive number, found {value!r}")
    if not (isinstance(transient, (int, float, np.number)) and 0.0 <= transient < np.inf):
        raise ModelError(f"{WHERE}: transient: expected a time of 0 s or more, found {transient!r}")
