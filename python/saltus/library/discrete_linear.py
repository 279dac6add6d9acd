"""Linear systems that change at ticks, at 0, dt, 2 dt, ..., counted by integers.

Their output at tick k is that of their input at tick k: in a row of such blocks all outputs change
in the order of the wires, then all states, so no block delays another.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = [
    "FilterDiscrete",
    "LTISystemDiscrete",
    "TransferFunctionDiscrete",
]


class FilterDiscrete(Block, _core.FilterDiscrete):
    """y[k] = b_0 u[k] + b_1 u[k-1] + ... + b_m u[k-m], entry by entry: a filter with a finite
    response. u[-1] = u[-2] = ... = `initial_state`.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    b_coefficients
        b_0, ..., b_m. Parameter of the context.
    initial_state
        A number, a vector or a matrix: u before the first tick, and the shape of the signal.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0, or there is no coefficient.

    Examples
    --------
    The mean of two ticks:

    >>> from saltus.library import Clock, FilterDiscrete
    >>> saltus.response(FilterDiscrete(1.0, [0.5, 0.5]), Clock(), t=[0.0, 1.0, 2.0])
    array([0. , 0.5, 1.5])
    """

    def __init__(
        self,
        dt: float,
        b_coefficients: ArrayLike,
        initial_state: ArrayLike = 0.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), dt, b_coefficients, initial_state)


class LTISystemDiscrete(Block, _core.LTISystemDiscrete):
    """x[k+1] = A x[k] + B u[k], y[k] = C x[k] + D u[k]; y is held from tick k to the next.

    A number counts as a matrix of one entry. u is a scalar if B has one column, y if C has one row.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    A, B, C, D
        Matrices. D may be left out; without it, or with zeros, the input does not reach the output
        at once. Parameters of the context, row by row.
    initial_state
        x[0]; by default zeros.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0, or the sizes of the matrices do not fit.

    Examples
    --------
    >>> from saltus.library import LTISystemDiscrete
    >>> block = LTISystemDiscrete(1.0, 0.5, 1.0, 2.0)
    >>> saltus.response(block, 1.0, t=[0.0, 1.0, 2.0])
    array([0., 2., 3.])
    """

    def __init__(
        self,
        dt: float,
        A: ArrayLike,
        B: ArrayLike,
        C: ArrayLike,
        D: ArrayLike | None = None,
        initial_state: ArrayLike | None = None,
        *,
        name: str | None = None,
    ):
        if np.ndim(dt) == 2 and D is not None and np.ndim(D) == 0:  # (A, B, C, D, dt) elsewhere
            dt, A, B, C, D = D, dt, A, B, C  # type: ignore[assignment]
        super().__init__(self._named(name), dt, A, B, C, D, initial_state)


class TransferFunctionDiscrete(Block, _core.TransferFunctionDiscrete):
    """y = (b_0 z^m + ... + b_m) / (a_0 z^n + ... + a_n) u, with m <= n; z shifts by one tick.

    u and y are numbers. The input reaches the output at once only if m = n.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    num
        b_0, ..., b_m: the highest power first. The parameter `numerator` of the context.
    den
        a_0, ..., a_n. The parameter `denominator` of the context.
    initial_state
        v[-1], ..., v[-n], where v solves a_0 v[k] + ... + a_n v[k-n] = u[k]; by default zeros.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0, m > n, or a polynomial has only zeros.

    Examples
    --------
    A lag that halves the distance with each tick:

    >>> from saltus.library import TransferFunctionDiscrete
    >>> block = TransferFunctionDiscrete(1.0, [0.5], [1.0, -0.5])
    >>> saltus.response(block, 1.0, t=[0.0, 1.0, 2.0, 3.0])
    array([0.   , 0.5  , 0.75 , 0.875])
    """

    def __init__(
        self,
        dt: float,
        num: ArrayLike,
        den: ArrayLike,
        initial_state: ArrayLike | None = None,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), dt, num, den, initial_state)
