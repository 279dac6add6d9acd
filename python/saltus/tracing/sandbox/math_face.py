"""The module math as a traced function sees it."""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Callable
from typing import Any

from saltus.tracing.numbers import (
    SCALARS,
    Symbol,
    SymbolArray,
    apply,
    has_symbols,
    is_number,
    kind_of,
    plain,
)
from saltus.tracing.refusal import refuse

__all__ = ["MATH_FACE", "math_function"]

MATH = {
    "acos": "acos", "acosh": "acosh", "asin": "asin", "asinh": "asinh", "atan": "atan",
    "atan2": "atan2", "atanh": "atanh", "cbrt": "cbrt", "copysign": "copysign", "cos": "cos",
    "cosh": "cosh", "degrees": "rad2deg", "exp": "exp", "exp2": "exp2", "expm1": "expm1",
    "fabs": "abs", "fmod": "fmod", "isfinite": "isfinite", "isinf": "isinf", "isnan": "isnan",
    "log10": "log10", "log1p": "log1p", "log2": "log2", "pow": "pow", "radians": "deg2rad",
    "sin": "sin", "sinh": "sinh", "sqrt": "sqrt", "tan": "tan", "tanh": "tanh",
}  # fmt: skip
"""function of math -> its name in SCALARS"""


def _one(value: Any) -> Any:
    """The number in an array of one entry, as math accepts it; any other value unchanged."""
    return value._one() if isinstance(value, SymbolArray) else value


def _real(value: Any) -> Any:
    """A truth as math takes it: the number 0 or 1."""
    return SCALARS["mul"](1.0, value) if kind_of(value) == "b" else value


def _log(x: Any, base: Any = None) -> Any:
    natural = SCALARS["log"](x)
    return natural if base is None else SCALARS["div"](natural, SCALARS["log"](base))


def _hypot(*parts: Any) -> Any:
    if len(parts) == 2:
        return SCALARS["hypot"](*parts)
    return SCALARS["sqrt"](functools.reduce(operator.add, (p * p for p in parts)))


def _is_close(a: Any, b: Any, rel_tol: Any, abs_tol: Any) -> Any:
    """|a - b| <= max(rel_tol max(|a|, |b|), abs_tol)"""
    size = SCALARS["maximum"](SCALARS["abs"](a), SCALARS["abs"](b))
    room = SCALARS["maximum"](SCALARS["mul"](rel_tol, size), abs_tol)
    near = SCALARS["le"](SCALARS["abs"](SCALARS["sub"](a, b)), room)
    near = SCALARS["logical_and"](near, SCALARS["isfinite"](size))
    return SCALARS["logical_or"](near, SCALARS["eq"](a, b))


MATH_OWN: dict[str, Callable[..., Any]] = {
    "log": _log,
    "hypot": _hypot,
    "floor": lambda x: x.__floor__(),
    "ceil": lambda x: x.__ceil__(),
    "trunc": lambda x: x.__trunc__(),
    "isclose": lambda a, b, *, rel_tol=1e-9, abs_tol=0.0: _is_close(a, b, rel_tol, abs_tol),
    "modf": lambda x: (x - SCALARS["trunc"](x), SCALARS["trunc"](x)),
}

SEQUENCES: dict[str, Callable[..., Any]] = {
    "fsum": lambda terms: functools.reduce(operator.add, terms),
    "prod": lambda terms, start=1: functools.reduce(operator.mul, terms, start),
    "dist": lambda p, q: _hypot(*(a - b for a, b in zip(p, q, strict=True))),
}


def _as_python(result: Any) -> Any:
    """math's functions return Python's numbers, whatever they are given."""
    return (
        Symbol(result.graph, result.node, result.kind, True) if type(result) is Symbol else result
    )


@functools.cache
def math_function(name: str) -> Callable[..., Any]:
    real: Callable[..., Any] = getattr(math, name)

    def call(*arguments: Any, **options: Any) -> Any:
        if not has_symbols(arguments):
            return real(*plain(arguments), **options)
        if name in SEQUENCES:
            return _as_python(SEQUENCES[name](*arguments, **options))
        arguments = tuple(_real(_one(a)) for a in arguments)
        if name in MATH_OWN:
            return _as_python(MATH_OWN[name](*arguments, **options))
        if name not in MATH:
            refuse(f"calls math.{name}, which has no symbolic form", "write it out")
        if not all(is_number(a) for a in arguments):
            raise TypeError(f"must be real number, not {type(arguments[0]).__name__}")
        return _as_python(apply(MATH[name], *arguments))

    return call


class Math:
    """The module math, for symbols and numbers."""

    def __getattr__(self, name: str) -> Any:
        value = getattr(math, name)
        return math_function(name) if callable(value) else value

    def __setattr__(self, name: str, value: Any) -> None:
        refuse(f"writes math.{name}")


MATH_FACE = Math()
