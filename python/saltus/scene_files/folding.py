"""The value of an operation on numbers alone."""

from __future__ import annotations

import ast
import math

__all__ = ["folded"]


def folded(node: ast.expr) -> float | None:
    """The value of a tree, in floats, so that 9**9**9 takes no time; None if it reads a name."""
    if isinstance(node, ast.Constant):
        return float(node.value)  # type: ignore[arg-type]
    if isinstance(node, ast.UnaryOp):
        inner = folded(node.operand)
        return -inner if inner is not None and isinstance(node.op, ast.USub) else inner
    if not isinstance(node, ast.BinOp):
        return None
    left, right = folded(node.left), folded(node.right)
    if left is None or right is None:
        return None
    try:
        return _arithmetic(node.op, left, right)
    except (ArithmeticError, ValueError):
        return math.nan


def _arithmetic(op: ast.operator, a: float, b: float) -> float:
    if isinstance(op, ast.Pow):
        return math.pow(a, b)
    if isinstance(op, ast.Mod):
        return a % b
    if isinstance(op, ast.Div):
        return a / b
    return a * b if isinstance(op, ast.Mult) else a + b if isinstance(op, ast.Add) else a - b
