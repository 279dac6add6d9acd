"""Whether a fit has ended where its cost jumps, and not at a minimum."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

__all__ = ["meets_jump"]

STEEP = 1e-2
"""the cosine between the residuals and a column of the Jacobian below which they have no part along
it; ftol = 1e-8 ends a smooth fit below 2e-4
"""
FAR, NEAR = 1e-4, 1e-6
"""relative steps down the gradient; a smooth cost changes a hundredth or less as much by the second
as by the first, a cost that jumps as much
"""

Residuals = Callable[[np.ndarray], np.ndarray | None]


def meets_jump(
    residuals: Residuals,
    u: np.ndarray,
    here: np.ndarray,
    jacobian: np.ndarray,
    bounds: tuple[np.ndarray, np.ndarray],
    noise: float,
) -> bool:
    """Whether the cost at `u` has a gradient, and a jump or a failing run right behind it.

    `here` are the residuals at `u`, whose length is known to `noise`.
    """
    length, columns = np.linalg.norm(here), np.linalg.norm(jacobian, axis=0)
    if length <= 10.0 * noise:
        return False
    slope = jacobian.T @ here
    inside = (columns > 0.0) & (u - np.sign(slope) * 1e-6 * np.abs(u) > bounds[0])
    inside &= u - np.sign(slope) * 1e-6 * np.abs(u) < bounds[1]
    steep = inside & (np.abs(slope) > STEEP * length * columns)
    if not steep.any():
        return False
    direction = np.where(steep, -slope / np.where(steep, columns, 1.0) ** 2, 0.0)
    direction /= np.max(np.abs(direction) / np.maximum(np.abs(u), 1e-3))
    found = [residuals(np.clip(u + step * direction, *bounds)) for step in (FAR, NEAR)]
    if any(each is None for each in found):
        return True
    far, near = (abs(float(each @ each) - length**2) for each in found if each is not None)
    return bool(near > 0.1 * far and near > 10.0 * noise * length)
