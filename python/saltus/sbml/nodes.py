"""`Nodes`: operations on the nodes of a graph, and on numbers beside them."""

from __future__ import annotations

import functools
import math
from typing import Any

__all__ = ["Nodes"]


class Nodes:
    """A float is a constant, an int a node."""

    def __init__(self, graph: Any):
        self.graph = graph

    def __call__(self, op: str | float, *operands: int | float) -> int:
        """The result of an operation, or the node of a number."""
        if isinstance(op, float):
            return int(self.graph.constant(op))
        return int(
            self.graph.apply(op, *(self(a) if isinstance(a, float) else a for a in operands))
        )

    def all(self, *truths: int) -> int:
        return functools.reduce(functools.partial(self, "logical_and"), truths)

    def any(self, truths: list[int]) -> int:
        return functools.reduce(functools.partial(self, "logical_or"), truths, self(0.0))

    def no(self, truth: int) -> int:
        return self("logical_not", truth)

    def sign(self, node: int) -> int:
        """-1, 0 or 1; 0 for NaN."""
        negative = self("select", self("lt", node, 0.0), -1.0, 0.0)
        return self("select", self("gt", node, 0.0), 1.0, negative)

    def finite(self, node: int) -> int:
        return self("lt", self("abs", node), math.inf)
