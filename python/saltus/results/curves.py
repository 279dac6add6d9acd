"""Curves between jumps: the parts of a picture of a signal."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from saltus._entries import entries

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["Curve", "curves_of", "holds_of", "refined"]

BETWEEN = 24  # points drawn within a step, from dense output
MOST = 20_000  # points in all, if there are fewer steps
ROUNDING = 1e-9  # part of the range of a curve; a smaller step is invisible


@dataclass(frozen=True)
class Curve:
    """One number over time, with gaps where it jumps."""

    label: str
    time: np.ndarray
    value: np.ndarray
    """nan in each gap"""
    before: np.ndarray
    """rows of (time, value) before each jump"""
    after: np.ndarray
    """rows of (time, value) after each jump"""


def _times_between(results: Results) -> np.ndarray:
    """[s] The times at which dense output is evaluated: inside each step, and never at a row."""
    joints = results._core.joints
    each = int(np.clip(MOST // len(joints), 1, BETWEEN))
    share = np.arange(each) / each
    times = (joints[:-1, None] + np.diff(joints)[:, None] * share).ravel()
    return np.setdiff1d(times, results.time)


def refined(results: Results) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
    """The times, jumps and signals of the rows, with the values of dense output between them."""
    if not results.dense or len(results.time) < 2:
        return results.time, results.jump, dict(results.outputs)
    time, more = results.time, _times_between(results)
    at = np.searchsorted(time, more)
    values = results(more)
    columns = {
        name: np.insert(array, at, values[name], axis=0) for name, array in results.outputs.items()
    }
    return (
        np.insert(time, at, more),
        np.insert(results.jump, at, results.jump[np.maximum(at - 1, 0)]),
        columns,
    )


def _curve(label: str, time: np.ndarray, jump: np.ndarray, value: np.ndarray) -> Curve:
    finite = value[np.isfinite(value)]
    visible = ROUNDING * np.ptp(finite) if finite.size else 0.0
    leap = (np.diff(jump) > 0) & (np.diff(time) == 0) & (np.abs(np.diff(value)) > visible)
    at = np.flatnonzero(leap) + 1
    return Curve(
        label,
        np.insert(time, at, time[at]),
        np.insert(value.astype(float), at, np.nan),
        np.column_stack([time[at - 1], value[at - 1]]),
        np.column_stack([time[at], value[at]]),
    )


def curves_of(results: Results) -> dict[str, list[Curve]]:
    """The curves of every recorded signal, one for each of its numbers."""
    if results._core.apart:
        return {
            name: _curves(name, results.time_of(name), results.jump_of(name), array)
            for name, array in results.outputs.items()
        }
    time, jump, columns = refined(results)
    return {name: _curves(name, time, jump, array) for name, array in columns.items()}


def _curves(name: str, time: np.ndarray, jump: np.ndarray, array: np.ndarray) -> list[Curve]:
    return [_curve(label, time, jump, column) for label, column in entries(name, array)]


def holds_of(results: Results) -> list[tuple[float, float]]:
    """[s] The spans in which something was at rest on a Zeno hold; overlapping spans are joined."""
    if not results._core.apart and not len(results.time):
        return []
    end = results.context.time if results._core.apart else float(results.time[-1])
    open_since: dict[tuple[str, str, int], float] = {}
    spans = []
    for e in results.events:
        key = (e.block, e.name, e.entry)
        if e.kind == "zeno_enter":
            open_since.setdefault(key, e.time)
        elif e.kind == "zeno_release" and key in open_since:
            spans.append((open_since.pop(key), e.time))
    spans += [(begin, end) for begin in open_since.values()]
    merged: list[tuple[float, float]] = []
    for begin, end in sorted(spans):
        if merged and begin <= merged[-1][1]:
            merged[-1] = (merged[-1][0], max(end, merged[-1][1]))
        elif end > begin:
            merged.append((begin, end))
    return merged
