"""Which differences cross zero at an instant, though their own guard fires a rounding later."""

from __future__ import annotations

import math
import sys

from saltus.sbml.nodes import Nodes
from saltus.sbml.running import RunningScope
from saltus.sbml.walk import Replaced

__all__ = ["Crossing"]

SAME_TIME = 1e-12
"""relative; zeros closer than this are one instant: a located time has some hundred roundings"""
ROUNDINGS = 8.0
"""of the terms of a difference: some of the step that made the states, one of each term"""
SHORT = math.sqrt(sys.float_info.epsilon)
"""relative to the time. A difference that changes by less than its rounding meanwhile turns at its
zero: roundings move the zeros of a parabola by their square root
"""


class _Moved(Replaced):
    """A node as it will be after some time, by the tangents of the states."""

    def __init__(self, scope: RunningScope, rates: dict[int, int], late: int):
        super().__init__(scope.graph, {})
        self.scope, self.rates, self.late = scope, rates, late

    def made(self, node: int) -> int:
        if self.graph.value(node) is None:
            op, operands = self.graph.operation(node)
            if op == "time":
                return self.scope.apply("add", node, self.late)
            if op == "continuous_state":
                moved = self.scope.apply("mul", self.late, self.rate(operands[0]))
                return self.scope.apply("add", node, moved)
        return super().made(node)

    def rate(self, i: int) -> int:
        if i not in self.rates:
            self.rates[i] = self.scope.variable_rate("continuous_state", i)
        return self.rates[i]


class Crossing:
    """For each difference the side to which the flow takes it at this instant, 0 for none.

    A difference crosses zero at this instant in two cases. It has different signs `SAME_TIME`
    before and after the instant, where the states move along their tangents. Or it is so small that
    roundings can hide the change of its sign: its own, or those of the difference that fired, by
    which the instant was located.
    """

    def __init__(self, scope: RunningScope):
        self.nodes = f = Nodes(scope.graph)
        self.now = list(scope.differences)
        self.noise = [f("mul", ROUNDINGS * sys.float_info.epsilon, scope.size_of_terms(node))
                      for node in self.now]  # fmt: skip
        scale = f("maximum", 1.0, f("abs", int(scope.graph.time())))
        rates: dict[int, int] = {}

        def after(time: float) -> list[int]:
            moved = _Moved(scope, rates, f("mul", time, scale))
            return [moved.of(node) for node in self.now]

        self.before, self.after = after(-SAME_TIME), after(SAME_TIME)
        self.change = [
            f("sub", late, now) for late, now in zip(after(SHORT), self.now, strict=True)
        ]
        self.steep = [
            f.all(f.finite(change), f("gt", f("abs", change), noise))
            for change, noise in zip(self.change, self.noise, strict=True)
        ]

    def sides(self, fired: list[int] | None = None) -> list[int]:
        """`fired` says for each difference whether its guard located the instant."""
        f, wide = self.nodes, self.nodes(SAME_TIME / SHORT)
        for k, one in enumerate(fired or ()):
            own = f("div", self.noise[k], f("abs", self.change[k]))
            wide = f("add", wide, f("select", f.all(one, self.steep[k]), own, 0.0))
        return [self._side(k, wide) for k in range(len(self.now))]

    def _side(self, k: int, wide: int) -> int:
        f, change = self.nodes, self.change[k]
        before, after = f.sign(self.before[k]), f.sign(self.after[k])
        reach = f("add", f("mul", f("abs", change), wide), self.noise[k])
        hidden = f.all(f("le", f("abs", self.now[k]), reach), self.steep[k])
        found = f("select", hidden, f.sign(change), 0.0)
        plain = f.all(f.finite(self.before[k]), f.finite(self.after[k]), f("ne", before, after))
        return f("select", plain, after, found)
