"""Results as tables of pandas and xarray."""

from __future__ import annotations

import importlib
from collections.abc import Iterable
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus._entries import dimension_names, entries
from saltus.errors import ModelError

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped,import-not-found,unused-ignore]
    import xarray  # type: ignore[import-not-found,unused-ignore]

    from saltus.results.outcome import Results

__all__ = ["extra", "to_pandas", "to_xarray", "write_csv"]


def extra(library: str, what: str, instead: str = "") -> Any:
    """A library that `what` needs and that comes with an extra of the package. If it is not
    installed, raises an ImportError that says so, and what to do `instead`. A module of a library,
    such as scipy.optimize, comes with the library.
    """
    try:
        return importlib.import_module(library)
    except ImportError:
        name = library.partition(".")[0]
        raise ImportError(
            f"{what} needs {name}, which is not installed: pip install {name}{instead}"
        ) from None


def columns_of(results: Results, taken: Iterable[str] = ()) -> dict[str, np.ndarray]:
    """The recorded signals, each entry of a vector or a matrix by itself. ModelError if two columns
    would have one name, or a name that is `taken`.
    """
    columns: dict[str, np.ndarray] = {}
    for name, array in results.outputs.items():
        for column, part in entries(name, array):
            if column in columns or column in taken:
                raise ModelError(
                    f"two columns would be called '{column}'; record the signal by another name"
                )
            columns[column] = part
    return columns


def write_csv(results: Results, path: str | PathLike[str]) -> None:
    import csv  # which few scripts need

    columns = {"time": results.time, "jump": results.jump}
    columns |= columns_of(results, columns)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*(column.tolist() for column in columns.values()), strict=True))


def to_pandas(results: Results) -> pandas.DataFrame:
    library = extra("pandas", "to_pandas")
    index = library.MultiIndex.from_arrays([results.time, results.jump], names=["time", "jump"])
    frame: pandas.DataFrame = library.DataFrame(columns_of(results), index=index)
    return frame


def _attributes(results: Results, name: str) -> dict[str, str]:
    """The unit, if all entries of the signal have the same."""
    units = results.units.get(name, "")
    unit = units if isinstance(units, str) else units[0] if len(set(units)) == 1 else ""
    return {"units": unit} if unit else {}


def to_xarray(results: Results) -> xarray.Dataset:
    library = extra("xarray", "to_xarray")
    signals = {
        name: (("time", *dimension_names(name, array.ndim - 1)), array, _attributes(results, name))
        for name, array in results.outputs.items()
    }
    coordinates = {"time": ("time", results.time, {"units": "s"}), "jump": ("time", results.jump)}
    dataset: xarray.Dataset = library.Dataset(signals, coordinates, {"status": results.status})
    return dataset
