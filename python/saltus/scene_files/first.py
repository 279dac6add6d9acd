"""The scene that `saltus new` writes."""

__all__ = ["first_scene"]

FIRST = """\
# Run it:       saltus run FILE
# Change it:    saltus run FILE --set e=0.5 --plot ball.svg
# Look inside:  saltus describe FILE
version = 1
title = "A ball that bounces on a floor"

[parameters]
g = 9.81  # [m/s^2] gravity
e = 0.8   # restitution: the part of the speed that a bounce leaves, 0 to 1
y0 = 10.0  # [m] height at the start

[states]
y = { start = "y0", rate = "v" }  # [m] height
v = { start = 0.0, rate = "-g" }  # [m/s] velocity

# Where y falls to 0 the ball bounces. All that is set is computed from the state before.
[guards.bounce]
guard = "y"
direction = "falling"
set = { y = "abs(y)", v = "-e * v" }

[outputs]
height = "y"
energy = "g * y + v**2 / 2"

[run]
until = 15.0  # [s]
rtol = 1e-9
atol = 1e-11
record = ["height", "energy"]

[sweep.values]
e = [0.5, 0.7, 0.9]
"""


def first_scene(file: str = "FILE") -> str:
    """The text of a first scene, to be changed into your own; `saltus new` writes it.

    Parameters
    ----------
    file
        The name in its comments.

    Examples
    --------
    >>> from saltus.scene_files import first_scene, loads
    >>> loads(first_scene()).title
    'A ball that bounces on a floor'
    """
    return FIRST.replace("FILE", file)
