"""The question to `trace` about a function, and its answers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from saltus.tracing.sandbox import Dependencies

__all__ = ["Refused", "Relations", "Shape", "Signature", "Traced"]

Shape = tuple[int, ...]


@dataclass(frozen=True, kw_only=True)
class Signature:
    """The form of a call of a function, and the values around which it is called."""

    function: Callable[..., Any]
    owner: Any = None
    """the block, if the function takes it first (a method that was stripped of its block)"""
    convention: str = "state"
    """'state': f(time, state, *inputs, **parameters); 'inputs': f((u_0, u_1, ...)); 'input':
    f(u_0); 'vector': f(time, x, *inputs, **parameters), x the continuous state alone
    """
    block: str = ""
    """its name, for messages"""
    state_shape: Shape = (0,)
    discrete_shape: Shape = (0,)
    mode: int = 0
    """the mode it starts in"""
    x: ArrayLike | None = None
    """the continuous state at the start, zeros by default; points of the check lie around it"""
    z: ArrayLike | None = None
    parameters: Mapping[str, ArrayLike] = field(default_factory=dict)
    """the parameters by name, in the order of the engine"""
    input_shapes: Sequence[Shape] = ()
    """the shape of every input of the block: () comes as a float, (n,) and (m, n) as an array"""
    inputs: Sequence[int] | None = None
    """positions of the inputs that the function gets; by default all"""
    kind: str = "vector"
    """'vector' and 'matrix' return numbers, 'reset' a state, 'update' a state or a discrete one"""
    out: bool = False
    """the function takes an array by the keyword `out`, fills it and returns nothing"""
    out_shape: Shape | None = None
    """the shape of that array; by default (result_size,)"""
    result_size: int | None = None
    """the number of returned numbers, if it is known"""
    result_shape: Shape | None = None
    """the rows and columns of the result, if it is known to be a matrix"""
    modes: Sequence[int] = (0, 1, 2, 3)
    """modes the check tries where the function reads the mode"""

    @property
    def passed(self) -> Sequence[int]:
        """Positions of the inputs the function gets."""
        return range(len(self.input_shapes)) if self.inputs is None else self.inputs

    def parameter_values(self) -> NDArray[np.float64]:
        """All parameters, one after the other."""
        values = [np.asarray(v, dtype=float).reshape(-1) for v in self.parameters.values()]
        return np.concatenate(values) if values else np.empty(0)

    def filled_shape(self) -> Shape:
        """The shape of the array `out`."""
        if self.out_shape is not None:
            return self.out_shape
        if self.result_size is None:
            raise ValueError("a function with `out`: give out_shape or result_size")
        return (self.result_size,)

    def start(self, what: str) -> NDArray[np.float64]:
        """The continuous ('x') or discrete ('z') state it starts with, flat."""
        value = self.x if what == "x" else self.z
        shape = self.state_shape if what == "x" else self.discrete_shape
        filled = np.zeros(shape) if value is None else np.asarray(value, dtype=float)
        return filled.reshape(-1)


@dataclass(frozen=True)
class Relations:
    """A truth that is made of comparisons a < b, a <= b, a > b, a >= b of real expressions.

    `differences` is a tape of one number for each comparison, positive where it is true, negative
    where it is not: the guard of a `Relation`. `true_at_zero` is the truth at zero. `truth` is a
    tape over their truths: it reads truth k, 0 or 1, as entry k of the discrete state, nothing
    else, and gives the values of the output.
    """

    differences: Any
    true_at_zero: tuple[bool, ...]
    truth: Any


@dataclass(frozen=True)
class Traced:
    """A function that became a tape, checked against the function itself."""

    tape: Any
    """gives the result, flat; for a reset or an update the written ones of x+, z+, mode+, one after
    the other
    """
    shape: Shape
    """the shape of the result"""
    boolean: bool
    residual: Any | None
    """tape of numbers that are positive where the truths of the result are true, and negative where
    they are not; they jump over zero if the function has the attribute `jumps`
    """
    relations: Relations | None
    """the relations of a result made of comparisons by and, or, not, ==, != and np.where alone"""
    wrote_x: bool
    wrote_z: bool
    wrote_mode: bool
    dependencies: Dependencies
    """`dependencies.changed()` names a source of the tape that has changed"""
    compared: int = 0
    """the number of points at which tape and function were compared"""
    numbers_are_truths: bool = False
    """whether the result has the numbers 0 and 1 in place of truths"""


@dataclass(frozen=True)
class Refused:
    """A function that has to be called."""

    reason: str
    """one sentence: the obstacle, its place, and a remedy"""
    dependencies: Dependencies = field(default_factory=Dependencies)
    """the values read until then: if one changes, another try may succeed"""
    by_check: bool = False
    """a tape was made, but it could not be confirmed around the values it starts with"""
