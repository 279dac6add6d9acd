"""What counts as a whole number."""

from __future__ import annotations

from typing import TypeGuard

import numpy as np

__all__ = ["is_whole"]


def is_whole(value: object) -> TypeGuard[int]:
    """Whether the value is an `int` of Python or NumPy. `True` is no number."""
    return isinstance(value, (int, np.integer)) and not isinstance(value, bool)
