"""The rimless wheel."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus.drawings.drawing import BLUE, ORANGE, Drawing, Which, pick
from saltus.drawings.shapes import bare, disc, frame, ground, rod
from saltus.results.animation.film import Film, Moment

__all__ = ["rimless_wheel"]


def rimless_wheel(
    angle: Which = 0, *, alpha: float = np.pi / 8, slope: float = 0.08, event: str = "spoke"
) -> Drawing:
    """Spokes of length 1 that roll down a slope, one after the other.

    Parameters
    ----------
    angle : str or int
        [rad] of the spoke that is on the ground, from the vertical, positive downhill.
    alpha : float
        [rad] half the angle between two spokes.
    slope : float
        [rad] of the ground.
    event : str
        The name of the event at which the next spoke takes over; it is counted.

    Examples
    --------
    >>> import saltus
    >>> run = saltus.scene("rimless-wheel").simulate(dense_output=True)
    >>> run.animate(saltus.drawings.rimless_wheel(), speed=31.0, fps=10)
    <Animation: 11 frames, 1 s at 10 frames a second...>
    """
    spokes = max(round(np.pi / alpha), 2)
    step = 2.0 * np.sin(alpha)  # along the ground, from spoke to spoke
    downhill = np.array([np.cos(slope), -np.sin(slope)])

    def prepare(ax: Any, film: Film) -> None:
        frame(ax, (-2.2, 2.2), (-1.3, 2.2))
        bare(ax)

    def draw(ax: Any, now: Moment) -> None:
        foot, theta = now.fired(event) * step * downhill, pick(now, angle)
        hub = foot + np.array([np.sin(theta), np.cos(theta)])
        # the picture moves with the wheel, and marks on the ground show that
        middle = hub - np.array([np.sin(slope), np.cos(slope)])
        far = np.array([-3.0, 3.0])
        along = middle + far[:, None] * downhill
        ground(ax, along[:, 0] - hub[0], along[:, 1] - hub[1] + 0.6, 0.25)
        for k in range(now.fired(event) - 3, now.fired(event) + 5):
            mark = k * step * downhill - hub + np.array([0.0, 0.6])
            ax.plot(*mark, marker="|", color=ORANGE, markersize=7, markeredgewidth=1.5)
        for k in range(spokes):
            turn = theta + 2.0 * alpha * k
            end = np.array([-np.sin(turn), 0.6 - np.cos(turn)])
            rod(ax, (0.0, 0.6), end, 4.0 if k == 0 else 2.0)
        disc(ax, 0.0, 0.6, 0.12, BLUE)

    return Drawing(draw, prepare)
