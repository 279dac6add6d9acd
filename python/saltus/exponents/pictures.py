"""Pictures of Lyapunov exponents, by matplotlib."""

from __future__ import annotations

from typing import Any

import numpy as np

__all__ = ["draw_history"]


def draw_history(
    times: np.ndarray, history: np.ndarray, errors: np.ndarray, ax: Any, style: dict[str, Any]
) -> Any:
    """Draws the running averages for `LyapunovSpectrum.plot`, with bands of two errors."""
    ax = ax or _axes()
    for i, column in enumerate(history.T):
        value = column[-1]
        if not np.isfinite(value):
            continue
        (line,) = ax.plot(times, column, **({"linewidth": 1.2} | style), label=f"{value:.4g}")
        width = 2.0 * errors[i] if np.isfinite(errors[i]) else 0.0
        ax.axhspan(value - width, value + width, color=line.get_color(), alpha=0.15, linewidth=0)
    ax.set(xlabel="time [s]", ylabel="exponents [1/s]")
    ax.legend(title="at the end", frameon=False)
    ax.spines[["top", "right"]].set_visible(False)
    return ax


def _axes() -> Any:
    import matplotlib.pyplot as plt

    return plt.subplots(layout="constrained")[1]
