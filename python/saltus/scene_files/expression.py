"""An expression in text: parsed, checked, and turned into a tree that Python can compile.

Python's own parser reads it, and every node has to be one of the few kinds in the tables here. The
tree that is compiled is built anew, from templates and checked numbers only. So a text can neither
call nor reach anything but the functions of the vocabulary.
"""

from __future__ import annotations

import ast
import functools
import itertools
import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from saltus._core import known_names
from saltus.scene_files.folding import folded
from saltus.scene_files.vocabulary import CONSTANTS, FUNCTIONS
from saltus.scene_files.wrong import Path, Wrong, found

__all__ = ["ANY", "EITHER", "Expression", "Word", "expression", "template", "wrong_at"]

MOST_CHARACTERS = 10_000
MOST_LEVELS = 150
ANY, EITHER = -1, -2
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


@dataclass(frozen=True)
class Word:
    """A name in an expression, and the Python text that replaces it."""

    code: str
    size: int | None = None
    """None: a number; n: a vector of n, of which an entry is taken; ANY: a vector of any length;
    EITHER: a number or a vector of any length
    """
    truth: bool = False
    """whether it is true or false"""
    choice_of: str | None = None
    """the word whose value it names: 'mode' for the name of a mode, which is no number"""


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


Scope = Mapping[str, Word]


def expression(path: Path, text: Any, scope: Scope) -> Expression:
    """The expression of a text or a number. Raises Wrong, with the column, for a text that is no
    expression.
    """
    if isinstance(text, (int, float)) and not isinstance(text, bool):
        return Expression(ast.Constant(float(text)), frozenset(), False)
    if not isinstance(text, str):
        raise Wrong(path, f'expected an expression such as "-k * x / m", found {found(text)}')
    builder = _Builder(path, text, scope)
    node = builder.parsed()
    tree, truth = builder.built(node, 0), builder.is_truth(node)
    return Expression(tree, frozenset(builder.names), truth, text, node)


def wrong_at(path: Path, made: Expression, node: ast.expr, message: str) -> Wrong:
    """A mistake in a part of an expression, with its column."""
    return _Builder(path, made.text, {}).wrong(message, node)


@functools.lru_cache(maxsize=4096)
def template(code: str) -> ast.expr:
    """The tree of a text that is part of this package."""
    return ast.parse(code, mode="eval").body


class _Builder:
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

    def wrong(self, message: str, node: Any = None) -> Wrong:
        if getattr(node, "col_offset", None) is None:
            return Wrong(self.path, f"'{self.short()}': {message}")
        at = self.place(node)
        return Wrong(self.path, f"'{self.short()}', column {at + 1}: {message}", at)

    def place(self, node: Any) -> int:
        """The position of a node in the text; Python's parser counts bytes, not characters."""
        return len(self.encoded[: node.col_offset].decode(errors="replace")) + self.lead()

    @functools.cached_property
    def encoded(self) -> bytes:
        return self.line().encode()

    def short(self) -> str:
        return self.text if len(self.text) <= 60 else f"{self.text[:57]}..."

    def line(self) -> str:
        """The text in one line, from its first word on."""
        return self.text.replace("\n", " ").replace("\t", " ").lstrip()

    def lead(self) -> int:
        return len(self.text) - len(self.text.replace("\n", " ").replace("\t", " ").lstrip())

    def parsed(self) -> ast.expr:
        if len(self.text) > MOST_CHARACTERS:
            raise Wrong(
                self.path,
                f"expected an expression of at most {MOST_CHARACTERS} characters, found "
                f"{len(self.text)}; split it into parameters or outputs",
            )
        if "#" in self.text:
            at = self.text.index("#")
            raise Wrong(
                self.path,
                f"'{self.short()}', column {at + 1}: '#' begins a comment in TOML, and is no part "
                "of an expression; write the comment outside of the text",
                at,
            )
        if not self.text.strip():
            raise Wrong(self.path, "expected an expression such as '-k * x / m', found no text")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                return ast.parse(self.line(), "<scene>", mode="eval").body
        except SyntaxError as error:
            at = min(max(0, (error.offset or 1) - 1) + self.lead(), len(self.text))
            raise Wrong(
                self.path,
                f"'{self.short()}', column {at + 1}: no expression: {error.msg}; expected "
                "one such as '-k * x / m'",
                at,
            ) from None
        except (RecursionError, MemoryError):
            raise self.too_deep() from None
        except ValueError as error:  # such as a character of code 0, or a number of 5000 digits
            raise self.wrong(f"no expression: {error}") from None

    def too_deep(self, node: Any = None) -> Wrong:
        return self.wrong(
            f"nested too deeply; expected at most {MOST_LEVELS} levels; name a part of it", node
        )

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
        return ast.BinOp(_numpy("positive", left), node.op, right)

    def as_number(self, node: ast.expr, level: int) -> ast.expr:
        """1 for a truth: numpy adds truths by "or"."""
        inner = self.built(node, level)
        known = self.scope.get(node.id) if isinstance(node, ast.Name) else None
        if not self.is_truth(node) and not (known is not None and known.truth):
            return inner
        return _numpy("where", inner, ast.Constant(1.0), ast.Constant(0.0))

    def is_number(self, made: ast.expr, node: ast.AST) -> bool:
        """Whether it is an operation on two numbers. Wrong if it has no finite result, as 1 / 0."""
        value = folded(made)
        if value is not None and not math.isfinite(value):
            raise self.wrong("expected a finite number", node)
        return value is not None

    def sign(self, node: ast.UnaryOp, level: int) -> ast.expr:
        if isinstance(node.op, ast.Not):
            return _numpy("logical_not", self.built(node.operand, level))
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
        return functools.reduce(lambda a, b: _numpy("logical_and", a, b), found)

    def side(self, node: ast.Compare, i: int, level: int) -> ast.expr:
        """A side of a comparison; the only place where the name of a mode stands for its number."""
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
        return functools.reduce(lambda a, b: _numpy(TRUTHS[type(node.op)], a, b), parts)

    def choice(self, node: ast.IfExp, level: int) -> ast.expr:
        parts = (node.test, node.body, node.orelse)
        return _numpy("where", *(self.built(part, level) for part in parts))

    def call(self, node: ast.Call, level: int) -> ast.expr:
        name = node.func.id if isinstance(node.func, ast.Name) else None
        if name not in FUNCTIONS:
            shown = f"function '{name}'" if name else "call"
            known = known_names(name or "", sorted(FUNCTIONS))
            raise self.wrong(f"unknown {shown}{known}", node.func)
        function, count = FUNCTIONS[name]
        self.require_arguments(node, name, count)
        if name == "interp":
            table = [self.vector(argument, level) for argument in node.args[1:]]
            self.require_table(node, table[0], table[1])
            return _numpy(function, self.built(node.args[0], level), *table)
        self.require_few(node, node.args)
        made = [self.built(argument, level) for argument in node.args]
        if count is None:
            return functools.reduce(lambda a, b: _numpy(function, a, b), made)
        return _numpy(function, *made)

    def require_few(self, node: ast.expr, parts: Sequence[ast.expr]) -> None:
        """Each part is a level of the tree that is built."""
        if len(parts) > MOST_LEVELS:
            raise self.wrong(f"expected at most {MOST_LEVELS} parts, found {len(parts)}", node)

    def require_arguments(self, node: ast.Call, name: str, count: int | None) -> None:
        given = len(node.args)
        if node.keywords:
            raise self.wrong(
                f"'{node.keywords[0].arg}=': arguments of {name} have no names here", node
            )
        if given != count if count is not None else given < 2:
            wanted = "two or more" if count is None else str(count)
            more = "" if count == 1 else "s"
            raise self.wrong(f"expected {wanted} argument{more} of {name}, found {given}", node)

    def require_table(self, node: ast.expr, x: ast.expr, y: ast.expr) -> None:
        """Wrong for lists of points of different lengths, or that do not increase."""
        if not isinstance(x, ast.List) or not isinstance(y, ast.List):
            return
        if len(x.elts) != len(y.elts) or not x.elts:
            raise self.wrong(
                f"expected as many points as values, found {len(x.elts)} and {len(y.elts)}", node
            )
        points = [folded(each) for each in x.elts]
        known = [each for each in points if each is not None]
        if any(one >= other for one, other in itertools.pairwise(known)):
            raise self.wrong("expected points of interp that increase", node)

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


def _numpy(function: str, *arguments: ast.expr) -> ast.expr:
    return ast.Call(template(f"np.{function}"), list(arguments), [])
