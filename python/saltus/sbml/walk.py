"""Walks through an expression graph, which find out each node once."""

from __future__ import annotations

from typing import Any, Generic, TypeVar

__all__ = ["VARIABLES", "Flows", "TimeAlone", "Walk"]

VARIABLES = ("time", "continuous_state", "discrete_state", "parameter")
"""operations of nodes that are variables of a formula"""
Found = TypeVar("Found")


class Walk(Generic[Found]):
    """What a derived class says of a node, in `made`, kept for the next question."""

    def __init__(self, graph: Any):
        self.graph = graph
        self.done: dict[int, Found] = {}

    def of(self, node: int) -> Found:
        if node not in self.done:
            self.done[node] = self.made(node)
        return self.done[node]

    def made(self, node: int) -> Found:
        raise NotImplementedError


class Flows(Walk[bool]):
    """Whether a node changes between instants."""

    def made(self, node: int) -> bool:
        if self.graph.value(node) is not None:
            return False
        op, operands = self.graph.operation(node)
        if op in VARIABLES:
            return bool(op in ("time", "continuous_state"))
        return op == "input" or any(map(self.of, operands))


class TimeAlone(Walk[bool]):
    """Whether a node changes with the time alone between instants."""

    def made(self, node: int) -> bool:
        if self.graph.value(node) is not None:
            return True
        op, operands = self.graph.operation(node)
        if op in VARIABLES:
            return bool(op != "continuous_state")
        return all(map(self.of, operands))
