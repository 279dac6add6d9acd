"""Functions that choose, np.where, np.select, np.clip, np.interp, and functions that test numbers.

Each computes all its branches and keeps one. In a derivative this makes a kink which no guard
locates. The error control of the solver has to deal with it, as when the function is called.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from saltus.tracing.numbers.arrays import SymbolArray, as_array
from saltus.tracing.numbers.entrywise import apply
from saltus.tracing.numbers.reductions import fold
from saltus.tracing.numbers.scalars import as_real
from saltus.tracing.numbers.symbol import joint
from saltus.tracing.refusal import refuse

__all__ = ["CHOICES", "clip", "round_"]

LARGEST_TABLE = 64  # the number of points of np.interp; each is computed at every evaluation


def where(condition: Any, *branches: Any) -> Any:
    """Entries of the first branch where the condition is true, else of the second."""
    if len(branches) != 2:
        refuse("calls np.where with a condition alone", "give it both values")
    yes, no = branches
    kind = joint(as_array(yes).kind, as_array(no).kind)
    result = apply("select", as_array(condition), yes, no)
    if kind == "f":  # a known truth may have chosen an integer among reals
        return result.astype(float) if isinstance(result, SymbolArray) else as_real(result)
    return result


def select(conditions: Sequence[Any], values: Sequence[Any], default: Any = 0) -> Any:
    """The value of the first condition that is true."""
    if len(conditions) != len(values):
        raise ValueError("list of cases must be same length as list of conditions")
    result = default
    for condition, value in zip(reversed(conditions), reversed(values), strict=True):
        result = where(condition, value, result)
    return result


def clip(a: Any, a_min: Any = None, a_max: Any = None, out: Any = None, **options: Any) -> Any:
    """min(max(a, low), high), and NaN where one of them is."""
    low, high = options.pop("min", a_min), options.pop("max", a_max)
    if out is not None or options:
        refuse("calls np.clip with `out` or options", "leave that out")
    result = a if low is None else apply("maximum", a, low)
    return result if high is None else apply("minimum", result, high)


def round_(a: Any, decimals: int = 0, out: Any = None) -> Any:
    if out is not None:
        refuse("calls np.round with `out`", "leave that out")
    if not decimals:
        return apply("rint", a)
    factor = 10.0 ** abs(decimals)
    first, last = ("mul", "div") if decimals > 0 else ("div", "mul")
    return apply(last, apply("rint", apply(first, a, factor)), factor)


def interp(
    x: Any, xp: Any, fp: Any, left: Any = None, right: Any = None, period: Any = None
) -> Any:
    """Straight lines through the points (xp, fp), constant beyond them; xp is known."""
    if period is not None:
        refuse("calls np.interp with a period", "use np.mod on x first")
    xp, fp = as_array(xp), as_array(fp)
    n = xp.size
    if n > LARGEST_TABLE:
        refuse(f"interpolates in a table of {n} points; up to {LARGEST_TABLE} are traced")
    result = where(apply("gt", x, xp[n - 1]), fp[n - 1] if right is None else right, fp[n - 1])
    for k in reversed(range(n - 1)):
        slope = apply("div", apply("sub", fp[k + 1], fp[k]), apply("sub", xp[k + 1], xp[k]))
        line = apply("add", apply("mul", slope, apply("sub", x, xp[k])), fp[k])
        result = where(apply("lt", x, xp[k + 1]), line, result)
    result = where(apply("lt", x, xp[0]), fp[0] if left is None else left, result)
    return where(apply("isnan", x), x, result)


def is_close(
    a: Any, b: Any, rtol: float = 1e-05, atol: float = 1e-08, equal_nan: bool = False
) -> Any:
    """|a - b| <= atol + rtol |b|, or both infinite and equal."""
    if equal_nan:
        refuse("calls np.isclose with equal_nan", "leave that out")
    room = apply("add", atol, apply("mul", rtol, apply("abs", b)))
    near = apply("le", apply("abs", apply("sub", a, b)), room)
    finite = apply("logical_and", near, apply("isfinite", b))
    return apply("logical_or", finite, apply("eq", a, b))


def _whole(test: Callable[..., Any]) -> Callable[..., Any]:
    def function(a: Any, b: Any, *rest: Any, **options: Any) -> Any:
        return fold("logical_and", False, test(a, b, *rest, **options), None)

    return function


def array_equal(a: Any, b: Any) -> Any:
    if as_array(a).shape != as_array(b).shape:
        return False
    return _whole(lambda x, y: apply("eq", x, y))(a, b)


def nan_to_num(x: Any, copy: bool = True, nan: float = 0.0, posinf: Any = None,
               neginf: Any = None) -> Any:  # fmt: skip
    largest = np.finfo(float).max
    high, low = largest if posinf is None else posinf, -largest if neginf is None else neginf
    result = where(apply("eq", x, np.inf), high, where(apply("eq", x, -np.inf), low, x))
    return where(apply("isnan", x), nan, result)


def count_nonzero(a: Any, axis: Any = None) -> Any:
    return fold("add", False, apply("truth", as_array(a)), axis)


def piecewise(x: Any, conditions: Any, functions: Any, *args: Any, **options: Any) -> Any:
    """The function of the last true condition. If none is true: the extra function, or 0."""
    x = as_array(x)
    if not isinstance(conditions, (list, tuple)):
        conditions = [conditions]

    def value(function: Any) -> Any:
        return function(x, *args, **options) if callable(function) else function

    extra = len(functions) - len(conditions)
    result = value(functions[-1]) if extra else 0
    for condition, function in zip(conditions, functions, strict=False):
        result = where(condition, value(function), result)
    return as_array(result).astype(x.dtype)


def is_in(element: Any, test_elements: Any, **options: Any) -> Any:
    """Whether the element equals one of the tested ones."""
    if options:
        refuse("calls np.isin with options", "leave them out")
    tests = [apply("eq", element, test) for test in as_array(test_elements).ravel()]
    return functools.reduce(lambda a, b: apply("logical_or", a, b), tests)


CHOICES: dict[str, Callable[..., Any]] = {
    "where": where,
    "select": select,
    "clip": clip,
    "round": round_,
    "around": round_,
    "interp": interp,
    "piecewise": piecewise,
    "isin": is_in,
    "isclose": is_close,
    "allclose": _whole(is_close),
    "array_equal": array_equal,
    "nan_to_num": nan_to_num,
    "count_nonzero": count_nonzero,
}
"""numpy's name of a function -> its form for symbols"""
