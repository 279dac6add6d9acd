"""Spans of time, as users give them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from saltus.errors import ModelError

__all__ = ["require_within", "span_of"]


def span_of(where: str, t_span: object, backward: bool = False) -> tuple[float, float]:
    """(begin, end) [s] with begin <= end, or in any order with `backward`. ModelError, which begins
    with `where`, for all else.
    """
    try:
        given: tuple[Any, ...] = tuple(t_span)  # type: ignore[arg-type]
        if any(isinstance(time, (str, bytes)) for time in given):
            raise TypeError
        begin, end = map(float, given)
    except (TypeError, ValueError):
        raise ModelError(
            f"{where}: expected a span (begin, end) in seconds, found {t_span!r}"
        ) from None
    if not (end >= begin or (backward and end < begin)):
        raise ModelError(f"{where}: expected a span with begin <= end, found {begin} s to {end} s")
    return begin, end


def require_within(where: str, save_at: Sequence[float], span: tuple[float, float]) -> None:
    """ModelError for times of rows before the begin of a run, or after its end."""
    outside = [time for time in save_at if not span[0] <= time <= span[1]]
    if outside:
        shown = ", ".join(f"{time} s" for time in outside[:4])
        more = f" and {len(outside) - 4} more" if len(outside) > 4 else ""
        raise ModelError(
            f"{where}: option save_at: expected times within the run, {span[0]} s to {span[1]} s, "
            f"found {shown}{more}; leave them out, or make the run longer"
        )
