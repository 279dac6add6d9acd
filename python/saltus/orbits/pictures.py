"""Pictures of orbits, by matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from saltus._core import known_names
from saltus.errors import ModelError
from saltus.results import Results

__all__ = ["draw_orbit"]

POINTS = 600


def draw_orbit(
    results: Results,
    names: Sequence[str],
    chosen: tuple[str | int, str | int],
    ax: Any,
    style: dict[str, Any],
) -> Any:
    """Draws the orbit for `PeriodicOrbit.plot`."""
    begin, end = results.span
    jumps = np.unique([e.time for e in results.events if begin < e.time < end])
    first = 0 if len(names) == 1 else _number(chosen[0], names)
    second = 0 if len(names) == 1 else _number(chosen[1], names)
    ax = ax or _axes()
    look, color = {"linewidth": 1.5} | style, None
    last: tuple[float, float] | None = None
    for left, right in zip([begin, *jumps], [*jumps, end], strict=True):
        curve = _piece(results, left, right, None if len(names) == 1 else first, second)
        (line,) = ax.plot(*curve, **(look if color is None else look | {"color": color}))
        color = line.get_color()
        if last is not None:
            ax.plot(
                *zip(last, curve[:, 0], strict=True), color=color, linestyle="--", linewidth=0.8
            )
        else:
            ax.plot(*curve[:, :1], marker="o", color=color, linestyle="none")
        last = tuple(curve[:, -1])
    ax.set_xlabel("time [s]" if len(names) == 1 else names[first])
    ax.set_ylabel(names[second])
    ax.spines[["top", "right"]].set_visible(False)
    return ax


def _piece(
    results: Results, left: float, right: float, first: int | None, second: int
) -> np.ndarray:
    """(2, points) of the curve between two jumps, from the value after to the value before one."""
    times = np.linspace(left, right, POINTS)
    states = np.vstack(
        [
            results(times[:-1], side="right").continuous_state,
            results(times[-1:], side="left").continuous_state,
        ]
    )
    return np.array([times if first is None else states[:, first], states[:, second]])


def _number(state: str | int, names: Sequence[str]) -> int:
    if state in names:
        return list(names).index(str(state))
    if isinstance(state, int) and not isinstance(state, bool) and 0 <= state < len(names):
        return state
    raise ModelError(f"plot: there is no state {state!r}{known_names(str(state), list(names))}")


def _axes() -> Any:
    import matplotlib.pyplot as plt

    return plt.subplots(layout="constrained")[1]
