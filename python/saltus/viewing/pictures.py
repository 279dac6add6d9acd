"""Figures of matplotlib as pictures that stand in a page themselves."""

from __future__ import annotations

import base64
import html
import io
import math
from typing import Any

from saltus._entries import entry_names
from saltus.results.tables import extra

__all__ = ["picture_of", "plots_of"]

MOST = 12  # panels; more would make a page that nobody reads
MANY = 24  # entries of a vector that are drawn
STYLE: dict[Any, Any] = {"font.size": 9, "svg.hashsalt": "saltus", "savefig.facecolor": "white"}


def picture_of(svg: str, words: str, width: str = "") -> str:
    """An SVG as an image: its names cannot meet those of another."""
    data = base64.b64encode(svg.encode()).decode()
    style = f' style="width:{width}"' if width else ""
    return f'<img alt="{html.escape(words)}"{style} src="data:image/svg+xml;base64,{data}">'


def plots_of(results: Any) -> list[str]:
    """The signals over time, the phase portrait of two numbers, the raster of events."""
    matplotlib = extra("matplotlib", "view", ", or install Saltus with the extra [plot]")
    plt = extra("matplotlib.pyplot", "view")
    pictures = []
    with matplotlib.rc_context(STYLE):
        names = _names(results)
        if names:
            results.plot(*names)
            pictures.append(_taken(plt, "Recorded signals over time"))
        if len(_numbers(results)) == 2 and len(results.time) > 1:
            results.plot_phase()
            pictures.append(_taken(plt, "Phase portrait"))
        if len(results.events):
            results.plot_events()
            pictures.append(_taken(plt, "Events over time"))
    return pictures


def _names(results: Any) -> list[str]:
    narrow = [n for n, a in results.outputs.items() if math.prod(a.shape[1:]) <= MANY]
    return narrow[:MOST]


def _numbers(results: Any) -> list[str]:
    return [
        label
        for name, array in results.outputs.items()
        for label in entry_names(name, array.shape[1:])
    ]


def _taken(plt: Any, words: str) -> str:
    """The current figure as a picture; it is closed."""
    figure, text = plt.gcf(), io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)
    svg = text.getvalue()
    return picture_of(svg[svg.index("<svg") :], words)
