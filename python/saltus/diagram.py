"""Blocks and wires: `DiagramBuilder` collects them, `Diagram` is the system they make."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from saltus import _core
from saltus._porting import is_reset, missing
from saltus._signals import block_of
from saltus._whole import is_whole
from saltus.errors import ModelError
from saltus.parameter import Parameter
from saltus.ports import EventInputPort, EventOutputPort, core_port
from saltus.system import InputPort, OutputPort, System, remember

__all__ = ["Diagram", "DiagramBuilder"]


def _port(port: object, kind: type[OutputPort] | type[InputPort]) -> tuple[System, int]:
    if not isinstance(port, kind):
        wanted = "an input" if kind is InputPort else "an output"
        wanted = wanted if isinstance(port, (InputPort, OutputPort)) else "a port"
        example = "input_ports[0]" if kind is InputPort else "output_ports[0]"
        raise ModelError(f"expected {wanted}, such as block.{example}, found {port!r}")
    return core_port(port)


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


def number_of(what: str, value: object) -> float:
    """A number as a float; ModelError for all else."""
    if isinstance(value, (bool, str)):
        raise ModelError(f"{what}: expected a number, found {value!r}")
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        raise ModelError(f"{what}: expected a number, found {value!r}") from None


class Diagram(System, _core.Diagram):
    """A system of blocks and wires, made by `DiagramBuilder.build`.

    `diagram["gain"]` is the block with that name. A diagram is a system like any other: it can be
    added to another diagram, to any depth. It keeps its blocks alive.

    Examples
    --------
    >>> from saltus.library import Constant, Integrator
    >>> builder = saltus.DiagramBuilder()
    >>> speed, x = builder.add(Constant(2.0, name="speed"), Integrator(name="x"))
    >>> builder.connect(speed.output(), x.input())
    >>> builder.export_output(x.output(), "position")
    0
    >>> diagram = builder.build("car")
    >>> diagram["x"].name, [block.name for block in diagram.blocks]
    ('x', ['speed', 'x'])
    >>> results = saltus.simulate(diagram, diagram.create_context(), (0.0, 3.0))
    >>> results.context[diagram["x"]].continuous_state
    array([6.])
    """

    def __init__(
        self,
        builder: _core.DiagramBuilder,
        name: str,
        children: dict[str, System],
        parameters: Mapping[str, Parameter] = {},
    ):
        super().__init__(builder, name)
        self._children = children
        self._expressions = dict(parameters)
        remember(self)

    def __getitem__(self, name: str) -> System:
        """A block of this diagram by name. ModelError lists the known names."""
        if name not in self._children:
            self.require(name)  # raises
        return self._children[name]

    @property
    def blocks(self) -> tuple[System, ...]:
        """The blocks of this diagram, in the order of `add`."""
        return tuple(self._children.values())

    @property
    def nodes(self) -> tuple[System, ...]:
        """The blocks of this diagram, as `blocks`."""
        return self.blocks

    @property
    def num_systems(self) -> int:
        """How many blocks this diagram has, an inner diagram counted as one."""
        return len(self._children)

    def find_system_with_path(self, path: str) -> System:
        """The block at a path of names, such as "car.engine"; ModelError if there is none.

        Examples
        --------
        >>> from saltus.library import Clock
        >>> builder = saltus.DiagramBuilder()
        >>> clock = builder.add(Clock(name="clock"))
        >>> builder.build().find_system_with_path("clock")
        <Clock 'clock'>
        """
        if not isinstance(path, str):
            raise ModelError(f"expected a path such as 'car.engine', found {path!r}")
        system: System = self
        for name in path.split("."):
            system = block_of(system, name)
        return system

    @property
    def parameters(self) -> dict[str, float | np.ndarray]:
        """The default value of each parameter: of its blocks by path, such as 'gain.gain', and its
        own by name.
        """
        return self.create_context().parameters


OF_BUILDER = {
    **dict.fromkeys(("add_block", "add_system", "AddSystem"), "it is builder.add(block)"),
    **dict.fromkeys(("Connect", "wire", "link"), "it is builder.connect(output, input)"),
    **dict.fromkeys(("Build", "compile", "finish"), "it is builder.build()"),
    **dict.fromkeys(("export", "ExportOutput"), "it is builder.export_output(port, name)"),
    "ExportInput": "it is builder.export_input(port, name)",
}
"""names of a builder in similar tools -> those here"""


class DiagramBuilder:
    """Collects blocks and wires. `build` uses it up.

    Raises
    ------
    ModelError
        If a name is used twice, a port belongs to a block that was not added, an input has two
        sources, or, in `build`, an input has no source.

    Examples
    --------
    >>> from saltus.library import Constant, Integrator
    >>> builder = saltus.DiagramBuilder()
    >>> speed, x = builder.add(Constant(2.0, name="speed"), Integrator(name="x"))
    >>> builder.connect(speed.output(), x.input())
    >>> builder.export_output(x.output(), "position")
    0
    >>> diagram = builder.build("car")
    >>> diagram.output_names
    ['position']
    """

    def __init__(self) -> None:
        self._core = _core.DiagramBuilder()
        self._children: dict[str, System] = {}

    if not TYPE_CHECKING:  # a type checker knows the names that are there

        def __getattr__(self, name: str) -> Any:
            return missing(self, name, OF_BUILDER)

    @overload
    def add(self, system: System, /) -> System: ...
    @overload
    def add(self, *systems: System) -> tuple[System, ...]: ...
    def add(self, *systems: System) -> System | tuple[System, ...]:
        """Adds blocks or diagrams.

        Parameters
        ----------
        systems
            One or more. Each needs a name of its own in this diagram.

        Returns
        -------
        System or tuple of System
            The given system, or all of them as a tuple.

        Examples
        --------
        >>> from saltus.library import Clock, Gain
        >>> builder = saltus.DiagramBuilder()
        >>> t = builder.add(Clock())
        >>> double, half = builder.add(Gain(2.0), Gain(0.5))
        """
        for system in systems:
            if not isinstance(system, System):
                raise ModelError(f"add: expected a system, found {system!r}")
            self._core.add(system)
            self._children[system.name] = system
        return systems[0] if len(systems) == 1 else systems

    def connect(self, source: OutputPort | str, destination: InputPort | str) -> None:
        """A wire from an output to an input.

        Parameters
        ----------
        source
            An output of a block that was added, such as `block.output()` or "block.out"; it may
            feed many inputs.
        destination
            An input of a block that was added, such as `block.input("reset_trigger")` or
            "block.reset_trigger"; it takes one wire.

        Raises
        ------
        ModelError
            If the input has a source already, a block was not added, or has no such port.

        Examples
        --------
        >>> from saltus.library import Clock, Gain
        >>> builder = saltus.DiagramBuilder()
        >>> t, double = builder.add(Clock(name="t"), Gain(2.0, name="double"))
        >>> builder.connect(t.output(), double.input())
        >>> builder.connect(t.output(), double.input())
        Traceback (most recent call last):
            ...
        saltus.errors.BuilderError: input 'in' of block 'double' already has a source, ...
        """
        if isinstance(source, InputPort) and isinstance(destination, OutputPort):
            raise ModelError(
                f"connect: the ports are swapped: expected an output and then an input, found "
                f"{source!r} and then {destination!r}; write connect(output, input)"
            )
        begin, end = self._output("connect", source), self._input("connect", destination)
        self._core.connect(*_port(begin, OutputPort), *_port(end, InputPort))

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
            number_of(f"{what}: weight", weight),
            number_of(f"{what}: delay [s]", delay),
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
        block, name = self._from("connect_event", port)
        return block.event_output(name) if output else block.event_input(name)

    def _output(self, where: str, port: OutputPort | str) -> OutputPort:
        if not isinstance(port, str):
            return port
        block, name = self._from(where, port)
        return block.output(name)

    def _input(self, where: str, port: InputPort | str) -> InputPort:
        if not isinstance(port, str):
            return port
        block, name = self._from(where, port)
        return block.input(name)

    def _from(self, where: str, path: str) -> tuple[System, str]:
        """The block and the name of its port for a path such as "gain.out"."""
        name, dot, port = path.partition(".")
        if name not in self._children or not dot:
            known = _core.known_names(name, list(self._children))
            raise ModelError(
                f"{where}: expected the names of a block and of a port, such as 'gain.out', found "
                f"'{path}'{known}"
            )
        if "." in port:
            raise ModelError(
                f"{where}: '{path}' is a port inside of diagram '{name}'; export it there, and "
                f"take the exported port"
            )
        return self._children[name], port

    def execute(
        self,
        block: System,
        control: OutputPort | str,
        kind: str = "enabled",
        *,
        states: str = "held",
        edge: str = "rising",
    ) -> None:
        """Executes a block only while, or only when, a signal of this diagram says so.

        `EnabledSubsystem` and `TriggeredSubsystem` are made with it; they hold their outputs, too.

        Parameters
        ----------
        block
            A block or a diagram that was added.
        control
            An output of another block that was added: one value that is held between instants, such
            as that of a `Comparator` or a `ControlPort`. It is true if it is not 0.
        kind
            "enabled": while the signal is false, dx/dt = 0 for all continuous states of the block,
            its updates and resets write nothing, and its guards are not seen. "triggered": at each
            edge of the signal its updates of the inherited period, -1, run once.
        states
            "held", or "reset": of kind "enabled", the states return to their declared initial
            values each time the signal becomes true during a run.
        edge
            "rising", "falling" or "either", of kind "triggered".

        Raises
        ------
        ModelError
            If a block was not added, has a control signal already, or would control itself; if a
            word is unknown. A plan refuses a signal that is not one held value, and a block that
            cannot be executed in this way.

        Examples
        --------
        >>> from saltus.library import Constant, Integrator, Pulse
        >>> builder = saltus.DiagramBuilder()
        >>> one, x = builder.add(Constant(1.0, name="one"), Integrator(name="x"))
        >>> pulse = builder.add(Pulse(period=2.0, name="pulse"))
        >>> builder.connect(one.output(), x.input())
        >>> builder.execute(x, pulse.output())
        >>> diagram = builder.build()
        >>> saltus.simulate(diagram, time_span=(0.0, 3.0)).context[x].continuous_state.round(9)
        array([2.])
        """
        resets = is_reset("execute", "states", states)
        of, output = _port(self._output("execute", control), OutputPort)
        if not isinstance(block, System):
            raise ModelError(f"execute: expected a system, found {block!r}")
        self._core.execute(block, of, output, kind, resets, edge)

    def export_input(self, port: InputPort | str, name: str | None = None) -> int:
        """Makes an input of a block one of the diagram.

        Parameters
        ----------
        port
            An input of a block that was added, without a source; or its path, "block.in".
        name
            The name of the port of the diagram; by default 'block_port'.

        Returns
        -------
        int
            Its position among the inputs of the diagram.

        Examples
        --------
        >>> from saltus.library import Gain
        >>> builder = saltus.DiagramBuilder()
        >>> gain = builder.add(Gain(2.0, name="gain"))
        >>> builder.export_input(gain.input(), "u")
        0
        >>> builder.build().input_names
        ['u']
        """
        own = self._input("export_input", port)
        return self._core.export_input(*_port(own, InputPort), name or "")

    def export_output(self, port: OutputPort | str, name: str | None = None) -> int:
        """Makes an output of a block one of the diagram.

        Parameters
        ----------
        port
            An output of a block that was added; or its path, "block.out".
        name
            The name of the port of the diagram; by default 'block_port'.

        Returns
        -------
        int
            Its position among the outputs of the diagram.

        Examples
        --------
        >>> from saltus.library import Clock
        >>> builder = saltus.DiagramBuilder()
        >>> clock = builder.add(Clock(name="clock"))
        >>> builder.export_output(clock.output())
        0
        >>> builder.build().output_names
        ['clock_out']
        """
        own = self._output("export_output", port)
        return self._core.export_output(*_port(own, OutputPort), name or "")

    def build(
        self, name: str = "root", parameters: Mapping[str, Parameter] | None = None
    ) -> Diagram:
        """The diagram of the blocks and wires so far.

        Parameters
        ----------
        name
            The name in messages, and in a diagram to which this one is added.
        parameters
            Parameters of the diagram, by their names in a context: each a `Parameter`, which blocks
            of this diagram and of diagrams in it were given. The parameters of these blocks follow,
            and cannot be set by themselves any more.

        Raises
        ------
        ModelError
            If an input of a block has no source, or nothing was added; if a value of `parameters` is
            no `Parameter`.

        Examples
        --------
        >>> from saltus.library import Gain
        >>> builder = saltus.DiagramBuilder()
        >>> gain = builder.add(Gain(2.0, name="gain"))
        >>> builder.build()
        Traceback (most recent call last):
            ...
        saltus.errors.InputNotConnectedError: input 'in' of block 'gain' is not connected; ...
        """
        if not parameters:
            return Diagram(self._core, name, self._children)
        from saltus.parameters.shared import Shared

        shared = Shared(parameters, self._children)
        shared.add_to(self._core)
        return Diagram(self._core, name, self._children, shared.parameters)
