"""Bodies in a plane, with the paths behind them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from saltus.drawings.drawing import INK, Drawing, Which, pick
from saltus.drawings.shapes import bare, disc, frame
from saltus.results.animation.film import Film, Moment

__all__ = ["bodies"]

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#999999")


def bodies(
    places: Sequence[tuple[Which, Which]] = ((0, 1),),
    *,
    centre: bool = False,
    trail: int = 60,
) -> Drawing:
    """Bodies in a plane, such as planets.

    Parameters
    ----------
    places : list of pairs
        (x, y) of each body.
    centre : bool
        Draws a body at (0, 0) too.
    trail : int
        The number of frames behind a body in which its path is drawn.

    Examples
    --------
    >>> import saltus
    >>> run = saltus.scene("pleiades", t_end=1.0).simulate(dense_output=True)
    >>> run.animate(saltus.drawings.bodies([(0, 7), (1, 8)]), fps=10)
    <Animation: 11 frames, 1 s at 10 frames a second>
    """

    def paths(film: Film) -> list[tuple[Any, Any]]:
        return [(pick(film.values, x), pick(film.values, y)) for x, y in places]

    def prepare(ax: Any, film: Film) -> None:
        all_x, all_y = (np.concatenate(part) for part in zip(*paths(film), strict=True))
        x, y = (np.append(part, [0.0] * centre) for part in (all_x, all_y))
        size = max(float(np.ptp(x)), float(np.ptp(y)), 1e-300)
        across, up = 0.5 * (x.max() + x.min()), 0.5 * (y.max() + y.min())
        frame(ax, (across - 0.6 * size, across + 0.6 * size), (up - 0.6 * size, up + 0.6 * size))
        bare(ax)
        if centre:
            disc(ax, 0.0, 0.0, 0.02 * size, INK)

    def draw(ax: Any, now: Moment) -> None:
        left, right = ax.get_xlim()
        before = slice(max(0, now.index - trail), now.index + 1)
        for i, (x, y) in enumerate(paths(now.film)):
            color = COLOURS[i % len(COLOURS)]
            ax.plot(x[before], y[before], color=color, linewidth=1.0, alpha=0.6)
            disc(ax, x[now.index], y[now.index], 0.018 * (right - left), color)

    return Drawing(draw, prepare)
