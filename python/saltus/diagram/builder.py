"""`DiagramBuilder`: collects blocks and wires."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, overload

from saltus._porting import is_reset, missing
from saltus.diagram.diagram import Diagram
from saltus.diagram.event_wires import WiresEvents
from saltus.diagram.exports import ExportsPorts
from saltus.diagram.parts import port_in_core
from saltus.errors import BuilderError, ModelError, SystemNameNotUniqueError
from saltus.parameter import Parameter
from saltus.system import InputPort, OutputPort, System

__all__ = ["DiagramBuilder"]

OF_BUILDER = {
    **dict.fromkeys(("add_block", "add_system", "AddSystem"), "it is builder.add(block)"),
    **dict.fromkeys(("Connect", "wire", "link"), "it is builder.connect(output, input)"),
    **dict.fromkeys(("Build", "compile", "finish"), "it is builder.build()"),
    **dict.fromkeys(("export", "ExportOutput"), "it is builder.export_output(port, name)"),
    "ExportInput": "it is builder.export_input(port, name)",
}
"""names of a builder in similar tools -> those here"""


class DiagramBuilder(WiresEvents, ExportsPorts):
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
        self._require_addable(systems)
        for system in systems:
            self._core.add(system)
            self._children[system.name] = system
        return systems[0] if len(systems) == 1 else systems

    def _require_addable(self, systems: tuple[System, ...]) -> None:
        """ModelError, before any of the systems is added, for one that cannot be."""
        known = dict(self._children)
        for system in systems:
            if not isinstance(system, System):
                raise ModelError(f"add: expected a system, found {system!r}")
            if known.get(system.name) is system:
                raise BuilderError(f"block '{system.name}' is added twice")
            if system.name in known:
                raise SystemNameNotUniqueError(
                    f"two blocks are called '{system.name}'; give each block of a diagram its own "
                    "name"
                )
            known[system.name] = system

    def connect(self, source: OutputPort | str, destination: InputPort | str) -> None:
        """A wire from an output to an input.

        Parameters
        ----------
        source
            An output of a block that was added, such as `block.output()` or "block.out"; it may
            feed many inputs. Of a block with one output its name, "block", is enough.
        destination
            An input of a block that was added, such as `block.input("reset_trigger")` or
            "block.reset_trigger", or "block" of one with a single input; it takes one wire.

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
        self._core.connect(*port_in_core(begin, OutputPort), *port_in_core(end, InputPort))

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
        of, output = port_in_core(self._output("execute", control), OutputPort)
        if not isinstance(block, System):
            raise ModelError(f"execute: expected a system, found {block!r}")
        self._core.execute(block, of, output, kind, resets, edge)

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
            return Diagram(self._core, name, self._children, exported=self._exported)
        from saltus.parameters.shared import Shared

        shared = Shared(parameters, self._children)
        shared.add_to(self._core)
        return Diagram(self._core, name, self._children, shared.parameters, self._exported)
