"""The places at which a fit begins: one, or several by a Latin hypercube within the bounds."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus._whole import is_whole
from saltus.errors import ModelError
from saltus.fitting.coordinates import Coordinates

__all__ = ["starts_of"]


def starts_of(coordinates: Coordinates, count: Any, seed: Any) -> list[np.ndarray]:
    """The start of the user, then `count` - 1 drawn ones: each parameter has one of them in each of
    `count` - 1 equal parts of its bounds (McKay, Beckman and Conover, Technometrics 21, 1979), of a
    logarithm in equal factors.
    """
    if not is_whole(count) or count < 1:
        raise ModelError(f"fit: starts: expected a number of starts, 1 or more, found {count!r}")
    if count == 1:
        return [coordinates.start]
    lower, upper = coordinates.lower, coordinates.upper
    open_ones = np.flatnonzero(~(np.isfinite(lower) & np.isfinite(upper)))
    if len(open_ones):
        names = ", ".join(f"'{coordinates.labels[k]}'" for k in open_ones)
        raise ModelError(
            f"fit: starts={count} are drawn between the bounds, and {names} has none, or 0 with "
            "log=True; give a lower and an upper bound"
        )
    try:
        draw = np.random.default_rng(seed)
    except (TypeError, ValueError):
        raise ModelError(f"fit: seed: expected an integer, found {seed!r}") from None
    parts = count - 1
    cells = np.column_stack([draw.permutation(parts) for _ in lower])
    share = (cells + draw.random(cells.shape)) / parts
    return [coordinates.start, *(lower + share * (upper - lower))]
