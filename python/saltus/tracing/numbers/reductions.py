"""Sums, products, means and extremes of arrays that hold symbols."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from saltus.tracing.numbers.arrays import Objects, SymbolArray, as_array, wrapped
from saltus.tracing.numbers.entrywise import apply
from saltus.tracing.numbers.scalars import SCALARS, cast
from saltus.tracing.refusal import refuse

__all__ = ["REDUCTIONS", "fold"]

EMPTY = {"add": 0.0, "mul": 1.0, "logical_and": True, "logical_or": False}


def _columns(a: SymbolArray, axis: Any) -> tuple[Objects, int]:
    """The entries with the folded axes last and flattened, and the number of these axes."""
    axes = tuple(range(a.ndim)) if axis is None else axis if isinstance(axis, tuple) else (axis,)
    axes = tuple(int(k) for k in axes)
    moved = np.moveaxis(a.data, axes, range(a.ndim - len(axes), a.ndim))
    return moved.reshape(*moved.shape[: a.ndim - len(axes)], -1), len(axes)


def _folded(name: str, cells: Iterable[Any], initial: Any) -> list[Any]:
    """All partial results, from left to right."""
    done: list[Any] = []
    for cell in cells:
        start = done[-1] if done else initial
        done.append(cell if start is None else SCALARS[name](start, cell))
    return done


def fold(
    name: str,
    accumulate: bool,
    value: Any,
    axis: Any = 0,
    dtype: Any = None,
    out: Any = None,
    keepdims: Any = False,
    initial: Any = None,
    **options: Any,
) -> Any:
    """Entries joined one after the other by an operation, over an axis, all or some."""
    if out is not None or options.get("where", True) is not True:
        refuse("sums with `out` or `where`", "leave that out")
    a = as_array(value)
    if name in ("add", "mul") and a.kind == "b":  # numpy counts truths
        a = a.astype(np.int64)
    if dtype is not None:
        a = a.astype(dtype)
    if accumulate:
        return _accumulated(name, a, axis)
    columns, _ = _columns(a, axis)
    if initial is None and columns.shape[-1] == 0:
        if name not in EMPTY:
            raise ValueError("zero-size array to a reduction that has no identity")
        initial = cast(EMPTY[name], a.kind)
    result = np.empty(columns.shape[:-1], dtype=object)
    for place in np.ndindex(*result.shape):
        done = _folded(name, columns[place], initial)
        result[place] = done[-1] if done else initial
    if keepdims is True:
        axes = range(a.ndim) if axis is None else np.atleast_1d(axis) % a.ndim
        result = result.reshape([1 if k in axes else n for k, n in enumerate(a.shape)])
    return wrapped(result)


def _accumulated(name: str, a: SymbolArray, axis: Any) -> Any:
    if axis is None:
        a, axis = a.ravel(), 0
    rows = np.moveaxis(a.data, axis, -1)
    result = np.empty(rows.shape, dtype=object)
    for place in np.ndindex(*rows.shape[:-1]):
        result[place] = _folded(name, rows[place], None)
    return wrapped(np.moveaxis(result, -1, axis))


def folding(name: str, accumulate: bool = False) -> Callable[..., Any]:
    """np.sum, np.prod, ... as methods and functions, by default over all axes."""

    def function(a: Any, axis: Any = None, dtype: Any = None, out: Any = None, **o: Any) -> Any:
        return fold(name, accumulate, a, axis, dtype, out, **o)

    def of_truths(a: Any, axis: Any = None, out: Any = None, **o: Any) -> Any:
        return fold(name, accumulate, apply("truth", as_array(a)), axis, None, out, **o)

    def extreme(a: Any, axis: Any = None, out: Any = None, **o: Any) -> Any:
        return fold(name, accumulate, a, axis, None, out, **o)

    if name.startswith("logical"):
        return of_truths
    return extreme if name in ("minimum", "maximum") else function


def mean(a: Any, axis: Any = None, dtype: Any = None, out: Any = None, **options: Any) -> Any:
    a = as_array(a)
    total = fold("add", False, a, axis, dtype, out, **options)
    return apply("div", total, float(_columns(a, axis)[0].shape[-1]))


def var(a: Any, axis: Any = None, dtype: Any = None, out: Any = None, ddof: int = 0,
        **options: Any) -> Any:  # fmt: skip
    a = as_array(a)
    apart = apply("sub", a, mean(a, axis, dtype, out, keepdims=True))
    total = fold("add", False, apply("mul", apart, apart), axis, dtype, out, **options)
    return apply("div", total, float(_columns(a, axis)[0].shape[-1] - ddof))


def std(a: Any, axis: Any = None, dtype: Any = None, out: Any = None, ddof: int = 0,
        **options: Any) -> Any:  # fmt: skip
    return apply("sqrt", var(a, axis, dtype, out, ddof, **options))


def ptp(a: Any, axis: Any = None, **options: Any) -> Any:
    high = folding("maximum")(a, axis, **options)
    return apply("sub", high, folding("minimum")(a, axis, **options))


def average(a: Any, axis: Any = None, weights: Any = None, **options: Any) -> Any:
    if weights is None:
        return mean(a, axis, **options)
    a, weights = as_array(a), as_array(weights)
    if options or a.shape != weights.shape:
        refuse("calls np.average with options or weights of another shape", "write it out")
    total = fold("add", False, apply("mul", a, weights), axis)
    return apply("div", total, fold("add", False, weights, axis))


def gradient(f: Any, *spacing: Any, **options: Any) -> Any:
    """Central differences, one-sided at the ends, of a vector with equal spacing."""
    f = as_array(f)
    if options or f.ndim != 1 or len(spacing) > 1 or any(np.ndim(h) for h in spacing):
        refuse("calls np.gradient of more than a vector with one spacing", "write it out")
    h = spacing[0] if spacing else 1.0
    result = np.empty(f.size, dtype=object)
    inner = apply("div", apply("sub", f[2:], f[:-2]), apply("mul", 2.0, h))
    result[1:-1] = as_array(inner).data
    result[0] = apply("div", apply("sub", f[1], f[0]), h)
    result[-1] = apply("div", apply("sub", f[-1], f[-2]), h)
    return wrapped(result)


REDUCTIONS: dict[str, Callable[..., Any]] = {
    "sum": folding("add"),
    "prod": folding("mul"),
    "cumsum": folding("add", True),
    "cumprod": folding("mul", True),
    "min": folding("minimum"),
    "max": folding("maximum"),
    "all": folding("logical_and"),
    "any": folding("logical_or"),
    "mean": mean,
    "var": var,
    "std": std,
    "ptp": ptp,
    "average": average,
    "gradient": gradient,
}
