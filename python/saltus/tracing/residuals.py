"""A truth as a guard: a number that is positive where it is true, and negative where it is not."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from saltus.tracing.relations import LOGIC, SIDES
from saltus.tracing.signature import Refused, Traced

__all__ = ["as_guard", "jump", "residual", "stand_for_truths"]

HELD = {"constant", "discrete_state", "mode", "parameter", "entry"}
"""values that change at instants only"""
SHARE = 1e-9
"""half of the jump of a truth, in the size of what it compares: above the rounding of a comparison,
below every difference that matters
"""
LEAST = 1e-100
"""half of the jump where the compared values are 0"""
MOVING = {"time", "continuous_state", "input"}
FINITE = {"add", "sub", "mul", "neg", "abs", "minimum", "maximum", "sin", "cos", "tanh", "atan"}
"""operations that make no NaN of ordinary numbers"""


class _Residuals:
    """The residuals of the truths of one graph.

    A comparison a > b has the residual a - b. `and` has the smaller of two residuals, `or` the
    larger one, `not` the negative one. So the residual is as continuous as what is compared, and it
    is zero where the truth may change. A truth over values that change at instants only, as
    mode == 1, chooses between residuals.
    """

    def __init__(self, graph: Any):
        self.graph = graph
        self._held: dict[int, bool] = {}
        self._finite: set[int] = set()

    def of(self, node: int) -> int | None:
        """The node of the residual of a truth; None if there is none, as for floor(x) == 2."""
        if self.graph.value(node) is None:
            name, operands = self.graph.operation(node)
            if name in SIDES:
                return self._comparison(name, *operands)
            if name == "logical_not":
                inner = self.part(operands[0])
                return None if inner is None else self._apply("neg", inner)
            if name in ("logical_and", "logical_or"):
                return self._both(name, *operands)
            if name == "select":
                return self._chosen(*operands)
            if name in ("eq", "ne") and all(map(self._is_truth, operands)) and not self.held(node):
                return self._differ(name, *operands)
        return (
            self._apply("select", node, self._one(), self._minus_one()) if self.held(node) else None
        )

    def part(self, node: int) -> int | None:
        """The residual of a part of a truth: a comparison with NaN is false there, as anywhere."""
        found = self.of(node)
        return None if found is None else self._without_nan(found, self._minus_one())

    def _without_nan(self, node: int, other: int) -> int:
        """The number, or another one where it is NaN."""
        if self._is_finite(node):
            return node
        found = self._apply("select", self._apply("eq", node, node), node, other)
        self._finite.add(found)
        return found

    def jump(self, node: int) -> int:
        found = self.part(node)
        if found is None:
            return self._apply("select", node, self._one(), self._minus_one())
        half = self._apply("add", self._half_jump(node), int(self.graph.constant(LEAST)))
        zero = int(self.graph.constant(0.0))
        above = self._apply("add", self._apply("maximum", found, zero), half)
        below = self._apply("sub", self._apply("minimum", found, zero), half)
        return self._apply("select", node, above, below)

    def _half_jump(self, node: int) -> int:
        """In proportion to all that a truth compares."""
        zero = int(self.graph.constant(0.0))
        name, operands = self.graph.operation(node)
        if name in SIDES:
            sizes = [self._apply("abs", n) for n in operands]
            size = self._without_nan(self._apply("add", *sizes), zero)
            return self._apply("mul", size, int(self.graph.constant(SHARE)))
        if name not in LOGIC or self.held(node):
            return zero
        total = zero
        for half in map(self._half_jump, operands):
            total = self._apply("add", total, half)
        return total

    def held(self, node: int) -> bool:
        """Whether a value changes at instants only."""
        if node not in self._held:
            name, operands = self.graph.operation(node)
            leaf = name in HELD or name in MOVING
            self._held[node] = name in HELD if leaf else all(map(self.held, operands))
        return self._held[node]

    def _comparison(self, name: str, a: int, b: int) -> int:
        return self._apply("sub", *((a, b) if SIDES[name][0] else (b, a)))

    def _is_finite(self, node: int) -> bool:
        name, operands = self.graph.operation(node)
        if node in self._finite or name in HELD or name in MOVING:
            return True
        return name in FINITE and all(map(self._is_finite, operands))

    def _both(self, name: str, a: int, b: int) -> int | None:
        """`and` is false where a held truth is false, `or` is true where it is true."""
        if self.held(b):
            a, b = b, a
        second = self.part(b)
        if second is None:
            return None
        if self.held(a):
            chosen = (second, self._minus_one()) if name == "logical_and" else (self._one(), second)
            return self._apply("select", a, *chosen)
        first = self.part(a)
        if first is None:
            return None
        return self._apply("minimum" if name == "logical_and" else "maximum", first, second)

    def _differ(self, name: str, a: int, b: int) -> int | None:
        """Two truths differ where one is true and the other is not."""
        first, second = self.part(a), self.part(b)
        if first is None or second is None:
            return None
        only_first = self._apply("minimum", first, self._apply("neg", second))
        only_second = self._apply("minimum", self._apply("neg", first), second)
        differ = self._apply("maximum", only_first, only_second)
        return differ if name == "ne" else self._apply("neg", differ)

    def stands_for_truth(self, node: int) -> bool:
        """Whether a number is 1 where a truth over the states is true, and 0 elsewhere."""
        return self.graph.value(node) is None and self._is_truth(node)

    def _is_truth(self, node: int) -> bool:
        number = self.graph.value(node)
        if number is not None:
            return number in (0.0, 1.0)
        name, operands = self.graph.operation(node)
        if name == "select":
            return all(map(self._is_truth, operands[1:]))
        return name in SIDES or name in LOGIC

    def _chosen(self, condition: int, a: int, b: int) -> int | None:
        yes, no = self.part(a), self.part(b)
        if yes is None or no is None:
            return None
        if self.held(condition):
            return self._apply("select", condition, yes, no)
        chooses = self.part(condition)
        if chooses is None:
            return None
        first = self._apply("minimum", chooses, yes)
        return self._apply(
            "maximum", first, self._apply("minimum", self._apply("neg", chooses), no)
        )

    def _apply(self, name: str, *operands: int) -> int:
        return int(self.graph.apply(name, *operands))

    def _one(self) -> int:
        return int(self.graph.constant(1.0))

    def _minus_one(self) -> int:
        return int(self.graph.constant(-1.0))


def residual(graph: Any, outputs: list[int]) -> Any | None:
    """The tape of the residuals of truths; None if one of them has none."""
    residuals = _Residuals(graph)
    nodes = [residuals.of(node) for node in outputs]
    return None if not nodes or None in nodes else graph.tape(nodes)


def stand_for_truths(graph: Any, outputs: list[int]) -> bool:
    """Whether all numbers are truths written as 0 and 1, such as np.where(x > 0.3, 1, 0)."""
    residuals = _Residuals(graph)
    return bool(outputs) and all(map(residuals.stands_for_truth, outputs))


def jump(graph: Any, outputs: list[int]) -> Any:
    """The tape of numbers that jump over zero where truths change, and vary as their residuals.

    A number is never zero, so its sign is that of the truth, also within rounding of its change.
    A truth without a residual is 1 or -1.
    """
    residuals = _Residuals(graph)
    return graph.tape([residuals.jump(node) for node in outputs])


def as_guard(outcome: Traced | Refused) -> Traced | Refused:
    """The function as a guard: a truth becomes its residual, also where it is written as 0 and 1.

    A truth that has no residual jumps: its function is called, and its value is 1 or -1.
    """
    if isinstance(outcome, Refused) or not (outcome.boolean or outcome.numbers_are_truths):
        return outcome
    if outcome.residual is None and not outcome.boolean:
        return outcome
    if outcome.residual is None:
        return Refused(
            "returns a truth that is not made of comparisons <, <=, >, >=, so it jumps; "
            "return a number that crosses zero, or declare a guard for each comparison",
            outcome.dependencies,
        )
    return replace(outcome, tape=outcome.residual, boolean=False)
