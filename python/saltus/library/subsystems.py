"""Parts of a diagram that are executed while, or only when, a control signal says so."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from numpy.typing import ArrayLike

from saltus import _core
from saltus._porting import is_reset, refusing
from saltus.diagram import Diagram, DiagramBuilder
from saltus.errors import BlockParameterError, ShapeMismatchError
from saltus.library.block import Block
from saltus.library.inside_triggered import edges_missed_by, refuse_edges
from saltus.system import System

__all__ = ["ControlPort", "EnabledSubsystem", "SubsystemOutput", "TriggeredSubsystem"]


class ControlPort(Block, _core.ControlPort):
    """y = whether u > 0: the control signal of an `EnabledSubsystem` or a `TriggeredSubsystem`.

    The crossings of zero are located, and y is held in between. At u = 0 exactly y is false.

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Clock, ControlPort
    >>> saltus.response(ControlPort(), Clock(), t=[0.0, 1.0])
    array([0., 1.])
    >>> saltus.response(ControlPort(), -1.0)
    0.0
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))


class SubsystemOutput(Block, _core.SubsystemOutput):
    """The output of an `EnabledSubsystem` or a `TriggeredSubsystem`. Inputs: `in`, `control`.

    Of kind "enabled" y = u while control is true; otherwise y is u at the end of the last time that
    control was true, and with `outputs="reset"` it is `initial_output`. Of kind "triggered" y is u
    at the last edge of control. Before all that y is `initial_output`.

    Parameters
    ----------
    initial_output
        A number, a vector or a matrix: the shape of the signal.
    kind
        "enabled" or "triggered".
    outputs
        "held" or "reset", of kind "enabled".
    edge
        "rising", "falling" or "either", of kind "triggered".
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If a word is unknown.

    Examples
    --------
    >>> from saltus.library import Clock, Pulse, SubsystemOutput
    >>> saltus.response(SubsystemOutput(), Clock(), Pulse(period=2.0), t=[0.5, 1.5, 2.5])
    array([0.5, 1. , 2.5])
    """

    def __init__(
        self,
        initial_output: ArrayLike = 0.0,
        kind: str = "enabled",
        *,
        outputs: str = "held",
        edge: str = "rising",
        name: str | None = None,
    ):
        called = self._named(name)
        resets = is_reset(f"block '{called}'", "outputs", outputs)
        super().__init__(called, kind, resets, edge, initial_output)


class _Subsystem(Diagram):
    """A system, its control port, and an output for each of its outputs."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if cls.__module__ == __name__:
            cls.__init__ = refusing(cls.__init__)  # type: ignore[method-assign]

    def _compose(
        self,
        name: str | None,
        system: System,
        control: str,
        initial_outputs: Mapping[str, ArrayLike] | None,
        execution: dict[str, str],
        output: dict[str, str],
    ) -> None:
        name = name or _core.next_name(type(self).__name__)
        if not isinstance(system, System):
            raise BlockParameterError(
                f"block '{name}': expected the system that it executes, a block or a diagram, "
                f"found {system!r}"
            )
        initial = dict(initial_outputs or {})
        for known in initial:
            if known not in system.output_names:
                near = _core.known_names(str(known), system.output_names)
                raise BlockParameterError(f"block '{name}': unknown output {known!r}{near}")
        _require_name(name, system, control)
        builder = DiagramBuilder()
        builder.add(system)
        port = builder.add(ControlPort(name=control))
        builder.execute(system, port.output(), **execution)
        for position, of in enumerate(system.input_names):
            if not _core.fixes_input(system, position):
                builder.export_input(system.input(of), of)
        builder.export_input(port.input(), control)
        for of in system.output_names:
            held = SubsystemOutput(
                initial.get(of, 0.0), execution["kind"], name=f"held_{of}", **output
            )
            builder.add(held)
            builder.connect(system.output(of), held.input("in"))
            builder.connect(port.output(), held.input("control"))
            builder.export_output(held.output(), of)
        try:
            shown = [system.output(of) for of in system.output_names]  # held, with their units
            Diagram.__init__(self, builder._core, name, builder._children, exported=shown)
        except ShapeMismatchError as error:
            _refuse_width(name, initial, error)
            raise


class EnabledSubsystem(_Subsystem):
    """Executes a system while its last input, `enable`, is above 0.

    While it is not enabled, dx/dt = 0 for all continuous states of its blocks, its guards are not
    seen, and its resets and updates write nothing. The time that its blocks read, as a `Clock`
    does, goes on. When it is enabled again, its guards are armed as where a mode is entered. Its
    other inputs and its outputs are those of the system; use them, not those of the system itself,
    whose outputs are computed from its inputs all the time. Inside a `TriggeredSubsystem` it needs
    states "held" and outputs "reset".

    Parameters
    ----------
    system
        A block or a diagram, which is in no other diagram. No block of it may keep a history, as
        `TransportDelay` does, or have a queued zero crossing.
    states
        "held": they continue from where they rested. "reset": they return to their initial values,
        as they were declared, each time the system becomes enabled during a run.
    outputs
        "held": while it is not enabled they keep their last values. "reset": they are
        `initial_outputs` then.
    initial_outputs
        Name of an output -> number or vector: its value before the system is first enabled, and its
        shape; 0 where none is given.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If a word or an output is unknown. A plan refuses a block that cannot rest.

    Examples
    --------
    >>> from saltus.library import EnabledSubsystem, Integrator, Pulse
    >>> half = EnabledSubsystem(Integrator(name="x"))
    >>> half.input_names, half.output_names
    (['in', 'enable'], ['out'])
    >>> saltus.response(half, 1.0, Pulse(period=2.0), t=[0.5, 1.0, 1.5, 2.5]).round(9)
    array([0.5, 1. , 1. , 1.5])
    """

    def __init__(
        self,
        system: System,
        *,
        states: str = "held",
        outputs: str = "held",
        initial_outputs: Mapping[str, ArrayLike] | None = None,
        name: str | None = None,
    ):
        execution = {"kind": "enabled", "states": states}
        self._compose(name, system, "enable", initial_outputs, execution, {"outputs": outputs})
        self._missed_edges = edges_missed_by(system, states, outputs)


class TriggeredSubsystem(_Subsystem):
    """Executes a system once at each edge of its last input, `trigger`, true while it is above 0.

    At an edge the outputs take the values that the system has there, and then its updates run,
    together; they read the values before. Its blocks have the inherited sample time, dt = -1, no
    continuous state and no guards, and follow no edges: no `TriggeredSubsystem`, and no
    `EnabledSubsystem` that holds its outputs or resets its states. A trigger that is true at the start of a run has no edge there.
    As with a `ZeroOrderHold`, a block that reads an output at the edge itself reads the value
    before it: of two subsystems in a row with one trigger the second is a trigger behind.

    Parameters
    ----------
    system
        A block or a diagram, which is in no other diagram.
    edge
        "rising", "falling" or "either".
    initial_outputs
        Name of an output -> number or vector: its value before the first edge, and its shape; 0
        where none is given.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If a word or an output is unknown. A plan refuses a block with a continuous state, a guard,
        or a sample time of its own.

    Examples
    --------
    >>> from saltus.library import Clock, Gain, Pulse, TriggeredSubsystem, UnitDelay
    >>> sampled = TriggeredSubsystem(Gain(1.0))
    >>> saltus.response(sampled, Clock(), Pulse(period=2.0, phase_delay=1.0), t=[0.5, 1.5, 3.5])
    array([0., 1., 3.])
    >>> before = TriggeredSubsystem(UnitDelay(dt=-1))
    >>> saltus.response(before, Clock(), Pulse(period=2.0, phase_delay=1.0), t=[0.5, 1.5, 3.5])
    array([0., 0., 1.])
    """

    def __init__(
        self,
        system: System,
        *,
        edge: str = "rising",
        initial_outputs: Mapping[str, ArrayLike] | None = None,
        name: str | None = None,
    ):
        execution = {"kind": "triggered", "edge": edge}
        if isinstance(system, System):
            refuse_edges(name or type(self).__name__, system)
        self._missed_edges = (
            "put an EnabledSubsystem with outputs='reset' in its place, enabled by an "
            "EdgeDetection(dt=-1)"
        )
        self._compose(name, system, "trigger", initial_outputs, execution, {"edge": edge})


def _require_name(name: str, system: System, control: str) -> None:
    """BlockParameterError for a system with an input, or a name, that the control port has."""
    if control in system.input_names:
        raise BlockParameterError(
            f"block '{name}': its system '{system.name}' has an input '{control}' already, which "
            "is the name of the control input of the whole; put the system into a diagram that "
            "exports this input by another name: "
            f"builder.export_input(block.input('{control}'), 'inner')"
        )
    if system.name == control:
        raise BlockParameterError(
            f"block '{name}': its system is called '{control}', which is the name of the control "
            "port beside it; give the system another name"
        )


def _refuse_width(name: str, initial: Mapping[str, ArrayLike], error: ShapeMismatchError) -> None:
    """BlockParameterError if the output before the first execution has another width."""
    found = re.search(
        r"of block 'held_(.+)': expected (a scalar|shape \((\d+),\)), found shape \((\d+),\) from",
        str(error),
    )
    if found is None:
        return
    of, given, width = found[1], int(found[3] or 1), int(found[4])
    what = (
        f"initial_outputs says {given}" if of in initial else "initial_outputs says nothing of it"
    )
    zeros = ", ".join(["0.0"] * min(width, 4)) + (", ..." if width > 4 else "")
    raise BlockParameterError(
        f"block '{name}': output '{of}' of its system has {width} values, and {what}; say which "
        f"values it has before the first execution: initial_outputs={{'{of}': [{zeros}]}}"
    ) from error
