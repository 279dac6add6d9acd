"""Spans of time, as users give them."""

from __future__ import annotations

from saltus.errors import ModelError

__all__ = ["span_of"]


def span_of(where: str, t_span: object) -> tuple[float, float]:
    """(begin, end) [s], in whichever order; ModelError, which begins with `where`, for all else."""
    try:
        begin, end = map(float, t_span)  # type: ignore[call-overload]
    except (TypeError, ValueError):
        raise ModelError(
            f"{where}: expected a span (begin, end) in seconds, found {t_span!r}"
        ) from None
    return begin, end
