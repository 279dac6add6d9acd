"""Derivatives of residuals by differences of runs, where a run has none."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

__all__ = ["difference", "step_of"]

Residuals = Callable[[np.ndarray], np.ndarray | None]
"""of the numbers of the optimizer; None if the run fails"""


def step_of(value: float, rtol: float) -> float:
    """The step of a central difference of runs with the relative tolerance `rtol`.

    With an error rtol of each run and h² of the difference their sum is least near the cube root of
    rtol (Dennis and Schnabel, Numerical Methods for Unconstrained Optimization, 1983, 5.6).
    """
    relative: float = max(rtol, float(np.finfo(float).eps)) ** (1.0 / 3.0)
    return relative * max(abs(value), 1e-3)


def difference(
    residuals: Residuals,
    at: np.ndarray,
    here: np.ndarray,
    column: int,
    step: float,
    bounds: tuple[float, float],
) -> np.ndarray | None:
    """The derivative of the residuals by one number: central within the bounds, else one-sided.

    `here` are the residuals at `at`. None if the runs on both sides fail.
    """
    sides: list[tuple[float, np.ndarray]] = []
    for sign in (1.0, -1.0):
        moved = at.copy()
        moved[column] = at[column] + sign * step
        found = residuals(moved) if bounds[0] <= moved[column] <= bounds[1] else None
        if found is not None:
            sides.append((float(moved[column]), found))
    if not sides:
        return None
    if len(sides) == 1:
        sides.append((float(at[column]), here))
    (a, right), (b, left) = sides
    slope: np.ndarray = (right - left) / (a - b)
    return slope
