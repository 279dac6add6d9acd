"""The derivative of a node of an expression graph along the flow."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from saltus.errors import ModelError
from saltus.sbml.walk import VARIABLES, Walk

__all__ = ["Jumps", "along"]

SMOOTH = {"floor", "ceil", "trunc", "sign", "rint"}
"""operations whose derivative is zero between their jumps"""
JUMPING = SMOOTH | {"fmod"}


def along(graph: Any, node: int, rate: Callable[[str, int], int], name: str) -> int:
    """d node / d time, where rate(kind, index) is that of a variable of the graph.

    ModelError, which names the id, for an operation whose derivative is not known here.
    """
    return _Derivative(graph, rate, name).of(node)


class _Derivative(Walk[int]):
    def __init__(self, graph: Any, rate: Callable[[str, int], int], name: str):
        super().__init__(graph)
        self.rate, self.name = rate, name

    def apply(self, op: str, *operands: int) -> int:
        return int(self.graph.apply(op, *operands))

    def constant(self, value: float) -> int:
        return int(self.graph.constant(value))

    def made(self, node: int) -> int:
        if self.graph.value(node) is not None:
            return self.constant(0.0)
        op, operands = self.graph.operation(node)
        if op in VARIABLES:
            return self.rate(op, operands[0] if operands else 0)
        if op == "select":
            return self.apply("select", operands[0], self.of(operands[1]), self.of(operands[2]))
        slopes = [self.of(one) for one in operands]
        if all(self.graph.value(slope) == 0.0 for slope in slopes) or op in SMOOTH:
            return self.constant(0.0)
        if len(operands) == 1:
            return self.apply("mul", self.slope(node, op, operands[0]), slopes[0])
        return self.of_two(node, op, operands, slopes)

    def slope(self, node: int, op: str, a: int) -> int:
        """The derivative of a function of one number by that number."""
        one = self.constant(1.0)
        if op == "neg":
            return self.constant(-1.0)
        if op == "exp":
            return node
        if op == "log":
            return self.apply("div", one, a)
        if op == "log10":
            return self.apply("div", self.constant(0.4342944819032518), a)
        if op == "sqrt":
            return self.apply("div", self.constant(0.5), node)
        if op == "sin":
            return self.apply("cos", a)
        if op == "cos":
            return self.apply("neg", self.apply("sin", a))
        if op == "tanh":
            return self.apply("sub", one, self.apply("mul", node, node))
        if op == "tan":
            return self.apply("add", one, self.apply("mul", node, node))
        if op == "abs":
            return self.apply("sign", a)
        raise ModelError(
            f"rateOf '{self.name}': the derivative of '{op}' is not known; write it as a formula"
        )

    def of_two(self, node: int, op: str, operands: list[int], slopes: list[int]) -> int:
        (a, b), (da, db) = operands, slopes
        if op in ("add", "sub"):
            return self.apply(op, da, db)
        if op == "mul":
            return self.apply("add", self.apply("mul", da, b), self.apply("mul", a, db))
        if op == "div":
            return self.apply("div", self.apply("sub", da, self.apply("mul", node, db)), b)
        if op == "pow" and self.graph.value(db) == 0.0:
            lower = self.apply("pow", a, self.apply("sub", b, self.constant(1.0)))
            return self.apply("mul", self.apply("mul", b, lower), da)
        if op == "pow":
            growth = self.apply("mul", db, self.apply("log", a))
            slow = self.apply("div", self.apply("mul", b, da), a)
            return self.apply("mul", node, self.apply("add", growth, slow))
        raise ModelError(
            f"rateOf '{self.name}': the derivative of '{op}' is not known; write it as a formula"
        )


class Jumps(Walk[bool]):
    """Whether a node reads an operation that jumps, of operands of which `flows` is true."""

    def __init__(self, graph: Any, flows: Callable[[int], bool]):
        super().__init__(graph)
        self.flows = flows

    def made(self, node: int) -> bool:
        if not self.flows(node):
            return False
        op, operands = self.graph.operation(node)
        return op not in VARIABLES and (op in JUMPING or any(map(self.of, operands)))
