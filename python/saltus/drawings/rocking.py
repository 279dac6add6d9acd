"""The rocking block."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus.drawings.drawing import BLUE, Drawing, Which, pick
from saltus.drawings.shapes import bare, frame, ground, polygon
from saltus.results.animation.film import Film, Moment

__all__ = ["rocking_block"]


def rocking_block(angle: Which = 0, *, alpha: float = 0.2, magnify: float = 1.0) -> Drawing:
    """A block that rocks on its two lower edges.

    Parameters
    ----------
    angle : str or int
        [rad] positive to the right: the block turns about its right edge, else about its left one.
    alpha : float
        [rad] between the diagonal and the upright side.
    magnify : float
        The drawn angle is so many times the true one.

    Examples
    --------
    >>> import saltus
    >>> run = saltus.scene("rocking-block", t_end=1.0).simulate(dense_output=True)
    >>> run.animate(saltus.drawings.rocking_block(), fps=10)
    <Animation: 11 frames, 1 s at 10 frames a second>
    """
    half, height = np.sin(alpha), 2.0 * np.cos(alpha)  # of a diagonal of length 2
    corners = np.array([(-half, 0.0), (half, 0.0), (half, height), (-half, height)])

    def prepare(ax: Any, film: Film) -> None:
        frame(ax, (-1.5, 1.5), (-0.25, height + 0.35))
        bare(ax)
        ground(ax, (-1.5, 1.5), (0.0, 0.0), 0.15)

    def draw(ax: Any, now: Moment) -> None:
        theta = magnify * pick(now, angle)
        edge = np.array([half if theta >= 0.0 else -half, 0.0])
        c, s = np.cos(theta), np.sin(theta)
        turned = (corners - edge) @ np.array([[c, -s], [s, c]]) + edge
        polygon(ax, turned, BLUE)

    return Drawing(draw, prepare)
