"""Comparisons inside a truth: smooth differences for the solver, and the truth over them."""

from __future__ import annotations

from typing import Any

from saltus.tracing.signature import Relations

__all__ = ["LOGIC", "SIDES", "find"]

SIDES = {"gt": (True, False), "ge": (True, True), "lt": (False, False), "le": (False, True)}
"""comparison a ? b -> (whether it is true where a - b is positive, true where it is zero)"""
LOGIC = {"logical_and", "logical_or", "logical_not", "select", "eq", "ne"}
NEGATION = ("logical_not", "eq")


class _Found:
    """The comparisons of a truth, in order, and the node of the truth over them."""

    def __init__(self, graph: Any, truth_graph: Any):
        self.graph = graph
        self.truths = truth_graph
        self.differences: dict[int, int] = {}
        """node of a difference -> its number"""
        self.true_at_zero: list[bool] = []
        self._done: dict[int, int | None] = {}

    def _comparison(self, name: str, a: int, b: int) -> int:
        """The truth of a comparison as a node over truths."""
        forward, at_zero = SIDES[name]
        difference = self.graph.apply("sub", *((a, b) if forward else (b, a)))
        if difference not in self.differences:
            self.differences[difference] = len(self.true_at_zero)
            self.true_at_zero.append(at_zero)
        k = self.differences[difference]
        if self.true_at_zero[k] != at_zero:
            raise KeyError  # a < b and a <= b in one truth: two relations of one difference
        return int(self.truths.discrete_state(k))

    def truth(self, node: int) -> int | None:
        """The node over truths, or None if it reads more than comparisons."""
        if node not in self._done:
            self._done[node] = self._built(node)
        return self._done[node]

    def _built(self, node: int) -> int | None:
        number = self.graph.value(node)
        if number is not None:
            return int(self.truths.constant(number))
        name, operands = self.graph.operation(node)
        if name in SIDES:
            return self._comparison(name, *operands)
        if name not in LOGIC:
            return None
        parts = [self.truth(n) for n in operands]
        if any(part is None for part in parts):
            return None
        return int(self.truths.apply(name, *parts))


def find(new_graph: Any, graph: Any, outputs: list[int]) -> Relations | None:
    """The relations of a truth, or None if it is not made of comparisons alone."""
    found = _Found(graph, new_graph())
    try:
        truths = [found.truth(node) for node in outputs]
    except KeyError:
        return None
    if not found.differences or any(node is None for node in truths):
        return None
    differences = graph.tape(list(found.differences))
    return Relations(differences, tuple(found.true_at_zero), found.truths.tape(truths))
