"""A film as a GIF, by pillow: one palette for all frames, so that only what moves is stored."""

from __future__ import annotations

import io
from collections.abc import Callable
from os import PathLike
from typing import Any

from saltus.results.tables import extra

__all__ = ["write_gif"]

COLOURS = 64
NEARLY_WHITE = 3 * 245  # of 3 * 255; the mean of white and the edges of letters
SAMPLES = 16  # the number of frames from which the palette is made


def write_gif(
    path: str | PathLike[str], show: Callable[[int], Any], count: int, fps: float, dpi: float
) -> None:
    """Writes a GIF that is repeated without end.

    Parameters
    ----------
    show : callable
        ``show(k)`` returns matplotlib's figure with frame k.
    """
    frames = [_frame(show(k), dpi) for k in range(count)]
    palette = _palette(frames[:: max(1, count // SAMPLES)])
    none = extra("PIL.Image", "a GIF").Dither.NONE
    first, *others = [frame.quantize(palette=palette, dither=none) for frame in frames]
    # a GIF counts in hundredths of a second
    duration = max(10.0 * round(100.0 / fps), 20.0)
    first.save(path, format="GIF", save_all=True, append_images=others, duration=duration, loop=0)


def _frame(figure: Any, dpi: float) -> Any:
    image = extra("PIL.Image", "a GIF")
    memory = io.BytesIO()
    figure.savefig(memory, format="png", dpi=dpi)
    return image.open(memory).convert("RGB")


def _palette(frames: list[Any]) -> Any:
    """The colours of these frames, from one picture with all of them."""
    image = extra("PIL.Image", "a GIF")
    width, height = frames[0].size
    strip = image.new("RGB", (width, height * len(frames)))
    for k, frame in enumerate(frames):
        strip.paste(frame, (0, k * height))
    found = strip.quantize(COLOURS)
    colours = found.getpalette()[: 3 * COLOURS]
    # pillow compares colours in steps of 4, so that a colour next to white could take its place
    for i in range(0, len(colours), 3):
        if sum(colours[i : i + 3]) > NEARLY_WHITE:
            colours[i : i + 3] = [255, 255, 255]  # paper is white
    found.putpalette(colours)
    found.load()  # only now the palette is that of the pixels
    return found
