"""The covariance of fitted parameters."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from saltus.errors import ModelError

__all__ = ["Uncertainty", "require_loss", "slopes_of", "uncertainty"]

Slopes = tuple[np.ndarray, np.ndarray]
LOSSES: dict[str, Callable[[np.ndarray], Slopes]] = {
    "linear": lambda z: (np.ones_like(z), np.zeros_like(z)),
    "soft_l1": lambda z: ((1 + z) ** -0.5, -0.5 * (1 + z) ** -1.5),
    "huber": lambda z: (
        np.maximum(z, 1.0) ** -0.5,
        np.where(z > 1.0, -0.5 * np.maximum(z, 1.0) ** -1.5, 0.0),
    ),
    "cauchy": lambda z: (1 / (1 + z), -1 / (1 + z) ** 2),
    "arctan": lambda z: (1 / (1 + z**2), -2 * z / (1 + z**2) ** 2),
}
"""the first and second derivative of the loss rho(z), as in `scipy.optimize.least_squares`"""


class Uncertainty(NamedTuple):
    """The covariance of parameters, inf and nan where the data do not determine them."""

    covariance: np.ndarray
    undetermined: tuple[tuple[int, ...], ...]
    """sets of parameters of which the data leave a combination open"""
    saddle: bool = False
    """no minimum: the second derivatives of the loss are not positive there"""


def slopes_of(loss: Any, z: np.ndarray) -> Slopes:
    """rho'(z) and rho''(z)."""
    if callable(loss):
        _, first, second = np.asarray(loss(z), dtype=float)
        return first, second
    return LOSSES[loss](z)


def uncertainty(
    residuals: np.ndarray,
    jacobian: np.ndarray,
    *,
    rtol: float,
    loss: Any = "linear",
    f_scale: float = 1.0,
    absolute: bool = False,
) -> Uncertainty:
    """The covariance of the parameters u of residuals r(u) with the Jacobian J.

    With the loss 'linear' it is s² (JᵀJ)⁻¹, s² = rᵀr / (n - p), or s² = 1 with `absolute`. With
    another loss it is H⁻¹ B H⁻¹ n / (n - p), H = Jᵀ diag(rho' + 2 z rho'') J,
    B = Jᵀ diag(rho'² r²) J, z = (r / f_scale)² (Huber, 5th Berkeley Symposium 1, 1967).

    A direction in which the Jacobian, with columns of length 1, has a singular value below `rtol`
    of the largest is undetermined: its derivatives are known no better.
    """
    n, p = jacobian.shape
    length = np.linalg.norm(jacobian, axis=0)
    scaled = jacobian / np.where(length > 0.0, length, 1.0)
    _, values, vectors = np.linalg.svd(scaled, full_matrices=True)
    values = np.append(values, np.zeros(p - len(values)))
    least = max(rtol, max(n, p) * float(np.finfo(float).eps))
    kept = values > least * values[0]
    known = vectors[kept].T
    inner, saddle = _within(residuals, scaled @ known, loss, f_scale, absolute, n - p)
    length = np.where(length > 0.0, length, 1.0)
    covariance = known @ inner @ known.T / np.outer(length, length)
    open_sets = tuple(_taking_part(row) for row in vectors[~kept])
    involved = sorted({k for each in open_sets for k in each})
    if saddle or (n == p and not absolute):
        involved = list(range(p))
    covariance[involved, :] = covariance[:, involved] = np.nan
    covariance[involved, involved] = np.inf
    return Uncertainty(covariance, open_sets, saddle)


def _taking_part(direction: np.ndarray) -> tuple[int, ...]:
    """The parameters that an undetermined direction moves, beyond its own rounding."""
    return tuple(int(k) for k in np.flatnonzero(np.abs(direction) > 1e-3))


def _within(
    residuals: np.ndarray, jacobian: np.ndarray, loss: Any, f_scale: float, absolute: bool, dof: int
) -> tuple[np.ndarray, bool]:
    """The covariance within the directions that the data determine; the columns of `jacobian`."""
    n, rank = jacobian.shape
    if loss == "linear":
        scale = 1.0 if absolute else float(residuals @ residuals) / max(dof, 1)
        _, values, vectors = np.linalg.svd(jacobian, full_matrices=False)
        return scale * (vectors.T / values**2) @ vectors, False
    z = (residuals / f_scale) ** 2
    first, second = slopes_of(loss, z)
    curvature = jacobian.T @ ((first + 2 * z * second)[:, None] * jacobian)
    if rank and np.linalg.eigvalsh(curvature)[0] <= 0.0:
        return np.zeros((rank, rank)), True
    spread = jacobian.T @ (((first * residuals) ** 2)[:, None] * jacobian)
    inverse = np.linalg.inv(curvature)
    return inverse @ spread @ inverse * n / max(dof, 1), False


def require_loss(loss: Any) -> None:
    """ModelError for a loss that there is not."""
    if not callable(loss) and loss not in LOSSES:
        raise ModelError(
            f"fit: loss: expected one of {', '.join(LOSSES)}, or a function, found {loss!r}"
        )
