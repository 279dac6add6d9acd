"""The value of a checked expression, in real numbers: whatever has none is named with its column.

A parameter, a time or an option is a number as soon as a scene is read. An equation is computed
during the run; of it, the parts that are made of parameters alone are computed here too, so that a
mistake in them has a place in the file.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from saltus.scene_files.vocabulary import FUNCTIONS
from saltus.scene_files.wrong import Path, Wrong

__all__ = ["evaluated"]

OPERATIONS: dict[type[ast.AST], tuple[str, Callable[[Any, Any], Any]]] = {
    ast.Add: ("+", lambda a, b: a + b),
    ast.Sub: ("-", lambda a, b: a - b),
    ast.Mult: ("*", lambda a, b: a * b),
    ast.Div: ("/", lambda a, b: a / b),
    ast.Mod: ("%", lambda a, b: a % b),
    ast.Pow: ("**", lambda a, b: a**b),
}
COMPARISONS: dict[type[ast.AST], Callable[[Any, Any], Any]] = {
    ast.Lt: lambda a, b: a < b,
    ast.LtE: lambda a, b: a <= b,
    ast.Gt: lambda a, b: a > b,
    ast.GtE: lambda a, b: a >= b,
    ast.Eq: lambda a, b: a == b,
    ast.NotEq: lambda a, b: a != b,
}
NAMES = {function: name for name, (function, _) in FUNCTIONS.items()}
"""function of numpy -> its name in an expression"""
GROWING = {"exp", "expm1", "sinh", "cosh", "hypot"}
"""functions with a value at every number, which may be too large"""


def evaluated(
    path: Path, text: Any, tree: ast.expr, values: Mapping[str, Any], whole: bool = True
) -> Any:
    """The value of a tree of `expression`; None if it reads anything but these parameters.

    Only the branch that is chosen is computed: `log(k) if k > 0 else 0` has a value for each k.
    Wrong if an operation has no value in the real numbers, or one that is too large; of a tree that
    is not the whole of a number, an infinite value is left to the run.
    """
    with np.errstate(all="ignore"):
        return _Evaluation(path, text, values, whole).value(tree, None)


class _Evaluation:
    def __init__(self, path: Path, text: Any, values: Mapping[str, Any], whole: bool):
        self.path, self.text, self.values, self.whole = path, text, values, whole

    def value(self, node: ast.expr, at: int | None) -> Any:
        at = getattr(node, "at", at)
        if isinstance(node, ast.Constant):
            return node.value
        if isinstance(node, ast.List):
            entries = [self.value(entry, at) for entry in node.elts]
            return None if None in entries else entries
        if isinstance(node, ast.UnaryOp):
            inner = self.value(node.operand, at)
            return -inner if inner is not None and isinstance(node.op, ast.USub) else inner
        if isinstance(node, ast.BinOp):
            return self.operation(node, at)
        if isinstance(node, ast.Compare):
            left, right = self.value(node.left, at), self.value(node.comparators[0], at)
            known = left is not None and right is not None
            return COMPARISONS[type(node.ops[0])](left, right) if known else None
        if isinstance(node, ast.Call):
            return self.call(node, at)
        return self.name(node)

    def name(self, node: ast.expr) -> Any:
        """A parameter, or an entry of one."""
        if isinstance(node, ast.Attribute) and node.attr == "inf":
            return math.inf
        if not isinstance(node, ast.Subscript) or not isinstance(node.slice, ast.Constant):
            return None
        key = node.slice.value
        if isinstance(node.value, ast.Name):
            return _floats(self.values[key]) if node.value.id == "p" else None  # type: ignore[index]
        vector = self.name(node.value)
        return None if vector is None else vector[key]

    def operation(self, node: ast.BinOp, at: int | None) -> Any:
        left, right = self.value(node.left, at), self.value(node.right, at)
        if left is None or right is None:
            return None
        sign, compute = OPERATIONS[type(node.op)]
        result = compute(np.float64(left), right)
        pole = (sign in "/%" and right == 0) or (sign == "**" and left == 0)
        self.require(result, (left, right), at, f"{_operand(left)} {sign} {_operand(right)}", pole)
        return result

    def call(self, node: ast.Call, at: int | None) -> Any:
        assert isinstance(node.func, ast.Attribute)
        function = node.func.attr
        if function == "where":
            return self.choice(node.args, at)
        if function in ("logical_and", "logical_or"):
            return self.truth(node.args, function == "logical_and", at)
        arguments = [self.value(argument, at) for argument in node.args]
        if any(argument is None for argument in arguments):
            return None
        try:
            result = getattr(np, function)(*arguments)
        except ValueError as error:  # of np.interp
            raise self.wrong(f"{NAMES[function]}: {error}", at) from None
        if function in NAMES:
            shown = f"{NAMES[function]}({', '.join(map(_short, arguments))})"
            self.require(result, arguments, at, shown, NAMES[function] not in GROWING)
        return result

    def choice(self, arguments: list[ast.expr], at: int | None) -> Any:
        condition = self.value(arguments[0], at)
        if condition is None:
            return None
        return self.value(arguments[1 if condition else 2], at)

    def truth(self, arguments: list[ast.expr], both: bool, at: int | None) -> Any:
        left = self.value(arguments[0], at)
        if left is None or bool(left) != both:
            return left if left is None else not both
        right = self.value(arguments[1], at)
        return None if right is None else bool(right)

    def require(self, result: Any, operands: Any, at: int | None, shown: str, pole: bool) -> None:
        if math.isnan(result):
            raise self.wrong(f"expected a real number, but {shown} has no value", at)
        if math.isfinite(result) or any(map(math.isinf, _numbers(operands))):
            return
        if pole:
            raise self.wrong(f"expected a finite number, but {shown} has no value", at)
        if self.whole:
            raise self.wrong(
                f"expected a finite number, but {shown} is beyond 1.8e308, the largest number", at
            )

    def wrong(self, message: str, at: int | None) -> Wrong:
        text = str(self.text)
        short = text if len(text) <= 60 else f"{text[:57]}..."
        where = "" if at is None else f", column {at + 1}"
        return Wrong(self.path, f"'{short}'{where}: {message}", at)


def _numbers(operands: Any) -> list[float]:
    return [n for each in operands for n in (each if isinstance(each, list) else [each])]


def _short(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_short, value))}]"
    return f"{float(value):.6g}"


def _operand(value: Any) -> str:
    return f"({_short(value)})" if value < 0 else _short(value)


def _floats(value: Any) -> Any:
    return [_floats(entry) for entry in value] if isinstance(value, list) else float(value)
