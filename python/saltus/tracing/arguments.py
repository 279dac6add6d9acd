"""The arguments of one call, symbolic or plain, and the numbers its result is made of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from saltus.tracing.numbers import Symbol, SymbolArray, as_array
from saltus.tracing.refusal import refuse
from saltus.tracing.signature import Shape, Signature
from saltus.tracing.state import PlainState, TracedState, in_other_order

__all__ = ["Point", "Result", "Symbols", "call", "plain_arguments", "plain_numbers", "result_of"]

Numbers = NDArray[np.float64]


@dataclass
class Point:
    """Plain values of everything a function may read."""

    time: float
    x: Numbers
    z: Numbers
    mode: int
    entry: int
    p: Numbers
    u: list[Numbers]

    def as_tape_takes(self) -> tuple[Any, ...]:
        return self.time, self.x, self.z, self.mode, self.entry, self.p, self.u


def _arranged(signature: Signature, first: list[Any], inputs: list[Any]) -> list[Any]:
    if signature.convention == "inputs":
        return [tuple(inputs)]
    return inputs[:1] if signature.convention == "input" else first + inputs


class Symbols:
    """Makes symbolic arguments over a graph; remembers which node is which variable."""

    def __init__(self, graph: Any, signature: Signature):
        self.graph = graph
        self.signature = signature
        self.variables: dict[int, tuple[str, int, int]] = {}

    def _one(self, kind: str, *place: int, python: bool = False) -> Symbol:
        node = getattr(self.graph, kind)(*place)
        first, second = (*place, 0, 0)[:2]
        self.variables[node] = (kind, first, second)
        return Symbol(self.graph, node, "i" if kind in ("mode", "entry") else "f", python)

    def _many(
        self, kind: str, shape: Shape, words: str, *place: int, first: int = 0
    ) -> SymbolArray:
        data = np.empty(shape, dtype=object)
        flat = data.reshape(-1)
        for i in range(data.size):
            flat[i] = self._one(kind, *place, first + i)
        return SymbolArray(data, "f", words)

    def state(self) -> TracedState:
        s = self.signature
        x = self._many("continuous_state", s.state_shape, "the continuous state")
        z = self._many("discrete_state", s.discrete_shape, "the discrete state")
        mode, entry = (self._one(kind, python=True) for kind in ("mode", "entry"))
        return TracedState(x, z, mode, entry)

    def _input(self, k: int) -> Any:
        shape = self.signature.input_shapes[k]
        if shape == ():
            return self._one("input", k, 0, python=True)
        return self._many("input", shape, f"input {k}", k)

    def parameters(self) -> dict[str, Any]:
        values: dict[str, Any] = {}
        at = 0
        for name, start in self.signature.parameters.items():
            shape, size = np.shape(start), np.size(start)
            if shape == ():
                values[name] = self._one("parameter", at, python=True)
            else:
                values[name] = self._many("parameter", shape, f"parameter {name}", first=at)
            at += size
        return values

    def arguments(self) -> tuple[list[Any], dict[str, Any], TracedState]:
        s = self.signature
        state = self.state()
        inputs = [self._input(k) for k in s.passed]
        seen = state.continuous_state if s.convention == "vector" else state
        first = [self._one("time", python=True), seen]
        plain = s.convention in ("inputs", "input")
        return _arranged(s, first, inputs), {} if plain else self.parameters(), state


def _read_only(values: Numbers, shape: Shape) -> Numbers:
    copied = np.array(values, dtype=float).reshape(shape)
    copied.flags.writeable = False
    return copied


def plain_arguments(signature: Signature, at: Point) -> tuple[list[Any], dict[str, Any]]:
    """The arguments with the values of a point, as the engine passes them."""
    x, z = _read_only(at.x, signature.state_shape), _read_only(at.z, signature.discrete_shape)
    state = PlainState(x, z, at.mode, at.entry)
    inputs: list[Any] = []
    for k in signature.passed:
        shape = signature.input_shapes[k]
        inputs.append(float(at.u[k][0]) if shape == () else _read_only(at.u[k], shape))
    values: dict[str, Any] = {}
    first = 0
    for name, start in signature.parameters.items():
        part = at.p[first : first + np.size(start)]
        values[name] = (
            float(part[0]) if np.shape(start) == () else _read_only(part, np.shape(start))
        )
        first += np.size(start)
    seen = x if signature.convention == "vector" else state
    plain = signature.convention in ("inputs", "input")
    return _arranged(signature, [at.time, seen], inputs), {} if plain else values


@dataclass
class Result:
    """The result of a call: its numbers, flat, known or symbolic."""

    numbers: list[Any]
    shape: Shape
    boolean: bool
    written: str
    """letters of x, z and m (the mode) that a reset or an update wrote, in that order"""


def call(
    signature: Signature,
    function: Callable[..., Any],
    arguments: list[Any],
    options: dict[str, Any],
    new_out: Callable[[Shape], Any],
) -> Any:
    """The function's result; with `out` that array, filled."""
    if not signature.out:
        return function(*arguments, **options)
    shape = signature.filled_shape()
    out = new_out(shape)
    if function(*arguments, **options, out=out) is not None:
        refuse("fills `out` and returns something as well", "return nothing")
    return out


def result_of(signature: Signature, returned: Any) -> Result:
    """The numbers in the result of a symbolic call."""
    if isinstance(returned, TracedState) and signature.kind in ("reset", "update"):
        return _written(returned)
    if returned is None:
        refuse("returns None", "is a `return` missing?")
    data = as_array(returned)
    numbers = list(data.data.flat)
    if signature.kind in ("reset", "update"):
        letter = _meant(signature)
        if len(numbers) != _size(signature, letter):
            refuse(f"returns {len(numbers)} numbers", f"return {_size(signature, letter)}")
        start = signature.state_shape if letter == "x" else signature.discrete_shape
        if in_other_order(data.shape, start):
            refuse(f"returns an array of shape {tuple(data.shape)}", f"return shape {start}")
        return Result(numbers, data.shape, False, letter)
    return Result(numbers, data.shape, data.kind == "b", "")


def _size(signature: Signature, letter: str) -> int:
    return signature.start(letter).size


def _meant(signature: Signature) -> str:
    """The state that numbers alone mean: the one state that the block has. If it has both, an
    update means the discrete state, and a reset map has to return a state.
    """
    has_x, has_z = _size(signature, "x") > 0, _size(signature, "z") > 0
    if has_x != has_z:
        return "z" if has_z else "x"
    if not has_x or signature.kind == "reset":
        refuse("returns no state", "return state.with_continuous_state(...)")
    return "z"


def _written(state: TracedState) -> Result:
    written = "".join(letter for letter in "xzm" if letter in state.written)
    parts = {"x": state.continuous_state, "z": state.discrete_state, "m": [state.mode]}
    numbers = [number for letter in written for number in as_array(parts[letter]).data.flat]
    return Result(numbers, (len(numbers),), False, written)


def plain_numbers(signature: Signature, returned: Any) -> tuple[Numbers, str]:
    """The numbers in the result of the function itself, and the written parts of the state."""
    if signature.kind in ("reset", "update") and isinstance(returned, TracedState):
        letters = "".join(letter for letter in "xzm" if letter in returned.written)
        parts = {"x": returned.continuous_state, "z": returned.discrete_state, "m": returned.mode}
        flat = [np.ravel(np.asarray(parts[letter], dtype=float)) for letter in letters]
        return np.concatenate(flat) if flat else np.empty(0), letters
    if returned is None or np.iscomplexobj(returned):
        raise TypeError("no real numbers")
    numbers = np.asarray(returned, dtype=float).reshape(-1)
    return numbers, _meant(signature) if signature.kind in ("reset", "update") else ""
