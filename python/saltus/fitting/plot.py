"""The picture of a fit: data and runs, and the residuals below them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus._core import known_names
from saltus.errors import ModelError
from saltus.results import Results
from saltus.results.curves import curves_of

if TYPE_CHECKING:
    from saltus.fitting.result import Compared

__all__ = ["plot"]

POINTS = {"linestyle": "none", "marker": "o", "markersize": 3.5, "markeredgewidth": 0.0}
MANY = 6  # names in a legend; more would cover the axes


def plot(
    compared: Sequence[Compared], runs: Sequence[Results], names: tuple[str, ...], axes: Any
) -> Any:
    """Draws for `FitResult.plot`."""
    known = list(dict.fromkeys(each.name for each in compared))
    for name in names:
        if name not in known:
            raise ModelError(f"the data have no {name!r}{known_names(str(name), known)}")
    chosen = names or tuple(known)
    axes = _axes(len(chosen)) if axes is None else np.asarray(axes, dtype=object).reshape(2, -1)
    labels = list(dict.fromkeys(each.experiment for each in compared))
    for name, above, below in zip(chosen, axes[0], axes[1], strict=True):
        group = [each for each in compared if each.name == name]
        for each in group:
            k = labels.index(each.experiment)
            _draw(above, below, each, runs[k], k, len(labels))
        _dress(above, below, group[0], len(labels))
    return axes


def _axes(count: int) -> Any:
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(
        2,
        count,
        sharex="col",
        squeeze=False,
        height_ratios=[2.4, 1.0],
        figsize=(max(7.0, 4.2 * count), 4.4),
        layout="constrained",
    )
    axes[0, 0].figure.align_ylabels()
    return axes


def _draw(above: Any, below: Any, each: Compared, run: Results, k: int, runs: int) -> None:
    look = {"label": each.experiment if runs > 1 else "data", "color": f"C{k}"}
    across = each.entry + 1 if each.is_event else each.time
    above.plot(across, each.data, **POINTS, **look, zorder=3)
    if each.is_event:
        above.plot(across, each.model, color=f"C{k}", linewidth=1.2, alpha=0.7)
    else:
        for curve in _curves(each, run):
            above.plot(curve.time, curve.value, color=f"C{k}", linewidth=1.2, alpha=0.7)
    below.plot(across, each.residual, **POINTS, color=f"C{k}")


def _curves(each: Compared, run: Results) -> list[Any]:
    """The curves of the entries that have data."""
    curves = curves_of(run)
    if each.name in curves:
        return [curves[each.name][k] for k in np.unique(each.entry)]
    return [curve for group in curves.values() for curve in group if curve.label == each.name]


def _dress(above: Any, below: Any, one: Compared, runs: int) -> None:
    below.axhline(0.0, color="0.35", linewidth=0.8, zorder=1)
    above.set_ylabel(f"{one.name}: time [s]" if one.is_event else one.name)
    below.set(ylabel="residual", xlabel="number of the event" if one.is_event else "time [s]")
    if 1 < runs <= MANY:
        above.legend(
            loc="lower right",
            bbox_to_anchor=(1.0, 1.0),
            frameon=False,
            ncols=runs,
            fontsize="small",
            borderaxespad=0.1,
        )
    for ax in (above, below):
        ax.spines[["top", "right"]].set_visible(False)
        ax.margins(x=0.02)
