"""`Drawing`: what `Results.animate` calls for each frame; `pick`: a number of that frame."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from saltus._core import known_names
from saltus._entries import entries
from saltus._whole import is_whole
from saltus.errors import ModelError
from saltus.results.animation.film import Film, Moment
from saltus.results.values import Values

__all__ = ["BLUE", "GREEN", "INK", "ORANGE", "PALE", "Drawing", "Which", "pick"]

Which = str | int
# Okabe and Ito's colours, which colour-blind readers can distinguish
BLUE, ORANGE, GREEN, INK, PALE = "#0072B2", "#D55E00", "#009E73", "#1A1A1A", "#B8B8B8"


def nothing_first(ax: Any, film: Film) -> None:
    """There is nothing that stays."""


@dataclass(frozen=True)
class Drawing:
    """A drawing in two parts; each is a function of your own.

    Examples
    --------
    >>> import saltus
    >>> from saltus.drawings import Drawing, pick
    >>> dot = Drawing(lambda ax, now: ax.plot(pick(now, 0), 0, "o"))
    >>> ball = saltus.scene("two-walls", t_end=1.0).simulate(dense_output=True)
    >>> len(ball.animate(dot, fps=10).film)
    11
    """

    draw: Callable[[Any, Moment], Any]
    """``draw(ax, now)`` adds to the axes what one frame shows; it is removed before the next"""
    prepare: Callable[[Any, Film], Any] = field(default_factory=lambda: nothing_first)
    """``prepare(ax, film)`` draws, once, what does not move, and sets the limits; `film.values` has
    the values of all frames"""

    def __call__(self, ax: Any, now: Moment) -> Any:
        return self.draw(ax, now)


def pick(values: Values, which: Which) -> Any:
    """A number of a frame, or of each frame of a film.

    Parameters
    ----------
    values : Values
        Such as `now`, `film.values` or `results(t)`.
    which : str or int
        The name of a signal, 'y', or of an entry of a signal, 'state[2]'; or the number of an
        entry, from 0, counted over all recorded signals in order.

    Returns
    -------
    float, or ndarray with the shape of ``values.time``

    Raises
    ------
    ModelError
        If nothing was recorded under the name, or the number is too large.

    Examples
    --------
    >>> import saltus
    >>> ball = saltus.scene("bouncing-ball").simulate(dense_output=True)
    >>> saltus.drawings.pick(ball(0.0), "y[0]"), saltus.drawings.pick(ball([0.0, 0.5]), 0).shape
    (10.0, (2,))
    """
    shape = np.shape(values.time)
    known: dict[str, np.ndarray] = {}
    for name, array in values.items():
        known |= dict(entries(name, array, before=len(shape)))
    if is_whole(which) and 0 <= which < len(known):
        found = list(known.values())[which]
    elif which in known:
        found = known[str(which)]
    else:
        raise ModelError(_unknown(which, known))
    return found if shape else float(found)


def _unknown(which: Which, entries: dict[str, np.ndarray]) -> str:
    if isinstance(which, int):
        return (
            f"a drawing needs entry {which} of what was recorded, and there are {len(entries)}: "
            f"{', '.join(entries) or 'none'}"
        )
    return f"nothing was recorded under {which!r}{known_names(str(which), list(entries))}"
