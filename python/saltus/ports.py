"""Ports: where systems are connected and recorded."""

from __future__ import annotations

import operator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from saltus.errors import ModelError

if TYPE_CHECKING:
    from saltus.system import System

__all__ = ["InputPort", "OutputPort", "key_of"]


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

    def __repr__(self) -> str:
        return f"<input '{self.name}' of '{self.system.name}'>"


def key_of(port: object) -> int | str:
    """The position or the name by which a port was asked for; ModelError for all else."""
    if isinstance(port, str):
        return port
    try:
        return operator.index(port)  # type: ignore[arg-type]
    except TypeError:
        raise ModelError(f"expected the position or the name of a port, found {port!r}") from None
