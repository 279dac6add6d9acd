"""Blocks that decide. A boolean is 0 or 1; what is not 0 counts as true."""

from __future__ import annotations

from saltus import _core
from saltus.library.block import Block


class Comparator(Block, _core.Comparator):
    """y = u_0 operator u_1, entry by entry; operator is <, <=, >, >=, == or !=.

    The first four are located by the smooth guard u_0 - u_1; == and != have none and are meant for
    held signals.
    """

    def __init__(self, operator: str, *, name: str | None = None):
        super().__init__(self._named(name), operator)


class LogicalOperator(Block, _core.LogicalOperator):
    """y = function(u_0, u_1, ...), entry by entry; function is 'or', 'and', 'not', 'nor', 'nand' or
    'xor' (an odd number).
    """

    def __init__(self, function: str, n_inputs: int = 2, *, name: str | None = None):
        super().__init__(self._named(name), function, n_inputs)


class Switch(Block, _core.Switch):
    """y = true_value if control, else false_value: the names of its three inputs, in the order
    true_value, control, false_value.

    With a `threshold`, a parameter in the unit of control, control is a real signal and true where
    it is at or above.
    """

    def __init__(self, threshold: float | None = None, *, name: str | None = None):
        super().__init__(self._named(name), threshold)
