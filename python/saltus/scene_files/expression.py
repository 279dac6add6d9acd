"""An expression in text: parsed, checked, and turned into a tree that Python can compile.

Python's own parser reads it (`expression_text.py`), and every node has to be one of the few kinds
in the tables of `expression_tree.py`. The tree that is compiled is built anew, from templates and
checked numbers only. So a text can neither call nor reach anything but the functions of the
vocabulary.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass
from typing import Any

from saltus.scene_files.expression_text import ExpressionText
from saltus.scene_files.expression_tree import TreeBuilder
from saltus.scene_files.words import Scope
from saltus.scene_files.wrong import Path, Wrong, found

__all__ = ["Expression", "expression", "wrong_at"]


@dataclass(frozen=True)
class Expression:
    """A checked expression."""

    tree: ast.expr
    names: frozenset[str]
    """the names of its scope that the expression reads"""
    boolean: bool
    text: str = ""
    node: ast.expr | None = None
    """the tree of the text, in which names are those of the scope; None for a number"""


def expression(path: Path, text: Any, scope: Scope) -> Expression:
    """The expression of a text or a number. Raises Wrong, with the column, for a text that is no
    expression.
    """
    if isinstance(text, (int, float)) and not isinstance(text, bool):
        return Expression(ast.Constant(float(text)), frozenset(), False)
    if not isinstance(text, str):
        raise Wrong(path, f'expected an expression such as "-k * x / m", found {found(text)}')
    builder = TreeBuilder(path, text, scope)
    node = builder.parsed()
    tree, truth = builder.built(node, 0), builder.is_truth(node)
    return Expression(tree, frozenset(builder.names), truth, text, node)


def wrong_at(path: Path, made: Expression, node: ast.expr, message: str) -> Wrong:
    """A mistake in a part of an expression, with its column."""
    return ExpressionText(path, made.text).wrong(message, node)
