"""The time events of a block."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from numpy.typing import ArrayLike

from saltus import _core
from saltus._declarations import callback_of
from saltus._porting import refusing
from saltus.errors import ModelError

__all__ = ["DeclaresTimes"]


class DeclaresTimes(_core.LeafSystem):
    """Declares updates at times that are known before the run."""

    __slots__ = ()

    @refusing
    def declare_periodic_update(
        self,
        callback: Callable[..., _core.State | ArrayLike],
        period: float,
        offset: float = 0.0,
        name: str | None = None,
    ) -> None:
        """Declares an update at offset + k period [s], k = 0, 1, ...: the callback returns the new
        state, or the new discrete state alone (the continuous state if the block has no other).
        """
        super().declare_periodic_update(callback_of(callback), period, offset, name or "")

    @refusing
    def declare_time_event(
        self,
        callback: Callable[..., _core.State | ArrayLike] | None = None,
        *,
        times: Sequence[float] | None = None,
        period: float | None = None,
        offset: float = 0.0,
        end: float = math.inf,
        count: int | None = None,
        name: str | None = None,
    ) -> None:
        """Declares an update at each of `times` [s], or at offset + k period [s], k = 0, 1, ..., or
        once at `offset`: the callback returns the new state, or the new discrete state alone.

        No update is later than `end` [s], and there are at most `count`, from the first one on. The
        times increase. Without a callback it is an exact stop at which held outputs are evaluated
        again.

        Raises
        ------
        ModelError
            If the times do not increase, if there are times beside a period or an offset, or if a
            period or a count is not positive.

        Examples
        --------
        >>> class Doses(saltus.LeafSystem):
        ...     def __init__(self):
        ...         super().__init__(name="doses")
        ...         self.declare_continuous_state([0.0], ode=lambda t, s: -s.continuous_state)
        ...         self.declare_time_event(self.dose, times=[0.5, 1.0, 4.0], end=2.0, name="dose")
        ...     def dose(self, time, state):
        ...         return state.with_continuous_state(state.continuous_state + 1.0)
        >>> doses = Doses()
        >>> results = saltus.simulate(doses, doses.create_context(), (0.0, 5.0))
        >>> results.events.times("dose", "time").tolist()
        [0.5, 1.0]
        """
        try:
            listed = None if times is None else [float(t) for t in times]
        except (TypeError, ValueError):
            raise ModelError(
                f"block '{self.name}': time event: expected times [s], found {times!r}"
            ) from None
        super().declare_time_event(
            callback_of(callback), period, offset, listed, end, count, name or ""
        )

    @refusing
    def declare_one_shot(
        self,
        callback: Callable[..., _core.State | ArrayLike] | None,
        time: float,
        name: str | None = None,
    ) -> None:
        """Declares an update once, at `time` [s]. Without a callback it is an exact stop at which
        held outputs are evaluated again.
        """
        super().declare_one_shot(callback_of(callback), time, name or "")
