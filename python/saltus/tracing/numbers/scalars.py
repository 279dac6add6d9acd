"""Arithmetic of single numbers: known numbers are computed by numpy, symbolic ones make a new node.

`SCALARS` has every operation of the graph by its name, and the operations that are made of several.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from typing import Any

import numpy as np

from saltus.tracing.numbers.symbol import ORDER, Symbol, joint, kind_of
from saltus.tracing.refusal import refuse

__all__ = [
    "NUMPY",
    "ORDER",
    "PYTHON",
    "SCALARS",
    "as_real",
    "cast",
    "is_number",
    "select",
    "truth",
    "whole",
]

Scalar = Any  # a Symbol or a number
Function = Callable[..., Scalar]

NUMPY: dict[str, Callable[..., Any]] = {
    "add": np.add, "sub": np.subtract, "mul": np.multiply, "div": np.true_divide,
    "pow": np.power, "neg": np.negative, "abs": np.abs, "sqrt": np.sqrt, "cbrt": np.cbrt,
    "exp": np.exp, "exp2": np.exp2, "expm1": np.expm1, "log": np.log, "log2": np.log2,
    "log10": np.log10, "log1p": np.log1p, "sin": np.sin, "cos": np.cos, "tan": np.tan,
    "asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2,
    "sinh": np.sinh, "cosh": np.cosh, "tanh": np.tanh, "asinh": np.arcsinh,
    "acosh": np.arccosh, "atanh": np.arctanh, "hypot": np.hypot, "floor": np.floor,
    "ceil": np.ceil, "trunc": np.trunc, "rint": np.rint, "sign": np.sign,
    "copysign": np.copysign, "mod": np.mod, "fmod": np.fmod, "floor_divide": np.floor_divide,
    "minimum": np.minimum, "maximum": np.maximum, "lt": np.less, "le": np.less_equal,
    "gt": np.greater, "ge": np.greater_equal, "eq": np.equal, "ne": np.not_equal,
    "logical_and": np.logical_and, "logical_or": np.logical_or, "logical_not": np.logical_not,
}  # fmt: skip
"""operation of the graph -> the function of numpy that it is"""

PYTHON: dict[str, Callable[..., Any]] = {
    "add": operator.add, "sub": operator.sub, "mul": operator.mul, "div": operator.truediv,
    "pow": operator.pow, "mod": operator.mod, "floor_divide": operator.floordiv,
    "neg": operator.neg, "abs": operator.abs,
}  # fmt: skip

TRUTHS = {"lt", "le", "gt", "ge", "eq", "ne", "logical_and", "logical_or", "logical_not"}
ARITHMETIC = {"add", "sub", "mul", "mod", "floor_divide", "fmod", "pow", "minimum", "maximum"}
SAME_KIND = {"abs", "neg", "sign", "floor", "ceil", "trunc", "rint"}


def is_number(value: object) -> bool:
    return kind_of(value) != ""


def is_python(value: Scalar) -> bool:
    return value.python if type(value) is Symbol else not isinstance(value, np.generic)


def record(name: str, arguments: tuple[Scalar, ...], kind: str) -> Symbol:
    """The node `name(*arguments)`; one of the arguments is a Symbol."""
    graph = next(a.graph for a in arguments if type(a) is Symbol)
    nodes = [a.node if type(a) is Symbol else graph.constant(float(a)) for a in arguments]
    python = all(is_python(a) for a in arguments)
    return Symbol(graph, graph.apply(name, *nodes), kind, python)


def _kind(name: str, arguments: tuple[Scalar, ...]) -> str:
    if name in TRUTHS:
        return "b"
    if name in ARITHMETIC or name in SAME_KIND:
        kind = joint(*(kind_of(a) for a in arguments))
        counts = kind == "b" and name not in ("minimum", "maximum", "abs")
        return "i" if counts else kind
    return "f"


def _refuse_narrow(name: str, arguments: tuple[Scalar, ...]) -> None:
    """numpy computes functions of truths with 16 bits, and their powers and remainders with 8."""
    if all(kind_of(a) == "b" for a in arguments):
        python = name in PYTHON and all(is_python(a) for a in arguments)
        if not python:
            refuse(f"computes {name} of truths, for which numpy takes small numbers",
                   "multiply them by 1.0 first")  # fmt: skip


def _plain(name: str) -> Function:
    narrow = name not in TRUTHS | SAME_KIND | {"add", "sub", "mul", "div", "minimum", "maximum"}

    def function(*arguments: Scalar) -> Scalar:
        if narrow:
            _refuse_narrow(name, arguments)
        for a in arguments:
            if type(a) is Symbol:
                kind = _kind(name, arguments)
                result = record(name, arguments, kind)
                # integers have no negative zero, their doubles have
                signed = kind == "i" and name in ("mul", "mod", "fmod", "neg", "floor_divide")
                return record("add", (result, 0.0), kind) if signed else result
        return NUMPY[name](*arguments)

    function.__name__ = name
    return function


SCALARS: dict[str, Function] = {name: _plain(name) for name in NUMPY}


def _numpy_truths(*arguments: Scalar) -> bool:
    return all(kind_of(a) == "b" for a in arguments) and not all(is_python(a) for a in arguments)


def _of_truths(name: str, instead: str | None) -> None:
    """numpy's arithmetic of truths: + is or, * is and, - is refused."""
    plain = SCALARS[name]

    def function(*arguments: Scalar) -> Scalar:
        if any(type(a) is Symbol for a in arguments) and _numpy_truths(*arguments):
            if instead is None:
                raise TypeError(f"numpy boolean {name} is not supported; use ^ or ~")
            return record(instead, arguments, "b")
        return plain(*arguments)

    SCALARS[name] = function


_of_truths("add", "logical_or")
_of_truths("mul", "logical_and")
_of_truths("sub", None)
_of_truths("neg", None)


def truth(value: Scalar) -> Scalar:
    """Whether a number differs from zero."""
    return value if kind_of(value) == "b" else SCALARS["ne"](value, 0.0)


def _logical(name: str) -> None:
    plain = SCALARS[name]
    SCALARS[name] = lambda *arguments: plain(*(truth(a) for a in arguments))


for _name in ("logical_and", "logical_or", "logical_not"):
    _logical(_name)


def select(condition: Scalar, yes: Scalar, no: Scalar) -> Scalar:
    """`yes` where the condition is true, else `no`; both are computed."""
    if type(condition) is not Symbol:
        return yes if condition else no
    if type(yes) is not Symbol and type(no) is not Symbol and yes is no:
        return yes
    kind = joint(kind_of(yes), kind_of(no))
    return record("select", (truth(condition), yes, no), kind)


def power(base: Scalar, exponent: Scalar) -> Scalar:
    """base**exponent; small whole powers by multiplication, as numpy squares."""
    if type(base) is not Symbol or type(exponent) is Symbol:
        return _power(base, exponent)
    mul = SCALARS["mul"]
    if exponent in (2, 3, 4) and base.kind != "b":
        square = mul(base, base)
        if exponent == 2:
            result = square
        else:
            result = mul(square, base) if exponent == 3 else mul(square, square)
        kind = joint(base.kind, kind_of(exponent))
        return Symbol(result.graph, result.node, kind, base.python and is_python(exponent))
    if exponent == 0.5:
        return SCALARS["sqrt"](base)
    return _power(base, exponent)


_power = SCALARS["pow"]


def _fmax(a: Scalar, b: Scalar, name: str = "maximum") -> Scalar:
    nan = SCALARS["ne"]
    return select(nan(a, a), b, select(nan(b, b), a, SCALARS[name](a, b)))


def _degrees(factor: float) -> Function:
    return lambda a: SCALARS["mul"](a, factor)


def _sinc(a: Scalar) -> Scalar:
    y = SCALARS["mul"](math.pi, select(SCALARS["eq"](a, 0.0), 1.0e-20, a))
    return SCALARS["div"](SCALARS["sin"](y), y)


def _logaddexp(a: Scalar, b: Scalar) -> Scalar:
    high, low = SCALARS["maximum"](a, b), SCALARS["minimum"](a, b)
    grown = SCALARS["log1p"](SCALARS["exp"](SCALARS["sub"](low, high)))
    return select(SCALARS["eq"](a, b), SCALARS["add"](a, math.log(2.0)), high + grown)


def _xor(a: Scalar, b: Scalar) -> Scalar:
    return SCALARS["ne"](truth(a), truth(b))


def _heaviside(a: Scalar, at_zero: Scalar) -> Scalar:
    step = select(SCALARS["lt"](a, 0.0), 0.0, select(SCALARS["eq"](a, 0.0), at_zero, 1.0))
    return select(SCALARS["ne"](a, a), a, step)


def _is_finite(a: Scalar) -> Scalar:
    return SCALARS["lt"](SCALARS["abs"](a), math.inf)


def as_real(a: Scalar) -> Scalar:
    return a.numpy("f") if type(a) is Symbol else np.float64(a)


COMPOSED: dict[str, Function] = {
    "pow": power,
    "select": select,
    "truth": truth,
    "logical_xor": _xor,
    "square": lambda a: SCALARS["mul"](a, a),
    "reciprocal": lambda a: SCALARS["div"](1.0, a),
    "positive": lambda a: a,
    "fmax": _fmax,
    "fmin": lambda a, b: _fmax(a, b, "minimum"),
    "deg2rad": _degrees(math.pi / 180.0),
    "rad2deg": _degrees(180.0 / math.pi),
    "sinc": _sinc,
    "logaddexp": _logaddexp,
    "heaviside": _heaviside,
    "isnan": lambda a: SCALARS["ne"](a, a),
    "isinf": lambda a: SCALARS["eq"](SCALARS["abs"](a), math.inf),
    "isfinite": _is_finite,
    "signbit": lambda a: SCALARS["lt"](SCALARS["copysign"](1.0, a), 0.0),
    "clip": lambda a, low, high: SCALARS["minimum"](SCALARS["maximum"](a, low), high),
}
SCALARS.update(COMPOSED)


def whole(name: str, value: Scalar) -> Scalar:
    """floor, ceil, trunc or rint to an integer; + 0.0 as integers have no negative zero."""
    return SCALARS["add"](SCALARS[name](value), 0.0)


def cast(value: Scalar, kind: str) -> Scalar:
    """The number as an entry of an array of that kind."""
    if type(value) is Symbol:
        if kind == "b":
            return truth(value).numpy()
        if kind == "i" and value.kind == "f":
            value = whole("trunc", value)
        return value.numpy(kind)
    return {"b": np.bool_, "i": np.int64, "f": np.float64}[kind](value)
