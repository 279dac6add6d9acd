"""Newton's method for F(u) = 0, damped where the full step leaves the domain or does not help."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from saltus.errors import SimulationError
from saltus.orbits.arc import Arc
from saltus.orbits.closing import Closing
from saltus.orbits.stamps import first_arc

__all__ = ["Found", "search"]

LEAST = 2.0**-12
"""the shortest part of a Newton step that is tried"""
STARTS = 8
"""returns that are followed until all modes and labels are as they were"""
SINGULAR = 1e-8
"""singular values below this part of the largest are errors of the derivatives, near 1e-9"""
NOISE = 1e3
"""tolerances below which a Newton step is the error of the runs, and no step helps any more"""


@dataclass(frozen=True)
class Found:
    """Where the search ended."""

    arc: Arc
    status: str
    """'converged', 'max_iterations' or 'stalled'"""
    message: str
    iterations: int


def search(closing: Closing, tolerance: float, most: int) -> Found:
    """Newton's method from the unknowns of `closing`, with the monotonicity test in units of the
    Newton step: |F'^-1 F(u + c d)| <= (1 - c/4) |d| (P. Deuflhard, Newton Methods for Nonlinear
    Problems, Springer 2004, section 3.3).
    """
    arc, message = _begin(closing), ""
    unknowns = closing.unknowns
    for iteration in range(most):
        step = _solved(closing, arc, closing.residual(arc))
        size = _size(closing, arc, step)
        if size <= tolerance:
            return _polished(closing, arc, unknowns + step, iteration)
        better, factor, message = _damped(closing, arc, unknowns, step)
        if better is None:
            if size <= NOISE * tolerance:
                note = f"the Newton step stays at {size:.1e} of the states: the error of the runs"
                return Found(arc, "converged", note, iteration)
            return Found(arc, "stalled", message, iteration)
        arc, unknowns = better, unknowns + factor * step
    size = _size(closing, arc, _solved(closing, arc, closing.residual(arc)))
    if size <= tolerance:
        return Found(arc, "converged", "", most)
    message = f"after {most} steps the next one has {size:.1e} of the size of the states"
    return Found(arc, "max_iterations", message, most)


def _polished(closing: Closing, arc: Arc, unknowns: np.ndarray, iterations: int) -> Found:
    """One more full step if it brings the return closer: it costs little, and squares the error."""
    better, _ = _tried(closing, unknowns)
    if better is not None:
        ends = [np.abs(closing.residual(each)).max(initial=0.0) for each in (arc, better)]
        if ends[1] < ends[0]:
            return Found(better, "converged", "", iterations + 1)
    return Found(arc, "converged", "", iterations)


def _begin(closing: Closing) -> Arc:
    """The first arc from which modes and labels return."""
    reason = ""
    for _ in range(STARTS):
        arc = first_arc(closing)
        closing.take_labels(arc)
        reason = arc.unreturned(closing.states, closing.labels)
        if not reason:
            return arc
        closing.move_to_end(arc)
    where, time = closing.runs.where, closing.base.time
    raise SimulationError(
        f"{where}: t = {time} s: {reason}, in each of {STARTS} returns; expected that all modes "
        "and discrete states return: reset what counts, or choose more firings or a longer period",
        time,
    )


def _solved(closing: Closing, arc: Arc, residual: np.ndarray) -> np.ndarray:
    """The Newton step; the shortest one, in units of the sizes, where the matrix is singular."""
    sizes = _sizes(closing, arc)
    return np.asarray(
        sizes * np.linalg.lstsq(closing.matrix(arc) * sizes, -residual, rcond=SINGULAR)[0]
    )


def _sizes(closing: Closing, arc: Arc) -> np.ndarray:
    sizes = closing.scale(arc)
    return np.where(sizes > 0.0, sizes, 1.0)


def _size(closing: Closing, arc: Arc, step: np.ndarray) -> float:
    return float(np.max(np.abs(step) / _sizes(closing, arc), initial=0.0))


def _damped(
    closing: Closing, arc: Arc, unknowns: np.ndarray, step: np.ndarray
) -> tuple[Arc | None, float, str]:
    """The arc after the largest part of the step that helps, and that part; None and the reason if
    there is none.
    """
    factor, message = 1.0, ""
    size = _size(closing, arc, step)
    while factor >= LEAST:
        trial, message = _tried(closing, unknowns + factor * step)
        if trial is not None:
            next_step = _solved(closing, arc, closing.residual(trial))
            if _size(closing, arc, next_step) <= (1.0 - 0.25 * factor) * size:
                return trial, factor, ""
            message = "no part of the Newton step brings the return closer to the start"
        factor *= 0.5
    return None, 0.0, message


def _tried(closing: Closing, unknowns: np.ndarray) -> tuple[Arc | None, str]:
    """The arc from the unknowns; None and the reason where there is none: outside of the domain a
    function may raise whatever it likes.
    """
    try:
        arc = closing.at(unknowns)
    except Exception as error:
        return None, str(error)
    reason = arc.unreturned(closing.states, closing.labels)
    return (None, reason) if reason else (arc, "")
