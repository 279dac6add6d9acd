"""Algebraic rules: which numbers they determine, and these as formulas of the others."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from saltus.errors import ModelError
from saltus.sbml.kinds import assigned_by_events
from saltus.sbml.quantities import Declared
from saltus.sbml.walk import VARIABLES, Walk

__all__ = ["names_in", "solved", "unknowns"]


def unknowns(declared: Declared) -> list[str]:
    """An unknown for each algebraic rule, by its position: an id in the rule that is not constant,
    and that neither a rule nor a reaction determines; of several, one that no event assigns, then
    one without a value, then the first by its name. ModelError for a rule without one.
    """
    free = {
        name
        for name, found in declared.quantities.items()
        if not found.constant and name not in declared.assigned and name not in declared.rates
    } - declared.reacted()
    late = assigned_by_events(declared)

    def rank(name: str) -> tuple[bool, bool, str]:
        return name in late, not declared.is_unset(name), name

    choices = [sorted(_read(rule.getMath(), declared) & free, key=rank)
               for rule in declared.algebraic]  # fmt: skip
    owner: dict[str, int] = {}
    for i in range(len(choices)):
        if not _matched(i, choices, owner, set()):
            raise ModelError(
                f"algebraic rule {i + 1}: no number is left that it could determine; expected an "
                "id in it that is not constant and that no rule, reaction or other algebraic rule "
                "determines"
            )
    return sorted(owner, key=lambda name: owner[name])


def _matched(i: int, choices: list[list[str]], owner: dict[str, int], seen: set[str]) -> bool:
    """Finds an unknown for rule i, where needed by another one for a rule before it."""
    for name in choices[i]:
        if name in seen:
            continue
        seen.add(name)
        if name not in owner or _matched(owner[name], choices, owner, seen):
            owner[name] = i
            return True
    return False


def _read(tree: Any, declared: Declared) -> set[str]:
    """The ids that a formula reads, also through assignment rules and reactions."""
    found: set[str] = set()
    waiting = [tree]
    while waiting:
        for name in names_in(waiting.pop()):
            if name in found:
                continue
            found.add(name)
            if name in declared.assigned:
                waiting.append(declared.assigned[name])
            elif name in declared.reactions and declared.reactions[name].law is not None:
                waiting.append(declared.reactions[name].law)
    return found


def names_in(tree: Any) -> Iterator[str]:
    """The ids in a formula."""
    if tree.isName():
        yield tree.getName()
    for i in range(tree.getNumChildren()):
        yield from names_in(tree.getChild(i))


def solved(graph: Any, zeros: list[int], count: int, names: list[str]) -> list[int]:
    """The inputs (0, k), k < count, for which the nodes `zeros`, linear in them, are zero.

    By elimination; a pivot is a number that is not zero where there is one, for a formula may be
    zero at some time.
    """
    rows = []
    linear = _Linear(graph, count)
    for i, zero in enumerate(zeros):
        try:
            rows.append(linear.of(zero))
        except _NotLinear as reason:
            raise ModelError(
                f"algebraic rule {i + 1}: it is not linear in {', '.join(names)} ({reason}), "
                "which is not supported; solve it for one id, as an assignment rule"
            ) from None
    return _eliminated(graph, rows, count, names)


Row = tuple[dict[int, int], int]
"""coefficients of the unknowns, and the rest, as nodes"""


class _NotLinear(Exception):
    pass


class _Linear(Walk[Row]):
    """Nodes as linear functions of the unknowns."""

    def __init__(self, graph: Any, count: int):
        super().__init__(graph)
        self.done = {int(graph.input(0, k)): ({k: self.one}, self.zero) for k in range(count)}

    @property
    def zero(self) -> int:
        return int(self.graph.constant(0.0))

    @property
    def one(self) -> int:
        return int(self.graph.constant(1.0))

    def made(self, node: int) -> Row:
        if self.graph.value(node) is not None:
            return {}, node
        op, operands = self.graph.operation(node)
        if op in VARIABLES:
            return {}, node
        parts = [self.of(one) for one in operands]
        if not any(row for row, _ in parts):
            return {}, node
        if op in ("add", "sub"):
            return self.combined(op, *parts)
        if op == "neg":
            return self.each(parts[0], lambda a: self.graph.apply("neg", a))
        if op == "mul" and not (parts[0][0] and parts[1][0]):
            k = 1 if parts[1][0] else 0
            return self.each(parts[k], lambda a: self.graph.apply("mul", a, operands[1 - k]))
        if op == "div" and not parts[1][0]:
            return self.each(parts[0], lambda a: self.graph.apply("div", a, operands[1]))
        if op == "pow" and self.graph.value(operands[1]) == 1.0:
            return parts[0]
        raise _NotLinear(op)

    def combined(self, op: str, a: Row, b: Row) -> Row:
        row = {
            k: int(self.graph.apply(op, a[0].get(k, self.zero), b[0].get(k, self.zero)))
            for k in a[0].keys() | b[0].keys()
        }
        return row, int(self.graph.apply(op, a[1], b[1]))

    def each(self, a: Row, change: Any) -> Row:
        return {k: int(change(one)) for k, one in a[0].items()}, int(change(a[1]))


def _eliminated(graph: Any, rows: list[Row], count: int, names: list[str]) -> list[int]:
    def apply(op: str, a: int, b: int) -> int:
        return int(graph.apply(op, a, b))

    def rank(node: int) -> int:
        """2 for no coefficient, 1 for a formula, 0 for a number."""
        value = graph.value(node)
        return 1 if value is None else 2 if value == 0.0 else 0

    zero = int(graph.constant(0.0))
    table = [[row.get(k, zero) for k in range(count)] + [rest] for row, rest in rows]
    for k in range(count):
        best = min(range(k, count), key=lambda i: (rank(table[i][k]), i))
        if rank(table[best][k]) == 2:
            raise ModelError(f"the algebraic rules do not determine '{names[k]}'")
        table[k], table[best] = table[best], table[k]
        table[k] = [apply("div", one, table[k][k]) for one in table[k]]
        for i in range(count):
            factor = table[i][k]
            if i != k and rank(factor) != 2:
                table[i] = [
                    apply("sub", one, apply("mul", factor, other))
                    for one, other in zip(table[i], table[k], strict=True)
                ]
    return [int(graph.apply("neg", row[count])) for row in table]
