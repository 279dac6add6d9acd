"""The search for an operating point: least squares within bounds, then Newton's method."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from saltus.operating.judge import Scales, is_solution
from saltus.operating.problem import Point, Problem
from saltus.results.tables import extra

__all__ = ["Found", "search"]

LAST_STEPS = 20
"""Newton steps at most: a simple root needs some three after `least_squares`"""
EPS = float(np.finfo(float).eps)


class Found(NamedTuple):
    """How a search ended."""

    first: Point
    point: Point
    scales: Scales
    status: str


def search(
    problem: Problem,
    start: np.ndarray,
    bounds: tuple[np.ndarray, np.ndarray],
    tolerance: float,
    max_nfev: int | None,
) -> Found:
    """The least squares of the residuals from a start, and Newton steps to their rounding.

    `scipy.optimize.least_squares` (method 'trf': Branch, Coleman and Li, SIAM J. Sci. Comput. 21,
    1999) gets rows and columns of size 1.
    """
    first = problem.at(start)
    scales = Scales.of(first, bounds)
    found = _least_squares(problem, first, bounds, scales, max_nfev)
    end = problem.at(np.clip(found.x * scales.unknowns, *bounds))
    end = _newton(problem, end, bounds, scales)
    scales = scales.with_end(end)
    if is_solution(end, scales, tolerance):
        return Found(first, end, scales, "converged")
    return Found(first, end, scales, "max_nfev" if found.status == 0 else "stalled")


def _least_squares(
    problem: Problem,
    first: Point,
    bounds: tuple[np.ndarray, np.ndarray],
    scales: Scales,
    max_nfev: int | None,
) -> Any:
    last = first

    def at(w: np.ndarray) -> Point | None:
        nonlocal last
        values = np.clip(w * scales.unknowns, *bounds)
        if not np.array_equal(values, last.values):
            point = problem.tried(values)
            if point is None:
                return None
            last = point
        return last

    def residual(w: np.ndarray) -> np.ndarray:
        # an infinite residual makes the step shorter
        point = at(w)
        return np.full(len(first.residual), np.inf) if point is None else point.residual / rows

    def jacobian(w: np.ndarray) -> np.ndarray:
        point = at(w)
        assert point is not None  # asked for at accepted points only
        return np.asarray(point.jacobian * scales.unknowns / rows[:, None])

    rows = scales.rows
    lower, upper = (bound / scales.unknowns for bound in bounds)
    return extra("scipy.optimize", "saltus.trim").least_squares(
        residual,
        np.clip(first.values / scales.unknowns, lower, upper),
        jac=jacobian,
        bounds=(lower, upper),
        xtol=10.0 * EPS,
        ftol=10.0 * EPS,
        gtol=10.0 * EPS,
        max_nfev=max_nfev,
    )


def _newton(
    problem: Problem, point: Point, bounds: tuple[np.ndarray, np.ndarray], scales: Scales
) -> Point:
    """The best of a few Newton steps: `least_squares` stays off the bounds, and ends early at a
    small cost.
    """
    for _ in range(LAST_STEPS):
        scaled = point.jacobian * scales.unknowns / scales.rows[:, None]
        step = np.linalg.lstsq(scaled, -point.residual / scales.rows, rcond=1e-10)[0]
        values = np.clip(point.values + step * scales.unknowns, *bounds)
        better = problem.tried(values)
        if better is None or not _norm(better, scales) < _norm(point, scales):
            break
        point = better
        if np.max(np.abs(step)) <= EPS:
            break
    return point


def _norm(point: Point, scales: Scales) -> float:
    return float(np.linalg.norm(point.residual / scales.rows))
