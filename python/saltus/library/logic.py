"""Blocks that decide. A boolean is 0 or 1; every number except 0 counts as true."""

from __future__ import annotations

from saltus import _core
from saltus.library.block import Block

__all__ = ["Comparator", "LogicalOperator", "Switch"]


class Comparator(Block, _core.Comparator):
    """y = u_0 operator u_1, entry by entry: 0 or 1.

    The first four are located by the smooth guard u_0 - u_1, and y is held between such instants;
    == and != have no guard and are meant for held signals.

    Parameters
    ----------
    operator
        "<", "<=", ">", ">=", "==" or "!=".
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        For another operator.

    Examples
    --------
    >>> from saltus.library import Comparator
    >>> saltus.response(Comparator("<"), [1.0, 4.0], 2.0)
    array([1., 0.])
    """

    def __init__(self, operator: str, *, name: str | None = None):
        super().__init__(self._named(name), operator)


class LogicalOperator(Block, _core.LogicalOperator):
    """y = function(u_0, u_1, ...), entry by entry: 0 or 1. Every number except 0 counts as true.

    Parameters
    ----------
    function
        "or", "and", "not", "nor", "nand" or "xor" (an odd number of inputs is true).
    n_inputs
        How many inputs there are; "not" takes 1.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        For another function, or a number of inputs that it does not take.

    Examples
    --------
    >>> from saltus.library import LogicalOperator
    >>> saltus.response(LogicalOperator("and"), [1.0, 1.0], [0.0, 1.0])
    array([0., 1.])
    """

    def __init__(self, function: str, n_inputs: int = 2, *, name: str | None = None):
        super().__init__(self._named(name), function, n_inputs)


class Switch(Block, _core.Switch):
    """y = true_value if control, else false_value: the names of its inputs, true_value, control,
    false_value in this order.

    Parameters
    ----------
    threshold
        Not said: control is a boolean. A number, in the unit of control: control is a real signal,
        and true at or above it; where it passes is located as an event. It is the parameter
        `threshold` of the context.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Examples
    --------
    >>> from saltus.library import Clock, Switch
    >>> saltus.response(Switch(2.0), 5.0, Clock(), 1.0, t=[1.0, 3.0])
    array([1., 5.])
    """

    def __init__(self, threshold: float | None = None, *, name: str | None = None):
        super().__init__(self._named(name), threshold)
