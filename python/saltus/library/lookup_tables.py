"""Tables of values at points, of one input, two, or any number. Where an input passes a point, the
derivative jumps: that is located where it reaches a derivative, a guard or a reset, and costs
nothing elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus.errors import ModelError
from saltus.library.block import Block

__all__ = [
    "LookupTable1d",
    "LookupTable2d",
    "LookupTableNd",
]


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
