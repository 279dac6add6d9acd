"""Blocks that change at ticks, at 0, dt, 2 dt, ..., counted by integers. At a tick all blocks read
their inputs before any writes.
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = ["RateLimiter", "UnitDelay", "ZeroOrderHold"]


class RateLimiter(Block, _core.RateLimiter):
    """y[k] = u[k], but at least y[k-1] + dt lower_limit and at most y[k-1] + dt upper_limit; held
    from tick k to the next. The first tick takes u as it is.

    A block that samples y at the same tick reads the value before it.

    Parameters
    ----------
    dt
        [s] From one tick to the next.
    upper_limit, lower_limit
        [1/s] times the unit of u, lower_limit <= upper_limit. Parameters of the context.
    initial_state
        y before the first tick, a number or a vector: the shape of the signal.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        For a dt that is not above 0, or limits that cross.

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


class UnitDelay(Block, _core.UnitDelay):
    """y[k] = u[k - 1], y[0] = initial_state; held from tick k to the next.

    Parameters
    ----------
    dt
        [s] From one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    initial_state
        A number or a vector: y before the first value, and the shape of the signal.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        For a dt that is not above 0.

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
        [s] From one tick to the next; ticks are at 0, dt, 2 dt, ..., counted by integers.
    initial_state
        A number or a vector: y before the first value, and the shape of the signal.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        For a dt that is not above 0.

    Examples
    --------
    >>> from saltus.library import Clock, ZeroOrderHold
    >>> saltus.response(ZeroOrderHold(dt=1.0), Clock(), t=[0.5, 1.5, 2.0])
    array([0., 1., 2.])
    """

    def __init__(self, dt: float, initial_state: ArrayLike = 0.0, *, name: str | None = None):
        super().__init__(self._named(name), dt, initial_state)
