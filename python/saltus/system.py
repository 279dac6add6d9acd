"""What a block and a diagram share: a name, ports, contexts."""

from __future__ import annotations

import json
import operator
from dataclasses import dataclass

from saltus import _core, ladder
from saltus.errors import ModelError
from saltus.ladder import Explanation

__all__ = ["InputPort", "OutputPort", "System"]


@dataclass(frozen=True)
class OutputPort:
    """An output of a system, to connect or to record. It keeps its system alive."""

    system: System
    index: int

    @property
    def name(self) -> str:
        return self.system.output_names[self.index]

    def __repr__(self) -> str:
        return f"<output '{self.name}' of '{self.system.name}'>"


@dataclass(frozen=True)
class InputPort:
    """An input of a system, to connect. It keeps its system alive."""

    system: System
    index: int

    @property
    def name(self) -> str:
        return self.system.input_names[self.index]

    def __repr__(self) -> str:
        return f"<input '{self.name}' of '{self.system.name}'>"


def _key(port: object) -> int | str:
    if isinstance(port, str):
        return port
    try:
        return operator.index(port)  # type: ignore[arg-type]
    except TypeError:
        raise ModelError(f"expected the position or the name of a port, found {port!r}") from None


class System:
    """A block or a diagram: structure, which a run never changes. The values are in a `Context`."""

    name: str
    """how messages and `diagram[...]` know it"""
    system_id: int
    """how a context knows it"""
    input_names: list[str]
    output_names: list[str]

    @property
    def input_ports(self) -> tuple[InputPort, ...]:
        """All inputs, in order."""
        return tuple(InputPort(self, i) for i in range(len(self.input_names)))

    @property
    def output_ports(self) -> tuple[OutputPort, ...]:
        """All outputs, in order."""
        return tuple(OutputPort(self, i) for i in range(len(self.output_names)))

    def input(self, port: int | str = 0) -> InputPort:
        """One input, by position or by name. ModelError lists the names there are."""
        return InputPort(self, _core.System.find_input(self, _key(port)))

    def output(self, port: int | str = 0) -> OutputPort:
        """One output, by position or by name. ModelError lists the names there are."""
        return OutputPort(self, _core.System.find_output(self, _key(port)))

    def context_from_json(self, text: str) -> _core.Context:
        """The context that `context.to_json()` wrote, of this system or one of the same blocks.

        It has the same bits, and a run goes on from it as from the context in memory. ModelError
        for text that is none, or of a system with other blocks.
        """
        try:
            data = json.loads(text)
        except json.JSONDecodeError as error:
            raise ModelError(f"a context in JSON: {error}") from None
        if not isinstance(data, dict):
            raise ModelError(f"a context in JSON: expected an object, found {type(data).__name__}")
        return _core.context_from_dict(self, data)

    def explain(self) -> Explanation:
        """How each Python callback runs: 'compiled', 'traced' or 'called', and why not faster.

        Nothing is simulated. The functions are traced as they are before a run; outputs whose shape
        was not said are called once.

        Returns
        -------
        Explanation
            A tuple of `Rung(block, callback, rung, reason)`; printed, a line for each.

        Examples
        --------
        >>> import saltus
        >>> block = saltus.library.FunctionBlock(lambda u: 2.0 * u, name="twice")
        >>> print(block.explain())
        twice: output 'out'  traced
        the system has open inputs; each is taken for a single number here
        """
        return ladder.explain(self)

    def create_context(self, time: float = 0.0) -> _core.Context:
        """The values every block starts with, at `time` [s]. What you change in it changes no
        system.
        """
        return _core.System.create_context(self, time)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} '{self.name}'>"
