"""The state a callback sees, symbolic while it is traced, plain while it is checked."""

from __future__ import annotations

import copy
import operator
from typing import Any

import numpy as np

from saltus.tracing.numbers import Symbol, SymbolArray, as_array
from saltus.tracing.refusal import refuse

__all__ = ["PlainState", "TracedState", "in_other_order"]


def in_other_order(found: tuple[int, ...], expected: tuple[int, ...]) -> bool:
    """Whether the numbers of an array would fill a matrix of this shape in another order: it has
    other rows and columns. The numbers alone, row by row, have no order of their own.
    """
    return len(expected) == 2 and len(found) > 1 and tuple(found) != tuple(expected)


def _require_order(data: Any, like: Any, what: str) -> None:
    if in_other_order(data.shape, like.shape):
        raise ValueError(f"{what}: expected shape {tuple(like.shape)}, found {tuple(data.shape)}")


class TracedState:
    """Has the members of `saltus.State`. Each `with_*` returns a new state that notes the write."""

    continuous_state: Any
    discrete_state: Any
    entry: Any
    mode: Any
    written: str
    """letters of the parts that were written: x, z, m for the mode"""

    __slots__ = ("continuous_state", "discrete_state", "entry", "mode", "written")

    def __init__(self, x: Any, z: Any, mode: Any, entry: Any):
        for name, value in zip(TracedState.__slots__, (x, z, entry, mode, ""), strict=True):
            object.__setattr__(self, name, value)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"state.{name} cannot be set; return state.with_{name}(...)")

    def _with(self, name: str, value: Any, letter: str) -> TracedState:
        other = copy.copy(self)
        object.__setattr__(other, name, value)
        object.__setattr__(other, "written", self.written + letter)
        return other

    def __copy__(self) -> TracedState:
        other = object.__new__(type(self))
        for name in TracedState.__slots__:
            object.__setattr__(other, name, getattr(self, name))
        return other

    @property
    def relations(self) -> Any:
        """The relations, which no tape can read: the engine holds their truths."""
        refuse("reads state.relations", "a callback that reads a relation is called")

    def __getitem__(self, key: Any) -> Any:
        refuse("takes the state for an array", "read state.continuous_state")

    def __iter__(self) -> Any:
        refuse("takes the state for an array", "read state.continuous_state")

    def with_continuous_state(self, continuous_state: Any) -> TracedState:
        value = self._filled(continuous_state, self.continuous_state, "continuous state")
        return self._with("continuous_state", value, "x")

    def with_discrete_state(self, discrete_state: Any) -> TracedState:
        value = self._filled(discrete_state, self.discrete_state, "discrete state")
        return self._with("discrete_state", value, "z")

    def with_mode(self, mode: Any) -> TracedState:
        return self._with("mode", self._whole(mode), "m")

    @staticmethod
    def _filled(value: Any, like: Any, what: str) -> Any:
        data = as_array(value)
        _require_order(data, like, what)
        if data.size != like.size:
            raise ValueError(f"{what}: expected {like.size} numbers, found {data.size}")
        filled = data.astype(float).copy().reshape(like.shape)
        filled.frozen = f"the {what}"
        return filled

    @staticmethod
    def _whole(mode: Any) -> Any:
        if isinstance(mode, SymbolArray) and mode.ndim == 0:
            mode = mode[()]
        if type(mode) is not Symbol:
            return operator.index(mode)
        if mode.kind == "f":
            refuse("sets the mode to a real number", "make it an integer: int(...)")
        return mode.numpy("i")


class PlainState(TracedState):
    """The same with numbers, read-only arrays."""

    __slots__ = ()

    @staticmethod
    def _filled(value: Any, like: Any, what: str) -> Any:
        data = np.array(value, dtype=float)
        _require_order(data, like, what)
        if data.size != like.size:
            raise ValueError(f"{what}: expected {like.size} numbers, found {data.size}")
        data = data.reshape(like.shape)
        data.flags.writeable = False
        return data

    @staticmethod
    def _whole(mode: Any) -> Any:
        return operator.index(mode)
