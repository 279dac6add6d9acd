"""Values of all runs: a grid or a table as one column for each name."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus.errors import ModelError

__all__ = ["Table", "table_of"]


@dataclass(frozen=True)
class Table:
    """One column for each name, one value in it for each run."""

    columns: dict[str, list[Any]]
    axes: dict[str, list[Any]]
    """dimensions of the results, in order, with the values along them; {'run': ...} of a table"""
    runs: int

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(len(values) for values in self.axes.values())

    @property
    def is_grid(self) -> bool:
        return not (len(self.axes) == 1 and "run" in self.axes and "run" not in self.columns)

    def part(self, first: int, last: int) -> dict[str, list[Any]]:
        """The columns of the runs `first` to `last` - 1."""
        return {name: column[first:last] for name, column in self.columns.items()}


def table_of(values: object, paired: bool) -> Table:
    """A mapping is a grid, or with `paired` a table of columns; all else is a table."""
    if isinstance(values, Mapping):
        columns = {_name(name): _column(name, column) for name, column in values.items()}
        return _paired(columns) if paired else _grid(columns)
    if hasattr(values, "columns") and hasattr(values, "to_dict"):  # a pandas.DataFrame
        frame: Any = values
        return _paired({_name(name): frame[name].tolist() for name in frame.columns})
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


def _column(name: object, values: object) -> list[Any] | Any:
    """A list; what is no sequence is one value for all runs."""
    if isinstance(values, np.ndarray) or hasattr(values, "tolist"):
        return values.tolist() if np.ndim(values) < 2 else list(np.asarray(values))  # type: ignore[arg-type]
    if isinstance(values, str) or not isinstance(values, Iterable):
        return values
    return list(values)


def _grid(columns: Mapping[str, Any]) -> Table:
    axes = {name: values for name, values in columns.items() if isinstance(values, list)}
    for name, values in axes.items():
        if not values:
            raise ModelError(f"sweep: '{name}' has no values")
    runs = math.prod(len(values) for values in axes.values())
    rows = list(itertools.product(*axes.values()))
    varied = dict(zip(axes, map(list, zip(*rows, strict=True)), strict=True)) if axes else {}
    fixed = {name: [value] * runs for name, value in columns.items() if name not in axes}
    return Table({**varied, **fixed}, axes or {"run": [0]}, runs)


def _paired(columns: Mapping[str, Any]) -> Table:
    lengths = {name: len(c) for name, c in columns.items() if isinstance(c, list)}
    if len(set(lengths.values())) > 1:
        said = ", ".join(f"'{name}' {n}" for name, n in lengths.items())
        raise ModelError(f"sweep: the columns of a table need the same length, found {said}")
    runs = next(iter(lengths.values()), 1)
    if not columns or not runs:
        raise ModelError("sweep: the table has no rows")
    full = {n: c if isinstance(c, list) else [c] * runs for n, c in columns.items()}
    return Table(full, {"run": list(range(runs))}, runs)


def _columns_of(rows: Sequence[object]) -> dict[str, list[Any]]:
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
    return {name: [row[name] for row in rows] for name in names}  # type: ignore[index]
