"""A recorded number by its name, over the rows or at chosen times."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from saltus._core import known_names
from saltus._entries import entry_names
from saltus._whole import is_whole
from saltus.errors import ModelError
from saltus.results.curves import Curve, curves_of

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["Which", "curve", "label_of", "labels_of", "number_at", "with_unit"]

Which = str | int


def labels_of(results: Results) -> list[str]:
    """The names of all recorded numbers: 'y', 'y[0]', ... of a vector, 'y[0,0]', ... of
    a matrix."""
    if not results.outputs:
        raise ModelError(
            "nothing was recorded, so there is nothing to draw: give recorded_signals="
            "['block.port'] to the run, or the system an output"
        )
    labels = []
    for name, array in results.outputs.items():
        labels += entry_names(name, array.shape[1:])
    return labels


def label_of(results: Results, which: Which) -> str:
    """The name of a recorded number. ModelError if there is none."""
    labels = labels_of(results)
    if is_whole(which):
        if 0 <= which < len(labels):
            return labels[which]
        raise ModelError(
            f"expected the number of an entry from 0 to {len(labels) - 1}, found {which}: "
            f"{', '.join(labels)} {'were' if len(labels) > 1 else 'was'} recorded"
        )
    if which not in labels:
        raise ModelError(f"nothing was recorded under {which!r}{known_names(str(which), labels)}")
    return str(which)


def with_unit(results: Results, label: str) -> str:
    """The name of a recorded number with its unit: 'height [m]'."""
    known = results._quantities
    if label in results.outputs:  # a signal may have the name of an entry of another one
        known = {label: known[label]} if label in known else {}
    for name, one in known.items():
        labels = entry_names(name, results.outputs[name].shape[1:])
        if any(one.units) and label in labels:
            unit = one.units[labels.index(label)]
            return f"{label} [{unit}]" if unit else label
    return label


def curve(results: Results, which: Which) -> Curve:
    """The curve of a recorded number, with gaps where it jumps."""
    label = label_of(results, which)
    return next(c for group in curves_of(results).values() for c in group if c.label == label)


def number_at(results: Results, which: Which, times: np.ndarray, side: str) -> np.ndarray:
    """A recorded number at the times of events, before or after them."""
    place = labels_of(results).index(label_of(results, which))
    if results.dense and not _in_rows(results, times):
        values = results(times, side=side)
        return _flat([values[name] for name in results.outputs], len(times))[:, place]
    rows = np.searchsorted(results.time, times, side="right") - 1
    if side == "left":
        rows = np.searchsorted(results.time, times, side="left")
    return _flat([array[rows] for array in results.outputs.values()], len(times))[:, place]


def _in_rows(results: Results, times: np.ndarray) -> bool:
    return bool(np.isin(times, results.time).all())


def _flat(arrays: list[np.ndarray], count: int) -> np.ndarray:
    return np.hstack([np.asarray(a, dtype=float).reshape(count, -1) for a in arrays])
