"""The Jacobian of `solve` in the forms that SciPy takes, as arguments of a declaration."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus._core import numbers
from saltus._wrapped import wrapping
from saltus.errors import ModelError
from saltus.solving.form import PLAIN, Form, Names

__all__ = ["derivatives_of"]


def derivatives_of(
    jacobian: Any,
    sparsity: Any,
    size: int,
    form: Form,
    args: tuple[Any, ...],
    names: Names,
) -> dict[str, Any]:
    """The Jacobian as arguments of `declare_continuous_state`. It takes what SciPy takes: a
    function or a matrix, dense or sparse. The entries of a sparse matrix are the sparsity.
    """
    places = form.places(sparsity)
    if jacobian is None:
        return {"jacobian": None, "jacobian_sparsity": places}
    if callable(jacobian):
        function = form.matrix(jacobian, args, size, names)
        function = function if names is not None else wrapping(jacobian, function)
        return {"jacobian": function, "jacobian_sparsity": places}
    sparse = hasattr(jacobian, "tocoo")
    given: Any = jacobian if sparse else _dense(jacobian)
    kind = given.dtype.kind
    if kind == "c" and not form.is_complex:
        raise ModelError("solve: jacobian: expected real numbers, as in x0, found complex ones")
    if given.shape != (size, size):
        raise ModelError(f"solve: jacobian: expected shape {(size, size)}, found {given.shape}")
    if sparse and sparsity is None and form == PLAIN:
        matrix = given.tocoo(copy=True)
        matrix.sum_duplicates()
        values = np.array(matrix.data, dtype=float)
        return {
            "jacobian_sparsity": (matrix.row.tolist(), matrix.col.tolist()),
            "sparse_jacobian": lambda time, state, /, **given: values,
        }
    dense = np.array(given.toarray() if sparse else given)
    dense = dense.astype(complex if form.is_complex else float)
    function = form.matrix(lambda t, x: dense, (), size)
    return {"jacobian": function, "jacobian_sparsity": places}


def _dense(jacobian: ArrayLike) -> np.ndarray:
    given = np.asarray(jacobian)
    return given if given.dtype.kind == "c" else np.array(numbers(jacobian, "solve: jacobian"))
