"""The parts of a controller that acts at ticks, at 0, dt, 2 dt, ..., counted by integers: a
derivative, an integral, and PID.
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = [
    "DerivativeDiscrete",
    "IntegratorDiscrete",
    "PIDDiscrete",
]


class DerivativeDiscrete(Block, _core.DerivativeDiscrete):
    """y[k] = (u[k] - u[k-1]) / dt, entry by entry; y[0] = 0, as there is no u before the first.

    With a filter of the coefficient N: y[k] = N (u[k] - x[k]), x[k] = x[k-1] + dt y[k], x[-1] =
    u[0], so that y[0] = 0 too: the derivative s N / (s + N) of u by the backward rule, which is
    stable for every N. Simulink's Discrete Derivative has u[-1] = 0 by default: y[0] = u[0] / dt.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    filter_coefficient
        [1/s] N > 0; by default the plain difference. Parameter of the context, if given.
    initial_state
        A number, a vector or a matrix: y before the first tick, and the shape of the signal.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt or the coefficient is not above 0.

    Examples
    --------
    >>> from saltus.library import DerivativeDiscrete, Ramp
    >>> ramp = Ramp(slope=3.0, start_time=0.0)
    >>> saltus.response(DerivativeDiscrete(dt=0.5), ramp, t=[0.0, 0.5, 2.2])
    array([0., 3., 3.])
    """

    def __init__(
        self,
        dt: float,
        filter_coefficient: float | None = None,
        initial_state: ArrayLike = 0.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), dt, filter_coefficient, initial_state)


class IntegratorDiscrete(Block, _core.IntegratorDiscrete):
    """y[k] = y[k-1] + dt (w u[k] + (1 - w) u[k-1]), with w = 0 for the method 'forward', 1 for
    'backward', 1/2 for 'trapezoidal'; y[0] is the state at the start.

    Inputs, each only if its option is on, in this order: `in`, `reset_trigger`, `reset_value`,
    `hold_trigger`. Triggers are read at ticks.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    initial_state
        A number, a vector or a matrix: y[0], and the value after a reset; that is a parameter of
        the context.
    method
        'forward', 'backward' or 'trapezoidal'. With 'forward' the input does not reach the output
        at once, so the block may close a loop.
    enable_reset
        Gives the input `reset_trigger`. Where it is true at a tick and was false at the tick
        before, y[k] becomes `initial_state`.
    enable_external_reset
        Gives the input `reset_value`, which y[k] becomes instead. Needs `enable_reset`.
    enable_limits
        y is between the limits from the first tick on, after a reset too, and does not wind up.
    lower_limit, upper_limit
        Numbers, vectors or matrices, one of them may be left out. They count only with
        `enable_limits`, and are parameters of the context then.
    enable_hold
        Gives the input `hold_trigger`. While it is true, y does not change.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0, the method is unknown, or the options do not go together.

    Examples
    --------
    >>> from saltus.library import Clock, IntegratorDiscrete
    >>> saltus.response(IntegratorDiscrete(1.0), Clock(), t=[1.0, 2.0, 3.0])
    array([0., 1., 3.])
    >>> saltus.response(IntegratorDiscrete(1.0, method="trapezoidal"), Clock(), t=[1.0, 2.0, 3.0])
    array([0.5, 2. , 4.5])
    """

    def __init__(
        self,
        dt: float,
        initial_state: ArrayLike = 0.0,
        method: str = "forward",
        *,
        enable_reset: bool = False,
        enable_external_reset: bool = False,
        enable_limits: bool = False,
        lower_limit: ArrayLike | None = None,
        upper_limit: ArrayLike | None = None,
        enable_hold: bool = False,
        name: str | None = None,
    ):
        super().__init__(
            self._named(name),
            dt,
            initial_state,
            method,
            enable_reset,
            enable_external_reset,
            enable_limits,
            lower_limit,
            upper_limit,
            enable_hold,
        )


class PIDDiscrete(Block, _core.PIDDiscrete):
    """v[k] = kp u[k] + i[k] + kd d[k]; y[k] = v[k], or v[k] between the limits.

    i[k+1] = i[k] + ki dt u[k], and d[k] = n (u[k] - f[k]) with f[k] = f[k-1] + dt d[k], the
    derivative behind a filter. u is the error. f[-1] = u[0]: the first tick makes no kick, d[0] =
    0. With a limit the integral does not change at ticks where v is beyond the limit and ki u
    pushes outward.

    A `PID` starts its filter at f(0) = 0, and the PIDDiscrete of pycollimator and Simulink's
    Discrete PID Controller start theirs at 0 too: by the same rule d[0] = n u[0] / (1 + n dt). The
    last entries of the discrete state are i, f, and 1 after the first tick: in a context with 1 there,
    the run starts with the f of the context.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    kp, ki, kd
        The gains: in y per u, in y per u and second, and in y seconds per u.
    n
        [1/s] The coefficient of the filter, > 0. The rule is stable for every n.
    initial_state
        i[0], in the unit of y, and y before the first tick.
    lower_limit, upper_limit
        In the unit of y; either may be left out. All numbers but `dt` and `initial_state` are
        parameters of the context.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt or n is not above 0, or the limits cross.

    Examples
    --------
    >>> from saltus.library import PIDDiscrete
    >>> saltus.response(PIDDiscrete(1.0, 2.0, ki=1.0), 1.0, t=[0.0, 1.0, 3.0])
    array([2., 3., 5.])
    """

    def __init__(
        self,
        dt: float,
        kp: float = 1.0,
        ki: float = 0.0,
        kd: float = 0.0,
        *,  # in other tools the next one is the state at the start
        n: float = 100.0,
        initial_state: float = 0.0,
        lower_limit: float | None = None,
        upper_limit: float | None = None,
        name: str | None = None,
    ):
        super().__init__(
            self._named(name), dt, kp, ki, kd, n, initial_state, lower_limit, upper_limit
        )
