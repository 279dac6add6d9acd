"""The event inputs of a block: reset maps for the events of other blocks."""

from __future__ import annotations

from collections.abc import Callable

from numpy.typing import ArrayLike

from saltus import _core
from saltus._declarations import RequiresInputs, callback_of, inputs_of
from saltus._porting import refusing

__all__ = ["DeclaresEventInputs"]


class DeclaresEventInputs(_core.LeafSystem):
    """Declares what the events of other blocks do here."""

    __slots__ = ()

    @refusing
    def declare_event_input(
        self,
        reset_map: Callable[..., _core.State | ArrayLike],
        name: str | None = None,
        size: int = 1,
        requires_inputs: RequiresInputs = True,
    ) -> None:
        """Declares an input for events of other blocks, to which `DiagramBuilder.connect_event`
        leads wires.

        Each delivery of a wire applies `reset_map(time, state, *inputs, weight, **parameters)`,
        which returns x+ from x-, as the reset map of a zero crossing does; `weight` is that of the
        wire, a float. With `size` n wires lead to the entries 0 to n - 1 of the input, and
        `state.entry` is the entry. The map sees what earlier updates, reset maps and deliveries of
        the same pass wrote to its block.

        Raises ModelError for a name declared twice, a name with a dot, and a `size` below 1.

        Examples
        --------
        >>> bell, counter = saltus.LeafSystem(name="bell"), saltus.LeafSystem(name="counter")
        >>> bell.declare_periodic_update(None, period=1.0, name="rings")
        >>> counter.declare_discrete_state([0.0])
        >>> counter.declare_event_input(
        ...     lambda t, s, weight: s.with_discrete_state(s.discrete_state + weight), name="count"
        ... )
        >>> builder = saltus.DiagramBuilder()
        >>> builder.add(bell, counter)
        (<LeafSystem 'bell'>, <LeafSystem 'counter'>)
        >>> builder.connect_event("bell.rings", "counter.count", weight=2.0, delay=0.5)
        >>> diagram = builder.build()
        >>> saltus.simulate(diagram, time_span=(0.0, 3.75)).context.discrete_state
        array([8.])
        """
        super().declare_event_input(
            callback_of(reset_map), name or "", size, inputs_of(requires_inputs)
        )
