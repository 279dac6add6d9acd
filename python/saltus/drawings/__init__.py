"""Ready drawings for `Results.animate`: functions that return a `Drawing`.

Each takes the numbers to draw as `which` of `pick`: the number of an entry, counted over all
recorded signals, or a name, such as 'y' or 'state[2]'.
"""

from saltus.drawings.balls import ball, ball_between_walls
from saltus.drawings.bodies import bodies
from saltus.drawings.cradle import newtons_cradle
from saltus.drawings.drawing import Drawing, pick
from saltus.drawings.of_scene import of_scene
from saltus.drawings.pendulums import pendulum, pendulum_on_cart
from saltus.drawings.rocking import rocking_block
from saltus.drawings.springs import mass_on_spring, quarter_car
from saltus.drawings.wheel import rimless_wheel

__all__ = [
    "Drawing",
    "ball",
    "ball_between_walls",
    "bodies",
    "mass_on_spring",
    "newtons_cradle",
    "of_scene",
    "pendulum",
    "pendulum_on_cart",
    "pick",
    "quarter_car",
    "rimless_wheel",
    "rocking_block",
]
