"""The drawing of a scene of the shelf, and drawings by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from saltus._core import known_names
from saltus.drawings.balls import ball, ball_between_walls
from saltus.drawings.bodies import bodies
from saltus.drawings.cradle import newtons_cradle
from saltus.drawings.drawing import Drawing
from saltus.drawings.pendulums import pendulum, pendulum_on_cart
from saltus.drawings.rocking import rocking_block
from saltus.drawings.springs import mass_on_spring, quarter_car
from saltus.drawings.wheel import rimless_wheel
from saltus.errors import ModelError

__all__ = ["NAMES", "by_name", "of_scene"]

NAMES: dict[str, Callable[..., Drawing]] = {
    "ball": ball,
    "ball_between_walls": ball_between_walls,
    "bodies": bodies,
    "mass_on_spring": mass_on_spring,
    "newtons_cradle": newtons_cradle,
    "pendulum": pendulum,
    "pendulum_on_cart": pendulum_on_cart,
    "quarter_car": quarter_car,
    "rimless_wheel": rimless_wheel,
    "rocking_block": rocking_block,
}
"""the drawings by name, for the command line"""

GRAVITY = 9.81  # [m/s^2], from which the strings of the cradle have their length


def _table(p: Mapping[str, float]) -> Drawing:
    return ball(floor=lambda t: p["amplitude"] * np.sin(p["w"] * t))


def _cradle(p: Mapping[str, float]) -> Drawing:
    return newtons_cradle(int(p["balls"]), gap=p["gap"], length=GRAVITY / p["w"] ** 2)


SHELF: dict[str, Callable[[Mapping[str, float]], Drawing]] = {
    "bouncing-ball": lambda p: ball(),
    "bouncing-ball-blocks": lambda p: ball(
        floor=lambda t: np.where(np.asarray(t) < p["drop_time"], p["floor"], p["dropped"])
    ),
    "ball-drag": lambda p: ball(),
    "ball-table": _table,
    "two-walls": lambda p: ball_between_walls(length=p["length"]),
    "newtons-cradle": _cradle,
    "rimless-wheel": lambda p: rimless_wheel(alpha=p["alpha"], slope=p["slope"]),
    "rocking-block": lambda p: rocking_block(alpha=p["alpha"]),
    "stick-slip": lambda p: mass_on_spring(belt=p["belt"]),
    "kepler": lambda p: bodies(centre=True),
    "pleiades": lambda p: bodies([(i, i + 7) for i in range(7)]),
}


def of_scene(name: str, parameters: Mapping[str, float]) -> Drawing | None:
    """The drawing of a scene of the shelf.

    Parameters
    ----------
    name : str
        The name of the scene.
    parameters : mapping
        Those of the scene: `Scene.parameters`.

    Returns
    -------
    Drawing or None
        None for a scene without one, such as a reaction.

    Examples
    --------
    >>> import saltus
    >>> wheel = saltus.scene("rimless-wheel")
    >>> saltus.drawings.of_scene(wheel.name, wheel.parameters) is not None
    True
    """
    make = SHELF.get(name)
    return None if make is None else make(parameters)


def by_name(name: str, arguments: Mapping[str, Any]) -> Drawing:
    """A drawing by its name, with arguments. ModelError for an unknown name or argument."""
    if name not in NAMES:
        raise ModelError(f"no drawing '{name}'{known_names(name, list(NAMES))}")
    try:
        return NAMES[name](**arguments)
    except TypeError as error:
        raise ModelError(f"drawing '{name}': {error}") from None
