"""Judgement of a search: its scales, convergence, rank, and the guards that it crossed."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from saltus.operating.problem import Point, Problem

__all__ = ["Scales", "beside", "crossed_guards", "is_solution", "margin_of", "undetermined"]

NOISE = 1e-12
"""[of the unit of an unknown] what its rounding may be: an unknown whose solution is 0 comes out
as some 1e-17 beside others of size 1
"""
RANK = 1e-8
"""[of the largest singular value] a smaller one is zero: exact derivatives have an error of 1e-15
of their terms, central differences of 1e-10
"""
BESIDE = 1e-6
"""[of the unit of an unknown] how far a second point is, which shows what a curvature does. At a
double root the Jacobian is as small as the error of the root, near 1e-8
"""
MARGIN = 1e-7
"""[of the largest entry of A] a real part below it has no sign: a double eigenvalue has an error of
the square root of the rounding
"""
PART = 1e-6
"""[of the largest entry of a null vector] smaller entries are rounding"""


class Scales(NamedTuple):
    """The sizes of unknowns and of residuals."""

    unknowns: np.ndarray
    """(n,) the unit of each: its size at the start, or the width of its bounds, or 1"""
    sizes: np.ndarray
    """(n,) the largest of its values at the start and at the end"""
    rows: np.ndarray
    """(m,) |J| times the units; 1 for an equation without unknowns"""

    @classmethod
    def of(cls, first: Point, bounds: tuple[np.ndarray, np.ndarray]) -> Scales:
        width = bounds[1] - bounds[0]
        unit = np.where(np.isfinite(width), width, 1.0)
        unknowns = np.where(first.values == 0.0, unit, np.abs(first.values))
        rows = np.abs(first.jacobian) @ unknowns
        return cls(unknowns, np.abs(first.values), np.where(rows > 0.0, rows, 1.0))

    def with_end(self, end: Point) -> Scales:
        """The same with the values at the end."""
        return self._replace(sizes=np.maximum(self.sizes, np.abs(end.values)))


def is_solution(point: Point, scales: Scales, tolerance: float) -> bool:
    """Whether each |r| is below tolerance |J| |v|, or of the rounding of the unknowns.

    v are the sizes of the unknowns on the way. So no residual counts as small because its unit is
    large. A residual below the rounding of the numbers that the equation reads counts as zero.
    """
    by = np.abs(point.jacobian)
    allowed = np.maximum(tolerance * (by @ scales.sizes), NOISE * (by @ scales.unknowns))
    allowed = np.maximum(allowed, point.rounding)
    return bool(np.all(np.abs(point.residual) <= allowed))


def beside(problem: Problem, point: Point, scales: Scales, upper: np.ndarray) -> Point | None:
    """A second point close to the first; None if it is not in the domain."""
    step = BESIDE * np.maximum(scales.sizes, scales.unknowns)
    return problem.tried(
        np.where(point.values + step > upper, point.values - step, point.values + step)
    )


def margin_of(point: Point, other: Point | None) -> float:
    """[1/s] What a real part of a pole has to exceed: its error, and its change to the other point
    with that of the entries of A.
    """
    a = point.matrices.A
    if not a.size:
        return 0.0
    change = 0.0 if other is None else abs(_largest(a) - _largest(other.matrices.A))
    return max(MARGIN * float(np.max(np.abs(a))), change)


def _largest(a: np.ndarray) -> float:
    return float(np.max(np.linalg.eigvals(a).real))


def undetermined(point: Point, other: Point | None, scales: Scales) -> tuple[int, np.ndarray]:
    """The rank of the Jacobian, and the numbers of the unknowns that its null space moves.

    A singular value that is below the change of the Jacobian to the other point counts as zero.
    """
    units = np.maximum(scales.sizes, scales.unknowns)
    rows = np.abs(point.jacobian) @ units
    if other is not None:
        rows = np.maximum(rows, np.abs(other.jacobian) @ units)
    factor = units / np.where(rows > 0.0, rows, 1.0)[:, None]
    scaled = point.jacobian * factor
    _, singular, right = np.linalg.svd(scaled)
    change = 0.0 if other is None else np.linalg.norm((other.jacobian - point.jacobian) * factor, 2)
    rank = int(np.sum(singular > max(RANK * singular[0], float(change))))
    null = np.linalg.norm(right[rank:], axis=0)
    return rank, np.flatnonzero(null > PART)


def crossed_guards(first: Point, end: Point) -> list[tuple[str, float, float]]:
    """The guards with an effect whose value changed its sign in their direction, with the values
    before and after.
    """
    crossed = []
    for (name, before, direction), (_, after, _) in zip(
        first.matrices.guards, end.matrices.guards, strict=True
    ):
        up, down = before < 0.0 < after, before > 0.0 > after
        falls = direction in ("crosses_zero", "positive_then_non_positive")
        rises = direction in ("crosses_zero", "negative_then_non_negative")
        if (up and rises) or (down and falls):
            crossed.append((name, before, after))
    return crossed
