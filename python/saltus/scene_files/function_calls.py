"""Calls in an expression: of a function of the vocabulary, with as many arguments as it takes."""

from __future__ import annotations

import ast
import itertools

from saltus._core import known_names
from saltus.scene_files.expression_text import ExpressionText
from saltus.scene_files.folding import folded
from saltus.scene_files.vocabulary import FUNCTIONS

__all__ = ["called", "require_table"]


def called(text: ExpressionText, node: ast.Call) -> tuple[str, str, int | None]:
    """The name of a function, that in NumPy, and the number of its arguments; None for two or
    more. Wrong for an unknown function, or another number.
    """
    name = node.func.id if isinstance(node.func, ast.Name) else None
    if name not in FUNCTIONS:
        shown = f"function '{name}'" if name else "call"
        known = known_names(name or "", sorted(FUNCTIONS))
        raise text.wrong(f"unknown {shown}{known}", node.func)
    function, count = FUNCTIONS[name]
    _require_arguments(text, node, name, count)
    return name, function, count


def _require_arguments(text: ExpressionText, node: ast.Call, name: str, count: int | None) -> None:
    given = len(node.args)
    if node.keywords:
        raise text.wrong(f"'{node.keywords[0].arg}=': arguments of {name} have no names here", node)
    if given != count if count is not None else given < 2:
        wanted = "two or more" if count is None else str(count)
        more = "" if count == 1 else "s"
        raise text.wrong(f"expected {wanted} argument{more} of {name}, found {given}", node)


def require_table(text: ExpressionText, node: ast.expr, x: ast.expr, y: ast.expr) -> None:
    """Wrong for lists of points of different lengths, or that do not increase."""
    if not isinstance(x, ast.List) or not isinstance(y, ast.List):
        return
    if len(x.elts) != len(y.elts) or not x.elts:
        raise text.wrong(
            f"expected as many points as values, found {len(x.elts)} and {len(y.elts)}", node
        )
    points = [folded(each) for each in x.elts]
    known = [each for each in points if each is not None]
    if any(one >= other for one, other in itertools.pairwise(known)):
        raise text.wrong("expected points of interp that increase", node)
