"""`Chart`: what a picture shows, before a library draws it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from saltus._core import known_names
from saltus.errors import ModelError

__all__ = ["BACKENDS", "COLOURS", "Chart", "Layer", "checked_backend"]

BACKENDS = ("matplotlib", "plotly")
COLOURS = ("#1f77b4", "#ff7f0e", "#2ca02c", "#d62728", "#9467bd", "#8c564b", "#e377c2", "#7f7f7f",
           "#bcbd22", "#17becf")  # fmt: skip
"""matplotlib's usual ten"""


@dataclass(frozen=True)
class Layer:
    """Points that are drawn alike; a nan is a gap."""

    x: np.ndarray
    y: np.ndarray
    kind: str
    """'line', 'jump' (a dashed line), 'hollow', 'filled', 'square', 'tick' or 'bar'"""
    colour: int = 0
    """the number of the colour"""
    label: str = ""


@dataclass(frozen=True)
class Chart:
    """A picture with one pair of axes."""

    x_label: str
    y_label: str
    layers: list[Layer]
    x_log: bool = False
    y_log: bool = False
    backwards: bool = False
    """whether x decreases to the right"""
    span: tuple[float, float] | None = None
    """begin and end of x; by default those of the layers"""
    rows: list[str] = field(default_factory=list)
    """names of the rows y = 0, 1, ... from the top, in place of a scale"""


def checked_backend(backend: str, ax: Any) -> None:
    """ModelError for an unknown backend, and for axes of matplotlib with another one."""
    if backend not in BACKENDS:
        raise ModelError(f"backend: unknown {backend!r}{known_names(str(backend), list(BACKENDS))}")
    if backend == "plotly" and ax is not None:
        raise ModelError("ax: these are axes of matplotlib; with backend='plotly' leave them out")
