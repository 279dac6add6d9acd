"""`walk`: a long run in pieces, with the growth of each direction in each of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from saltus import _core
from saltus.exponents.piece import Piece, Pieces

__all__ = ["Growth", "walk"]

ALIGNED = 0.1
"""the part of the time in which the directions only turn towards their own ones"""
WANTED = np.log(1e3)
"""by how much two directions may grow apart in a piece; the derivatives have an error of 1e-9 to
1e-10 of the largest, so the smaller direction is known to 1e-6
"""
MOST = np.log(1e6)
"""beyond this a piece is divided"""
DIVISIONS = 20
"""halvings of the longest piece. A direction that is lost in a piece that short is lost at an
event: the matrix of its jump is singular
"""
GROWTH = 2.0


@dataclass(frozen=True)
class Growth:
    """ln r_ii of each piece, with D Q = Q' R."""

    durations: np.ndarray
    """(pieces,) [s]"""
    logs: np.ndarray
    """(pieces, directions); -inf where an event leaves nothing of a direction"""
    aligned: int
    """the number of the first pieces that do not count"""
    end: _core.Context


def walk(
    pieces: Pieces, start: _core.Context, time: float, longest: float, directions: int
) -> Growth:
    """Carries `directions` orthonormal vectors along the run of `time` seconds from `start`, and
    makes them orthonormal again after each piece.
    """
    frame = _generic(len(pieces.active))[:, :directions]
    end, context, duration = start.time + time, start, longest
    lost = np.zeros(directions, dtype=bool)
    durations: list[float] = []
    logs: list[np.ndarray] = []
    aligned = 0
    while (left := end - context.time) > 1e-9 * time:
        # two pieces of the same length in place of a long one and a rest
        duration = min(duration, left if left <= duration else max(0.5 * left, longest * 1e-9))
        piece, frame, grown = _divided(pieces, context, duration, end, frame, lost, longest)
        context = piece.end
        durations.append(piece.duration)
        logs.append(np.where(lost, -np.inf, grown))
        if context.time <= start.time + ALIGNED * time:
            aligned = len(logs)
        apart = max(_apart(grown, lost), 1e-3)
        duration = min(longest, piece.duration * min(GROWTH, WANTED / apart))
        duration = max(duration, longest * 2.0**-DIVISIONS)
    return Growth(np.array(durations), np.array(logs), aligned, context)


def _divided(
    pieces: Pieces,
    context: _core.Context,
    duration: float,
    end: float,
    frame: np.ndarray,
    lost: np.ndarray,
    longest: float,
) -> tuple[Piece, np.ndarray, np.ndarray]:
    """A piece in which the directions do not grow too far apart, the frame after it, and ln r_ii.
    Notes in `lost` the directions of which an event leaves nothing.
    """
    while True:
        piece = pieces.run(context, duration, end)
        turned, grown = _orthonormal(piece.matrix @ frame)
        apart = _apart(grown, lost)
        shortest = piece.rested or duration <= longest * 2.0**-DIVISIONS
        if apart <= MOST or (shortest and not piece.has_events):
            return piece, turned, grown
        if shortest:
            lost |= np.isneginf(grown) | (grown < np.max(grown) - MOST)
            return piece, turned, grown
        duration *= 0.5


def _orthonormal(vectors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    frame, upper = np.linalg.qr(vectors)
    with np.errstate(divide="ignore"):
        return frame, np.log(np.abs(np.diagonal(upper)))


def _apart(grown: np.ndarray, lost: np.ndarray) -> float:
    """ln of the largest over the smallest growth of the directions that are not lost."""
    kept = grown[~lost]
    return float(np.ptp(kept)) if kept.size and np.isfinite(kept).all() else _apart_of_none(kept)


def _apart_of_none(kept: np.ndarray) -> float:
    return np.inf if kept.size else 0.0


def _generic(n: int) -> np.ndarray:
    """(n, n) orthonormal directions, the same in each run, none along a state."""
    return np.asarray(np.linalg.qr(np.random.default_rng(1980).standard_normal((n, n)))[0])
