"""The base of blocks and diagrams: a name, ports, contexts."""

from __future__ import annotations

import json
import weakref
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core, callbacks
from saltus.callbacks import Explanation
from saltus.errors import ModelError
from saltus.ports import EventInputPort, EventOutputPort, InputPort, OutputPort, key_of

__all__ = ["InputPort", "OutputPort", "System", "remember", "system_of"]

_systems: weakref.WeakValueDictionary[int, System] = weakref.WeakValueDictionary()
"""living systems that may have made a context, by their number"""


def remember(system: System) -> None:
    """Lets `system_of` find a system."""
    _systems[system.system_id] = system


def system_of(context: _core.Context) -> System | None:
    """The system whose values a context has, if it still lives and made a context."""
    return _systems.get(context.system_id)


def _event_of(where: str, name: object, entry: object) -> tuple[str, int | None]:
    """The name and the entry of an event; ModelError for other types."""
    if not isinstance(name, str):
        raise ModelError(f"{where}: expected the name of an event, found {name!r}")
    place = None if entry is None else key_of(entry)
    if isinstance(place, str):
        raise ModelError(f"{where}: expected the number of an entry, found {entry!r}")
    return name, place


class Count:
    """The length of a list of a system; a class of the user may have an attribute of that name."""

    def __init__(self, of: str, doc: str):
        self._of = of
        self.__doc__ = doc

    def __get__(self, system: Any, owner: type | None = None) -> Any:
        return self if system is None else len(getattr(system, self._of))


class System:
    """A block or a diagram: structure, which a run never changes. The values are in a `Context`.

    Examples
    --------
    >>> from saltus.library import Adder
    >>> total = Adder("+-", name="total")
    >>> total.name, total.input_names, total.output_names
    ('total', ['in_0', 'in_1'], ['out'])
    >>> total.input_ports[1]
    <input 'in_1' of 'total'>
    >>> total.output_ports[0] == total.output()
    True
    """

    name: str
    """the name in messages and for `diagram[...]`"""
    system_id: int
    """the number for `context[...]`"""
    input_names: list[str]
    output_names: list[str]
    event_output_names: list[str]
    """the events from which event wires may start: zero crossings, then time events"""
    event_input_names: list[str]
    """the inputs to which event wires may lead"""
    interpreted_blocks: list[str]
    """the paths of the blocks in it whose Python functions a run calls"""
    num_input_ports = Count("input_names", "How many inputs there are.")
    num_output_ports = Count("output_names", "How many outputs there are.")

    @property
    def input_ports(self) -> tuple[InputPort, ...]:
        """All inputs, in order."""
        return tuple(InputPort(self, i) for i in range(len(self.input_names)))

    @property
    def output_ports(self) -> tuple[OutputPort, ...]:
        """All outputs, in order."""
        return tuple(OutputPort(self, i) for i in range(len(self.output_names)))

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
        return InputPort(self, _core.System.find_input(self, key_of(port)))

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
        return OutputPort(self, _core.System.find_output(self, key_of(port)))

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
        return EventOutputPort(self, _core.System.find_event_output(self, name, place), place)

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
        return EventInputPort(self, _core.System.find_event_input(self, name, place), place)

    def context_from_json(self, text: str) -> _core.Context:
        """The context that `context.to_json()` wrote, of this system or one of the same blocks.

        It has the same bits, and a run goes on from it as from the context in memory.

        Parameters
        ----------
        text
            The text from `Context.to_json`.

        Raises
        ------
        ModelError
            If the text is no context, or belongs to a system with other blocks.

        Examples
        --------
        >>> from saltus.library import Integrator
        >>> x = Integrator(2.0)
        >>> text = x.create_context(time=1.5).to_json()
        >>> x.context_from_json(text)
        Context(time=1.5, continuous_state=[2], mode=0)
        """
        try:
            data = json.loads(text)
        except (ValueError, TypeError, RecursionError) as error:
            raise ModelError(f"a context in JSON: {error}") from None
        if not isinstance(data, dict):
            raise ModelError(f"a context in JSON: expected an object, found {type(data).__name__}")
        remember(self)
        return _core.context_from_dict(self, data)

    def explain(self) -> Explanation:
        """How each Python callback runs: 'compiled', 'traced' or 'called', and why not faster.

        Nothing is simulated. The functions are traced as they are before a run; outputs without a
        given shape are called once.

        Returns
        -------
        Explanation
            A tuple of `ExplainedCallback(block, callback, runs, reason)`; printed, a line for each.

        Examples
        --------
        >>> import saltus
        >>> block = saltus.library.FunctionBlock(lambda u: 2.0 * u, name="twice")
        >>> print(block.explain())
        twice: output 'out'  traced
        the system has open inputs; each is taken for a single number here
        """
        return callbacks.explain(self)

    def create_context(
        self, time: float = 0.0, values: Mapping[str, ArrayLike] | None = None
    ) -> _core.Context:
        """The values every block starts with. A change of a context changes no system.

        Parameters
        ----------
        time
            [s]
        values
            Other start values, parameters and modes, by the names that a sweep has for them:
            ``{"ball.height": 5.0, "ball.e": 0.9}``, ``"x[0]"`` for an entry of a state without a
            name, ``"x"`` for all of them, ``"room.mode"``.

        Raises
        ------
        ModelError
            For a name that is not there, with the nearest one; for values that are no finite
            numbers, or of another number than the state or the parameter has.

        Examples
        --------
        >>> from saltus.library import Integrator
        >>> Integrator([1.0, 2.0]).create_context()
        Context(time=0, continuous_state=[1, 2], mode=0)
        >>> Integrator([1.0, 2.0]).create_context(values={"x[1]": 5.0})
        Context(time=0, continuous_state=[1, 5], mode=0)
        """
        remember(self)
        if isinstance(time, Mapping):
            raise ModelError(
                "create_context: time: expected a time [s], found a dict; give it as values={...}"
            )
        context = _core.System.create_context(self, time)
        if values is None:
            return context
        from saltus._start_values import with_values

        return with_values(context, values)

    def eval_time_derivatives(self, context: _core.Context) -> np.ndarray:
        """dx/dt of the continuous states of this system at a context, without a run.

        Parameters
        ----------
        context
            The values of this system, or of a diagram around it. No event happens.

        Returns
        -------
        numpy.ndarray
            A number for each continuous state, in the order of `context.continuous_state`.

        Raises
        ------
        ModelError
            If the context is of another system, or an input is open; and wherever a run would.

        Examples
        --------
        >>> from saltus.library import Integrator
        >>> x = Integrator([1.0, 2.0])
        >>> x.input().fix_value([0.5, -1.0])
        >>> x.eval_time_derivatives(x.create_context())
        array([ 0.5, -1. ])
        """
        from saltus import _evaluate

        return _evaluate.rates(self, context)

    def pprint(self, output: Callable[[str], object] = print) -> None:
        """Prints the blocks of the system as a tree, each with its class and its ports.

        Parameters
        ----------
        output
            The function that takes the text in place of `print`.

        Examples
        --------
        >>> from saltus.library import Gain
        >>> Gain(2.0, name="double").pprint()
        double  Gain  (in) -> (out)
        """
        from saltus._tree import tree_of

        output("\n".join(tree_of(self)))

    def to_dot(
        self,
        *,
        recorded_signals: Mapping[str, OutputPort | str] | Sequence[str] | None = None,
        max_depth: int | None = None,
    ) -> str:
        """The system as a picture in the language of Graphviz.

        Inner diagrams are clusters. Colours tell continuous from held signals, grey blocks are
        folded by the engine (constant, computed once) or dropped (nothing reads them), a dashed
        wire is read
        at events only, such as the trigger of a reset; a legend says so. Ports show their names if
        these say something, wires of more than one number their width, blocks their states, zero
        crossings and time events. A system that does not compile is drawn with the reason.

        Parameters
        ----------
        recorded_signals
            The outputs that a run would record, by name, as for `simulate`. By default every
            output of the system.
        max_depth
            Inner diagrams deeper than this many levels are one block each.

        Returns
        -------
        str
            A `digraph`; `dot -Tsvg` or `dot -Tpdf` draws it.

        Raises
        ------
        ModelError
            If a recorded signal belongs to another system.

        Examples
        --------
        >>> from saltus.library import Gain
        >>> print(Gain(2.0, name="double").to_dot().splitlines()[0])
        digraph "double" {
        """
        from saltus import _picture

        return _picture.to_dot(self, recorded_signals, max_depth)

    def to_mermaid(
        self,
        what: str = "blocks",
        *,
        recorded_signals: Mapping[str, OutputPort | str] | Sequence[str] | None = None,
        max_depth: int | None = None,
    ) -> str:
        """The system as a picture in the language of Mermaid, which GitHub, GitLab, JupyterLab and
        most tools for documentation draw.

        Parameters
        ----------
        what
            "blocks": a flowchart that shows what `to_dot` does. "modes": a state diagram of the
            modes of a block, with the zero crossings that lead from one to another.
        recorded_signals, max_depth
            As for `to_dot`; they apply to "blocks" only.

        Returns
        -------
        str
            The text that belongs between the marks of a ``mermaid`` fence.

        Raises
        ------
        ModelError
            If "modes" is asked of a system without modes, and as for `to_dot`.

        Examples
        --------
        >>> from saltus.library import Gain
        >>> print(Gain(2.0, name="double").to_mermaid().splitlines()[1].strip())
        b0["<b>double</b><br/>Gain"]:::continuous
        """
        from saltus import _picture

        return _picture.to_mermaid(self, what, recorded_signals, max_depth)

    def _repr_svg_(self) -> str | None:
        from saltus import _picture

        return _picture.in_svg(self)

    def _repr_markdown_(self) -> str | None:
        from saltus import _picture

        return _picture.in_markdown(self)

    def __repr__(self) -> str:
        if not _core.made(self):  # its constructor has raised, and a traceback shows it
            return f"<{type(self).__name__}, which was not made>"
        return f"<{type(self).__name__} '{self.name}'>"
