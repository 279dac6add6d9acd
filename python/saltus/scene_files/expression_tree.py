"""The tree that is compiled in place of an expression: built anew, node by node, from templates and
checked numbers.
"""

from __future__ import annotations

import ast
import functools
import math
from collections.abc import Callable
from typing import Any

from saltus._core import known_names
from saltus.scene_files.expression_text import MOST_LEVELS, ExpressionText
from saltus.scene_files.folding import folded
from saltus.scene_files.function_calls import called, require_table
from saltus.scene_files.vocabulary import CONSTANTS, FUNCTIONS
from saltus.scene_files.words import EITHER, Scope, Word, numpy_call, template
from saltus.scene_files.wrong import Path, Wrong, found

__all__ = ["TreeBuilder"]

OPERATORS = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.Mod, ast.Pow)
PARTIAL = (ast.Div, ast.Mod, ast.Pow)
"""operators that have no real value for some numbers"""
COMPARISONS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Eq, ast.NotEq)
TRUTHS = {ast.And: "logical_and", ast.Or: "logical_or"}
HINTS: dict[type[ast.AST], str] = {
    ast.BitXor: "'^' is no operator; a power is written '**'",
    ast.BitAnd: "'&' is no operator; write 'and'",
    ast.BitOr: "'|' is no operator; write 'or'",
    ast.FloorDiv: "'//' is no operator; write floor(a / b)",
    ast.Attribute: "a name has no '.'; lead a signal of another block to an input",
    ast.Lambda: "'lambda' is reserved; choose another name",
}


class TreeBuilder(ExpressionText):
    """Builds the tree of a text with the names of a scope, and notes which of them it reads."""

    def __init__(self, path: Path, text: str, scope: Scope):
        self.path, self.text, self.scope = path, text, scope
        self.names: set[str] = set()
        self.kinds: dict[type[ast.AST], Callable[[Any, int], ast.expr]] = {
            ast.BinOp: self.operation,
            ast.UnaryOp: self.sign,
            ast.Compare: self.comparison,
            ast.BoolOp: self.truth,
            ast.IfExp: self.choice,
            ast.Call: self.call,
            ast.Name: self.name,
            ast.Subscript: self.entry,
            ast.Constant: self.number,
        }

    def built(self, node: ast.expr, level: int) -> ast.expr:
        build = self.kinds.get(type(node))
        if build is None:
            raise self.refused(node, type(node))
        if level > MOST_LEVELS:
            raise self.too_deep(node)
        made = build(node, level + 1)
        if isinstance(made, (ast.BinOp, ast.Call)):
            made.at = self.place(node)  # type: ignore[union-attr]
        return made

    def refused(self, node: ast.AST, kind: type[ast.AST]) -> Wrong:
        hint = HINTS.get(kind, "expected numbers, names, + - * / % **, comparisons, and functions")
        return self.wrong(hint, node)

    def operation(self, node: ast.BinOp, level: int) -> ast.expr:
        if not isinstance(node.op, OPERATORS):
            raise self.refused(node, type(node.op))
        left, right = self.as_number(node.left, level), self.as_number(node.right, level)
        made = ast.BinOp(left, node.op, right)
        if self.is_number(made, node) or not isinstance(node.op, PARTIAL):
            return made
        # Of numbers of Python a power may be complex, and a division by zero an exception; those of
        # NumPy stay real, and the engine reports what is not finite.
        return ast.BinOp(numpy_call("positive", left), node.op, right)

    def as_number(self, node: ast.expr, level: int) -> ast.expr:
        """1 for a truth: numpy adds truths by "or"."""
        inner = self.built(node, level)
        known = self.scope.get(node.id) if isinstance(node, ast.Name) else None
        if not self.is_truth(node) and not (known is not None and known.truth):
            return inner
        return numpy_call("where", inner, ast.Constant(1.0), ast.Constant(0.0))

    def is_number(self, made: ast.expr, node: ast.AST) -> bool:
        """Whether it is an operation on two numbers. Wrong if it has no finite result, as 1 / 0."""
        value = folded(made)
        if value is not None and not math.isfinite(value):
            raise self.wrong("expected a finite number", node)
        return value is not None

    def sign(self, node: ast.UnaryOp, level: int) -> ast.expr:
        if isinstance(node.op, ast.Not):
            return numpy_call("logical_not", self.built(node.operand, level))
        if not isinstance(node.op, (ast.USub, ast.UAdd)):
            raise self.refused(node, type(node.op))
        return ast.UnaryOp(node.op, self.as_number(node.operand, level))

    def comparison(self, node: ast.Compare, level: int) -> ast.expr:
        """a < b < c is a < b and b < c."""
        self.require_few(node, node.comparators)
        sides = [self.side(node, i, level) for i in range(len(node.comparators) + 1)]
        found: list[ast.expr] = []
        for op, left, right in zip(node.ops, sides[:-1], sides[1:], strict=True):
            if not isinstance(op, COMPARISONS):
                raise self.refused(node, type(op))
            found.append(ast.Compare(left, [op], [right]))
        return functools.reduce(lambda a, b: numpy_call("logical_and", a, b), found)

    def side(self, node: ast.Compare, i: int, level: int) -> ast.expr:
        """A side of a comparison. Only here the name of a mode means its number."""
        sides = [node.left, *node.comparators]
        side = sides[i]
        word = self.scope.get(side.id) if isinstance(side, ast.Name) else None
        before = [(node.ops[i - 1], sides[i - 1])] if i > 0 else []
        beside = [*before, *zip(node.ops[i : i + 1], sides[i + 1 :], strict=False)]
        if word is None or not all(_names_choice(word, op, other) for op, other in beside):
            return self.built(side, level)
        assert isinstance(side, ast.Name)
        self.names.add(side.id)
        return template(word.code)

    def truth(self, node: ast.BoolOp, level: int) -> ast.expr:
        self.require_few(node, node.values)
        parts = [self.built(part, level) for part in node.values]
        return functools.reduce(lambda a, b: numpy_call(TRUTHS[type(node.op)], a, b), parts)

    def choice(self, node: ast.IfExp, level: int) -> ast.expr:
        parts = (node.test, node.body, node.orelse)
        return numpy_call("where", *(self.built(part, level) for part in parts))

    def call(self, node: ast.Call, level: int) -> ast.expr:
        name, function, count = called(self, node)
        if name == "interp":
            table = [self.vector(argument, level) for argument in node.args[1:]]
            require_table(self, node, table[0], table[1])
            return numpy_call(function, self.built(node.args[0], level), *table)
        self.require_few(node, node.args)
        made = [self.built(argument, level) for argument in node.args]
        if count is None:
            return functools.reduce(lambda a, b: numpy_call(function, a, b), made)
        return numpy_call(function, *made)

    def vector(self, node: ast.expr, level: int) -> ast.expr:
        """A whole vector, which only interp takes: the name of a vector, or a list of numbers."""
        if isinstance(node, ast.List):
            return ast.List([self.built(entry, level) for entry in node.elts], ast.Load())
        word = self.scope.get(node.id) if isinstance(node, ast.Name) else None
        if word is None or word.size is None:
            raise self.wrong("expected a vector, such as a parameter or [0, 1, 2]", node)
        assert isinstance(node, ast.Name)
        self.names.add(node.id)
        return template(word.code)

    def name(self, node: ast.Name, level: int) -> ast.expr:
        if node.id in CONSTANTS and node.id not in self.scope:
            return template("np.inf") if node.id == "inf" else ast.Constant(CONSTANTS[node.id])
        word = self.word(node)
        if word.size is not None and word.size != EITHER:
            raise self.wrong(f"'{node.id}' is a vector; write {node.id}[0]", node)
        if word.choice_of is not None:
            what = word.choice_of
            raise self.wrong(
                f"'{node.id}' is the name of a {what} and no value; write {what} == {node.id}", node
            )
        return template(word.code)

    def word(self, node: ast.Name) -> Word:
        if node.id not in self.scope:
            if node.id in FUNCTIONS:
                raise self.wrong(f"'{node.id}' is a function; write {node.id}(...)", node)
            known = known_names(node.id, sorted(self.scope)) if self.scope else "; no name is known"
            raise self.wrong(f"unknown name '{node.id}'{known}", node)
        self.names.add(node.id)
        return self.scope[node.id]

    def entry(self, node: ast.Subscript, level: int) -> ast.expr:
        if not isinstance(node.value, ast.Name):
            raise self.wrong("expected an entry of a vector by its name, such as u[0]", node)
        word, index = self.word(node.value), node.slice
        if word.size is None:
            raise self.wrong(f"'{node.value.id}' is a number and has no entries", node)
        value = index.value if isinstance(index, ast.Constant) else None
        if type(value) is not int or (word.size >= 0 and value >= word.size):
            most = f", 0 to {word.size - 1}" if word.size > 0 else ""
            raise self.wrong(f"expected the position of an entry{most}, as in u[0]", index)
        return ast.Subscript(template(word.code), ast.Constant(value), ast.Load())

    def number(self, node: ast.Constant, level: int) -> ast.expr:
        if type(node.value) not in (int, float):
            raise self.wrong(f"expected a number or a name, found {found(node.value)}", node)
        try:
            size = float(node.value)  # type: ignore[arg-type]
        except OverflowError:
            size = math.inf
        if not math.isfinite(size):
            raise self.wrong("expected a finite number", node)
        return ast.Constant(size)

    def is_truth(self, node: ast.expr) -> bool:
        negation = isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not)
        return negation or isinstance(node, (ast.Compare, ast.BoolOp))


def _names_choice(word: Word, op: ast.cmpop, other: ast.expr) -> bool:
    """Whether a comparison is `mode == heating`, of the name of a mode with the mode."""
    equality = isinstance(op, (ast.Eq, ast.NotEq))
    return equality and isinstance(other, ast.Name) and other.id == word.choice_of
