"""Traces that are kept, with the function they were made from.

A trace refers to the values that the function reads, and these may refer to the function. So an
attribute of the function keeps it, where the garbage collector sees the circle: the traces are
freed with the function.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import FunctionType
from typing import Any

import numpy as np

from saltus._wrapped import OWNER
from saltus.tracing.check import Check
from saltus.tracing.refusal import Refusal
from saltus.tracing.sandbox import same
from saltus.tracing.signature import Refused, Signature, Traced

__all__ = ["Kept", "call_of", "find", "keep", "start_of"]

TRACES = "__saltus_traces__"
MOST = 8  # the number of ways to call one function that are remembered


@dataclass(frozen=True)
class Kept:
    """One trace, and the conditions under which it can be used again."""

    function: FunctionType
    """the traced function"""
    start: tuple[bytes, ...]
    """the values around which tape and function were compared"""
    outcome: Traced | Refused
    check: Check | None
    """compares tape and function around other values; None without a tape"""


class Traces(dict[Any, Kept]):
    """The traces of a function by the way it is called. A copy of the function has none."""

    def __reduce__(self) -> tuple[Any, ...]:
        return Traces, ()


def find(signature: Signature) -> Traced | Refused | None:
    """The kept trace, if nothing it was made from has changed."""
    kept = _traces(signature).get(call_of(signature))
    if kept is None or not _stands_for(kept.function, signature.function):
        return None
    if kept.outcome.dependencies.changed() is not None:
        return None
    if kept.start == start_of(signature):
        return kept.outcome
    if kept.check is None or isinstance(kept.outcome, Refused):
        return None
    try:
        compared = kept.check.run(signature)
    except Refusal as refusal:
        return Refused(str(refusal), kept.outcome.dependencies)
    return replace(kept.outcome, compared=compared)


def keep(signature: Signature, outcome: Traced | Refused, check: Check | None) -> None:
    """Remember a trace for `find`."""
    traces = _traces(signature)
    if len(traces) >= MOST:
        traces.clear()
    if type(signature.function) is FunctionType:
        kept = Kept(signature.function, start_of(signature), outcome, check)
        traces[call_of(signature)] = kept


def _traces(signature: Signature) -> dict[Any, Kept]:
    """The traces of a function; a new dictionary for a function that cannot keep any.

    A method cannot keep traces: its class would keep its objects alive.
    """
    function = signature.function
    owner = getattr(function, OWNER, function)
    if signature.owner is not None or not type(owner) is type(function) is FunctionType:
        return {}
    traces: Traces = vars(owner).setdefault(TRACES, Traces())
    return traces


def call_of(signature: Signature) -> tuple[Any, ...]:
    """The properties of a call, except the function and the values it starts with."""
    s = signature
    code = getattr(s.function, "__code__", None)
    parameters = tuple((name, np.shape(value)) for name, value in s.parameters.items())
    inputs = None if s.inputs is None else tuple(s.inputs)
    shapes = tuple(map(tuple, s.input_shapes))
    sizes = (s.state_shape, s.discrete_shape, shapes, s.out_shape, s.result_size, s.result_shape)
    return (code, s.convention, s.kind, s.out, inputs, s.mode, tuple(s.modes), parameters, sizes)


def start_of(signature: Signature) -> tuple[bytes, ...]:
    """The start values of a function, to be compared."""
    values = (signature.start("x"), signature.start("z"), signature.parameter_values())
    return tuple(value.tobytes() for value in values)


def _stands_for(one: FunctionType, other: Any) -> bool:
    """Whether they are one function, or two that were made to call it in the same way."""
    if one is other:
        return True
    if OWNER not in vars(one) or one.__code__ is not other.__code__:
        return False
    pairs = zip(one.__closure__ or (), other.__closure__ or (), strict=True)
    return all(_same_parts(a.cell_contents, b.cell_contents) for a, b in pairs)


def _same_parts(a: Any, b: Any) -> bool:
    if type(a) is tuple and type(b) is tuple:
        return len(a) == len(b) and all(map(_same_parts, a, b))
    return same(a, b)
