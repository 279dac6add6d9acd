"""Declared derivatives: the form in which the engine takes those of a user."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from saltus._core import known_names
from saltus.errors import ModelError

__all__ = ["columns_of"]


def columns_of(
    given: Callable[..., Mapping[str, Any]] | None,
    block: Any,
    inputs: list[int] | None,
    rows: int | str | None,
    what: str,
) -> Callable[..., np.ndarray] | None:
    """The function that the engine calls: all blocks of columns, one after the other, column by
    column. `rows` is 'states' for a reset map, and None for an output, whose blocks say it.
    """
    if given is None:
        return None
    if not callable(given):
        raise ModelError(f"block '{block.name}': {what}: expected a function, found {given!r}")

    def derivatives(time: float, state: Any, /, *values: Any, **parameters: Any) -> np.ndarray:
        names = [block.input_names[i] for i in (range(len(values)) if inputs is None else inputs)]
        widths = {
            "continuous_state": np.size(state.continuous_state),
            "discrete_state": np.size(state.discrete_state),
            **{name: np.size(value) for name, value in parameters.items()},
        }
        of_inputs = {name: np.size(u) for name, u in zip(names, values, strict=True)}
        place = f"t = {time} s: block '{block.name}': {what}"
        found = given(time, state, *values, **parameters)
        known = [*widths, *of_inputs, "time"]
        if not isinstance(found, Mapping):
            raise ModelError(
                f"{place}: expected a dict of arrays with keys of {known}, found {found!r}"
            )
        for name in found:
            if name not in known:
                raise ModelError(f"{place}: unknown value {name!r}{known_names(str(name), known)}")
        sizes = [*widths.items(), *of_inputs.items(), ("time", 1)]
        if rows == "states":
            count = widths["continuous_state"] + widths["discrete_state"]
        else:
            count = _rows(found, dict(sizes)) if rows is None else int(rows)
        # An input that has the name of a parameter is given by no key: the parameter counts.
        seen: set[str] = set()
        blocks = []
        for name, width in sizes:
            value = None if name in seen else found.get(name)
            seen.add(name)
            blocks.append(_block(value, count, width, f"{place}: {name!r}"))
        return np.concatenate(blocks)

    return derivatives


def _rows(found: Mapping[str, Any], widths: dict[str, int]) -> int:
    """The number of rows of the first block that says it."""
    for name, value in found.items():
        if widths[name] > 0:
            return np.size(value) // widths[name]
    return 1


def _block(value: Any, rows: int, width: int, place: str) -> np.ndarray:
    """The numbers of a block, column by column; zero if it is not given."""
    if value is None:
        return np.zeros(rows * width)
    array = np.asarray(value, dtype=float)
    splits = range(array.ndim + 1)
    if not any(
        (math.prod(array.shape[:i]), math.prod(array.shape[i:])) == (rows, width) for i in splits
    ):
        raise ModelError(f"{place}: expected shape {(rows, width)}, found {array.shape}")
    columns: np.ndarray = array.reshape(rows, width).T.ravel()
    return columns
