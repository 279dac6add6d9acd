"""Newton's cradle."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus.drawings.drawing import BLUE, INK, Drawing, pick
from saltus.drawings.shapes import bare, disc, frame, rod
from saltus.results.animation.film import Film, Moment

__all__ = ["newtons_cradle"]


def newtons_cradle(
    balls: int = 5, *, gap: float = 0.0, length: float = 0.4, radius: float = 0.0, first: int = 0
) -> Drawing:
    """Balls that hang next to each other on strings.

    Parameters
    ----------
    balls : int
        Their number n.
    gap : float
        [m] between balls that hang still.
    length : float
        [m] of the strings.
    radius : float
        [m] of a ball; by default a tenth of the length.
    first : int
        The places [m] are the recorded numbers `first` to `first` + n - 1, as in the scene
        'newtons-cradle': ball i hangs still at i `gap`, and two touch when their places are equal.
        The drawing puts a diameter between them.

    Examples
    --------
    >>> import saltus
    >>> run = saltus.scene("newtons-cradle", t_end=0.3).simulate(dense_output=True)
    >>> run.animate(saltus.drawings.newtons_cradle(5, gap=1e-3), fps=30)
    <Animation: 10 frames, 0.3 s at 30 frames a second>
    """
    r = radius or 0.1 * length
    still = np.arange(balls) * (2.0 * r + gap)

    def swing(now: Moment, i: int) -> tuple[float, float]:
        out = pick(now, first + i) - i * gap
        angle = np.arcsin(np.clip(out / length, -1.0, 1.0))
        return still[i] + length * np.sin(angle), -length * np.cos(angle)

    def prepare(ax: Any, film: Film) -> None:
        wide = (
            max(float(np.max(np.abs(pick(film.values, first + i)))) for i in range(balls)) + 2 * r
        )
        frame(ax, (still[0] - wide, still[-1] + wide), (-length - 2.0 * r, 0.12 * length))
        bare(ax)
        rod(ax, (still[0] - r, 0.0), (still[-1] + r, 0.0), 4.0)

    def draw(ax: Any, now: Moment) -> None:
        for i in range(balls):
            x, y = swing(now, i)
            ax.plot([still[i], x], [0.0, y], color=INK, linewidth=0.8)
            disc(ax, x, y, r, BLUE)

    return Drawing(draw, prepare)
