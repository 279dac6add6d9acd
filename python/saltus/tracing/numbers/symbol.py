"""`Symbol`: one number that is not known yet, a node of an expression graph."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus.tracing.refusal import refuse

__all__ = ["ORDER", "Symbol", "joint", "kind_of"]

ORDER = "bif"  # truth, integer, real: an operation on two kinds gives the later one
LARGEST = 100_000  # the largest number of nodes; a longer tape gains nothing over numpy

VARIABLES = {"time", "continuous_state", "discrete_state", "entry", "parameter", "input"}

BRANCH = "use np.where, np.minimum, `&` and `|`, or modes with zero crossings"


def kind_of(value: Any) -> str:
    """'b', 'i' or 'f' for a truth, an integer, a real number; '' for any other value."""
    if type(value) is Symbol:
        return value.kind
    if isinstance(value, (bool, np.bool_)):
        return "b"
    if isinstance(value, (int, np.integer)):
        return "i"
    return "f" if isinstance(value, (float, np.floating)) else ""


def joint(*kinds: str) -> str:
    """The kind of an array that holds numbers of these kinds."""
    return max(kinds, key=ORDER.index)


class Symbol:
    """A symbolic number. Its operators make new ones; it cannot be branched on.

    `python` says that the called form has a Python float, int or bool here, not a numpy scalar:
    of Python's truths the sum is an integer, of numpy's a truth.
    """

    __array_priority__ = 1000.0
    __slots__ = ("graph", "kind", "node", "python")

    def __init__(self, graph: Any, node: int, kind: str = "f", python: bool = False):
        if node > LARGEST:
            refuse(f"has more than {LARGEST} operations", "what is that large is called")
        self.graph = graph
        self.node = node
        self.kind = kind
        self.python = python

    @property
    def value(self) -> float | None:
        """The number, if it is known after all."""
        number: float | None = self.graph.value(self.node)
        return number

    def known(self, what: str, remedy: str) -> float:
        number = self.value
        return refuse(what, remedy) if number is None else number

    def numpy(self, kind: str = "") -> Symbol:
        """The same number as an entry of an array, of that kind."""
        kind = kind or self.kind
        if not self.python and kind == self.kind:
            return self
        return Symbol(self.graph, self.node, kind)

    def reads_mode_only(self) -> bool:
        """Whether it follows from the mode alone."""
        waiting, seen = [self.node], {-1}
        while waiting and len(seen) < 100:
            node = waiting.pop()
            name, operands = self.graph.operation(node)
            if name == "mode" or name == "constant":
                continue
            if name in VARIABLES:
                return False
            seen.add(node)
            waiting += [n for n in operands if n not in seen]
        return True

    def __bool__(self) -> bool:
        if self.value is None and self.reads_mode_only():
            refuse("branches on the mode", "use np.where(state.mode == ..., ..., ...)")
        return bool(self.known("branches on a value", BRANCH))

    def __float__(self) -> float:
        return float(self.known("turns a value into a fixed number", "use numpy on it"))

    def __int__(self) -> int:
        return int(self.known("turns a value into a fixed integer", "use np.floor or np.trunc"))

    def __index__(self) -> int:
        number = self.known("uses a value as an index or a count", "use np.where or np.select")
        if self.kind == "f":
            raise TypeError("'float' object cannot be interpreted as an integer")
        return int(number)

    def __complex__(self) -> complex:
        refuse("computes with complex numbers", "use real and imaginary parts")

    def __hash__(self) -> int:
        refuse("looks up a value, in a dictionary or a set", "use np.where or np.select")

    def __copy__(self) -> Symbol:
        return self

    def __deepcopy__(self, memo: object) -> Symbol:
        return self

    def __reduce__(self) -> Any:
        refuse("stores a value", "return it instead")

    def __repr__(self) -> str:
        return f"<symbol {self.node}>"

    # the attributes of numpy's numbers
    shape: tuple[int, ...] = ()
    ndim = 0
    size = 1

    @property
    def real(self) -> Symbol:
        return self

    @property
    def T(self) -> Symbol:
        return self

    # the other methods of numpy's numbers are in operators.py
    def item(self) -> Symbol:
        return Symbol(self.graph, self.node, self.kind, True)

    def conjugate(self) -> Symbol:
        return self
