"""The tolerances and the first step of `saltus.solve`, as SciPy's users give them."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus.errors import ModelError
from saltus.solving.form import Form

__all__ = ["first_step_of", "tolerances_of"]

LEAST = 1e-15
"""the least relative tolerance: a double has no more digits"""


def tolerances_of(rtol: ArrayLike, atol: ArrayLike, size: int, form: Form) -> dict[str, Any]:
    """The options rtol and atol of the engine, from one number or one for each state."""
    if type(rtol) is type(atol) is float and rtol >= LEAST:
        return {"rtol": rtol, "atol": atol}
    for name, tolerance in (("rtol", rtol), ("atol", atol)):
        if np.ndim(tolerance) == 1 and len(tolerance) != size:  # type: ignore[arg-type]
            raise ModelError(
                f"solve: {name}: expected a number, or {size} numbers, one for each state; found "
                f"{len(tolerance)}"  # type: ignore[arg-type]
            )
    return {"rtol": form.tolerance(_possible(rtol)), "atol": form.tolerance(atol)}


def _possible(rtol: ArrayLike) -> Any:
    """rtol, with positive values that are too small raised to the least."""
    try:
        given = np.asarray(rtol, dtype=float)
    except (TypeError, ValueError):
        return rtol  # the engine says what is wrong
    small = (given > 0) & (given < LEAST)
    if not small.any():
        return rtol
    warnings.warn(
        f"At least one element of `rtol` is too small: {given[small].min():g}; {LEAST:g} is taken",
        stacklevel=4,
    )
    return np.where(small, LEAST, given)[()]


def first_step_of(first_step: float | None, length: float) -> float | None:
    """[s] the first step, which is not longer than the span."""
    if first_step is None or not np.isscalar(first_step):
        return first_step
    if not 0 < first_step <= length:  # type: ignore[operator]
        raise ModelError(
            f"solve: first_step: expected a time > 0 s within t_span, {length:g} s long; found "
            f"{first_step!r}"
        )
    return float(first_step)  # type: ignore[arg-type]
