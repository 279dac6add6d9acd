"""Blocks with a state."""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = ["Integrator", "UnitDelay", "ZeroOrderHold"]


class Integrator(Block, _core.Integrator):
    """dx/dt = u, y = x, in the shape of `initial_state`.

    Inputs, each only if its option is on, in this order: `in`, `reset_trigger`, `reset_value`,
    `hold_trigger`.

    Parameters
    ----------
    initial_state
        A number or a vector: where the state starts, and where a reset puts it. Where one run
        starts is the continuous state of its context; the parameter `initial_state` of the
        context is what a reset goes to.
    enable_reset
        Gives the input `reset_trigger`, a boolean on whose rising edge x becomes `initial_state`.
    enable_external_reset
        Gives the input `reset_value`, which x becomes instead. Needs `enable_reset`.
    zeno_tolerance
        [s] Overrides the option of the simulator; 0 switches the Zeno monitor off.
    enable_limits
        An entry does not move while it is at a limit and its derivative points outward.
    lower_limit, upper_limit
        A number or a vector each, one of them may be left out. They count only with
        `enable_limits`, and are parameters of the context then.
    enable_hold
        Gives the input `hold_trigger`, a boolean. While it is true, x does not change.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        For options that do not go together, such as `enable_external_reset` alone.

    Examples
    --------
    A falling body, 5 m up: its height after 1 s.

    >>> from saltus.library import Constant, Integrator
    >>> builder = saltus.DiagramBuilder()
    >>> g, v, y = builder.add(Constant(-9.81), Integrator(), Integrator(5.0))
    >>> builder.connect(g.output(), v.input())
    >>> builder.connect(v.output(), y.input())
    >>> diagram = builder.build()
    >>> end = saltus.simulate(diagram, diagram.create_context(), (0.0, 1.0)).context
    >>> round(float(end[y].continuous_state[0]), 6)
    0.095
    """

    def __init__(
        self,
        initial_state: ArrayLike = 0.0,
        *,
        enable_reset: bool = False,
        enable_external_reset: bool = False,
        zeno_tolerance: float | None = None,
        enable_limits: bool = False,
        lower_limit: ArrayLike | None = None,
        upper_limit: ArrayLike | None = None,
        enable_hold: bool = False,
        name: str | None = None,
    ):
        super().__init__(
            self._named(name),
            initial_state,
            enable_reset,
            enable_external_reset,
            zeno_tolerance,
            enable_limits,
            lower_limit,
            upper_limit,
            enable_hold,
        )


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
    >>> builder = saltus.DiagramBuilder()
    >>> t, block = builder.add(Clock(), UnitDelay(dt=1.0))
    >>> builder.connect(t.output(), block.input())
    >>> diagram = builder.build()
    >>> results = saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 2.0), save_at=[0.5, 1.5],
    ...     recorded_signals={"y": block.output()},
    ... )
    >>> results.time
    array([0. , 0. , 0.5, 1. , 1. , 1.5, 2. , 2. ])
    >>> results.outputs["y"]
    array([0., 0., 0., 0., 0., 0., 0., 1.])
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
    >>> builder = saltus.DiagramBuilder()
    >>> t, block = builder.add(Clock(), ZeroOrderHold(dt=1.0))
    >>> builder.connect(t.output(), block.input())
    >>> diagram = builder.build()
    >>> results = saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 2.0), save_at=[0.5, 1.5],
    ...     recorded_signals={"y": block.output()},
    ... )
    >>> results.time
    array([0. , 0. , 0.5, 1. , 1. , 1.5, 2. , 2. ])
    >>> results.outputs["y"]
    array([0., 0., 0., 0., 1., 1., 1., 2.])
    """

    def __init__(self, dt: float, initial_state: ArrayLike = 0.0, *, name: str | None = None):
        super().__init__(self._named(name), dt, initial_state)
