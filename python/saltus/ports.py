"""Ports: where systems are connected and recorded."""

from __future__ import annotations

import operator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from saltus import _core
from saltus.errors import ModelError

if TYPE_CHECKING:
    from saltus.system import System

__all__ = ["InputPort", "OutputPort", "core_port", "key_of"]

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
        position = operator.index(port)  # type: ignore[arg-type]
    except TypeError:
        raise ModelError(f"expected the position or the name of a port, found {port!r}") from None
    if abs(position) > LARGEST:
        raise ModelError(f"no port has the position {position}")
    return position


def core_port(port: OutputPort | InputPort) -> tuple[System, int]:
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
