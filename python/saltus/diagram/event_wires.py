"""Event wires of a builder, and the events that a diagram makes its own."""

from __future__ import annotations

from saltus._whole import is_whole
from saltus.diagram.parts import BuilderParts
from saltus.errors import ModelError
from saltus.ports import EventInputPort, EventOutputPort, core_port
from saltus.system import System

__all__ = ["WiresEvents"]


def _event_port(
    port: object, kind: type[EventOutputPort] | type[EventInputPort]
) -> tuple[System, int, int | None]:
    if not isinstance(port, kind):
        wanted = (
            'an event input, such as block.event_input("synapse")'
            if kind is EventInputPort
            else 'an event, such as block.event_output("fire")'
        )
        raise ModelError(f"expected {wanted}, found {port!r}")
    if port.entry is not None and not is_whole(port.entry):
        raise ModelError(f"expected the number of an entry, found {port.entry!r}")
    return *core_port(port), port.entry


def _number(what: str, value: object) -> float:
    """A number as a float; ModelError for all else."""
    if isinstance(value, (bool, str)):
        raise ModelError(f"{what}: expected a number, found {value!r}")
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        raise ModelError(f"{what}: expected a number, found {value!r}") from None


class WiresEvents(BuilderParts):
    """Leads events of one block to another."""

    def connect_event(
        self,
        source: EventOutputPort | str,
        target: EventInputPort | str,
        weight: float = 1.0,
        delay: float = 0.0,
    ) -> None:
        """A wire from an event of one block to an event input of another, or of the same: each
        firing of the event applies the reset map of the input.

        Parameters
        ----------
        source
            A zero crossing or a time event of a block that was added, such as
            `block.event_output("fire")` or "block.fire"; any number of wires may leave it.
        target
            An event input of a block that was added, such as `block.event_input("synapse")` or
            "block.synapse"; any number of wires may lead to it.
        weight
            A finite number, which the reset map gets.
        delay
            [s] With 0 the reset map is applied in the next pass of the instant; otherwise this long
            after the firing, at an exact stop.

        Raises
        ------
        ModelError
            If a block was not added or has no such event or event input, if the weight is not
            finite, or if the delay is negative or not finite. A plan refuses wires of blocks in a
            part that is executed by a control signal.

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
        >>> builder.connect_event("bell.rings", "counter.count", weight=0.5)
        >>> diagram = builder.build()
        >>> saltus.simulate(diagram, time_span=(0.0, 3.75)).context.discrete_state
        array([2.])
        """
        begin, end = self._event(source, True), self._event(target, False)
        what = "connect_event"
        self._core.connect_event(
            *_event_port(begin, EventOutputPort),
            *_event_port(end, EventInputPort),
            _number(f"{what}: weight", weight),
            _number(f"{what}: delay [s]", delay),
        )

    def export_event_output(self, port: EventOutputPort | str, name: str | None = None) -> int:
        """Makes an event of a block one of the diagram, so that event wires around the diagram may
        start from it.

        Parameters
        ----------
        port
            An event of a block that was added; or its path, "block.event". With all of its entries:
            the wire names one.
        name
            The name of the event of the diagram; by default 'block_event'.

        Returns
        -------
        int
            Its position among the events of the diagram.

        Examples
        --------
        >>> bell = saltus.LeafSystem(name="bell")
        >>> bell.declare_periodic_update(None, period=1.0, name="rings")
        >>> builder = saltus.DiagramBuilder()
        >>> builder.add(bell)
        <LeafSystem 'bell'>
        >>> builder.export_event_output("bell.rings", "rings")
        0
        >>> builder.build("tower").event_output_names
        ['rings']
        """
        own = self._event(port, True)
        return self._core.export_event_output(*_event_port(own, EventOutputPort), name or "")

    def export_event_input(self, port: EventInputPort | str, name: str | None = None) -> int:
        """Makes an event input of a block one of the diagram, as `export_event_output`.

        Parameters
        ----------
        port
            An event input of a block that was added; or its path, "block.input".
        name
            The name of the event input of the diagram; by default 'block_input'.

        Returns
        -------
        int
            Its position among the event inputs of the diagram.

        Examples
        --------
        >>> cell = saltus.LeafSystem(name="cell")
        >>> cell.declare_event_input(lambda t, s, weight: s, name="synapse")
        >>> builder = saltus.DiagramBuilder()
        >>> builder.add(cell)
        <LeafSystem 'cell'>
        >>> builder.export_event_input("cell.synapse")
        0
        >>> builder.build().event_input_names
        ['cell_synapse']
        """
        own = self._event(port, False)
        return self._core.export_event_input(*_event_port(own, EventInputPort), name or "")

    def _event(
        self, port: EventOutputPort | EventInputPort | str, output: bool
    ) -> EventOutputPort | EventInputPort:
        if not isinstance(port, str):
            return port
        kind = "event_output" if output else "event_input"
        block, name = self._from("connect_event", port, kind)
        return block.event_output(name) if output else block.event_input(name)
