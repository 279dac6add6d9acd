"""The outcomes of runs: a column for each kind of value, a row for each run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from saltus import _core

__all__ = ["NOT_RUN", "PLAIN", "STATUS", "WIDE", "Columns", "empty", "failed", "join"]

Columns = dict[str, Any]
"""'status', 'end_time', 'wall_time', 'events', 'steps': one value a run; 'continuous_state',
'discrete_state', 'modes': a row a run; 'signals': of each name an array, runs first; 'reasons':
(message, block) by run; 'reduced': what `reduce` gave, by run; 'names': of states and blocks
"""
NOT_RUN = -1
STATUS = np.array([*_core.status_names(), "not_run"])  # the numbers of statuses; -1 is the last one
PLAIN = {"status": NOT_RUN, "end_time": np.nan, "wall_time": np.nan, "events": 0, "steps": 0}
WIDE = {"continuous_state": np.nan, "discrete_state": np.nan, "modes": 0}


def empty(runs: int) -> Columns:
    """The columns of runs that were not made."""
    columns: Columns = {name: np.full(runs, nothing) for name, nothing in PLAIN.items()}
    columns |= {name: np.full((runs, 0), nothing) for name, nothing in WIDE.items()}
    return columns | {"signals": {}, "reasons": {}, "reduced": {}, "names": {}}


def failed(runs: int, reason: str) -> Columns:
    """The columns of runs that failed before they began."""
    columns = empty(runs)
    columns["status"][:] = list(STATUS).index("failed")
    columns["reasons"] = {run: (reason, "") for run in range(runs)}
    return columns


def _wide(arrays: Sequence[np.ndarray], shape: tuple[int, ...], nothing: float) -> np.ndarray:
    """Puts arrays under one another, each filled up to `shape` with `nothing`."""
    total = sum(len(array) for array in arrays)
    whole = np.full((total, *shape), nothing, dtype=np.result_type(*arrays))
    first = 0
    for array in arrays:
        rows = slice(first, first + len(array))
        place = (rows, *(slice(0, n) for n in array.shape[1:]))
        whole[place] = array
        first += len(array)
    return whole


def _widest(arrays: Sequence[np.ndarray]) -> tuple[int, ...]:
    deepest = max(array.ndim for array in arrays)
    return tuple(
        max(array.shape[i] for array in arrays if array.ndim == deepest) for i in range(1, deepest)
    )


def _signal(name: str, parts: Sequence[Columns]) -> np.ndarray:
    """A signal of all parts; nan for a part without the signal."""
    shape = _widest([part["signals"][name] for part in parts if name in part["signals"]])
    arrays = [
        part["signals"].get(name, np.full((len(part["status"]), *shape), np.nan)) for part in parts
    ]
    return _wide(arrays, shape, np.nan)


def _by_run(name: str, parts: Sequence[Columns]) -> dict[int, Any]:
    joined: dict[int, Any] = {}
    first = 0
    for part in parts:
        joined |= {first + run: value for run, value in part[name].items()}
        first += len(part["status"])
    return joined


def _longest(parts: Sequence[Columns]) -> Mapping[str, list[str]]:
    """Names of the states, from the part that has most."""
    kinds = dict.fromkeys(kind for part in parts for kind in part["names"])
    return {kind: max((p["names"].get(kind, []) for p in parts), key=len) for kind in kinds}


def join(parts: Sequence[Columns]) -> Columns:
    """Joins columns one after the other. If systems differ in size, nan fills up the smaller
    ones.
    """
    if len(parts) == 1:
        return parts[0]
    columns: Columns = {name: np.concatenate([p[name] for p in parts]) for name in PLAIN}
    for name, nothing in WIDE.items():
        arrays = [part[name] for part in parts]
        columns[name] = _wide(arrays, _widest(arrays), nothing)
    signals = dict.fromkeys(name for part in parts for name in part["signals"])
    columns["signals"] = {name: _signal(name, parts) for name in signals}
    columns |= {name: _by_run(name, parts) for name in ("reasons", "reduced")}
    return columns | {"names": _longest(parts)}
