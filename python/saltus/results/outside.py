"""Why the output of a block is not finite, in words that its inputs and its points give."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus import _core
from saltus._signals import block_of, blocks_in
from saltus.system import System

__all__ = ["explained"]

SIGN = "is not finite"
"""what the message of such an end has"""


def explained(message: str, path: str, context: _core.Context, system: System) -> str:
    """The message of a run that ended where an output is not finite, with the inputs of the block,
    and with the table of which an input is outside of the points.
    """
    if SIGN not in message or not path:
        return message
    try:
        block = _at(system, path)
        if "where" not in message:
            message += _inputs(block, context)
        return message + _tables(block, system, context)
    except Exception:  # a function of the user that is called for a message must not hide it
        return message


def _at(system: System, path: str) -> System:
    """The block at the path of a message, which begins within a diagram."""
    for name in path.split(".") if blocks_in(system) else ():
        system = block_of(system, name)
    return system


def _inputs(block: System, context: _core.Context) -> str:
    shown = [f"{port.name} = {_short(port.eval(context))}" for port in block.input_ports]
    return f"; the input there: {', '.join(shown)}" if shown else ""


def _tables(block: System, system: System, context: _core.Context) -> str:
    """Of the block, or of any table with an input outside of its points."""
    for one in [block, *_leaves(system)]:
        ranges = getattr(one, "_ends_outside", None)
        if ranges is None:
            continue
        ports = list(zip(one.input_ports, ranges, strict=False))
        beyond = [each for each in ports if not _within(each[0].eval(context), *each[1])]
        if beyond or one is block:  # a step may have tried an input that the context does not have
            points = " and ".join(
                f"{low:g} to {high:g} of '{port.name}'" for port, (low, high) in beyond or ports
            )
            return (
                f"; the table '{one.name}' has the points {points}, and extrapolation='error': "
                "keep its input within them, or say extrapolation='clip' or 'linear'"
            )
    return ""


def _within(value: Any, low: float, high: float) -> bool:
    return bool(np.all((low <= np.asarray(value)) & (np.asarray(value) <= high)))


def _leaves(system: System) -> list[System]:
    inner = blocks_in(system)
    return [leaf for block in inner for leaf in _leaves(block)] if inner else [system]


def _short(value: Any) -> str:
    if np.ndim(value) == 0:
        return f"{float(value)}"
    return np.array2string(np.asarray(value), precision=6, threshold=6)
