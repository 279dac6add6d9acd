"""Which differences cross zero at an instant, though their own guard fires a rounding later."""

from __future__ import annotations

import math
import sys
from typing import Any

import numpy as np

from saltus.sbml.formula import evaluated

__all__ = ["SAME_TIME", "crossing"]

SAME_TIME = 1e-12
"""relative; due times closer than this are one: a located time has some hundred roundings"""
ROUNDINGS = 8.0
"""of the terms of a difference: some of the step that made the states, one of each term"""
SHORT = math.sqrt(sys.float_info.epsilon)
"""relative to the time. A difference that changes by less than its rounding meanwhile turns at its
zero: roundings move the zeros of a parabola by their square root
"""


def crossing(
    program: Any,
    time: float,
    x: Any,
    z: Any,
    p: Any,
    now: np.ndarray,
    fired: int | None = None,
) -> np.ndarray:
    """1 for a difference that becomes positive at this instant by the flow, -1 for one that becomes
    negative, 0 for the others. The differences have the values `now`.

    A difference crosses zero at this instant in two cases. It has different signs `SAME_TIME`
    before and after the instant, where the states move along their tangents. Or it is so small that
    roundings can hide the change of its sign: its own, or those of the difference that `fired`, by
    which the instant was located.
    """
    scale = max(1.0, abs(time))
    near, short = SAME_TIME * scale, SHORT * scale

    def numbers(tape: Any, late: float) -> np.ndarray:
        found: np.ndarray = evaluated(tape, time + late, x + late * rates, z, p)
        return found

    with np.errstate(all="ignore"):
        rates = evaluated(program.flow, time, x, z, p) if len(x) else np.zeros(0)
        before, after = (np.sign(numbers(program.differences, d)) for d in (-near, near))
        change = numbers(program.differences, short) - now
        noise = ROUNDINGS * sys.float_info.epsilon * numbers(program.sizes_of_terms, 0.0)
        steep = np.isfinite(change) & (np.abs(change) > noise)
        wide = near / short
        if fired is not None and steep[fired]:
            wide += noise[fired] / abs(change[fired])
        hidden = np.abs(now) <= np.abs(change) * wide + noise
        found = np.where(hidden & steep, np.sign(change), 0.0)
        plain = np.isfinite(before) & np.isfinite(after) & (before != after)
    return np.where(plain, after, found)
