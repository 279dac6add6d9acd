"""Blocks that are a Python function of their inputs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numpy.typing import ArrayLike

from saltus import _core
from saltus._declarations import callback_of, shape_of
from saltus._porting import refusing
from saltus.errors import BlockParameterError
from saltus.leaf_system import LeafSystem

__all__ = ["FeedthroughBlock", "FunctionBlock", "ReduceBlock", "SourceBlock"]


def _declare_function(
    block: LeafSystem,
    function: Callable[..., ArrayLike],
    shape: int | tuple[int, ...] | None,
    boolean: bool | None,
    convention: _core.Convention,
    formula: bool,
) -> None:
    """The one output of a block that is a function of its inputs and nothing else."""
    _core.LeafSystem.declare_output_port(
        block,
        callback_of(function),
        "out",
        None,
        shape_of(shape),
        boolean,
        ["inputs"],
        convention,
        bool(formula),
        None,
        None,
    )


class ReduceBlock(LeafSystem):
    """y = f((u_0, u_1, ...)): a Python function of the tuple of all inputs.

    Parameters
    ----------
    n_inputs
        How many inputs there are, 1 or more.
    function
        Takes one tuple with a float for each number and a read-only array for each vector; returns
        a number, a boolean or an array. The engine calls it any number of times, so it must not
        change anything. It is called once before the run, with inputs at zero, to find the kind of
        its result.
    shape
        The shape of y, such as (2, 3) of a matrix, where the call before the run would not show it.
    boolean
        Whether y is true or false. A boolean that reaches a derivative or a reset is located: by a
        smooth guard where Saltus can see into the function, else by bisection.
    formula
        Whether a run may compute the function together with the blocks around it; see
        `LeafSystem.declare_output_port`.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    BlockParameterError
        If there is no input.

    Examples
    --------
    >>> from saltus.library import ReduceBlock
    >>> saltus.response(ReduceBlock(2, lambda u: u[0] ** 2 + u[1]), 3.0, 1.0)
    10.0
    """

    @refusing
    def __init__(
        self,
        n_inputs: int,
        function: Callable[[tuple[Any, ...]], ArrayLike],
        *,
        shape: int | tuple[int, ...] | None = None,
        boolean: bool | None = None,
        formula: bool = False,
        name: str | None = None,
    ):
        super().__init__(name)
        if n_inputs < 1:
            raise BlockParameterError(
                f"block '{self.name}': expected 1 input or more, found {n_inputs}"
            )
        for _ in range(n_inputs):
            self.declare_input_port()
        _declare_function(self, function, shape, boolean, _core.Convention.inputs, formula)


class FunctionBlock(LeafSystem):
    """y = f(u): a Python function of the one input.

    Parameters
    ----------
    function
        Takes a float, or a read-only array if the input is a vector; returns a number, a boolean or
        an array. Otherwise as that of `ReduceBlock`.
    shape
        The shape of y, such as (2, 3) of a matrix, where the call before the run would not show it.
    boolean
        Whether y is true or false. A boolean that reaches a derivative or a reset is located: by a
        smooth guard where Saltus can see into the function, else by bisection.
    formula
        Whether a run may compute the function together with the blocks around it; see
        `LeafSystem.declare_output_port`.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import FunctionBlock
    >>> saltus.response(FunctionBlock(np.cumsum), [1.0, 2.0, 3.0])
    array([1., 3., 6.])
    """

    @refusing
    def __init__(
        self,
        function: Callable[..., ArrayLike],
        *,
        shape: int | tuple[int, ...] | None = None,
        boolean: bool | None = None,
        formula: bool = False,
        name: str | None = None,
    ):
        super().__init__(name)
        self.declare_input_port("in")
        _declare_function(self, function, shape, boolean, _core.Convention.input, formula)


class FeedthroughBlock(FunctionBlock):
    """y = f(u): another name of `FunctionBlock`.

    Examples
    --------
    >>> from saltus.library import FeedthroughBlock
    >>> square = FeedthroughBlock(lambda u: u**2)
    >>> square.input().fix_value(3.0)
    >>> square.output().eval(square.create_context())
    9.0
    """


class SourceBlock(LeafSystem):
    """y = f(t): a Python function of the time.

    Parameters
    ----------
    function
        Takes the time [s], a float; returns a number or an array. Otherwise as that of
        `ReduceBlock`.
    shape
        The shape of y, such as (2, 3) of a matrix, where the call before the run would not show it.
    boolean
        Whether y is true or false, as for `ReduceBlock`.
    formula
        Whether a run may compute the function together with the blocks around it; see
        `LeafSystem.declare_output_port`.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import SourceBlock
    >>> parabola = SourceBlock(lambda t: t**2)
    >>> parabola.output().eval(parabola.create_context(time=3.0))
    9.0
    """

    @refusing
    def __init__(
        self,
        function: Callable[..., ArrayLike],
        *,
        shape: int | tuple[int, ...] | None = None,
        boolean: bool | None = None,
        formula: bool = False,
        name: str | None = None,
    ):
        super().__init__(name)
        if not callable(function):
            raise BlockParameterError(
                f"block '{self.name}': expected a function, found {function!r}"
            )
        self.declare_output_port(
            lambda time, state: function(time),
            name="out",
            requires_inputs=False,
            shape=shape,
            boolean=boolean,
            reads=["time"],
            formula=formula,
        )
