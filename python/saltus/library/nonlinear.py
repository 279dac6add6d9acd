"""Blocks with kinks, jumps and hysteresis. A kink is located where it reaches a derivative, a guard
or a reset, and costs nothing elsewhere.
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = [
    "DeadZone",
    "MinMax",
    "Quantizer",
    "Sign",
]


class DeadZone(Block, _core.DeadZone):
    """y = 0 for abs(u) < half_range, entry by entry; outside u, or u -+ half_range if
    `shifted`.

    If y reaches a derivative, the times at which u passes an edge are located as events.

    Parameters
    ----------
    half_range
        >= 0, a number, or a vector as wide as the input. It is the parameter `half_range` of the
        context.
    shifted
        Whether the edge is subtracted outside, so that y is continuous, as in Simulink. Otherwise y
        jumps there, as in Collimator.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If half_range is below 0.

    Examples
    --------
    >>> from saltus.library import DeadZone
    >>> saltus.response(DeadZone(1.0), [-3.0, 0.5, 3.0])
    array([-3.,  0.,  3.])
    >>> saltus.response(DeadZone(1.0, shifted=True), [-3.0, 0.5, 3.0])
    array([-2.,  0.,  2.])
    """

    def __init__(
        self, half_range: ArrayLike = 1.0, *, shifted: bool = False, name: str | None = None
    ):
        super().__init__(self._named(name), half_range, shifted)


class MinMax(Block, _core.MinMax):
    """y = the smallest, or the largest, of u_0, u_1, ..., entry by entry.

    If y reaches a derivative, the times at which another input takes over are located as events.

    Parameters
    ----------
    operator
        "min" or "max".
    n_inputs
        How many inputs there are, 1 or more.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the operator is unknown, or there is no input.

    Examples
    --------
    >>> from saltus.library import MinMax
    >>> saltus.response(MinMax("max"), [1.0, 5.0], 3.0)
    array([3., 5.])
    """

    def __init__(self, operator: str | int, n_inputs: int | str = 2, *, name: str | None = None):
        if isinstance(n_inputs, str):  # MinMax(2, "max") in pycollimator
            operator, n_inputs = n_inputs, operator
        super().__init__(self._named(name), operator, n_inputs)  # type: ignore[arg-type]


class Quantizer(Block, _core.Quantizer):
    """y = interval round(u / interval), entry by entry: the nearest level, with a level at 0.

    If y reaches a derivative, the times at which the level changes are located as events.

    With a hysteresis h above 0 the level is a discrete state: it is left for the nearest level
    where u is (interval + h) / 2 away from it, so that noise below h does not make it chatter. The
    changes are then located everywhere, and the input has the shape of the interval.

    Parameters
    ----------
    interval
        > 0, a number, or a vector as wide as the input. It is the parameter `interval` of the
        context.
    hysteresis
        0, or less than the smallest interval. Above 0 it is the parameter `hysteresis` of the
        context.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the interval is not above 0, or the hysteresis is not from 0 to below the interval.

    Examples
    --------
    >>> from saltus.library import Quantizer
    >>> saltus.response(Quantizer(0.5), [0.2, 0.7, -1.4])
    array([ 0. ,  0.5, -1.5])
    """

    def __init__(self, interval: ArrayLike, *, hysteresis: float = 0.0, name: str | None = None):
        super().__init__(self._named(name), interval, hysteresis)


class Sign(Block, _core.Sign):
    """y = -1 for u < 0, 0 for u = 0, 1 for u > 0, entry by entry.

    If y reaches a derivative, the times at which u passes zero are located as events.

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Sign
    >>> saltus.response(Sign(), [-2.0, 0.0, 3.0])
    array([-1.,  0.,  1.])
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))
