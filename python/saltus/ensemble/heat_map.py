"""`plot_sweep`: the outcome of a sweep over two parameters, as a heat map."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from saltus._core import known_names
from saltus._status import WELL
from saltus.errors import ModelError
from saltus.results.charts.chart import checked_backend
from saltus.results.tables import extra

__all__ = ["plot_sweep"]

EXTRA = ", or install Saltus with the extra [plotly]"


def plot_sweep(
    swept: Any,
    name: str,
    over: Sequence[str] | None = None,
    *,
    ax: Any = None,
    backend: str = "matplotlib",
    **style: Any,
) -> Any:
    """Draws a number of each run of a sweep over two parameters: a heat map.

    Runs without a value, such as those that failed, are white; the failed ones have a cross.

    Parameters
    ----------
    swept : xarray.Dataset or dict
        What `sweep` returned for a grid.
    name : str
        A number of each run: 'events', 'end_time', 'steps', a recorded signal, or a value of
        `reduce`. It must have two dimensions that are longer than one; choose from others with
        ``swept.isel(time=-1)`` first.
    over : (str, str), optional
        The parameters of the horizontal and of the vertical axis. A dict needs them; of a Dataset
        by default the dimensions, the first one across.
    ax : matplotlib Axes, optional
        By default those of a new figure.
    backend : {'matplotlib', 'plotly'}
        The library that draws.
    **style
        Passed on to matplotlib's `pcolormesh`, or plotly's `Heatmap`.

    Returns
    -------
    Axes, or plotly Figure

    Raises
    ------
    ModelError
        If there is no such name, it has not two dimensions, or an axis has other than numbers.
    ImportError
        If the library is not installed; it says how to install it.

    Examples
    --------
    >>> import saltus
    >>> ball = saltus.scene("bouncing-ball").system
    >>> grid = {"e": [0.5, 0.7, 0.9], "x[0]": [5.0, 10.0]}
    >>> axes = saltus.plot_sweep(saltus.sweep(ball, grid, (0.0, 3.0)), "events")
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('e', 'x[0]')
    """
    checked_backend(backend, ax)
    dims, values = _values(swept, name, over)
    x, y = (_axis(swept, dim, size) for dim, size in zip(dims, values.shape, strict=True))
    failed = _failed(swept, values.shape)
    if over is not None and (dims[1], dims[0]) == tuple(over):
        dims, values, x, y, failed = dims[::-1], values.T, y, x, failed.T
    draw = _by_matplotlib if backend == "matplotlib" else _by_plotly
    return draw(dims, name, x, y, values.T, failed.T, ax, style)


def _values(
    swept: Any, name: str, over: Sequence[str] | None
) -> tuple[tuple[str, ...], np.ndarray]:
    """The two dimensions of a variable, and its values over them."""
    if over is not None and (isinstance(over, str) or len(over) != 2 or over[0] == over[1]):
        raise ModelError(f"plot_sweep: over: expected two parameters, found {over!r}")
    if name not in swept:
        names = [str(key) for key in swept if key != "attrs"]
        raise ModelError(f"plot_sweep: no value {name!r}{known_names(str(name), names)}")
    array = np.asarray(swept[name])
    dims = _dims(swept, name, array, over)
    long = [i for i, size in enumerate(array.shape) if size > 1 or dims[i] in (over or ())]
    if len(long) != 2 or array.dtype.kind not in "fiub":
        shape = ", ".join(f"{d}: {n}" for d, n in zip(dims, array.shape, strict=True))
        raise ModelError(
            f"plot_sweep: expected numbers over two parameters, found '{name}' over ({shape}); "
            "choose one entry of the others first"
        )
    kept = tuple(dims[i] for i in long)
    for wanted in over or ():
        if wanted not in kept:
            raise ModelError(f"plot_sweep: over: no {wanted!r}{known_names(wanted, list(kept))}")
    others = [i for i in range(array.ndim) if i not in long]
    return kept, np.squeeze(array.astype(float), axis=tuple(others))


def _dims(swept: Any, name: str, array: np.ndarray, over: Sequence[str] | None) -> tuple[str, ...]:
    if not isinstance(swept, Mapping) or hasattr(swept, "dims"):
        return tuple(str(dim) for dim in swept[name].dims)
    if over is None:
        raise ModelError(
            "plot_sweep: a dict does not know its dimensions: give over=('e', 'g'), in any order, "
            "or sweep into a Dataset"
        )
    for dim in over:
        if dim not in swept or np.ndim(swept[dim]) != 1:
            names = [key for key, a in swept.items() if key != "attrs" and np.ndim(a) == 1]
            raise ModelError(f"plot_sweep: over: no {dim!r}{known_names(dim, names)}")
    order = [key for key in swept if key in over]  # that of the grid
    sizes = [len(swept[dim]) for dim in order]
    if array.ndim < 2 or list(array.shape[:2]) != sizes:
        raise ModelError(
            f"plot_sweep: expected '{name}' over {tuple(order)}, of shape {tuple(sizes)}, found "
            f"{array.shape}"
        )
    return (*order, *(f"axis {i}" for i in range(2, array.ndim)))


def _axis(swept: Any, dim: str, size: int) -> np.ndarray:
    values = np.asarray(swept[dim]) if dim in swept else np.arange(size)
    if values.dtype.kind not in "fiu":
        raise ModelError(f"plot_sweep: expected numbers of '{dim}', found {values[0]!r}")
    return values.astype(float)


def _failed(swept: Any, shape: tuple[int, ...]) -> np.ndarray:
    """Which runs did not end well."""
    status = np.squeeze(np.asarray(swept["status"])) if "status" in swept else np.full(shape, "")
    if status.shape != shape:
        return np.zeros(shape, dtype=bool)
    return ~np.isin(status.astype(str), [*WELL, ""])


def _by_matplotlib(
    dims: tuple[str, ...], name: str, x: np.ndarray, y: np.ndarray, values: np.ndarray,
    failed: np.ndarray, ax: Any, style: dict[str, Any],
) -> Any:  # fmt: skip
    if ax is None:
        plt = extra("matplotlib.pyplot", "plot_sweep", ", or install Saltus with the extra [plot]")
        _, ax = plt.subplots(figsize=(5.6, 4.0), layout="constrained")
    across, up = np.argsort(x), np.argsort(y)
    mesh = np.ma.masked_invalid(values[np.ix_(up, across)])
    drawn = ax.pcolormesh(
        x[across], y[up], mesh, **({"shading": "nearest", "rasterized": True} | style)
    )
    rows, columns = np.nonzero(failed)
    if len(rows):
        ax.plot(x[columns], y[rows], "x", color="#b3261e", markersize=5)
    ax.figure.colorbar(drawn, ax=ax, label=name)
    ax.set_xlabel(dims[0])
    ax.set_ylabel(dims[1])
    return ax


def _by_plotly(
    dims: tuple[str, ...], name: str, x: np.ndarray, y: np.ndarray, values: np.ndarray,
    failed: np.ndarray, ax: Any, style: dict[str, Any],
) -> Any:  # fmt: skip
    from saltus.results.charts.by_plotly import AXIS, figure

    objects = extra("plotly.graph_objects", "backend='plotly'", EXTRA)
    look = {"colorscale": "Viridis", "colorbar": {"title": {"text": name}}} | style
    axes = [{**AXIS, "title": {"text": dim}} for dim in dims]
    drawn = figure(xaxis=axes[0], yaxis=axes[1])
    drawn.add_trace(objects.Heatmap(x=x, y=y, z=values, **look))
    rows, columns = np.nonzero(failed)
    if len(rows):
        marks = {"symbol": "x-thin-open", "color": "#b3261e", "size": 8}
        drawn.add_trace(objects.Scatter(x=x[columns], y=y[rows], mode="markers", marker=marks))
    return drawn
