"""Matrix products of symbols and numbers."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np

from saltus.tracing.numbers.arrays import Objects, as_array, wrapped
from saltus.tracing.numbers.entrywise import apply
from saltus.tracing.numbers.reductions import REDUCTIONS
from saltus.tracing.numbers.scalars import SCALARS
from saltus.tracing.numbers.symbol import Symbol
from saltus.tracing.refusal import refuse

__all__ = ["dot", "inner", "matmul", "matrix_power", "multi_dot", "norm", "outer", "vdot"]


def _is_zero(value: Any) -> bool:
    return type(value) is not Symbol and value == 0


def _sum_of_products(a: Objects, b: Objects) -> Any:
    """Sum a_i b_i. A zero of a constant matrix is left out: the Jacobian keeps its sparsity.

    If the values are finite, this changes at most the sign of a zero.
    """
    total: Any = None
    for x, y in zip(a, b, strict=True):
        if _is_zero(x) or _is_zero(y):
            continue
        product = SCALARS["mul"](x, y)
        total = product if total is None else SCALARS["add"](total, product)
    return np.float64(0.0) if total is None else total


def matmul(a: Any, b: Any) -> Any:
    """a @ b, for vectors and matrices."""
    a, b = as_array(a), as_array(b)
    if a.ndim == 0 or b.ndim == 0:
        raise ValueError("matmul: input operand does not have enough dimensions")
    if a.ndim > 2 or b.ndim > 2:
        return wrapped(_stacked(a.data, b.data))
    rows = a.data.reshape(-1, a.shape[-1])
    columns = b.data.reshape(b.shape[0], -1).T
    if rows.shape[1] != columns.shape[1]:
        raise ValueError(f"matmul: shapes {a.shape} and {b.shape} do not fit")
    result = np.empty((len(rows), len(columns)), dtype=object)
    for i, row in enumerate(rows):
        for j, column in enumerate(columns):
            result[i, j] = _sum_of_products(row, column)
    return wrapped(result.reshape(a.shape[:-1] + b.shape[1:]))


def _stacked(a: Objects, b: Objects) -> Any:
    return np.matmul(a, b)


def dot(a: Any, b: Any, out: None = None) -> Any:
    a, b = as_array(a), as_array(b)
    if a.ndim == 0 or b.ndim == 0:
        return apply("mul", a, b)
    return matmul(a, b) if a.ndim <= 2 and b.ndim <= 2 else wrapped(np.dot(a.data, b.data))


def inner(a: Any, b: Any) -> Any:
    b = as_array(b)
    return dot(a, b.T if b.ndim == 2 else b)


def vdot(a: Any, b: Any) -> Any:
    return dot(as_array(a).ravel(), as_array(b).ravel())


def outer(a: Any, b: Any, out: None = None) -> Any:
    return apply("mul", as_array(a).reshape(-1, 1), as_array(b).reshape(1, -1))


def multi_dot(arrays: Any, *, out: None = None) -> Any:
    return functools.reduce(dot, arrays)


def matrix_power(a: Any, n: int) -> Any:
    """a @ a @ ..., n times, n >= 0."""
    if n < 0:
        refuse("calls np.linalg.matrix_power with a negative power", "use np.linalg.inv")
    return functools.reduce(matmul, [a] * n, np.eye(as_array(a).shape[0]))


def norm(x: Any, ord: Any = None, axis: Any = None, keepdims: bool = False) -> Any:
    """The Euclidean (Frobenius) norm, and the 1- and infinity-norm of vectors."""
    x = as_array(x)
    if ord in (1, np.inf) and (x.ndim == 1 or axis is not None):
        total = REDUCTIONS["sum" if ord == 1 else "max"]
        return total(apply("abs", x), axis, keepdims=keepdims)
    if ord not in (None, 2, "fro") or (ord == 2 and x.ndim > 1 and axis is None):
        refuse(f"calls np.linalg.norm with ord={ord!r}", "write it out")
    return apply("sqrt", REDUCTIONS["sum"](apply("mul", x, x), axis, keepdims=keepdims))
