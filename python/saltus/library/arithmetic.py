"""Blocks that calculate with their inputs. One input is called 'in', several 'in_0', 'in_1', ...;
likewise outputs.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numpy.typing import ArrayLike

from saltus import _core
from saltus.errors import ModelError
from saltus.leaf_system import LeafSystem
from saltus.library.block import Block
from saltus.porting import refusing


class Gain(Block, _core.Gain):
    """y = gain u, entry by entry. Parameter `gain`."""

    def __init__(self, gain: ArrayLike, *, name: str | None = None):
        super().__init__(self._named(name), gain)


class Offset(Block, _core.Offset):
    """y = u + offset, entry by entry. Parameter `offset`."""

    def __init__(self, offset: ArrayLike, *, name: str | None = None):
        super().__init__(self._named(name), offset)


class Adder(Block, _core.Adder):
    """y = ±u_0 ±u_1 ..., one sign for each input: "+-" is u_0 - u_1. A number n of inputs is a sum
    of n.
    """

    def __init__(self, operators: str | int = "++", *, name: str | None = None):
        super().__init__(
            self._named(name), operators if isinstance(operators, str) else "+" * operators
        )


class Product(Block, _core.Product):
    """y = 1 */ u_0 */ u_1 ..., one operator for each input: "*/" is u_0 / u_1. A number n of inputs
    is a product of n.
    """

    def __init__(self, operators: str | int = "**", *, name: str | None = None):
        super().__init__(
            self._named(name), operators if isinstance(operators, str) else "*" * operators
        )


class Abs(Block, _core.Abs):
    """y = |u|, entry by entry; u = 0 is located."""

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))


class Saturate(Block, _core.Saturate):
    """y = min(max(u, lower_limit), upper_limit), entry by entry. Parameters: the limits that are
    given, one or both.
    """

    def __init__(
        self,
        lower_limit: ArrayLike | None = None,
        upper_limit: ArrayLike | None = None,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), lower_limit, upper_limit)


class Multiplexer(Block, _core.Multiplexer):
    """y = (u_0, u_1, ...): the inputs, one after the other, as one vector."""

    def __init__(self, n_inputs: int, *, name: str | None = None):
        super().__init__(self._named(name), n_inputs)


class Demultiplexer(Block, _core.Demultiplexer):
    """y_k = part k of u, cut into n_outputs equal parts."""

    def __init__(self, n_outputs: int, *, name: str | None = None):
        super().__init__(self._named(name), n_outputs)


class ReduceBlock(LeafSystem):
    """y = f((u_0, u_1, ...)): any Python function of the tuple of all inputs, floats or arrays.

    `function` must not change the world: it is called as often as the engine likes, and once before
    the run, with inputs at zero, to see what it gives: how many numbers, and whether they are
    booleans. A boolean that reaches a derivative or a reset is located by bisection; a
    `Comparator`, which Saltus can see into, is faster. `shape` and `boolean` say it where that call
    would not.
    """

    @refusing
    def __init__(
        self,
        n_inputs: int,
        function: Callable[[tuple[Any, ...]], ArrayLike],
        *,
        shape: int | tuple[int, ...] | None = None,
        boolean: bool | None = None,
        name: str | None = None,
    ):
        super().__init__(name)
        if n_inputs < 1:
            raise ModelError(f"block '{self.name}': expected 1 input or more, found {n_inputs}")
        for _ in range(n_inputs):
            self.declare_input_port()
        self._declare_function(function, shape, boolean, _core.Convention.inputs)


class FunctionBlock(LeafSystem):
    """y = f(u): any Python function of the one input, a float or an array. Otherwise like
    `ReduceBlock`.
    """

    @refusing
    def __init__(
        self,
        function: Callable[..., ArrayLike],
        *,
        shape: int | tuple[int, ...] | None = None,
        boolean: bool | None = None,
        name: str | None = None,
    ):
        super().__init__(name)
        self.declare_input_port("in")
        self._declare_function(function, shape, boolean, _core.Convention.input)
