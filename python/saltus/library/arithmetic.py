"""Blocks that calculate with their inputs, entry by entry. One input is called 'in', several
'in_0', 'in_1', ...; likewise outputs.
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = ["Abs", "Adder", "Gain", "Offset", "Product", "Saturate"]


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
    operators
        The signs, one character an input: "+-" is u_0 - u_1. A number n stands for n plus signs.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        For another character than + and -.

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

    def __init__(self, operators: str | int = "++", *, name: str | None = None):
        super().__init__(
            self._named(name), operators if isinstance(operators, str) else "+" * operators
        )


class Product(Block, _core.Product):
    """y = 1 */ u_0 */ u_1 ..., entry by entry, with one operator for each input.

    Parameters
    ----------
    operators
        "*" or "/" for each input: "*/" is u_0 / u_1. A number n stands for n times "*".
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        For another character than * and /.

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

    def __init__(self, operators: str | int = "**", *, name: str | None = None):
        super().__init__(
            self._named(name), operators if isinstance(operators, str) else "*" * operators
        )


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
