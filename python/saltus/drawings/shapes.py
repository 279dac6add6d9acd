"""Shapes that more than one drawing uses, added to matplotlib's axes in data coordinates."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus.drawings.drawing import INK, PALE
from saltus.results.tables import extra

__all__ = ["bare", "box", "disc", "frame", "ground", "polygon", "rod", "spring"]


def frame(ax: Any, x: tuple[float, float], y: tuple[float, float]) -> None:
    """Sets the limits, with one scale for both directions."""
    ax.set_xlim(*x)
    ax.set_ylim(*y)
    ax.set_aspect("equal")


def bare(ax: Any) -> None:
    """Removes the scales; the drawing says everything."""
    ax.set_xticks([])
    ax.set_yticks([])
    ax.spines[:].set_visible(False)


def disc(ax: Any, x: float, y: float, radius: float, color: str) -> None:
    patches = extra("matplotlib.patches", "a drawing")
    ax.add_patch(patches.Circle((x, y), radius, facecolor=color, edgecolor=INK, linewidth=0.8))


def polygon(ax: Any, corners: ArrayLike, color: str) -> None:
    """A polygon with corners of shape (n, 2)."""
    patches = extra("matplotlib.patches", "a drawing")
    look = {"facecolor": color, "edgecolor": INK, "linewidth": 1.0, "joinstyle": "round"}
    ax.add_patch(patches.Polygon(np.asarray(corners), closed=True, **look))


def box(ax: Any, x: float, y: float, width: float, height: float, color: str) -> None:
    """A box with its middle at (x, y)."""
    w, h = 0.5 * width, 0.5 * height
    polygon(ax, [(x - w, y - h), (x + w, y - h), (x + w, y + h), (x - w, y + h)], color)


def rod(ax: Any, begin: ArrayLike, end: ArrayLike, width: float = 2.0) -> None:
    """A line from one point to another; `width` in points."""
    (x0, y0), (x1, y1) = np.asarray(begin), np.asarray(end)
    ax.plot([x0, x1], [y0, y1], color=INK, linewidth=width, solid_capstyle="round")


def ground(ax: Any, x: ArrayLike, y: ArrayLike, depth: float) -> None:
    """A surface, hatched below it down to `depth`; above it if `depth` is negative."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    look = {"facecolor": "none", "edgecolor": PALE, "hatch": "////", "linewidth": 0.0}
    ax.fill_between(x, y - depth, y, **look)
    ax.plot(x, y, color=INK, linewidth=1.0)


def spring(ax: Any, begin: ArrayLike, end: ArrayLike, turns: int, width: float) -> None:
    """A zigzag from one point to another."""
    begin, end = np.asarray(begin, dtype=float), np.asarray(end, dtype=float)
    along = np.concatenate([[0.0, 0.12], np.linspace(0.12, 0.88, 2 * turns + 1)[:-1] + 0.38 / turns,
                            [0.88, 1.0]])  # fmt: skip
    across = np.zeros_like(along)
    across[2:-2] = 0.5 * width * (-1.0) ** np.arange(2 * turns)
    direction = end - begin
    length = float(np.hypot(*direction)) or 1.0
    normal = np.array([-direction[1], direction[0]]) / length
    points = begin + along[:, None] * direction + across[:, None] * normal
    ax.plot(*points.T, color=INK, linewidth=1.2, solid_joinstyle="round")
