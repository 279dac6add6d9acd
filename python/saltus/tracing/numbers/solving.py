"""Small linear systems with symbolic entries: np.linalg.solve, inv and det."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus.tracing.numbers.arrays import Objects, as_array, wrapped
from saltus.tracing.numbers.scalars import SCALARS, select
from saltus.tracing.refusal import refuse

__all__ = ["det", "inv", "solve"]

LARGEST = 6  # rows; the work grows as the cube


def _exchange(rows: Objects, k: int, i: int) -> Any:
    """Rows k and i such that the larger pivot is in k; the truth that they changed places."""
    change = SCALARS["gt"](SCALARS["abs"](rows[i, k]), SCALARS["abs"](rows[k, k]))
    for j in range(k, rows.shape[1]):
        above, below = rows[k, j], rows[i, j]
        rows[k, j], rows[i, j] = select(change, below, above), select(change, above, below)
    return change


def _eliminated(rows: Objects) -> tuple[Objects, Any]:
    """Upper triangular form by Gauss with partial pivoting; the sign of the permutation.

    Golub & Van Loan, Matrix Computations (4th ed.), 3.4. The rows are exchanged by selection, as
    the largest pivot is not known.
    """
    n = len(rows)
    sign: Any = 1.0
    for k in range(n):
        for i in range(k + 1, n):
            change = _exchange(rows, k, i)
            sign = select(change, SCALARS["neg"](sign), sign)
        for i in range(k + 1, n):
            factor = SCALARS["div"](rows[i, k], rows[k, k])
            for j in range(k + 1, rows.shape[1]):
                rows[i, j] = rows[i, j] - SCALARS["mul"](factor, rows[k, j])
            rows[i, k] = 0.0
    return rows, sign


def _square(a: Any) -> Objects:
    a = as_array(a).astype(float)
    if a.ndim != 2 or a.shape[0] != a.shape[1]:
        refuse(f"solves with an array of shape {a.shape}", "one square matrix at a time")
    if a.shape[0] > LARGEST:
        refuse(f"solves with {a.shape[0]} rows; up to {LARGEST} are traced")
    rows: Objects = a.data
    return rows


def solve(a: Any, b: Any) -> Any:
    """The x with a x = b."""
    matrix, right = _square(a), as_array(b).astype(float)
    n = len(matrix)
    columns = right.data.reshape(n, -1)
    rows, _ = _eliminated(np.concatenate([matrix, columns], axis=1))
    x = np.empty(columns.shape, dtype=object)
    for column in range(columns.shape[1]):
        for i in reversed(range(n)):
            total = rows[i, n + column]
            for j in range(i + 1, n):
                total = total - SCALARS["mul"](rows[i, j], x[j, column])
            x[i, column] = SCALARS["div"](total, rows[i, i])
    return wrapped(x.reshape(right.shape))


def inv(a: Any) -> Any:
    return solve(a, np.eye(as_array(a).shape[0]))


def det(a: Any) -> Any:
    rows, sign = _eliminated(_square(a).copy())
    result = sign
    for i in range(len(rows)):
        result = SCALARS["mul"](result, rows[i, i])
    return wrapped(np.array(result, dtype=object))
