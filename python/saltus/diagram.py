"""Blocks and wires: `DiagramBuilder` collects them, `Diagram` is the system they make."""

from __future__ import annotations

from typing import overload

from saltus import _core
from saltus.errors import ModelError
from saltus.system import InputPort, OutputPort, System

__all__ = ["Diagram", "DiagramBuilder"]


def _port(port: object, kind: type[OutputPort] | type[InputPort]) -> tuple[System, int]:
    if not isinstance(port, kind):
        example = "input_ports[0]" if kind is InputPort else "output_ports[0]"
        raise ModelError(f"expected a port, such as block.{example}, found {port!r}")
    return port.system, port.index


class Diagram(System, _core.Diagram):
    """A system of blocks and wires, made by `DiagramBuilder.build`. `diagram["gain"]` is the block
    of that name.

    A diagram is a system like any other: it can be added to another diagram, to any depth. It keeps
    its blocks alive.
    """

    def __init__(self, builder: _core.DiagramBuilder, name: str, children: dict[str, System]):
        super().__init__(builder, name)
        self._children = children

    def __getitem__(self, name: str) -> System:
        """A block of this diagram by name. ModelError lists the names there are."""
        if name not in self._children:
            self.require(name)  # raises
        return self._children[name]

    @property
    def blocks(self) -> tuple[System, ...]:
        """The blocks of this diagram, in the order of `add`."""
        return tuple(self._children.values())


class DiagramBuilder:
    """Collects blocks and wires, and is spent by `build`.

    A name used twice, a port of a block that was not added, an input with two sources and, in
    `build`, an input with none are a ModelError.
    """

    def __init__(self) -> None:
        self._core = _core.DiagramBuilder()
        self._children: dict[str, System] = {}

    @overload
    def add(self, system: System, /) -> System: ...
    @overload
    def add(self, *systems: System) -> tuple[System, ...]: ...
    def add(self, *systems: System) -> System | tuple[System, ...]:
        """Adds blocks or diagrams; returns the one given, or all of them as a tuple."""
        for system in systems:
            if not isinstance(system, System):
                raise ModelError(f"add: expected a system, found {system!r}")
            self._core.add(system)
            self._children[system.name] = system
        return systems[0] if len(systems) == 1 else systems

    def connect(self, source: OutputPort, destination: InputPort) -> None:
        """A wire from an output to an input."""
        self._core.connect(*_port(source, OutputPort), *_port(destination, InputPort))

    def export_input(self, port: InputPort, name: str | None = None) -> int:
        """Makes an input of a block one of the diagram, called 'block_port' if not said; returns
        its position there.
        """
        return self._core.export_input(*_port(port, InputPort), name or "")

    def export_output(self, port: OutputPort, name: str | None = None) -> int:
        """Makes an output of a block one of the diagram, called 'block_port' if not said; returns
        its position there.
        """
        return self._core.export_output(*_port(port, OutputPort), name or "")

    def build(self, name: str = "root") -> Diagram:
        """The diagram."""
        return Diagram(self._core, name, self._children)
