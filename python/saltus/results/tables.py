"""Results as tables of pandas and xarray."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped,import-not-found,unused-ignore]
    import xarray  # type: ignore[import-not-found,unused-ignore]

    from saltus.results.outcome import Results

__all__ = ["to_pandas", "to_xarray"]


def to_pandas(results: Results) -> pandas.DataFrame:
    import pandas

    columns = {}
    for name, array in results.outputs.items():
        if array.ndim == 1:
            columns[name] = array
        else:
            columns.update({f"{name}[{i}]": array[:, i] for i in range(array.shape[1])})
    index = pandas.MultiIndex.from_arrays([results.time, results.jump], names=["time", "jump"])
    return pandas.DataFrame(columns, index=index)


def to_xarray(results: Results) -> xarray.Dataset:
    import xarray

    signals = {
        name: (("time",) if array.ndim == 1 else ("time", f"{name}_entry"), array)
        for name, array in results.outputs.items()
    }
    coordinates = {"time": ("time", results.time, {"units": "s"}), "jump": ("time", results.jump)}
    return xarray.Dataset(signals, coordinates, {"status": results.status})
