"""The data of one experiment as columns over time, from a dict, pandas or xarray."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus.errors import ModelError
from saltus.fitting.experiment import EventTimes

__all__ = ["Columns", "columns_of", "sigma_of"]

EXPECTED = (
    "expected a dict with 'time' and signals, a pandas.DataFrame with a column or an index "
    "'time', or an xarray.Dataset over 'time'"
)


@dataclass(frozen=True)
class Columns:
    """Times, signals at these times, and times of events."""

    time: np.ndarray
    """[s] finite; in any order, and some may be equal"""
    signals: dict[str, np.ndarray]
    """by name: a value or a vector for each time; nan where one is missing"""
    events: dict[str, EventTimes]


def columns_of(where: str, data: Any) -> Columns:
    """The columns of any kind of data. `where` begins the message of an error."""
    signals = {str(name): values for name, values in _mapping(where, data).items()}
    events = {name: v for name, v in signals.items() if isinstance(v, EventTimes)}
    signals = {name: v for name, v in signals.items() if name not in events}
    if "time" not in signals and signals:
        raise ModelError(f"{where}: the data have no 'time'; {EXPECTED}")
    time = _numbers(f"{where}: 'time'", signals.pop("time", []))
    _require_times(where, time)
    jump = signals.pop("jump", None)
    columns = {name: _column(where, name, values, time) for name, values in signals.items()}
    if not columns and not events:
        raise ModelError(f"{where}: the data have no signal and no event; {EXPECTED}")
    if jump is not None:
        time, columns = _after_events(time, np.asarray(jump), columns)
    return Columns(time, columns, events)


def _require_times(where: str, time: np.ndarray) -> None:
    what = f"{where}: 'time': expected a list of finite times [s]"
    if time.ndim != 1:
        raise ModelError(f"{what}, found the shape {time.shape}")
    wrong = np.flatnonzero(~np.isfinite(time))
    if len(wrong):
        raise ModelError(
            f"{what}, found {time[wrong[0]]} in row {wrong[0]}"
            f"{_more(len(wrong))}; leave the row out. A value without a time cannot count; nan is a "
            "missing value in the other columns"
        )


def _more(count: int) -> str:
    return "" if count == 1 else f" and in {count - 1} more"


def _mapping(where: str, data: Any) -> dict[Any, Any]:
    if hasattr(data, "data_vars") and hasattr(data, "coords"):  # an xarray.Dataset
        return _of_dataset(where, data)
    if hasattr(data, "columns") and hasattr(data, "index"):  # a pandas.DataFrame
        named = {name: data.index.get_level_values(name) for name in data.index.names if name}
        if set(named) & set(data.columns):
            raise ModelError(f"{where}: 'time' is a column and an index; remove one of them")
        return {**named, **{name: data[name] for name in data.columns}}
    if isinstance(data, Mapping):
        return dict(data)
    raise ModelError(f"{where}: {EXPECTED}, found {data!r}")


def _of_dataset(where: str, data: Any) -> dict[Any, Any]:
    if "time" not in data.coords:
        raise ModelError(f"{where}: the data have no coordinate 'time'; {EXPECTED}")
    columns: dict[Any, Any] = {"time": data["time"].values}
    if "jump" in data.coords:
        columns["jump"] = data["jump"].values
    for name, variable in data.data_vars.items():
        if "time" not in variable.dims:
            raise ModelError(
                f"{where}: '{name}' has no dimension 'time'; select the signals: data[['y']]"
            )
        columns[name] = variable.transpose("time", ...).values
    return columns


def _column(where: str, name: str, values: Any, time: np.ndarray) -> np.ndarray:
    column = _numbers(f"{where}: '{name}'", values)
    if column.ndim not in (1, 2, 3) or len(column) != len(time):
        raise ModelError(
            f"{where}: '{name}': expected a value, a vector or a matrix for each of {len(time)} "
            f"times, found the shape {column.shape}"
        )
    if np.isinf(column).any():
        raise ModelError(f"{where}: '{name}' is infinite at t = {_first(column, time):g} s; "
                         "write nan for a missing value")  # fmt: skip
    return column


def _first(column: np.ndarray, time: np.ndarray) -> float:
    rows = np.isinf(column).reshape(len(column), -1).any(axis=1)
    return float(time[np.flatnonzero(rows)[0]])


def _after_events(
    time: np.ndarray, jump: np.ndarray, columns: dict[str, np.ndarray]
) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Of rows before and after an event, as `Results` has them, the last one of each time."""
    order = np.lexsort((jump, time))
    rows = order[np.append(np.diff(time[order]) > 0.0, True)] if len(time) else order
    return time[rows], {name: column[rows] for name, column in columns.items()}


def _numbers(what: str, values: Any) -> np.ndarray:
    try:
        return np.array(values, dtype=float, order="C")
    except (TypeError, ValueError):
        raise ModelError(f"{what}: expected numbers, found {values!r}") from None


def sigma_of(where: str, sigma: Any, name: str, column: np.ndarray) -> np.ndarray:
    """The standard deviation of each value of a column, 1 if none is given."""
    given = sigma.get(name) if isinstance(sigma, Mapping) else sigma
    if isinstance(given, (bool, np.bool_)):
        raise ModelError(f"{where}: sigma of '{name}': expected a number, found {given}")
    values = _numbers(f"{where}: sigma of '{name}'", 1.0 if given is None else given)
    if values.ndim == 1 and column.ndim == 2 and len(values) == len(column) != column.shape[1]:
        values = values[:, None]
    try:
        full = np.broadcast_to(values, column.shape)
    except ValueError:
        raise ModelError(
            f"{where}: sigma of '{name}': expected a number or the shape {column.shape} of the "
            f"data, found the shape {values.shape}"
        ) from None
    wrong = np.isfinite(column) & ~(np.isfinite(full) & (full > 0.0))
    if wrong.any():
        at = "" if values.ndim == 0 else f" in row {np.argwhere(wrong)[0][0]}"
        raise ModelError(
            f"{where}: sigma of '{name}': expected finite standard deviations above 0, found "
            f"{full[wrong][0]:g}{at}; a value that should not count is nan in the data"
        )
    return full
