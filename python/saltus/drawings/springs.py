"""Masses on springs."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus.drawings.drawing import BLUE, GREEN, INK, ORANGE, PALE, Drawing, Which, pick
from saltus.drawings.shapes import bare, box, disc, frame, ground, rod, spring
from saltus.results.animation.film import Film, Moment

__all__ = ["mass_on_spring", "quarter_car"]


def mass_on_spring(place: Which = 0, *, belt: float = 0.0) -> Drawing:
    """A mass on a spring between it and a wall; it slides on a floor, or on a belt.

    Parameters
    ----------
    place : str or int
        [m] of the mass, 0 where the spring is relaxed, positive away from the wall.
    belt : float
        [m/s] the speed of the belt below the mass, whose marks move with it.

    Examples
    --------
    >>> import saltus
    >>> run = saltus.solve(lambda t, x: [x[1], -x[0]], (0, 1), [1.0, 0.0], dense_output=True)
    >>> run.animate(saltus.drawings.mass_on_spring(), fps=10)
    <Animation: 11 frames, 1 s at 10 frames a second>
    """

    def scale(film: Film) -> float:
        return float(np.max(np.abs(pick(film.values, place)))) or 1.0

    def prepare(ax: Any, film: Film) -> None:
        size = scale(film)
        frame(ax, (-2.6 * size, 2.2 * size), (-0.9 * size, 1.2 * size))
        bare(ax)
        floor = -0.35 * size
        if belt == 0.0:
            ground(ax, (-2.4 * size, 2.2 * size), (floor, floor), 0.15 * size)
        else:
            rod(ax, (-2.4 * size, floor), (2.2 * size, floor), 3.0)
        ax.plot([-2.4 * size] * 2, [floor, 0.9 * size], color=INK, linewidth=2.0)

    def draw(ax: Any, now: Moment) -> None:
        size, x = scale(now.film), pick(now, place)
        if belt:
            spacing = 0.5 * size
            marks = np.arange(-4, 5) * spacing + (belt * now.time) % spacing
            marks = marks[(marks > -2.3 * size) & (marks < 2.1 * size)]
            ax.plot(marks, 0 * marks - 0.45 * size, "|", color=ORANGE, markersize=7)
        spring(ax, (-2.4 * size, 0.0), (x - 0.35 * size, 0.0), 8, 0.3 * size)
        box(ax, x, 0.0, 0.7 * size, 0.7 * size, BLUE)

    return Drawing(draw, prepare)


def quarter_car(
    body: Which = 0, wheel: Which = 1, road: Which | None = None, *, radius: float = 0.3
) -> Drawing:
    """A quarter of a car: a body on a strut, and a wheel on the road.

    Parameters
    ----------
    body, wheel : str or int
        [m] their heights over the places where they rest.
    road : str or int, optional
        [m] the height of the road under the wheel; by default 0.
    radius : float
        [m] of the wheel.

    Examples
    --------
    >>> import saltus
    >>> run = saltus.solve(lambda t, x: [-x[0], -x[1]], (0, 1), [0.1, 0.05], dense_output=True)
    >>> run.animate(saltus.drawings.quarter_car("x[0]", "x[1]"), fps=10)
    <Animation: 11 frames, 1 s at 10 frames a second>
    """
    rest, thick = 3.2 * radius, 1.2 * radius

    def prepare(ax: Any, film: Film) -> None:
        high = float(np.max(pick(film.values, body)))
        frame(ax, (-3.2 * radius, 3.2 * radius), (-radius, high + rest + 2.0 * radius))
        bare(ax)

    def draw(ax: Any, now: Moment) -> None:
        level = 0.0 if road is None else pick(now, road)
        ground(ax, ax.get_xlim(), (level, level), 0.4 * radius)
        hub, bottom = pick(now, wheel) + radius, pick(now, body) + rest
        disc(ax, 0.0, hub, radius, PALE)
        disc(ax, 0.0, hub, 0.2 * radius, INK)
        spring(ax, (-0.25 * radius, hub), (-0.25 * radius, bottom), 5, 0.35 * radius)
        _damper(ax, 0.35 * radius, hub, bottom, 0.25 * radius)
        box(ax, 0.0, bottom + 0.5 * thick, 4.0 * radius, thick, GREEN)

    return Drawing(draw, prepare)


def _damper(ax: Any, x: float, low: float, high: float, width: float) -> None:
    middle = low + 0.4 * (high - low)
    rod(ax, (x, low), (x, middle), 1.2)
    cup = [(x - width, middle + 2 * width), (x - width, middle), (x + width, middle)]
    ax.plot(*zip(*cup, (x + width, middle + 2 * width), strict=True), color=INK, linewidth=1.2)
    piston = middle + width
    ax.plot([x - 0.8 * width, x + 0.8 * width], [piston, piston], color=INK, linewidth=2.0)
    rod(ax, (x, piston), (x, high), 1.2)
