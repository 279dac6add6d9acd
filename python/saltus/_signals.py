"""Blocks and outputs by path, and the signals that a run records."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy
from typing import Any

from saltus import _core
from saltus._quantities import Quantity, quantity_of, says, shown_twice
from saltus.errors import ModelError
from saltus.ports import OutputPort
from saltus.system import System

__all__ = [
    "block_of",
    "blocks_in",
    "is_diagram",
    "named",
    "port_of",
    "quantities_of",
    "signals_in",
    "signals_of",
]


def is_diagram(system: System) -> bool:
    """Whether a system has blocks, in Python or in C++."""
    return isinstance(system, _core.Diagram) or (
        isinstance(system, _core.SharedSystem) and bool(system.block_names)
    )


def blocks_in(system: System) -> tuple[System, ...]:
    """The blocks of a diagram, whether it was made in Python or in C++; none of a leaf."""
    inside: Any = system
    return tuple(inside.blocks) if is_diagram(system) else ()


def block_of(system: System, name: str) -> System:
    """A block of a diagram by name; ModelError if there is none."""
    if is_diagram(system):
        inside: Any = system
        block: System = inside[name]
        return block
    raise ModelError(f"block '{system.name}' is no diagram: it has no block '{name}'")


def port_of(system: System, port: OutputPort | str, what: str = "recorded_signals") -> OutputPort:
    """A port, or the port at a path: 'y' of the system itself, 'car.engine.y' of a block in it."""
    if isinstance(port, OutputPort):
        return port
    if not isinstance(port, str):
        raise ModelError(
            f"{what}: expected a port, such as block.output_ports[0], or its path, found {port!r}"
        )
    *blocks, name = port.split(".")
    for block in blocks:
        system = block_of(system, block)
    if name not in system.output_names and is_diagram(system):
        _refuse_block(system, name, port, what)
    return system.output(name)


def _refuse_block(system: System, name: str, port: str, what: str) -> None:
    """ModelError for the path of a block in place of that of one of its outputs."""
    for block in blocks_in(system):
        if block.name == name:
            listed = ", ".join(f"'{port}.{each}'" for each in block.output_names) or "it has none"
            raise ModelError(f"{what}: '{port}' is a block; say which output: {listed}")


def named(signals: Any) -> dict[str, OutputPort | str]:
    """The requested signals by name: from a dict of names with ports or paths, or from a list of
    paths, which are then the names too.
    """
    if isinstance(signals, (list, tuple)) and all(isinstance(path, str) for path in signals):
        signals = {path: path for path in signals}
    if not isinstance(signals, Mapping) or not all(isinstance(name, str) for name in signals):
        raise ModelError(
            "recorded_signals: expected a dict of names with ports or their paths, or a list of "
            f"paths, found {signals!r}"
        )
    return dict(signals)


def signals_in(system: System, signals: Any) -> dict[str, OutputPort]:
    """The same with the ports of `system`."""
    return {
        name: port_of(system, port, f"recorded signal '{name}'")
        for name, port in named(signals).items()
    }


def signals_of(system: System, signals: Any) -> dict[str, OutputPort]:
    """The signals of a run; by default the outputs of the system, but for one of all states where
    each of these has a name.
    """
    if signals is not None:
        return signals_in(system, signals)
    twice = shown_twice(system)
    return {port.name: port for port in system.output_ports if port.index not in twice}


def quantities_of(system: System, signals: Any) -> Callable[[], dict[str, Quantity]]:
    """What the signals of a run show, of those whose blocks say it. It is found when it is called:
    for many signals that takes longer than a short run.
    """
    if not says(system):
        return dict
    given = copy(signals)  # which the user may change after the run

    def find() -> dict[str, Quantity]:
        found = {name: quantity_of(port) for name, port in signals_of(system, given).items()}
        return {name: one for name, one in found.items() if one}

    return find
