"""Delays: of the value at a tick by a number of ticks, and of a signal in continuous time."""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = [
    "DelayN",
    "TransportDelay",
    "UnitDelay",
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
