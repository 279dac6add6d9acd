"""Blocks that change at ticks, at 0, dt, 2 dt, ..., counted by integers. At a tick all blocks read
their inputs before any writes.
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = [
    "DiscreteClock",
    "EdgeDetection",
    "RateLimiter",
    "RateTransition",
    "ZeroOrderHold",
]


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
