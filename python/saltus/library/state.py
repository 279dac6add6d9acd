"""Blocks with a continuous state."""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = ["Integrator", "SecondOrderIntegrator", "SlewRateLimiter"]


class Integrator(Block, _core.Integrator):
    """dx/dt = u, y = x, in the shape of `initial_state`.

    Inputs, each only if its option is on, in this order: `in`, `reset_trigger`, `reset_value`,
    `hold_trigger`.

    Parameters
    ----------
    initial_state
        A number, a vector or a matrix: the state at the start, and after a reset. The start of one
        run is the continuous state of its context; the parameter `initial_state` of the context is
        the state after a reset.
    enable_reset
        Gives the input `reset_trigger`, a boolean on whose rising edge x becomes `initial_state`.
    enable_external_reset
        Gives the input `reset_value`, which x becomes instead. Needs `enable_reset`.
    zeno_tolerance
        [s] Overrides the option of the simulator; 0 switches the Zeno monitor off.
    enable_limits
        An entry does not move while it is at a limit and its derivative points outward.
    lower_limit, upper_limit
        Numbers, vectors or matrices, one of them may be left out. They count only with
        `enable_limits`, and are parameters of the context then.
    enable_hold
        Gives the input `hold_trigger`, a boolean. While it is true, x does not change.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the options do not go together, such as `enable_external_reset` alone.

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


class SecondOrderIntegrator(Block, _core.SecondOrderIntegrator):
    """d2x/dt2 = u: the position and the velocity of a body, entry by entry, with stops.

    Outputs: `x`, the position, and `dx`, the velocity. Where x reaches a limit outward it becomes
    the limit, and the velocity becomes -restitution times its value before. A body with restitution
    0, or whose rebounds accumulate, rests at the limit until u points inward. A run that
    would begin beyond a limit of x or dx, where a context puts the state or the limit there, raises
    a `BlockParameterError`.

    Parameters
    ----------
    initial_position
        A number, a vector or a matrix: the shape of the signal.
    initial_velocity
        A number or a vector.
    lower_limit, upper_limit
        Of the position, a number or a vector each; either may be left out. Parameters of the
        context.
    restitution
        0 to 1. Parameter of the context, if there is a limit.
    lower_velocity_limit, upper_velocity_limit
        Of the velocity, a number or a vector each; either may be left out. Parameters of the
        context. An entry at a limit keeps its velocity while u points outward, and a rebound is
        within the limits.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If limits cross, the start is outside of them, or the restitution is impossible.

    Examples
    --------
    A body pushed against a stop at 0.5 m:

    >>> from saltus.library import SecondOrderIntegrator
    >>> block = SecondOrderIntegrator(upper_limit=0.5)
    >>> x, v = saltus.response(block, 1.0, t=[0.5, 2.0])
    >>> x, v
    (array([0.125, 0.5  ]), array([0.5, 0. ]))
    """

    def __init__(
        self,
        initial_position: ArrayLike = 0.0,
        initial_velocity: ArrayLike = 0.0,
        *,
        lower_limit: ArrayLike | None = None,
        upper_limit: ArrayLike | None = None,
        restitution: float = 0.0,
        lower_velocity_limit: ArrayLike | None = None,
        upper_velocity_limit: ArrayLike | None = None,
        name: str | None = None,
    ):
        super().__init__(
            self._named(name),
            initial_position,
            initial_velocity,
            lower_limit,
            upper_limit,
            restitution,
            lower_velocity_limit,
            upper_velocity_limit,
        )


class SlewRateLimiter(Block, _core.SlewRateLimiter):
    """dy/dt = min(max((u - y) / time_constant, lower_limit), upper_limit), entry by entry: y
    follows u, but no faster than the limits, in continuous time.

    A rate of u is not needed. Where u is slower than the limits, y lags it by time_constant times
    its rate. The times at which a limit begins and ends to act are located. `RateLimiter` is the
    same at ticks.

    Parameters
    ----------
    upper_limit, lower_limit
        [1/s] Numbers >= 0 and <= 0, parameters of the context.
    time_constant
        [s] > 0, a parameter of the context.
    initial_state
        y at the start, a number or a vector.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If a limit has the wrong sign, or the time constant is not above 0.

    Examples
    --------
    >>> from saltus.library import SlewRateLimiter
    >>> saltus.response(SlewRateLimiter(0.5), 2.0, t=[1.0, 2.0, 9.0]).round(6)
    array([0.5, 1. , 2. ])
    """

    def __init__(
        self,
        upper_limit: float = 1.0,
        lower_limit: float = -1.0,
        time_constant: float = 0.001,
        initial_state: ArrayLike = 0.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), upper_limit, lower_limit, time_constant, initial_state)
