"""Blocks that calculate with their inputs, entry by entry. One input is called 'in', several
'in_0', 'in_1', ...; likewise outputs.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus.errors import BlockParameterError
from saltus.library.block import Block

__all__ = ["Abs", "Adder", "Gain", "Offset", "Product", "Saturate"]


def _operators(block: str, usual: str, n_in: object, operators: object) -> str:
    """One operator an input; `usual` for each where only their number is said."""
    given = [value for value in (n_in, operators) if value is not None] or [2]
    counts: list[Any] = [len(v) if isinstance(v, str) else v for v in given]
    for count in counts:
        if not isinstance(count, (int, np.integer)) or isinstance(count, bool) or count < 1:
            raise BlockParameterError(
                f"block '{block}': expected the number of inputs, or an operator for each such as "
                f"'{usual}{usual}', found {count!r}"
            )
    if len(set(counts)) > 1:
        raise BlockParameterError(
            f"block '{block}': {counts[0]} inputs and {counts[1]} operators {given[1]!r}; expected "
            "one operator for each input"
        )
    signs = [v for v in given if isinstance(v, str)]
    if len(set(signs)) > 1:
        raise BlockParameterError(
            f"block '{block}': operators {signs[0]!r} and {signs[1]!r}; say them once"
        )
    return signs[0] if signs else usual * counts[0]


class Gain(Block, _core.Gain):
    """y = gain u, entry by entry.

    Parameters
    ----------
    gain
        A number, or a vector as wide as the input. It is the parameter `gain` of the context.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Examples
    --------
    >>> from saltus.library import Constant, Gain
    >>> builder = saltus.DiagramBuilder()
    >>> u, block = builder.add(Constant([1.0, 3.0]), Gain(-2.0))
    >>> builder.connect(u.output(), block.input())
    >>> _ = builder.export_output(block.output(), "y")
    >>> diagram = builder.build()
    >>> saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 0.0), recorded_signals={"y": diagram.output()}
    ... ).outputs["y"]
    array([[-2., -6.]])
    """

    def __init__(self, gain: ArrayLike, *, name: str | None = None):
        super().__init__(self._named(name), gain)


class Offset(Block, _core.Offset):
    """y = u + offset, entry by entry.

    Parameters
    ----------
    offset
        A number, or a vector as wide as the input. It is the parameter `offset` of the context.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Examples
    --------
    >>> from saltus.library import Constant, Offset
    >>> builder = saltus.DiagramBuilder()
    >>> u, block = builder.add(Constant([1.0, 3.0]), Offset(10.0))
    >>> builder.connect(u.output(), block.input())
    >>> _ = builder.export_output(block.output(), "y")
    >>> diagram = builder.build()
    >>> saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 0.0), recorded_signals={"y": diagram.output()}
    ... ).outputs["y"]
    array([[11., 13.]])
    """

    def __init__(self, offset: ArrayLike, *, name: str | None = None):
        super().__init__(self._named(name), offset)


class Adder(Block, _core.Adder):
    """y = ±u_0 ±u_1 ..., entry by entry, with one sign for each input.

    Parameters
    ----------
    n_in
        The number of inputs; or the operators, in their place.
    operators
        The signs, one character an input: "+-" is u_0 - u_1. Without them all are plus, of two
        inputs if `n_in` is not said either.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        For another character than + and -, or another number of them than `n_in`.

    Examples
    --------
    >>> from saltus.library import Constant, Adder
    >>> builder = saltus.DiagramBuilder()
    >>> a, b, block = builder.add(Constant(5.0), Constant(2.0), Adder("+-"))
    >>> builder.connect(a.output(), block.input(0))
    >>> builder.connect(b.output(), block.input(1))
    >>> diagram = builder.build()
    >>> saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 0.0), recorded_signals={"y": block.output()}
    ... ).outputs["y"]
    array([3.])
    """

    def __init__(
        self,
        n_in: int | str | None = None,
        operators: str | int | None = None,
        *,
        name: str | None = None,
    ):
        name = self._named(name)
        super().__init__(name, _operators(name, "+", n_in, operators))


class Product(Block, _core.Product):
    """y = 1 */ u_0 */ u_1 ..., entry by entry, with one operator for each input.

    Parameters
    ----------
    n_in
        The number of inputs; or the operators, in their place.
    operators
        "*" or "/" for each input: "*/" is u_0 / u_1. Without them all are "*", of two inputs if
        `n_in` is not said either.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        For another character than * and /, or another number of them than `n_in`.

    Examples
    --------
    >>> from saltus.library import Constant, Product
    >>> builder = saltus.DiagramBuilder()
    >>> a, b, block = builder.add(Constant(6.0), Constant(4.0), Product("*/"))
    >>> builder.connect(a.output(), block.input(0))
    >>> builder.connect(b.output(), block.input(1))
    >>> diagram = builder.build()
    >>> saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 0.0), recorded_signals={"y": block.output()}
    ... ).outputs["y"]
    array([1.5])
    """

    def __init__(
        self,
        n_in: int | str | None = None,
        operators: str | int | None = None,
        *,
        name: str | None = None,
    ):
        name = self._named(name)
        super().__init__(name, _operators(name, "*", n_in, operators))


class Abs(Block, _core.Abs):
    """y = abs(u), entry by entry. Where u passes zero is located as an event.

    Parameters
    ----------
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Examples
    --------
    >>> from saltus.library import Constant, Abs
    >>> builder = saltus.DiagramBuilder()
    >>> u, block = builder.add(Constant([-2.0, 3.0]), Abs())
    >>> builder.connect(u.output(), block.input())
    >>> _ = builder.export_output(block.output(), "y")
    >>> diagram = builder.build()
    >>> saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 0.0), recorded_signals={"y": diagram.output()}
    ... ).outputs["y"]
    array([[2., 3.]])
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))


class Saturate(Block, _core.Saturate):
    """y = min(max(u, lower_limit), upper_limit), entry by entry.

    Parameters
    ----------
    lower_limit, upper_limit
        A number or a vector each; one of them may be left out. Those given are parameters of the
        context. Where u passes a limit is located as an event.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        If neither is given, or the lower one is above the upper one.

    Examples
    --------
    >>> from saltus.library import Constant, Saturate
    >>> builder = saltus.DiagramBuilder()
    >>> u, block = builder.add(Constant([-5.0, 0.5, 5.0]), Saturate(-1.0, 1.0))
    >>> builder.connect(u.output(), block.input())
    >>> _ = builder.export_output(block.output(), "y")
    >>> diagram = builder.build()
    >>> saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 0.0), recorded_signals={"y": diagram.output()}
    ... ).outputs["y"]
    array([[-1. ,  0.5,  1. ]])
    """

    def __init__(
        self,
        lower_limit: ArrayLike | None = None,
        upper_limit: ArrayLike | None = None,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), lower_limit, upper_limit)
