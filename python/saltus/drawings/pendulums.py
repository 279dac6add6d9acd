"""Pendulums: hanging, and upright on a cart."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus.drawings.drawing import BLUE, GREEN, INK, Drawing, Which, pick
from saltus.drawings.shapes import bare, box, disc, frame, ground, rod
from saltus.results.animation.film import Film, Moment

__all__ = ["pendulum", "pendulum_on_cart"]


def pendulum(angle: Which = 0, *, length: float = 1.0, upright: bool = False) -> Drawing:
    """A bob on a rod.

    Parameters
    ----------
    angle : str or int
        [rad] from the lowest place, positive to the right; with `upright` from the highest.
    length : float
        [m] of the rod.

    Examples
    --------
    >>> import saltus
    >>> run = saltus.solve(lambda t, x: [x[1], -x[0]], (0, 1), [1.0, 0.0], dense_output=True)
    >>> run.animate(saltus.drawings.pendulum(), fps=10)
    <Animation: 11 frames, 1 s at 10 frames a second>
    """
    down = 1.0 if upright else -1.0

    def prepare(ax: Any, film: Film) -> None:
        lowest = float(np.min(down * np.cos(pick(film.values, angle))))
        highest = float(np.max(down * np.cos(pick(film.values, angle))))
        low, high = min(lowest, 0.0) - 0.15, max(highest, 0.0) + 0.15
        wide = max(1.15, 0.7 * (high - low))
        frame(ax, (-wide * length, wide * length), (low * length, high * length))
        bare(ax)
        if not upright:
            ground(ax, (-0.2 * length, 0.2 * length), (0.0, 0.0), -0.06 * length)

    def draw(ax: Any, now: Moment) -> None:
        theta = pick(now, angle)
        end = (length * np.sin(theta), down * length * np.cos(theta))
        rod(ax, (0.0, 0.0), end)
        disc(ax, 0.0, 0.0, 0.02 * length, INK)
        disc(ax, *end, 0.08 * length, BLUE)

    return Drawing(draw, prepare)


def pendulum_on_cart(
    place: Which = 0, angle: Which = 2, *, length: float = 0.5, upright: bool = True
) -> Drawing:
    """A pendulum on a cart.

    Parameters
    ----------
    place : str or int
        [m] of the cart.
    angle : str or int
        [rad] from the highest place, positive to the right; without `upright` from the lowest.
    length : float
        [m] of the rod.

    Examples
    --------
    >>> import saltus
    >>> run = saltus.solve(lambda t, x: [1.0, -x[1]], (0, 1), [0.0, 0.2], dense_output=True)
    >>> run.animate(saltus.drawings.pendulum_on_cart("x[0]", "x[1]"), fps=10)
    <Animation: 11 frames, 1 s at 10 frames a second>
    """
    up = 1.0 if upright else -1.0
    width, height = 0.5 * length, 0.25 * length
    wheel = 0.08 * length

    def prepare(ax: Any, film: Film) -> None:
        x = pick(film.values, place)
        left, right = float(np.min(x)) - 1.3 * length, float(np.max(x)) + 1.3 * length
        frame(ax, (left, right), (-1.3 * length if not upright else -0.6 * length, 1.4 * length))
        bare(ax)
        rail = -0.5 * height - 2.0 * wheel
        ground(ax, (left, right), (rail, rail), 0.1 * length)

    def draw(ax: Any, now: Moment) -> None:
        x, theta = pick(now, place), pick(now, angle)
        for side in (-0.3, 0.3):
            disc(ax, x + side * width, -0.5 * height - wheel, wheel, INK)
        box(ax, x, 0.0, width, height, GREEN)
        end = (x + length * np.sin(theta), up * length * np.cos(theta))
        rod(ax, (x, 0.0), end)
        disc(ax, *end, 0.1 * length, BLUE)

    return Drawing(draw, prepare)
