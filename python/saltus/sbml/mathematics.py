"""Mathematics of SBML as nodes of an expression graph."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, Protocol

import libsbml as s

from saltus.errors import ModelError

__all__ = ["Meaning", "node_of"]

AVOGADRO = 6.02214179e23  # the value that SBML level 3 prescribes
LARGEST_FACTORIAL = 170


class Meaning(Protocol):
    """The meaning of the words in a formula."""

    graph: Any
    functions: Mapping[str, Any]

    def value(self, name: str) -> int: ...
    def rate(self, name: str) -> int: ...
    def time(self) -> int: ...
    def comparison(self, op: str, a: int, b: int) -> int: ...


UNARY = {
    s.AST_FUNCTION_ABS: "abs",
    s.AST_FUNCTION_ARCCOS: "acos",
    s.AST_FUNCTION_ARCCOSH: "acosh",
    s.AST_FUNCTION_ARCSIN: "asin",
    s.AST_FUNCTION_ARCSINH: "asinh",
    s.AST_FUNCTION_ARCTAN: "atan",
    s.AST_FUNCTION_ARCTANH: "atanh",
    s.AST_FUNCTION_CEILING: "ceil",
    s.AST_FUNCTION_COS: "cos",
    s.AST_FUNCTION_COSH: "cosh",
    s.AST_FUNCTION_EXP: "exp",
    s.AST_FUNCTION_FLOOR: "floor",
    s.AST_FUNCTION_LN: "log",
    s.AST_FUNCTION_SIN: "sin",
    s.AST_FUNCTION_SINH: "sinh",
    s.AST_FUNCTION_TAN: "tan",
    s.AST_FUNCTION_TANH: "tanh",
    s.AST_LOGICAL_NOT: "logical_not",
}
RECIPROCAL = {
    s.AST_FUNCTION_COT: "tan",
    s.AST_FUNCTION_COTH: "tanh",
    s.AST_FUNCTION_CSC: "sin",
    s.AST_FUNCTION_CSCH: "sinh",
    s.AST_FUNCTION_SEC: "cos",
    s.AST_FUNCTION_SECH: "cosh",
}
"""1 / f(x)"""
OF_RECIPROCAL = {
    s.AST_FUNCTION_ARCCOT: "atan",
    s.AST_FUNCTION_ARCCOTH: "atanh",
    s.AST_FUNCTION_ARCCSC: "asin",
    s.AST_FUNCTION_ARCCSCH: "asinh",
    s.AST_FUNCTION_ARCSEC: "acos",
    s.AST_FUNCTION_ARCSECH: "acosh",
}
"""f(1 / x)"""
MANY = {
    s.AST_PLUS: ("add", 0.0),
    s.AST_TIMES: ("mul", 1.0),
    s.AST_LOGICAL_AND: ("logical_and", 1.0),
    s.AST_LOGICAL_OR: ("logical_or", 0.0),
    s.AST_FUNCTION_MAX: ("maximum", math.nan),
    s.AST_FUNCTION_MIN: ("minimum", math.nan),
}
"""(operation, value of none)"""
COMPARISONS = {
    s.AST_RELATIONAL_EQ: "eq",
    s.AST_RELATIONAL_GEQ: "ge",
    s.AST_RELATIONAL_GT: "gt",
    s.AST_RELATIONAL_LEQ: "le",
    s.AST_RELATIONAL_LT: "lt",
    s.AST_RELATIONAL_NEQ: "ne",
}
CONSTANTS = {
    s.AST_CONSTANT_E: math.e,
    s.AST_CONSTANT_PI: math.pi,
    s.AST_CONSTANT_TRUE: 1.0,
    s.AST_CONSTANT_FALSE: 0.0,
    s.AST_NAME_AVOGADRO: AVOGADRO,
}


def node_of(meaning: Meaning, tree: Any, local: Mapping[str, int] | None = None) -> int:
    """The node of a formula; `local` names go before those of the model."""
    return _Builder(meaning, local or {}).node(tree)


class _Builder:
    def __init__(self, meaning: Meaning, local: Mapping[str, int], calls: tuple[str, ...] = ()):
        self.meaning, self.graph, self.local = meaning, meaning.graph, local
        self.calls = calls
        """the functions whose formula this is, outermost first"""

    def constant(self, value: float) -> int:
        return int(self.graph.constant(value))

    def apply(self, op: str, *operands: int) -> int:
        return int(self.graph.apply(op, *operands))

    def node(self, tree: Any) -> int:
        kind = tree.getType()
        if tree.isNumber():
            return self.constant(tree.getValue())
        if kind in CONSTANTS:
            return self.constant(CONSTANTS[kind])
        if kind == s.AST_NAME_TIME:
            return self.meaning.time()
        if kind == s.AST_NAME:
            return self.name(tree.getName())
        if kind == s.AST_FUNCTION_RATE_OF:
            return self.rate(tree)
        if kind == s.AST_FUNCTION_DELAY:
            raise ModelError(
                f"'{s.formulaToL3String(tree)}': a delay of a value is not supported; an event may "
                "have a delay, and a chain of reactions imitates that of a value"
            )
        operands = [self.node(tree.getChild(i)) for i in range(tree.getNumChildren())]
        return self.operation(tree, kind, operands)

    def name(self, name: str) -> int:
        return self.local[name] if name in self.local else self.meaning.value(name)

    def rate(self, tree: Any) -> int:
        child = tree.getChild(0)
        if child.getType() != s.AST_NAME:
            raise ModelError(f"'{s.formulaToL3String(tree)}': expected rateOf of an id")
        name = child.getName()
        if name in self.local:
            return self.constant(0.0)
        return self.meaning.rate(name)

    def operation(self, tree: Any, kind: int, a: list[int]) -> int:
        if kind in UNARY and len(a) == 1:
            return self.apply(UNARY[kind], a[0])
        if kind in MANY:
            return self.many(kind, a)
        if kind in COMPARISONS:
            return self.chain(COMPARISONS[kind], a)
        if kind in RECIPROCAL and len(a) == 1:
            return self.apply("div", self.constant(1.0), self.apply(RECIPROCAL[kind], a[0]))
        if kind in OF_RECIPROCAL and len(a) == 1:
            return self.apply(OF_RECIPROCAL[kind], self.apply("div", self.constant(1.0), a[0]))
        special = SPECIAL.get(kind)
        if special is None or len(a) not in special[0]:
            shown = s.formulaToL3String(tree) or tree.getName()
            raise ModelError(f"'{shown}': not supported, or with {len(a)} arguments")
        return special[1](self, a, tree)

    def many(self, kind: int, a: list[int]) -> int:
        op, none = MANY[kind]
        if not a:
            return self.constant(none)
        result = a[0]
        for one in a[1:]:
            result = self.apply(op, result, one)
        return result

    def chain(self, op: str, a: list[int]) -> int:
        """a < b < c is a < b and b < c."""
        result = self.constant(1.0)
        for i in range(len(a) - 1):
            truth = self.meaning.comparison(op, a[i], a[i + 1])
            result = truth if i == 0 else self.apply("logical_and", result, truth)
        return result

    def minus(self, a: list[int], tree: Any) -> int:
        return self.apply("neg", a[0]) if len(a) == 1 else self.apply("sub", a[0], a[1])

    def divide(self, a: list[int], tree: Any) -> int:
        return self.apply("div", a[0], a[1])

    def power(self, a: list[int], tree: Any) -> int:
        return self.apply("pow", a[0], a[1])

    def log(self, a: list[int], tree: Any) -> int:
        """log(x) to base 10, or log(base, x)."""
        if len(a) == 1:
            return self.apply("log10", a[0])
        if self.graph.value(a[0]) == 10.0:
            return self.apply("log10", a[1])
        return self.apply("div", self.apply("log", a[1]), self.apply("log", a[0]))

    def root(self, a: list[int], tree: Any) -> int:
        """root(x), or root(degree, x)."""
        if len(a) == 1 or self.graph.value(a[0]) == 2.0:
            return self.apply("sqrt", a[-1])
        return self.apply("pow", a[1], self.apply("div", self.constant(1.0), a[0]))

    def quotient(self, a: list[int], tree: Any) -> int:
        return self.apply("trunc", self.apply("div", a[0], a[1]))

    def remainder(self, a: list[int], tree: Any) -> int:
        return self.apply("fmod", a[0], a[1])

    def factorial(self, a: list[int], tree: Any) -> int:
        known = self.graph.value(a[0])
        if known is not None:
            return self.constant(_factorial(known))
        result = self.constant(math.inf)
        for n in range(LARGEST_FACTORIAL, -1, -1):
            below = self.apply("le", a[0], self.constant(float(n)))
            result = self.apply("select", below, self.constant(float(math.factorial(n))), result)
        return result

    def exclusive(self, a: list[int], tree: Any) -> int:
        """Whether an odd number of operands is true."""
        result = self.constant(0.0)
        for one in a:
            result = self.apply("ne", result, self.apply("ne", one, self.constant(0.0)))
        return result

    def implies(self, a: list[int], tree: Any) -> int:
        return self.apply("logical_or", self.apply("logical_not", a[0]), a[1])

    def piecewise(self, a: list[int], tree: Any) -> int:
        """value, condition, value, condition, ..., otherwise; NaN where no condition is true."""
        result = a[-1] if len(a) % 2 else self.constant(math.nan)
        for i in range(len(a) // 2 - 1, -1, -1):
            result = self.apply("select", a[2 * i + 1], a[2 * i], result)
        return result

    def call(self, a: list[int], tree: Any) -> int:
        name = tree.getName()
        if name not in self.meaning.functions:
            raise ModelError(f"unknown function '{name}'")
        definition = self.meaning.functions[name]
        if definition is None or definition.getNumChildren() == 0:
            return self.constant(math.nan)
        count = definition.getNumChildren() - 1
        if count != len(a):
            raise ModelError(f"function '{name}': expected {count} arguments, found {len(a)}")
        names = [definition.getChild(i).getName() for i in range(count)]
        if name in self.calls:
            raise ModelError(f"function '{name}' calls itself: {' -> '.join([*self.calls, name])}")
        local = dict(zip(names, a, strict=True))
        return _Builder(self.meaning, local, (*self.calls, name)).node(definition.getChild(count))


def _factorial(n: float) -> float:
    if not (n >= 0.0 and n == math.floor(n) and n <= LARGEST_FACTORIAL):
        raise ModelError(
            f"factorial({n:g}): expected a whole number from 0 to {LARGEST_FACTORIAL}, above which "
            "it is no finite number"
        )
    return float(math.factorial(int(n)))


Special = tuple[Any, Callable[[_Builder, list[int], Any], int]]
ANY = range(1, 100_000)
SPECIAL: dict[int, Special] = {
    s.AST_MINUS: ((1, 2), _Builder.minus),
    s.AST_DIVIDE: ((2,), _Builder.divide),
    s.AST_POWER: ((2,), _Builder.power),
    s.AST_FUNCTION_POWER: ((2,), _Builder.power),
    s.AST_FUNCTION_LOG: ((1, 2), _Builder.log),
    s.AST_FUNCTION_ROOT: ((1, 2), _Builder.root),
    s.AST_FUNCTION_QUOTIENT: ((2,), _Builder.quotient),
    s.AST_FUNCTION_REM: ((2,), _Builder.remainder),
    s.AST_FUNCTION_FACTORIAL: ((1,), _Builder.factorial),
    s.AST_LOGICAL_XOR: (range(100_000), _Builder.exclusive),
    s.AST_LOGICAL_IMPLIES: ((2,), _Builder.implies),
    s.AST_FUNCTION_PIECEWISE: (ANY, _Builder.piecewise),
    s.AST_FUNCTION: (range(100_000), _Builder.call),
}
