"""`multipliers_of`: the Floquet multipliers of an orbit, and what they say about the result."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from saltus.orbits.arc import Arc
from saltus.orbits.closing import Closing

__all__ = ["Spectrum", "multipliers_of"]

OFF = 1e-5
"""the error of the trivial multiplier above which a note says it; that of a run is near 1e-8"""
ONE = 1e-6
"""the smallest singular value of M - 1, as part of the norm of M, below which a multiplier is 1: a
double one may be further from 1 by the square root of the errors of M
"""


@dataclass(frozen=True)
class Spectrum:
    values: np.ndarray
    """complex, the largest first; of an autonomous system without the trivial one"""
    trivial: float
    isolated: bool
    """whether no multiplier is 1, so that the orbit is not one of many"""
    notes: list[str]


def multipliers_of(closing: Closing, arc: Arc) -> Spectrum:
    """The eigenvalues of the monodromy matrix M; for an autonomous system those of M on the states
    modulo the flow f: M f = f, so with columns Q across f the others are those of Q^T M Q.
    """
    active = closing.active
    matrix, notes, trivial = arc.monodromy[np.ix_(active, active)], [], np.nan
    if closing.autonomous:
        start, end = arc.flow_start[active], arc.flow_end[active]
        trivial, off = _trivial(matrix, start, end)
        if not off <= OFF:
            notes.append(
                f"the flow returns with an error of {off:.1e} (the trivial multiplier is "
                f"{trivial:.8g}, exactly 1): tighten rtol, or look for a part that the "
                "derivatives do not see"
            )
        across = np.linalg.qr(end[:, None], mode="complete")[0][:, 1:]
        matrix = across.T @ matrix @ across
    values = np.linalg.eigvals(matrix).astype(complex)
    values = values[np.argsort(-np.abs(values), kind="stable")]
    isolated = _isolated(matrix)
    if not isolated:
        notes.append(
            "a multiplier is 1: the orbit is one of many, as where a quantity is conserved"
        )
    return Spectrum(values, trivial, isolated, notes)


def _isolated(matrix: np.ndarray) -> bool:
    if not matrix.size:
        return True
    least = np.linalg.svd(matrix - np.eye(len(matrix)), compute_uv=False)[-1]
    return bool(least > ONE * max(1.0, float(np.linalg.norm(matrix, 2))))


def _trivial(matrix: np.ndarray, start: np.ndarray, end: np.ndarray) -> tuple[float, float]:
    """The factor of M f along f, and the relative error of M f = f."""
    square = float(end @ end)
    if square == 0.0:
        return np.nan, np.inf
    image = matrix @ start
    return float(end @ image) / square, float(np.linalg.norm(image - end) / np.sqrt(square))
