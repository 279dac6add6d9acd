"""Values of all runs: a grid or a table as one column for each name."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus.errors import ModelError

__all__ = ["Column", "Table", "entry", "table_of"]


Column = np.ndarray | list[Any]  # an array of numbers; a list of anything else


@dataclass(frozen=True)
class Table:
    """One column for each name, one value in it for each run."""

    columns: dict[str, Column]
    axes: dict[str, Column]
    """dimensions of the results, in order, with the values along them; {'run': ...} of a table"""
    runs: int

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(len(values) for values in self.axes.values())

    @property
    def is_grid(self) -> bool:
        return not (len(self.axes) == 1 and "run" in self.axes and "run" not in self.columns)

    def part(self, first: int, last: int) -> dict[str, Column]:
        """The columns of the runs `first` to `last` - 1."""
        return {name: column[first:last] for name, column in self.columns.items()}


def entry(column: Column, run: int) -> Any:
    """One value; a number of NumPy becomes a number of Python."""
    value = column[run]
    return value.item() if isinstance(value, np.generic) else value


def table_of(values: object, paired: bool) -> Table:
    """A mapping is a grid, or with `paired` a table of columns; all else is a table."""
    if isinstance(values, Mapping):
        columns = {_name(name): _column(column) for name, column in values.items()}
        return _paired(columns) if paired else _grid(columns)
    if hasattr(values, "columns") and hasattr(values, "to_dict"):  # a pandas.DataFrame
        frame: Any = values
        return _paired({_name(name): _column(frame[name].to_numpy()) for name in frame.columns})
    if isinstance(values, Iterable) and not isinstance(values, str):
        return _paired(_columns_of(list(values)))
    raise ModelError(
        "sweep: expected a dict of names and values, a table of columns or a list of dicts, "
        f"found {values!r}"
    )


def _name(name: object) -> str:
    if not isinstance(name, str):
        raise ModelError(f"sweep: expected the name of a parameter or a state, found {name!r}")
    return name


def _column(values: object) -> Column | Any:
    """An array of numbers, or a list of other values. A value that is no sequence is used for all
    runs.
    """
    if isinstance(values, str) or not isinstance(values, Iterable) or np.ndim(values) == 0:  # type: ignore[arg-type]
        return values
    values = values if isinstance(values, np.ndarray) else list(values)
    try:
        array = np.asarray(values)
    except ValueError:  # rows of different lengths
        return list(values)
    return array if array.dtype.kind in "bif" else list(values)


def _is_column(values: object) -> bool:
    return isinstance(values, (np.ndarray, list))


def _taken(column: Column, rows: np.ndarray) -> Column:
    """The entries of a column by number."""
    return column[rows] if isinstance(column, np.ndarray) else [column[row] for row in rows]


def _filled(value: object, runs: int) -> Column:
    number = isinstance(value, (int, float, np.number))
    return np.full(runs, value) if number else [value] * runs


def _grid(columns: Mapping[str, Any]) -> Table:
    axes = {name: values for name, values in columns.items() if _is_column(values)}
    for name, values in axes.items():
        if not len(values):
            raise ModelError(f"sweep: '{name}' has no values")
    shape = [len(values) for values in axes.values()]
    runs = math.prod(shape)
    places = dict(zip(axes, np.indices(shape).reshape(len(shape), runs), strict=True))
    full = {
        name: _taken(values, places[name]) if name in axes else _filled(values, runs)
        for name, values in columns.items()
    }
    return Table(full, axes or {"run": [0]}, runs)


def _paired(columns: Mapping[str, Any]) -> Table:
    lengths = {name: len(c) for name, c in columns.items() if _is_column(c)}
    if len(set(lengths.values())) > 1:
        said = ", ".join(f"'{name}' {n}" for name, n in lengths.items())
        raise ModelError(f"sweep: the columns of a table need the same length, found {said}")
    runs = next(iter(lengths.values()), 1)
    if not columns or not runs:
        raise ModelError("sweep: the table has no rows")
    full = {n: c if _is_column(c) else _filled(c, runs) for n, c in columns.items()}
    return Table(full, {"run": list(range(runs))}, runs)


def _columns_of(rows: Sequence[Any]) -> dict[str, Any]:
    names: list[str] = []
    for i, row in enumerate(rows):
        if not isinstance(row, Mapping):
            raise ModelError(
                f"sweep: expected a dict of names and values as row {i}, found {row!r}"
            )
        if i == 0:
            names = [_name(name) for name in row]
        elif set(row) != set(names):
            missing = sorted(map(str, set(names) ^ set(row)))
            raise ModelError(f"sweep: row {i} names other values than row 0: {', '.join(missing)}")
    return {name: _column([row[name] for row in rows]) for name in names}
