"""Columns as an xarray.Dataset, or as a dict of arrays."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from saltus._entries import dimension_names
from saltus._status import WELL
from saltus.ensemble.columns import STATUS, Columns
from saltus.ensemble.table import Table
from saltus.errors import ModelError
from saltus.results.tables import extra

__all__ = [
    "Arrays",
    "arrays_of",
    "refuse_reserved",
    "summary",
    "to_dataset",
    "to_dict",
    "xarray",
]

Arrays = dict[str, tuple[tuple[str, ...], np.ndarray]]
"""Each name with its dimensions and its values; the dimensions of the runs come first."""

RESERVED = {"status", "message", "block", "events", "steps", "end_time", "wall_time",
            "continuous_state", "discrete_state", "modes", "time", "run"}  # fmt: skip


def xarray() -> Any:
    """The library; an ImportError with advice if it is not installed."""
    return extra("xarray", "sweep", ", or ask for a dict of numpy arrays with as_dict=True")


def refuse_reserved(varied: Iterable[str], signals: Iterable[str]) -> None:
    """Raises ModelError for a name that the results need themselves."""
    for name in signals:
        if name in RESERVED or name in varied:
            raise ModelError(
                f"sweep: recorded signal '{name}': this name is taken; give another, as "
                f"recorded_signals={{'{name}_': ...}} does in Python, or record = "
                f"{{ {name}_ = ... }} in a scene file"
            )
    for name in varied:
        if name in RESERVED:
            raise ModelError(
                f"sweep: '{name}' is a name of the results; say it with the name of its block, "
                f"such as 'ball.{name}', or choose another name of the parameter"
            )


def summary(columns: Columns, wall_time: float) -> dict[str, Any]:
    """A summary of the sweep, for the foot of the printed results."""
    kinds, counts = np.unique(columns["status"], return_counts=True)
    by_kind = dict(zip(STATUS[kinds].tolist(), counts.tolist(), strict=True))
    done = sum(by_kind.values()) - by_kind.get("not_run", 0)
    return {
        "runs": sum(by_kind.values()),
        "failures": _failures(by_kind, columns) or "none",
        "wall_time": wall_time,
        "runs_per_second": done / wall_time if wall_time > 0 else float("nan"),
    }


def _failures(by_kind: Mapping[str, int], columns: Columns) -> str:
    """'2 failed (the fuse blew); 1 not_run'."""
    said = []
    for kind, count in by_kind.items():
        if kind in WELL:
            continue
        of_kind = {r: t for r, (t, _) in columns["reasons"].items()
                   if STATUS[columns["status"][r]] == kind}  # fmt: skip
        why = Counter(of_kind.values())
        most = why.most_common(1)[0][0] if why else ""
        more = f", and {len(why) - 1} other reasons" if len(why) > 1 else ""
        said.append(f"{count} {kind}" + (f" ({most}{more})" if most else ""))
    return "; ".join(said)


def _texts(reasons: Mapping[int, tuple[str, str]], which: int, runs: int) -> np.ndarray:
    texts = np.full(runs, "", dtype=object)
    for run, reason in reasons.items():
        texts[run] = reason[which]
    return texts


def arrays_of(columns: Columns, table: Table, reduced: str, save_at: list[float]) -> Arrays:
    """All columns in the shape of the grid. With `reduced`, the values of `reduce` take the place
    of states and signals.
    """
    dims, shape = tuple(table.axes), table.shape
    if not table.is_grid:
        dims, shape = ("run",), (table.runs,)
    arrays: Arrays = {}

    def add(name: str, array: np.ndarray, *more: str) -> None:
        arrays[name] = ((*dims, *more), array.reshape(*shape, *array.shape[1:]))

    if reduced:
        for key, array in _reduced(columns["reduced"], table.runs, reduced).items():
            name = f"reduced_{key}" if key in RESERVED or key in table.columns else key
            add(name, array, *(f"{name}_{i}" for i in range(array.ndim - 1)))
    else:
        _add_values(add, columns, save_at)
    add("status", STATUS[columns["status"]])
    for which, name in enumerate(("message", "block")):
        add(name, _texts(columns["reasons"], which, table.runs))
    for name in ("end_time", "events", "steps", "wall_time"):
        add(name, columns[name])
    return arrays


def _add_values(add: Any, columns: Columns, save_at: list[float]) -> None:
    """Recorded signals, and the states at the end."""
    for name, array in columns["signals"].items():
        more = ["time"] if save_at else []
        add(name, array, *more, *dimension_names(name, array.ndim - 1 - len(more)))
    for name in ("continuous_state", "discrete_state"):
        if columns[name].shape[1]:
            add(name, columns[name], f"{name}_entry")
    if "mode" in columns["names"]:
        add("modes", columns["modes"], "modes_block")


def _reduced(values: Mapping[int, Any], runs: int, name: str) -> dict[str, np.ndarray]:
    """The values of `reduce` by name: the keys of a dict, or one name for a number or an array."""
    rows = {run: v if isinstance(v, Mapping) else {name: v} for run, v in values.items()}
    found: dict[str, np.ndarray] = {}
    for key in dict.fromkeys(str(key) for row in rows.values() for key in row):
        first = next(np.asarray(row[key]) for row in rows.values() if key in row)
        number = np.issubdtype(first.dtype, np.number) or first.dtype == bool
        kind = np.result_type(first.dtype, float) if number else object
        column = np.full((runs, *first.shape), np.nan if number else None, dtype=kind)
        for run, row in rows.items():
            if key in row:
                _put(column, run, row[key], key)
        found[key] = column
    return found


def _put(column: np.ndarray, run: int, value: Any, key: str) -> None:
    try:
        column[run] = value
    except (TypeError, ValueError):
        raise ModelError(
            f"sweep: reduce gave '{key}' of another shape in run {run}: expected "
            f"{column.shape[1:] or 'a number'}, found {value!r}"
        ) from None


def _coordinates(columns: Columns, table: Table, save_at: list[float]) -> Arrays:
    """The values of the runs, names of the states, times."""
    found: Arrays = {}
    for name, column in table.columns.items():
        of_axis = table.is_grid and name in table.axes
        values = table.axes[name] if of_axis else column
        dims: tuple[str, ...] = (name,) if of_axis else ("run",)
        if table.is_grid and not of_axis:
            dims, values = (), column[0]
        array = np.asarray(values)
        if array.ndim == len(dims):
            found[name] = (dims, array)
        else:  # vectors or matrices
            axes = dimension_names(name, array.ndim - len(dims))
            found[f"{name}_values"] = ((*dims, *axes), array)
    if not table.is_grid:
        found["run"] = (("run",), np.arange(table.runs))
    if save_at:
        found["time"] = (("time",), np.asarray(save_at))
    states = (("x", "continuous_state_entry"), ("z", "discrete_state_entry"))
    for kind, dim in (*states, ("mode", "modes_block")):
        if columns["names"].get(kind):
            found[dim] = ((dim,), np.array(columns["names"][kind]))
    return found


def to_dataset(
    columns: Columns, table: Table, reduced: str, save_at: list[float], attributes: dict[str, Any]
) -> Any:
    """An xarray.Dataset."""
    variables = arrays_of(columns, table, reduced, save_at)
    used = {dim for dims, _ in variables.values() for dim in dims}
    coordinates = {
        name: value
        for name, value in _coordinates(columns, table, save_at).items()
        if set(value[0]) <= used | _axes_of_values(name.removesuffix("_values"))
    }
    return xarray().Dataset(variables, coordinates, attributes)


def _axes_of_values(name: str) -> set[str]:
    """The axes of the values of a swept vector or matrix."""
    return {*dimension_names(name, 1), *dimension_names(name, 2)}


def to_dict(
    columns: Columns, table: Table, reduced: str, save_at: list[float], attributes: dict[str, Any]
) -> dict[str, Any]:
    """The arrays alone, in the same shapes, by the same names; 'attrs' has the attributes."""
    variables = arrays_of(columns, table, reduced, save_at)
    coordinates = _coordinates(columns, table, save_at)
    return {name: array for name, (_, array) in {**coordinates, **variables}.items()} | {
        "attrs": attributes
    }
