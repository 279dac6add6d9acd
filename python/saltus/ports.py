"""Ports: where systems are connected and recorded."""

from __future__ import annotations

import operator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus.errors import ModelError

if TYPE_CHECKING:
    from saltus.system import System

__all__ = [
    "EventInputPort",
    "EventOutputPort",
    "InputPort",
    "OutputPort",
    "core_port",
    "key_of",
]

LARGEST = 2**31 - 1
"""the largest position that the engine can be asked for"""


@dataclass(frozen=True)
class OutputPort:
    """An output of a system, to connect or to record. It keeps its system alive.

    Parameters
    ----------
    system
        The system it belongs to.
    index
        Its position among the outputs.

    Examples
    --------
    >>> from saltus.library import Adder
    >>> total = Adder("+-", name="total")
    >>> total.output()
    <output 'out' of 'total'>
    >>> total.output().name, total.output().index
    ('out', 0)
    """

    system: System
    index: int

    @property
    def name(self) -> str:
        """The name of the port in its system."""
        return self.system.output_names[self.index]

    def eval(self, context: _core.Context) -> float | np.ndarray:
        """The value of this output at a context, without a run: a float, or a read-only array.

        Parameters
        ----------
        context
            The values of the system that the port belongs to, or of the diagram around it. No event
            happens; a comparison that a run would locate has the truth that its guard has there.

        Raises
        ------
        ModelError
            If the context is of another system, or an input is open; and wherever a run would.

        Examples
        --------
        >>> from saltus.library import Gain, Integrator
        >>> builder = saltus.DiagramBuilder()
        >>> x, twice = builder.add(Integrator(3.0, name="x"), Gain(2.0, name="twice"))
        >>> builder.connect(x.output(), twice.input())
        >>> builder.connect(twice.output(), x.input())
        >>> diagram = builder.build()
        >>> twice.output().eval(diagram.create_context())
        6.0
        """
        from saltus import _evaluate

        return _evaluate.output_value(self, context)

    def __repr__(self) -> str:
        return f"<output '{self.name}' of '{self.system.name}'>"


@dataclass(frozen=True)
class InputPort:
    """An input of a system, to connect. It keeps its system alive.

    Parameters
    ----------
    system
        The system it belongs to.
    index
        Its position among the inputs.

    Examples
    --------
    >>> from saltus.library import Adder
    >>> total = Adder("+-", name="total")
    >>> total.input("in_1")
    <input 'in_1' of 'total'>
    >>> total.input("in_1") == total.input_ports[1]
    True
    """

    system: System
    index: int

    @property
    def name(self) -> str:
        """The name of the port in its system."""
        return self.system.input_names[self.index]

    def eval(self, context: _core.Context) -> float | np.ndarray:
        """The value that this input has at a context, without a run: that of the connected output,
        or its fixed value. Otherwise as `OutputPort.eval`.

        Examples
        --------
        >>> from saltus.library import Gain
        >>> gain = Gain(2.0)
        >>> gain.input().fix_value(4.0)
        >>> gain.input().eval(gain.create_context())
        4.0
        """
        from saltus import _evaluate

        return _evaluate.input_value(self, context)

    def fix_value(self, value: ArrayLike | None) -> None:
        """Gives the input a constant value, so that nothing has to be connected to it.

        The value holds for runs that begin afterwards. A value that is to vary from run to run
        belongs in a `Constant`, where it is a parameter.

        Parameters
        ----------
        value
            A finite number, or a vector or a matrix of them. None: the input is open again.

        Raises
        ------
        ModelError
            For a value that is no number, vector or matrix, or is not finite, and for a block
            inside of a diagram that C++ made. `connect` and `build` refuse an input that has a
            fixed value and a wire, and so does a run.

        Examples
        --------
        >>> from saltus.library import Integrator
        >>> x = Integrator(1.0)
        >>> x.input().fix_value(-2.0)
        >>> saltus.simulate(x, x.create_context(), (0.0, 3.0)).context.continuous_state
        array([-5.])
        """
        from saltus import _evaluate

        _evaluate.fix(self, value)

    def __repr__(self) -> str:
        return f"<input '{self.name}' of '{self.system.name}'>"


@dataclass(frozen=True)
class EventOutputPort:
    """An event of a system, from which event wires may start. It keeps its system alive.

    Parameters
    ----------
    system
        The system it belongs to.
    index
        Its position among the events: the zero crossings come first, then the time events.
    entry
        The guard, in a vector of guards.

    Examples
    --------
    >>> tank = saltus.LeafSystem(name="tank")
    >>> tank.declare_continuous_state([0.0], ode=lambda t, s: [1.0])
    >>> tank.declare_zero_crossing(lambda t, s: s.continuous_state[0] - 1.0, name="full")
    >>> tank.event_output("full")
    <event 'full' of 'tank'>
    """

    system: System
    index: int
    entry: int | None = None

    @property
    def name(self) -> str:
        """The name of the event in its system."""
        return self.system.event_output_names[self.index]

    def __repr__(self) -> str:
        return f"<event '{_with_entry(self)}' of '{self.system.name}'>"


@dataclass(frozen=True)
class EventInputPort:
    """An input of a system for events, to which event wires may lead. It keeps its system alive.

    Parameters
    ----------
    system
        The system it belongs to.
    index
        Its position among the event inputs.
    entry
        The entry, of an input of several.

    Examples
    --------
    >>> cells = saltus.LeafSystem(name="cells")
    >>> cells.declare_event_input(lambda t, s, weight: s, name="synapse", size=3)
    >>> cells.event_input("synapse", 2)
    <event input 'synapse[2]' of 'cells'>
    """

    system: System
    index: int
    entry: int | None = None

    @property
    def name(self) -> str:
        """The name of the input in its system."""
        return self.system.event_input_names[self.index]

    def __repr__(self) -> str:
        return f"<event input '{_with_entry(self)}' of '{self.system.name}'>"


def _with_entry(port: EventOutputPort | EventInputPort) -> str:
    return port.name if port.entry is None else f"{port.name}[{port.entry}]"


def key_of(port: object) -> int | str:
    """The position or the name by which a port was asked for; ModelError for all else."""
    if isinstance(port, str):
        return port
    try:
        position = operator.index(port)  # type: ignore[arg-type]
    except TypeError:
        raise ModelError(f"expected the position or the name of a port, found {port!r}") from None
    if abs(position) > LARGEST:
        raise ModelError(f"no port has the position {position}")
    return position


def core_port(
    port: OutputPort | InputPort | EventOutputPort | EventInputPort,
) -> tuple[System, int]:
    """The system and the position of a port in the form that the engine takes.

    The fields of a port are public, so the position may be anything. The engine refuses a position
    that the system does not have.
    """
    if not isinstance(port.system, _core.System):
        raise ModelError(f"expected the port of a system, found one of {port.system!r}")
    position = key_of(port.index)
    if isinstance(position, str):
        raise ModelError(f"expected the position of a port, found {position!r}")
    return port.system, position
