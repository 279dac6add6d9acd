"""What moves between events: its equality with anything is true for moments that no guard sees.

The motion of a value is a set of causes: `ALWAYS` for what follows the time or a continuous state,
and the names of the inputs that it follows. Of `floor(x)`, of a truth, and of a function with flat
parts, such as `max`, the set is empty: they can be equal to a number for a while.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import reduce

from saltus.scene_files.expression import Expression, wrong_at
from saltus.scene_files.wrong import Path, Wrong

__all__ = ["ALWAYS", "NEVER", "Doubt", "Motions", "doubts_of", "motion_of", "require_a_change"]

ALWAYS = frozenset({"*"})
NEVER: frozenset[str] = frozenset()
FLAT = {"floor", "ceil", "round", "sign", "max", "min", "clip", "interp"}
"""functions that are constant on whole intervals of their arguments"""

Motions = Mapping[str, frozenset[str]]
"""the motion of each name; a name that is not there is held between events"""


@dataclass(frozen=True)
class Doubt:
    """An equality in a guard, and the motion of what it compares."""

    path: Path
    made: Expression
    node: ast.Compare
    causes: frozenset[str]

    def refusal(self) -> Wrong:
        left = ast.unparse(self.node.left)
        right = ast.unparse(self.node.comparators[0])
        difference = left if right in ("0", "0.0") else f"{left} - {_factor(right)}"
        instead = f"'{left} <= {right}' or '{left} >= {right}'"
        if self.path[-3] == "guards":
            instead = f"'{difference}' with a direction, or {instead}"
        return wrong_at(
            self.path,
            self.made,
            self.node,
            f"'{ast.unparse(self.node)}' changes for a single moment, which no step meets, so that "
            f"it never fires; write {instead}",
        )


def _factor(text: str) -> str:
    return text if text.replace("_", "").replace(".", "").isalnum() else f"({text})"


def motion_of(node: ast.expr, motions: Motions) -> frozenset[str]:
    """The causes that move the value of an expression; fewer rather than more."""
    if isinstance(node, ast.Name):
        return motions.get(node.id, NEVER)
    if isinstance(node, ast.Subscript):
        return motion_of(node.value, motions)
    if isinstance(node, ast.BinOp):
        return motion_of(node.left, motions) | motion_of(node.right, motions)
    if isinstance(node, ast.UnaryOp):
        return NEVER if isinstance(node.op, ast.Not) else motion_of(node.operand, motions)
    if isinstance(node, ast.IfExp):
        return motion_of(node.body, motions) & motion_of(node.orelse, motions)
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name):
        return NEVER
    parts = [motion_of(argument, motions) for argument in node.args]
    if node.func.id == "where":
        return parts[1] & parts[2]
    return NEVER if node.func.id in FLAT else reduce(frozenset.union, parts, NEVER)


def doubts_of(
    path: Path, made: Expression, motions: Motions, variables: Mapping[str, Expression]
) -> list[Doubt]:
    """The equalities on whose truth a guard depends, with what moves them; one that always moves is
    Wrong. A condition inside of a value, as in `x / y if y != 0 else 0`, is none of them.
    """
    doubts = [
        Doubt(path, made, node, _sides(node, motions))
        for node in _equalities(made.node, motions, variables)
    ]
    for doubt in doubts:
        if "*" in doubt.causes:
            raise doubt.refusal()
    return [doubt for doubt in doubts if doubt.causes]


def _sides(node: ast.Compare, motions: Motions) -> frozenset[str]:
    return motion_of(node.left, motions) | motion_of(node.comparators[0], motions)


def _equalities(
    node: ast.expr | None, motions: Motions, variables: Mapping[str, Expression]
) -> Iterator[ast.Compare]:
    """The comparisons by == and != in the structure of a truth, or of a value of two constants."""
    if isinstance(node, ast.Compare):
        sides = [node.left, *node.comparators]
        for op, left, right in zip(node.ops, sides[:-1], sides[1:], strict=True):
            if isinstance(op, (ast.Eq, ast.NotEq)):
                yield ast.copy_location(ast.Compare(left, [op], [right]), node)
        return
    parts: list[ast.expr] = []
    if isinstance(node, ast.BoolOp):
        parts = node.values
    elif isinstance(node, ast.UnaryOp):
        parts = [node.operand]
    elif isinstance(node, ast.BinOp):
        parts = [node.left, node.right] if not motion_of(node, motions) else []
    elif isinstance(node, ast.IfExp):
        parts = _of_choice(node.test, node.body, node.orelse, motions)
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "where":
        parts = _of_choice(node.args[0], node.args[1], node.args[2], motions)
    elif isinstance(node, ast.Name) and node.id in variables:
        parts = [each] if (each := variables[node.id].node) is not None else []
    for part in parts:
        yield from _equalities(part, motions, variables)


def _of_choice(test: ast.expr, yes: ast.expr, no: ast.expr, motions: Motions) -> list[ast.expr]:
    """The parts of a choice that decide on its truth."""
    moves = motion_of(yes, motions) | motion_of(no, motions)
    return [yes, no] if moves else [test, yes, no]


def require_a_change(path: Path, made: Expression, changing: frozenset[str]) -> None:
    """Wrong for a guard that reads nothing that changes during a run."""
    if made.names & changing:
        return
    read = ", ".join(f"'{name}'" for name in sorted(made.names))
    what = f"it reads parameters alone ({read})" if read else "it is a constant"
    raise Wrong(
        path,
        f"expected an expression of a state, an input or the time, such as 'y - 1'; {what}, so "
        "that it passes no zero and never fires",
    )
