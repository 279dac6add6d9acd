"""Spans of time, as users give them."""

from __future__ import annotations

from typing import Any

from saltus.errors import ModelError

__all__ = ["span_of"]


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
