"""Blocks that change at ticks, at 0, dt, 2 dt, ..., counted by integers. At a tick all blocks read
their inputs before any writes.
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = ["UnitDelay", "ZeroOrderHold"]


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
    """y(t) = u(k dt) for k dt <= t < (k + 1) dt: what the input was at the last tick.

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
