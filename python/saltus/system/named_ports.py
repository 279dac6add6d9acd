"""`NamedPorts`: the ports of a system, all of them, or one by its name or its number."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from saltus import _core
from saltus.errors import ModelError
from saltus.ports import EventInputPort, EventOutputPort, InputPort, OutputPort, key_of

if TYPE_CHECKING:
    from saltus.system.system import System

__all__ = ["NamedPorts"]


class Count:
    """The length of a list of a system; a class of the user may have an attribute of that name."""

    def __init__(self, of: str, doc: str):
        self._of = of
        self.__doc__ = doc

    def __get__(self, system: Any, owner: type | None = None) -> Any:
        return self if system is None else len(getattr(system, self._of))


class NamedPorts:
    """The part of `System` that has its ports.

    Examples
    --------
    >>> from saltus.library import Adder
    >>> total = Adder("+-", name="total")
    >>> total.input("in_1") == total.input_ports[1]
    True
    """

    input_names: list[str]
    output_names: list[str]
    event_output_names: list[str]
    """the events from which event wires may start: zero crossings, then time events"""
    event_input_names: list[str]
    """the inputs to which event wires may lead"""
    num_input_ports = Count("input_names", "How many inputs there are.")
    num_output_ports = Count("output_names", "How many outputs there are.")

    @property
    def input_ports(self) -> tuple[InputPort, ...]:
        """All inputs, in order."""
        return tuple(InputPort(_system(self), i) for i in range(len(self.input_names)))

    @property
    def output_ports(self) -> tuple[OutputPort, ...]:
        """All outputs, in order."""
        return tuple(OutputPort(_system(self), i) for i in range(len(self.output_names)))

    def input(self, port: int | str = 0) -> InputPort:
        """One input.

        Parameters
        ----------
        port
            Its position or its name.

        Raises
        ------
        ModelError
            If no port has this name or number; the message lists the names.

        Examples
        --------
        >>> from saltus.library import Adder
        >>> Adder("+-", name="total").input(1)
        <input 'in_1' of 'total'>
        """
        return InputPort(_system(self), _core.System.find_input(_system(self), key_of(port)))

    def output(self, port: int | str = 0) -> OutputPort:
        """One output.

        Parameters
        ----------
        port
            Its position or its name.

        Raises
        ------
        ModelError
            If no port has this name or number; the message lists the names.

        Examples
        --------
        >>> from saltus.library import Gain
        >>> Gain(2.0, name="gain").output("put")
        Traceback (most recent call last):
            ...
        saltus.errors.ModelError: block 'gain' has no output 'put'; did you mean 'out'? Known: 'out'
        """
        return OutputPort(_system(self), _core.System.find_output(_system(self), key_of(port)))

    def event_output(self, event: str, entry: int | None = None) -> EventOutputPort:
        """One event from which event wires may start: a zero crossing or a time event of a block,
        or what a diagram exports.

        Parameters
        ----------
        event
            Its name.
        entry
            The guard, in a vector of guards: each of them is a source of its own.

        Raises
        ------
        ModelError
            If no event has this name; the message lists the names. If it has no such entry.

        Examples
        --------
        >>> clock = saltus.LeafSystem(name="clock")
        >>> clock.declare_periodic_update(None, period=1.0, name="tick")
        >>> clock.event_output("tick")
        <event 'tick' of 'clock'>
        """
        name, place = _event_of("event_output", event, entry)
        return EventOutputPort(
            _system(self), _core.System.find_event_output(_system(self), name, place), place
        )

    def event_input(self, port: str, entry: int | None = None) -> EventInputPort:
        """One input for events, by name, as `event_output`.

        Parameters
        ----------
        port
            Its name.
        entry
            The entry, of an input of several.

        Raises
        ------
        ModelError
            If no event input has this name; the message lists the names. If it has no such entry.

        Examples
        --------
        >>> cell = saltus.LeafSystem(name="cell")
        >>> cell.declare_event_input(lambda t, s, weight: s, name="synapse")
        >>> cell.event_input("synaps")
        Traceback (most recent call last):
            ...
        saltus.errors.ModelError: block 'cell' has no event input 'synaps'; did you mean ...
        """
        name, place = _event_of("event_input", port, entry)
        return EventInputPort(
            _system(self), _core.System.find_event_input(_system(self), name, place), place
        )


def _event_of(where: str, name: object, entry: object) -> tuple[str, int | None]:
    """The name and the entry of an event; ModelError for other types."""
    if not isinstance(name, str):
        raise ModelError(f"{where}: expected the name of an event, found {name!r}")
    place = None if entry is None else key_of(entry)
    if isinstance(place, str):
        raise ModelError(f"{where}: expected the number of an entry, found {entry!r}")
    return name, place


def _system(part: NamedPorts) -> System:
    return cast("System", part)
