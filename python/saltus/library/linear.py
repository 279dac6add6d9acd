"""Linear systems: blocks with coefficients."""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = ["PID", "Derivative", "LTISystem", "TransferFunction"]


class Derivative(Block, _core.Derivative):
    """y = N (u - x), dx/dt = y, entry by entry: the derivative of u behind a filter, s N / (s + N).

    x follows u with the lag 1 / N; a step of u makes a peak of N times its height. There is no
    derivative without a filter: at an event, and in a loop, it would not be defined.

    Parameters
    ----------
    filter_coefficient
        [1/s] N > 0, a number, a vector or a matrix: several times the fastest frequency of u. It is
        the parameter `filter_coefficient` of the context.
    initial_state
        x at the start, a number, a vector or a matrix: the shape of the signal. With u at the start
        y begins at 0.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the coefficient is not above 0, or not finite.

    Examples
    --------
    >>> from saltus.library import Derivative, Ramp
    >>> round(saltus.response(Derivative(), Ramp(slope=3.0, start_time=0.0), t=1.0), 6)
    3.0
    """

    def __init__(
        self,
        filter_coefficient: ArrayLike = 100.0,
        initial_state: ArrayLike = 0.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), filter_coefficient, initial_state)


class LTISystem(Block, _core.LTISystem):
    """dx/dt = A x + B u, y = C x + D u: a linear system with constant coefficients.

    u is a number if B has one column, y if C has one row; otherwise they are vectors.

    Parameters
    ----------
    A, B, C
        Matrices, n x n, n x inputs and outputs x n, or numbers for 1 x 1. They are parameters of
        the context, row by row.
    D
        A matrix, outputs x inputs. Without it, or if it is zero, there is no feedthrough.
    initial_state
        x at the start, n numbers; by default zeros.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the sizes of the matrices do not fit.

    Examples
    --------
    A mass on a spring, pulled with 1 N: its position and velocity.

    >>> from saltus.library import LTISystem
    >>> block = LTISystem([[0, 1], [-1, 0]], [[0], [1]], np.eye(2))
    >>> saltus.response(block, 1.0, t=np.pi).round(6) + 0.0
    array([2., 0.])
    """

    def __init__(
        self,
        A: ArrayLike,
        B: ArrayLike,
        C: ArrayLike,
        D: ArrayLike | None = None,
        initial_state: ArrayLike | None = None,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), A, B, C, D, initial_state)


class PID(Block, _core.PID):
    """v = kp u + i + kd n (u - f), with di/dt = ki u and df/dt = n (u - f); y is v, or v between
    the limits. u is the error.

    The derivative has a filter, always. With a limit the integral i is clamped: it does
    not change from when v is beyond the limit and the error pushes outward, until the error turns
    or v is inside again by `band`. Both are located as events. The band prevents chattering while
    the error falls.

    Parameters
    ----------
    kp, ki, kd
        The gains: in y per u, in y per u and second, and in y seconds per u.
    n
        [1/s] The coefficient of the filter, > 0.
    initial_state
        The integral i at the start, in the unit of y.
    lower_limit, upper_limit
        The limits, in the unit of y; either may be left out.
    band
        > 0, in the unit of y; by default 1e-3 of the distance of the limits, or of the limit.
        All numbers but `initial_state` are parameters of the context, the last three if there is a
        limit.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If n is not above 0 or not finite, or the limits cross.

    Examples
    --------
    >>> from saltus.library import PID
    >>> saltus.response(PID(2.0, ki=1.0), 1.0, t=[0.0, 3.0])
    array([2., 5.])
    >>> saltus.response(PID(2.0, ki=1.0, upper_limit=4.0), 1.0, t=[0.0, 3.0])
    array([2., 4.])
    """

    def __init__(
        self,
        kp: float = 1.0,
        ki: float = 0.0,
        kd: float = 0.0,
        n: float = 100.0,
        initial_state: float = 0.0,
        *,
        lower_limit: float | None = None,
        upper_limit: float | None = None,
        band: float | None = None,
        name: str | None = None,
    ):
        super().__init__(
            self._named(name), kp, ki, kd, n, initial_state, lower_limit, upper_limit, band
        )


class TransferFunction(Block, _core.TransferFunction):
    """y = (b_0 s^m + ... + b_m) / (a_0 s^n + ... + a_n) u, with m <= n. u and y are numbers.

    The input reaches the output at once only if m = n. The states are those of the controllable
    companion form, each divided by a power of two that balances the system (E. E. Osborne, J. ACM 7
    (1960) 338): the states of the context times `scales` are v, v', v'', ..., where v solves
    (a_0 s^n + ... + a_n) v = a_0 u.

    Parameters
    ----------
    num
        b_0, ..., b_m: the highest power first. The parameter `numerator` of the context.
    den
        a_0, ..., a_n. The parameter `denominator` of the context.
    initial_state
        v, v', ... at the start, n numbers; by default zeros.
    initial_output
        The steady value of y at the start, in place of `initial_state`. It fixes the states of a
        steady state, whose input is y divided by the gain at s = 0.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        For m > n, a polynomial of zeros, two starts, or an `initial_output` where the gain at s = 0
        is 0 or infinite.

    Examples
    --------
    The step response of a lag of 1 s:

    >>> from saltus.library import TransferFunction
    >>> saltus.response(TransferFunction([1.0], [1.0, 1.0]), 1.0, t=[0.0, 1.0, 5.0]).round(4)
    array([0.    , 0.6321, 0.9933])
    """

    def __init__(
        self,
        num: ArrayLike,
        den: ArrayLike,
        initial_state: ArrayLike | None = None,
        *,
        initial_output: float | None = None,
        name: str | None = None,
    ):
        super().__init__(self._named(name), num, den, initial_state, initial_output)
