"""The arguments of the declarations of a block in the form of the engine."""

from __future__ import annotations

import operator
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus.compiled import as_compiled
from saltus.errors import ModelError

__all__ = [
    "EVERYTHING",
    "SHORT",
    "RequiresInputs",
    "callback_of",
    "direction_of",
    "initial_of",
    "inputs_of",
    "places_of",
    "shape_of",
]

RequiresInputs = bool | Iterable[int]
EVERYTHING = ("time", "continuous_state", "discrete_state", "mode", "inputs")
SHORT = {
    "both": "crosses_zero",
    "falling": "positive_then_non_positive",
    "rising": "negative_then_non_negative",
}
"""directions in one word"""


def callback_of(function: Any) -> Any:
    """The compiled function of a pointer; any other value unchanged."""
    return as_compiled(function) or function


def direction_of(direction: Any) -> Any:
    """The name in the engine of a direction in one word; any other value unchanged."""
    return SHORT.get(str(direction), direction)


def inputs_of(requires_inputs: RequiresInputs) -> list[int] | None:
    if isinstance(requires_inputs, (bool, np.bool_)):
        return None if requires_inputs else []
    return [int(i) for i in requires_inputs]


def initial_of(what: str, shape: Any, default_value: ArrayLike | None) -> ArrayLike:
    """A number n or a tuple is a shape, filled with zeros; anything else is the value itself."""
    if default_value is not None:
        if shape is not None and np.shape(default_value) != np.shape(np.zeros(shape)):
            found = np.shape(default_value)
            raise ModelError(
                f"{what}: shape {shape} and a value of shape {found}; give one of them"
            )
        return default_value
    if shape is None:
        raise ModelError(f"{what}: give a shape, such as 2, or a default_value")
    return np.zeros(shape) if isinstance(shape, (int, np.integer, tuple)) else shape


def places_of(what: str, sparsity: Any) -> list[tuple[int, int]]:
    """(row, column) of each entry that may differ from zero."""
    try:
        if not isinstance(sparsity, tuple):
            matrix = sparsity if hasattr(sparsity, "nonzero") else np.asarray(sparsity)
            sparsity = matrix.nonzero()
        rows, columns = ([operator.index(i) for i in part] for part in sparsity)
        return list(zip(rows, columns, strict=True))
    except (TypeError, ValueError):
        raise ModelError(
            f"{what}: jacobian_sparsity: expected an n by n array, a sparse matrix or a pair "
            "(rows, columns) of equally many integers"
        ) from None


def shape_of(shape: Any, default_value: ArrayLike | None = None) -> list[int] | None:
    if shape is None:
        return None if default_value is None else list(np.shape(default_value))
    try:
        sizes = [operator.index(n) for n in np.atleast_1d(np.asarray(shape, dtype=object))]
    except TypeError:
        sizes = [-1]
    if any(n < 0 for n in sizes):
        raise ModelError(f"shape: expected () or a number of entries, found {shape!r}")
    return sizes
