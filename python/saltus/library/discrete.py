"""Blocks that change at ticks, at 0, dt, 2 dt, ..., counted by integers. At a tick all blocks read
their inputs before any writes. And the delay in continuous time.
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = [
    "DelayN",
    "DiscreteClock",
    "EdgeDetection",
    "RateLimiter",
    "RateTransition",
    "TransportDelay",
    "UnitDelay",
    "ZeroOrderHold",
]


class DelayN(Block, _core.DelayN):
    """y[k] = u[k - n], and initial_state for k < n; held from tick k to the next.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    n
        The number of ticks by which y is behind u, 1 or more.
    initial_state
        A number, a vector or a matrix: y before the first value, and the shape of the signal.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0, or n is below 1.

    Examples
    --------
    >>> from saltus.library import Clock, DelayN
    >>> saltus.response(DelayN(dt=1.0, n=3), Clock(), t=[2.5, 3.5, 5.0])
    array([0., 0., 2.])
    """

    def __init__(
        self, dt: float, n: int, initial_state: ArrayLike = 0.0, *, name: str | None = None
    ):
        super().__init__(self._named(name), dt, n, initial_state)


class DiscreteClock(Block, _core.DiscreteClock):
    """y = k dt [s], from tick k to the next; 0 before the first tick.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0.

    Examples
    --------
    >>> from saltus.library import DiscreteClock
    >>> saltus.response(DiscreteClock(dt=0.5), t=[0.4, 0.5, 1.7])
    array([0. , 0.5, 1.5])
    """

    def __init__(self, dt: float, *, name: str | None = None):
        super().__init__(self._named(name), dt)


class EdgeDetection(Block, _core.EdgeDetection):
    """y[k] = 1 if the truth of u changed from tick k - 1 to tick k, in the direction of the edge;
    else 0. y is a boolean, held to the next tick. u is one boolean, true if it is not 0.

    A truth that changes and changes back between two ticks has no edge: a `Counter` sees each.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    edge
        'rising', 'falling' or 'either'.
    initial_state
        The truth of u before the first tick.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0, or the edge is unknown.

    Examples
    --------
    >>> from saltus.library import EdgeDetection, Step
    >>> saltus.response(EdgeDetection(dt=1.0), Step(step_time=1.5), t=[1.0, 2.0, 3.0])
    array([0., 1., 0.])
    """

    def __init__(
        self,
        dt: float,
        edge: str = "rising",
        initial_state: bool = False,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), dt, edge, initial_state)


class RateLimiter(Block, _core.RateLimiter):
    """y[k] = u[k], but at least y[k-1] + dt lower_limit and at most y[k-1] + dt upper_limit; held
    from tick k to the next. The first tick takes u as it is.

    A block that samples y at the same tick reads the value before it.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next.
    upper_limit, lower_limit
        [1/s] times the unit of u, lower_limit <= upper_limit. Parameters of the context.
    initial_state
        y before the first tick, a number, a vector or a matrix: the shape of the signal.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0, or the limits cross.

    Examples
    --------
    >>> from saltus.library import RateLimiter, Step
    >>> block = RateLimiter(dt=0.5, upper_limit=2.0)
    >>> saltus.response(block, Step(0.0, 5.0, step_time=1.0), t=[0.9, 1.2, 1.6, 9.0])
    array([0., 1., 2., 5.])
    """

    def __init__(
        self,
        dt: float,
        upper_limit: float = 1.0,
        lower_limit: float = -1.0,
        initial_state: ArrayLike = 0.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), dt, upper_limit, lower_limit, initial_state)


class RateTransition(Block, _core.RateTransition):
    """y[k] = u[k]: the input at tick k, held to the next tick.

    At a tick y is u as it is at that tick: a block with a slow period reads one with a fast period
    without a delay. A `ZeroOrderHold` shows a block that samples it at the same tick the value
    before. From a slow period to a fast one nothing is needed: outputs are held.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at offset + k dt, counted by integers.
    initial_state
        A number, a vector or a matrix: y before the first tick, and the shape of the signal.
    offset
        [s] The time of the first tick.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0, or offset is not finite.

    Examples
    --------
    >>> from saltus.library import DiscreteClock, RateTransition
    >>> saltus.response(RateTransition(dt=1.0), DiscreteClock(dt=0.5), t=[0.6, 1.0, 1.6])
    array([0., 1., 1.])
    """

    def __init__(
        self,
        dt: float,
        initial_state: ArrayLike = 0.0,
        offset: float = 0.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), dt, initial_state, offset)


class TransportDelay(Block, _core.TransportDelay):
    """y(t) = u(t - delay), and initial_output for t < t0 + delay, t0 the begin of the first run.

    Between events the input is kept as polynomials, within a tenth of the tolerance of the run.
    Each jump, and each kink that an event makes in the input, is a time event of the output,
    exactly `delay` later. No step of the solver is longer than the delay. There is no feedthrough,
    so the block may close a loop: x' = -x(t - 1). The past is part of the discrete state: a context
    that is saved and loaded has it, and a run that goes on from it too.

    Parameters
    ----------
    delay
        [s] By how much y is behind u, above 0.
    initial_output
        A number, a vector or a matrix: y before the first value, and the shape of the signal. It is
        a parameter of the context.
    capacity
        The number of pieces of the input that are kept, 4 or more; about one for each step within
        the delay. It fixes the size of the state: 3 + 9 numbers a piece, for a number.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the delay is not above 0, or the capacity is below 4.
    SimulationError
        If the input needs more pieces within the delay than the capacity, or if a run does not
        begin where the past of its context ends.

    Notes
    -----
    The method of steps: A. Bellen, M. Zennaro, "Numerical Methods for Delay Differential
    Equations", 2003, ch. 3.

    Examples
    --------
    >>> from saltus.library import Clock, TransportDelay
    >>> saltus.response(TransportDelay(0.5, initial_output=-1.0), Clock(), t=[0.25, 1.0, 2.0])
    array([-1. ,  0.5,  1.5])
    """

    def __init__(
        self,
        delay: float,
        *,
        initial_output: ArrayLike = 0.0,
        capacity: int = 256,
        name: str | None = None,
    ):
        super().__init__(self._named(name), delay, initial_output, capacity)


class UnitDelay(Block, _core.UnitDelay):
    """y[k] = u[k - 1], y[0] = initial_state; held from tick k to the next.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    initial_state
        A number, a vector or a matrix: y before the first value, and the shape of the signal.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0.

    Examples
    --------
    >>> from saltus.library import Clock, UnitDelay
    >>> saltus.response(UnitDelay(dt=1.0), Clock(), t=[0.5, 1.5, 2.0])
    array([0., 0., 1.])
    """

    def __init__(self, dt: float, initial_state: ArrayLike = 0.0, *, name: str | None = None):
        super().__init__(self._named(name), dt, initial_state)


class ZeroOrderHold(Block, _core.ZeroOrderHold):
    """y(t) = u(k dt) for k dt <= t < (k + 1) dt: the input at the last tick.

    Parameters
    ----------
    dt
        [s] The time from one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    initial_state
        A number, a vector or a matrix: y before the first value, and the shape of the signal.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If dt is not above 0.

    Examples
    --------
    >>> from saltus.library import Clock, ZeroOrderHold
    >>> saltus.response(ZeroOrderHold(dt=1.0), Clock(), t=[0.5, 1.5, 2.0])
    array([0., 1., 2.])
    """

    def __init__(self, dt: float, initial_state: ArrayLike = 0.0, *, name: str | None = None):
        super().__init__(self._named(name), dt, initial_state)
