"""The step response of a linearisation, and its picture beside the poles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus._core import known_names
from saltus.errors import ModelError
from saltus.results.tables import extra

__all__ = ["draw", "horizon", "step"]

POINTS = 600
LARGEST = 1e-9
"""[of the largest pole] a smaller real or imaginary part counts as zero"""
MANY = 8  # names in a legend; more would cover the axes


def step(
    matrices: tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray], times: ArrayLike
) -> np.ndarray:
    """(time, output, input) C x(t) + D with x' = A x + B and x(0) = 0.

    x is the last column of the exponential of [[A, B], [0, 0]] t (C. Van Loan, IEEE Trans. Autom.
    Control 23 (1978) 395), from one time to the next one.
    """
    a, b, c, d = matrices
    n, m = b.shape
    whole = np.zeros((n + m, n + m))
    whole[:n, :n], whole[:n, n:] = a, b
    expm = extra("scipy.linalg", "the step response").expm
    x, before, dt, moved = np.zeros((n, m)), 0.0, np.nan, np.eye(n + m)
    rows = []
    for time in np.asarray(times, dtype=float):
        if time - before != dt:
            dt = time - before
            moved = expm(whole * dt)
        x, before = moved[:n, :n] @ x + moved[:n, n:], time
        rows.append(c @ x + d)
    return np.array(rows).reshape(-1, c.shape[0], m)


def horizon(a: np.ndarray) -> float:
    """[s] A time that shows the slowest motion: 5 time constants, 3 of a growing one, 4 periods of
    an undamped one, or 10 s if nothing moves.
    """
    poles = np.linalg.eigvals(a)
    least = LARGEST * float(np.max(np.abs(poles), initial=0.0))
    grows = poles.real[poles.real > least]
    decays = -poles.real[poles.real < -least]
    turns = np.abs(poles.imag[np.abs(poles.imag) > least])
    if len(grows):
        return 3.0 / float(np.max(grows))
    if len(decays):
        return 5.0 / float(np.min(decays))
    return 8.0 * np.pi / float(np.min(turns)) if len(turns) else 10.0


def draw(
    lin: Any,
    inputs: Sequence[str] | None,
    outputs: Sequence[str] | None,
    t_end: float | None,
    axes: Any,
) -> Any:
    """Draws for `Linearization.plot`."""
    end = horizon(lin.A) if t_end is None else _time(t_end)
    times = np.linspace(0.0, end, POINTS)
    columns, rows = _numbers(inputs, lin.inputs), _numbers(outputs, lin.outputs)
    left, right = _axes() if axes is None else axes
    _poles(left, lin.poles())
    found = step((lin.A, lin.B, lin.C, lin.D), times)
    for j in columns:
        for i in rows:
            right.plot(times, found[:, i, j], label=f"{lin.outputs[i]} by {lin.inputs[j]}")
    _dress(left, right, len(columns) * len(rows))
    return left, right


def _poles(ax: Any, poles: np.ndarray) -> None:
    for line in (ax.axhline, ax.axvline):
        line(0.0, color="0.35", linewidth=0.8, zorder=1)
    ax.plot(poles.real, poles.imag, linestyle="none", marker="x", markersize=7, markeredgewidth=1.6)
    ax.set(xlabel="real part [1/s]", ylabel="imaginary part [1/s]", title="poles")
    ax.margins(0.15)
    across, up = (np.max(np.abs(part), initial=0.0) for part in (poles.real, poles.imag))
    high = max(1.15 * up, 0.5 * across) or 1.0  # real poles need no scale of their own
    ax.set_ylim(-high, high)


def _dress(left: Any, right: Any, curves: int) -> None:
    right.axhline(0.0, color="0.35", linewidth=0.8, zorder=1)
    right.set(xlabel="time [s]", title="response to a step by 1")
    if curves == 1:
        right.set_ylabel(right.get_lines()[0].get_label())
    elif curves <= MANY:
        right.legend(frameon=False, fontsize="small")
    right.margins(x=0.02)
    for ax in (left, right):
        ax.title.set_fontsize("medium")
        ax.spines[["top", "right"]].set_visible(False)


def _axes() -> Any:
    import matplotlib.pyplot as plt

    return plt.subplots(1, 2, figsize=(8.0, 3.4), layout="constrained")[1]


def _numbers(chosen: Sequence[str] | None, names: tuple[str, ...]) -> list[int]:
    if chosen is None:
        return list(range(len(names)))
    if isinstance(chosen, str):
        chosen = [chosen]
    for name in chosen:
        if name not in names:
            raise ModelError(f"plot: there is no '{name}'{known_names(str(name), list(names))}")
    return [names.index(name) for name in chosen]


def _time(end: Any) -> float:
    if not (isinstance(end, (int, float, np.number)) and 0.0 < end < np.inf):
        raise ModelError(f"plot: t_end: expected a positive time, found {end!r}")
    return float(end)
