"""Blocks with kinks, jumps and hysteresis. A kink is located where it reaches a derivative, a guard
or a reset, and costs nothing elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus.errors import ModelError
from saltus.library.block import Block

__all__ = [
    "DeadZone",
    "LookupTable1d",
    "LookupTable2d",
    "LookupTableNd",
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


class LookupTable1d(Block, _core.LookupTable1d):
    """y = the value of a table at u, entry by entry.

    If y reaches a derivative, the times at which u passes a point of the table are located as
    events, by one guard for all points.

    Parameters
    ----------
    input_array
        The points, 2 or more numbers that increase. They are fixed.
    output_array
        The values at the points. It is the parameter `output_array` of the context.
    interpolation
        "linear", "nearest", or "flat": the value of the point before.
    extrapolation
        "clip", the value of the outer point; "linear"; or "error": y is not a number there, and the
        run ends with an error.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the arrays do not fit, the points do not increase, or a word is unknown.

    Examples
    --------
    >>> from saltus.library import LookupTable1d
    >>> table = LookupTable1d([0.0, 1.0, 3.0], [0.0, 2.0, 1.0])
    >>> saltus.response(table, [-1.0, 0.5, 2.0, 9.0])
    array([0. , 1. , 1.5, 1. ])
    """

    def __init__(
        self,
        input_array: ArrayLike,
        output_array: ArrayLike,
        interpolation: str = "linear",
        extrapolation: str = "clip",
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), input_array, output_array, interpolation, extrapolation)
        self._ends_outside = _ranges([input_array], extrapolation)


class LookupTable2d(Block, _core.LookupTable2d):
    """y = the value of a table at (u_0, u_1), bilinear in each cell, entry by entry.

    If y reaches a derivative, the times at which an input passes a point of the table are located
    as events, by one guard for each input.

    Parameters
    ----------
    input_x, input_y
        The points of each input, 2 or more numbers that increase. They are fixed.
    output_table
        A matrix: entry (i, j) is the value at input_x[i], input_y[j]. The parameter `output_table`
        of the context, row by row.
    extrapolation
        "clip", the value at the border; "linear"; or "error": y is not a number there, and the run
        ends with an error.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the table does not fit, the points do not increase, or the word is unknown.

    Examples
    --------
    >>> from saltus.library import LookupTable2d
    >>> table = LookupTable2d([0.0, 1.0], [0.0, 2.0], [[0.0, 2.0], [10.0, 14.0]])
    >>> saltus.response(table, [0.0, 0.5, 9.0], [1.0, 1.0, 2.0])
    array([ 1. ,  6.5, 14. ])
    """

    def __init__(
        self,
        input_x: ArrayLike,
        input_y: ArrayLike,
        output_table: ArrayLike,
        extrapolation: str = "clip",
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), input_x, input_y, output_table, extrapolation)
        self._ends_outside = _ranges([input_x, input_y], extrapolation)


class LookupTableNd(Block, _core.LookupTableNd):
    """y = the value of a table at (u_0, u_1, ...), linear along each input in each cell, entry by
    entry.

    If y reaches a derivative, the times at which an input passes a point of the table are located
    as events, by one guard for each input. A value takes 2^n products for n inputs.

    Parameters
    ----------
    input_axes
        A list with the points of each input, 2 or more numbers that increase. They are fixed.
    output_table
        An array with a dimension for each input: entry [i, j, ...] is the value at point i of the
        first input, point j of the second, and so on. The parameter `output_table` of the context,
        row by row.
    extrapolation
        "clip", the value at the border; "linear"; or "error": y is not a number there, and the run
        ends with an error.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the table does not fit, the points do not increase, or the word is unknown.

    Examples
    --------
    >>> from saltus.library import LookupTableNd
    >>> x, y, z = [0.0, 1.0], [0.0, 2.0], [0.0, 1.0, 4.0]
    >>> table = LookupTableNd([x, y, z], np.add.outer(np.add.outer(x, y), z))
    >>> saltus.response(table, 0.5, 1.0, [2.0, 9.0])
    array([3.5, 5.5])
    """

    def __init__(
        self,
        input_axes: Sequence[ArrayLike],
        output_table: ArrayLike,
        extrapolation: str = "clip",
        *,
        name: str | None = None,
    ):
        called = self._named(name)
        table, axes = np.asarray(output_table, dtype=float), list(input_axes)
        expected = tuple(np.size(axis) for axis in axes)
        if table.ndim > 1 and table.shape != expected:  # in a file it is a list
            raise ModelError(
                f"block '{called}': output_table has the shape {table.shape}; expected {expected}, "
                "as input_axes says"
            )
        super().__init__(called, axes, table.ravel(), extrapolation)
        self._ends_outside = _ranges(axes, extrapolation)


def _ranges(axes: Sequence[ArrayLike], extrapolation: str) -> list[tuple[float, float]] | None:
    """The outer points of each input of a table that ends the run outside of them."""
    if extrapolation != "error":
        return None
    return [(float(np.min(points)), float(np.max(points))) for points in axes]
