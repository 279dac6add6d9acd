"""Walks through an expression graph, which find out each node once."""

from __future__ import annotations

from typing import Any, Generic, TypeVar

__all__ = ["VARIABLES", "Reads", "Replaced", "Walk"]

VARIABLES = ("time", "continuous_state", "discrete_state", "parameter", "input", "entry")
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


class Reads(Walk[bool]):
    """Whether a node reads a variable of one of these kinds."""

    def __init__(self, graph: Any, *kinds: str):
        super().__init__(graph)
        self.kinds = kinds

    def made(self, node: int) -> bool:
        if self.graph.value(node) is not None:
            return False
        op, operands = self.graph.operation(node)
        return op in self.kinds if op in VARIABLES else any(map(self.of, operands))


class Replaced(Walk[int]):
    """A node with other nodes in the places of some. The method `put` may be called after a node
    was asked for that does not read what is put.
    """

    def __init__(self, graph: Any, nodes: dict[int, int]):
        super().__init__(graph)
        self.done = dict(nodes)

    def put(self, node: int, other: int) -> None:
        self.done[node] = other

    def made(self, node: int) -> int:
        if self.graph.value(node) is not None:
            return node
        op, operands = self.graph.operation(node)
        if op in VARIABLES:
            return node
        others = [self.of(one) for one in operands]
        return node if others == operands else int(self.graph.apply(op, *others))
