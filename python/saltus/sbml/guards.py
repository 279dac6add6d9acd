"""The guards of differences: each locates where one leaves its side of zero."""

from __future__ import annotations

from saltus.errors import ModelError
from saltus.sbml.crossing import Crossing
from saltus.sbml.derivative import along
from saltus.sbml.nodes import Nodes
from saltus.sbml.running import RunningScope

__all__ = ["Guards", "just_after"]

AFTER = 1e-13
"""relative; how much later than a zero follows what is true after it alone: more than the roundings
of a sum of some hundred times (2e-14), less than `SAME_TIME` of `crossing`
"""
LEAST = 1e-300
"""a difference of zeros has no rounding; its guards begin below zero all the same"""


def just_after(nodes: Nodes) -> int:
    """How much later than now something is that follows an instant."""
    return nodes("mul", AFTER, nodes("add", 1.0, nodes("abs", int(nodes.graph.time()))))


class Guards:
    """Guards that rise where a difference becomes positive, and where it becomes negative."""

    def __init__(self, scope: RunningScope, crossing: Crossing, sides: list[int]):
        self.scope, self.noise, self.sides = scope, crossing.noise, sides
        self.differences = list(scope.differences)
        self.nodes = Nodes(scope.graph)

    def up(self) -> list[int]:
        zero_counts = self.scope.zero_above
        return [self._made(k, n, k not in zero_counts) for k, n in enumerate(self.differences)]

    def down(self) -> list[int]:
        zero_counts = self.scope.zero_below
        negative = [self.nodes("neg", node) for node in self.differences]
        return [self._made(k, n, k not in zero_counts) for k, n in enumerate(negative)]

    def _made(self, k: int, node: int, strictly: bool) -> int:
        """A guard is lowered by its rounding while its side is 0: it fires where it comes from
        below zero, and a difference may leave its zero with any slope.
        """
        f = self.nodes
        at_zero = f("eq", self.sides[k], 0.0)
        lower = f("select", at_zero, f("add", self.noise[k], LEAST), 0.0)
        return self._late(f("sub", node, lower), strictly)

    def _late(self, node: int, strictly: bool) -> int:
        """A guard of the time alone may be zero before its comparison has changed. It then fires
        just after that time, and a row there shows the values before. It is lowered by its change
        in between, unless it jumps or has no slope.
        """
        f = self.nodes
        if not strictly or self.scope.follows_states(node):
            return node
        try:
            slope = along(f.graph, node, self.scope.variable_rate, "a comparison")
        except ModelError:
            return node
        size = f("select", f.finite(slope), f("abs", slope), 0.0)
        return f("sub", node, f("mul", size, just_after(f)))
