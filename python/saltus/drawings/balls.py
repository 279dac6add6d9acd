"""Balls: over a floor or a table, and between walls."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from saltus.drawings.drawing import BLUE, ORANGE, Drawing, Which, pick
from saltus.drawings.shapes import bare, disc, frame, ground
from saltus.results.animation.film import Film, Moment
from saltus.results.values import Values

__all__ = ["ball", "ball_between_walls"]

Floor = float | str | Callable[[Any], Any]
WIDE = 2.5  # a strip of the past is so much wider than the other side
TRAIL = 40  # the number of earlier places of the ball that are drawn


def ball(
    height: Which = 0,
    *,
    floor: Floor = 0.0,
    across: Which | None = None,
    past: float = 0.0,
    radius: float = 0.0,
) -> Drawing:
    """A ball over a floor or a table that moves.

    Parameters
    ----------
    height : str or int
        [m] the lowest point of the ball.
    floor : float, str, or callable
        [m] its height: a constant, a recorded signal, or a function of the time [s].
    across : str or int, optional
        [m] the ball's place across; by default it falls on one line.
    past : float
        [s] of earlier heights that run out of the picture on the left, as on a strip of paper.
    radius : float
        [m] by default a twenty-fifth of the largest height.

    Examples
    --------
    >>> import saltus
    >>> run = saltus.scene("bouncing-ball", t_end=1.0).simulate(dense_output=True)
    >>> run.animate(saltus.drawings.ball("y[0]"), fps=10)
    <Animation: 11 frames, 1 s at 10 frames a second>
    """

    def surface(values: Values) -> Any:
        if callable(floor):
            return floor(values.time)
        return pick(values, floor) if isinstance(floor, str) else floor + 0.0 * values.time

    def size(film: Film) -> tuple[float, float, float]:
        heights, floors = pick(film.values, height), surface(film.values)
        low, high = float(np.min([heights, floors])), float(np.max([heights, floors]))
        return low, high, radius or 0.04 * (high - low or 1.0)

    def prepare(ax: Any, film: Film) -> None:
        low, high, r = size(film)
        margin = 0.08 * (high - low or 1.0)
        half = 0.55 * (high - low or 1.0)
        left, right = _width(film, across, half)
        if past:
            left = -WIDE * (right := half)
        frame(ax, (left - 2 * r, right + 2 * r), (low - margin, high + 2 * r + margin))
        ax.set_xticks([])
        ax.set_ylabel("height [m]")
        ax.spines[["top", "right", "bottom"]].set_visible(False)

    def draw(ax: Any, now: Moment) -> None:
        low, high, r = size(now.film)
        level = float(surface(now))
        ground(ax, ax.get_xlim(), [level, level], 0.05 * (high - low or 1.0))
        x = 0.0 if across is None else pick(now, across)
        if across is not None:
            _trail(ax, now, across, height, r)
        elif past:
            times = now.film.times[: now.index + 1]
            strip = (times - now.time) / past * -ax.get_xlim()[0]
            y = pick(now.film.values, height)[: now.index + 1] + r
            ax.plot(strip[strip > ax.get_xlim()[0]], y[strip > ax.get_xlim()[0]], color=ORANGE)
        disc(ax, x, pick(now, height) + r, r, BLUE)

    return Drawing(draw, prepare)


def _width(film: Film, across: Which | None, usual: float) -> tuple[float, float]:
    if across is None:
        return -usual, usual
    places = pick(film.values, across)
    return float(np.min(places)), float(np.max(places))


def _trail(ax: Any, now: Moment, across: Which, height: Which, r: float) -> None:
    before = slice(max(0, now.index - TRAIL), now.index + 1)
    x, y = pick(now.film.values, across)[before], pick(now.film.values, height)[before]
    ax.plot(x, y + r, color=ORANGE, linewidth=1.0, alpha=0.6)


def ball_between_walls(place: Which = 0, *, length: float = 1.0, radius: float = 0.0) -> Drawing:
    """A ball between two walls, at 0 and at `length` [m].

    Parameters
    ----------
    place : str or int
        [m] of the ball, from 0 to `length`.
    radius : float
        [m] by default a thirtieth of the length; the walls are drawn that much farther out.

    Examples
    --------
    >>> import saltus
    >>> run = saltus.scene("two-walls", t_end=1.0).simulate(dense_output=True)
    >>> run.animate(saltus.drawings.ball_between_walls(), fps=10)
    <Animation: 11 frames, 1 s at 10 frames a second>
    """
    r = radius or length / 30.0

    def prepare(ax: Any, film: Film) -> None:
        frame(ax, (-0.12 * length, 1.12 * length), (-0.25 * length, 0.25 * length))
        bare(ax)
        for x, outwards in ((-r, -1.0), (length + r, 1.0)):
            _wall(ax, x, outwards * 0.05 * length, 0.2 * length)

    def draw(ax: Any, now: Moment) -> None:
        disc(ax, pick(now, place), 0.0, r, BLUE)

    return Drawing(draw, prepare)


def _wall(ax: Any, x: float, depth: float, height: float) -> None:
    look = {"facecolor": "none", "edgecolor": "0.7", "hatch": "////", "linewidth": 0.0}
    ax.fill_betweenx([-height, height], x, x + depth, **look)
    ax.plot([x, x], [-height, height], color="black", linewidth=1.2)
