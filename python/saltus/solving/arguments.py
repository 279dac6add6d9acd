"""The arguments of `solve` as what the block behind it takes: the start, `args`, the times."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus._core import numbers
from saltus.errors import ModelError
from saltus.solving.form import Form

__all__ = ["arguments_of", "state_of", "times_of"]


def state_of(x0: ArrayLike) -> np.ndarray:
    """The state at the beginning: a vector, or a number; complex if one of its numbers is."""
    if isinstance(x0, (list, tuple)) and {float, int}.issuperset(map(type, x0)):
        start = np.array(x0, dtype=float)  # plain numbers, quickly
    else:
        start = np.array(x0) if _is_complex(x0) else np.array(numbers(x0, "solve: x0"))
    if start.ndim > 1:
        raise ModelError(f"solve: x0: expected shape (n,), found {start.shape}; flatten it")
    start = start.reshape(-1)
    if np.isfinite(start).all():
        return start
    for i in np.flatnonzero(~np.isfinite(start))[:1]:
        raise ModelError(
            f"solve: x0: entry {i} is {start[i]}; give a finite value. All components of the "
            "initial state `y0` must be finite."
        )
    return start


def _is_complex(x0: ArrayLike) -> bool:
    try:
        return np.array(x0).dtype.kind == "c"
    except ValueError:  # a ragged list, which is refused
        return False


def arguments_of(args: Any) -> tuple[Any, ...]:
    """The arguments as a tuple. A forgotten comma, args=(k), is an error with advice."""
    try:
        return () if args is None else tuple(args)
    except TypeError:
        raise _WrongKind(
            f"solve: args: expected a tuple, found {args!r}; for one argument write "
            f"args=({args!r},). Supplied 'args' cannot be unpacked."
        ) from None


class _WrongKind(ModelError, TypeError):
    """An error of the caller that Python, and SciPy, call a TypeError."""


def times_of(t_eval: ArrayLike, begin: float, end: float, form: Form) -> list[float]:
    """[s] The times of the wanted rows, as the engine counts time."""
    try:
        times = np.array(t_eval, dtype=float)
    except (TypeError, ValueError):
        raise ModelError(f"solve: t_eval: expected times in seconds, found {t_eval!r}") from None
    if times.ndim != 1 or times.size == 0:
        raise ModelError(f"solve: t_eval: expected some times, found shape {times.shape}")
    forward = form.time(times)
    within = form.time(begin) <= forward[0] and forward[-1] <= form.time(end)
    if not (within and np.all(np.diff(forward) > 0)):
        raise ModelError(
            f"solve: t_eval: expected {'decreasing' if form.backward else 'increasing'} times "
            f"within t_span, {begin:g} s to {end:g} s, found {np.array2string(times, threshold=8)}"
        )
    return [float(s) for s in forward]
