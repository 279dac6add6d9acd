"""Random numbers, held between ticks. They are a function of the seed and the number of the tick
(Philox 4x32-10: J. K. Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC '11): a run
that is resumed, or is one of a sweep, has the same numbers to the bit.
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = ["RandomNumber", "WhiteNoise"]


class RandomNumber(Block, _core.RandomNumber):
    """y[k] = a random number, held from tick k to the next; one for each entry, independent.

    Two blocks with one seed have the same numbers: give each its own.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    distribution
        'normal' or 'uniform'.
    seed
        Any number. Parameter of the context, so a sweep may draw over seeds.
    mean, standard_deviation
        The values of a normal distribution, a number or a vector each. Parameters of the context.
    lower_limit, upper_limit
        The bounds of a uniform distribution, likewise; `upper_limit` itself is not drawn.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0, the distribution is unknown, or the limits cross.

    Examples
    --------
    >>> from saltus.library import RandomNumber
    >>> y = saltus.response(RandomNumber(0.1, seed=7), t=[0.0, 0.05, 0.1])
    >>> bool(y[0] == y[1] != y[2])
    True
    """

    def __init__(
        self,
        dt: float,
        distribution: str = "normal",
        seed: float = 0.0,
        *,
        mean: ArrayLike = 0.0,
        standard_deviation: ArrayLike = 1.0,
        lower_limit: ArrayLike = 0.0,
        upper_limit: ArrayLike = 1.0,
        name: str | None = None,
    ):
        super().__init__(
            self._named(name),
            dt,
            distribution,
            seed,
            mean,
            standard_deviation,
            lower_limit,
            upper_limit,
        )


class WhiteNoise(Block, _core.WhiteNoise):
    """y[k] = sqrt(power / dt) times a normally distributed number, held from tick k to the next.

    The noise is white for signals that are slow against dt: the integral of y from 0 to t has the
    variance power t. Two blocks with one seed have the same numbers: give each its own.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    power
        [s times the square of the unit of y] The two-sided density over the frequency in Hz, a
        number or a vector. Parameter of the context.
    seed
        Any number. Parameter of the context, so a sweep may draw over seeds.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0, or the power is below 0.

    Examples
    --------
    >>> from saltus.library import WhiteNoise
    >>> saltus.response(WhiteNoise(0.1, power=0.0), t=1.0)
    0.0
    """

    def __init__(
        self,
        dt: float,
        *,  # in other tools the second number is divided by dt, and the third one is no seed
        power: ArrayLike = 1.0,
        seed: float = 0.0,
        name: str | None = None,
    ):
        super().__init__(self._named(name), dt, power, seed)
