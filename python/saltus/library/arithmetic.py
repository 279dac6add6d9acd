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


class Multiplexer(Block, _core.Multiplexer):
    """y = (u_0, u_1, ...): the inputs, one after the other, as one vector.

    Parameters
    ----------
    n_inputs
        How many inputs there are, 1 or more; each may be a number or a vector.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Examples
    --------
    >>> from saltus.library import Constant, Multiplexer
    >>> builder = saltus.DiagramBuilder()
    >>> a, b, block = builder.add(Constant(1.0), Constant([2.0, 3.0]), Multiplexer(2))
    >>> builder.connect(a.output(), block.input(0))
    >>> builder.connect(b.output(), block.input(1))
    >>> diagram = builder.build()
    >>> saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 0.0), recorded_signals={"y": block.output()}
    ... ).outputs["y"]
    array([[1., 2., 3.]])
    """

    def __init__(self, n_inputs: int, *, name: str | None = None):
        super().__init__(self._named(name), n_inputs)


class Demultiplexer(Block, _core.Demultiplexer):
    """y_k = part k of u, which is cut into equal parts.

    Parameters
    ----------
    n_outputs
        How many parts there are, 1 or more; the width of u must be a multiple.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        When the diagram is used, if u cannot be cut so.

    Examples
    --------
    >>> from saltus.library import Constant, Demultiplexer
    >>> builder = saltus.DiagramBuilder()
    >>> u, block = builder.add(Constant([1.0, 2.0, 3.0, 4.0]), Demultiplexer(2))
    >>> builder.connect(u.output(), block.input())
    >>> _ = builder.export_output(block.output(), "y")
    >>> diagram = builder.build()
    >>> saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 0.0), recorded_signals={"y": diagram.output()}
    ... ).outputs["y"]
    array([[1., 2.]])
    """

    def __init__(self, n_outputs: int, *, name: str | None = None):
        super().__init__(self._named(name), n_outputs)


class ReduceBlock(LeafSystem):
    """y = f((u_0, u_1, ...)): a Python function of the tuple of all inputs.

    Parameters
    ----------
    n_inputs
        How many inputs there are, 1 or more.
    function
        Takes one tuple, of a float for each number and a read-only array for each vector; returns a
        number, a boolean or an array. It is called as often as the engine likes, so it must not
        change anything; once before the run, with inputs at zero, to see what it gives.
    shape
        The shape of y, where the call before the run would not show it.
    boolean
        Whether y is true or false. A boolean that reaches a derivative or a reset is located: by a
        smooth guard where Saltus can see into the function, else by bisection.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        For fewer than one input.

    Examples
    --------
    >>> from saltus.library import Constant, ReduceBlock
    >>> builder = saltus.DiagramBuilder()
    >>> a, b, block = builder.add(
    ...     Constant(3.0), Constant(1.0), ReduceBlock(2, lambda u: u[0] ** 2 + u[1])
    ... )
    >>> builder.connect(a.output(), block.input(0))
    >>> builder.connect(b.output(), block.input(1))
    >>> diagram = builder.build()
    >>> saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 0.0), recorded_signals={"y": block.output()}
    ... ).outputs["y"]
    array([10.])
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
    """y = f(u): a Python function of the one input.

    Parameters
    ----------
    function
        Takes a float, or a read-only array if the input is a vector; returns a number, a boolean or
        an array. Otherwise as that of `ReduceBlock`.
    shape
        The shape of y, where the call before the run would not show it.
    boolean
        Whether y is true or false. A boolean that reaches a derivative or a reset is located: by a
        smooth guard where Saltus can see into the function, else by bisection.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Examples
    --------
    >>> from saltus.library import Constant, FunctionBlock
    >>> builder = saltus.DiagramBuilder()
    >>> u, block = builder.add(Constant([1.0, 2.0, 3.0]), FunctionBlock(np.cumsum))
    >>> builder.connect(u.output(), block.input())
    >>> _ = builder.export_output(block.output(), "y")
    >>> diagram = builder.build()
    >>> saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 0.0), recorded_signals={"y": diagram.output()}
    ... ).outputs["y"]
    array([[1., 3., 6.]])
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
