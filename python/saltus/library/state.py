"""Blocks with a state."""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block


class Integrator(Block, _core.Integrator):
    """dx/dt = u, y = x, in the shape of `initial_state`.

    Inputs, each only if its option is on, in this order: 'in'; 'reset_trigger' (`enable_reset`), on
    whose rising edge x becomes `initial_state`; 'reset_value' (`enable_external_reset`), which it
    becomes instead; 'hold_trigger' (`enable_hold`), while which is true x stands still. With
    `enable_limits` an entry stands still while it is at `lower_limit` or `upper_limit` and pushed
    outward. `zeno_tolerance` [s] overrides that of the simulator options, 0 switches the Zeno
    monitor off. Parameters `initial_state`, `lower_limit`, `upper_limit`. Where a run starts is the
    continuous state of the context.
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
    """y[k] = u[k-1], y[0] = initial_state; held from tick k, at k dt [s], to the next."""

    def __init__(self, dt: float, initial_state: ArrayLike = 0.0, *, name: str | None = None):
        super().__init__(self._named(name), dt, initial_state)


class ZeroOrderHold(Block, _core.ZeroOrderHold):
    """y(t) = u(k dt) for k dt <= t < (k+1) dt, dt in seconds; initial_state, which gives the shape,
    before the first tick.
    """

    def __init__(self, dt: float, initial_state: ArrayLike = 0.0, *, name: str | None = None):
        super().__init__(self._named(name), dt, initial_state)
