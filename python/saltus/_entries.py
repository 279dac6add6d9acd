"""The entries of a signal: a number, a vector or a matrix, and how each entry is called."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

__all__ = ["dimension_names", "entries", "entry_names"]


def entry_names(name: str, shape: Sequence[int]) -> list[str]:
    """The names of all entries, in the order in which they are stored: 'y' of a number, 'y[0]',
    'y[1]' of a vector, 'y[0,0]', 'y[0,1]' of a matrix.
    """
    if len(shape) == 0:
        return [name]
    return [f"{name}[{','.join(map(str, place))}]" for place in np.ndindex(*shape)]


def entries(name: str, rows: Any, before: int = 1) -> Iterator[tuple[str, np.ndarray]]:
    """Each entry by its name, with its column. The first `before` axes of `rows` count the rows."""
    array = np.asarray(rows)
    shape = array.shape[before:]
    flat = array.reshape(*array.shape[:before], int(np.prod(shape, dtype=int)))
    for i, label in enumerate(entry_names(name, shape)):
        yield label, flat[..., i]


def dimension_names(name: str, dimensions: int) -> tuple[str, ...]:
    """The names of the axes of a signal behind those of its rows: none of a number, 'y_entry' of a
    vector, 'y_row' and 'y_column' of a matrix.
    """
    return {0: (), 1: (f"{name}_entry",), 2: (f"{name}_row", f"{name}_column")}[dimensions]
