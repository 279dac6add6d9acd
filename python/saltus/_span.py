"""Spans of time, as users give them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from saltus import _core
from saltus.errors import ModelError

__all__ = ["ROUNDING", "rows_within", "span_of"]

ROUNDING = 1e-12
"""the part of a time that sums and products of a few thousand steps may be wrong by"""


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
            f"{where}: expected a span (begin, end) in seconds, found {_shown(t_span)}"
        ) from None
    if not (end >= begin or (backward and end < begin)):
        raise ModelError(f"{where}: expected a span with begin <= end, found {begin} s to {end} s")
    return begin, end


def _shown(t_span: object) -> str:
    """What was given for a span, with what to write."""
    if isinstance(t_span, (int, float)) and not isinstance(t_span, bool):
        return f"{t_span!r}; write (0.0, {float(t_span)})"
    if isinstance(t_span, _core.Context):
        return "a context, which comes before the span: simulate(system, context, (begin, end))"
    if hasattr(t_span, "ode_solver_method"):
        return "options; write options=..., after the span"
    return repr(t_span)


def _remedy(beyond: Sequence[float], span: tuple[float, float]) -> str:
    """What to do about times that are not within the span."""
    begin, end = span
    before, after = min(beyond) < begin, max(beyond) > end
    kept = (
        f"{begin} <= t" if not after else f"t <= {end}" if not before else f"{begin} <= t <= {end}"
    )
    longer = ", or make the run longer" if after else ""
    earlier = ", or begin earlier" if before and not after else ""
    return (
        f"leave them out, as a piece of a longer run does: save_at=[t for t in times if {kept}]"
        f"{longer}{earlier}"
    )


def rows_within(where: str, save_at: Sequence[float], span: tuple[float, float]) -> Sequence[float]:
    """The times of rows of a run. A time may be beyond an end by rounding, as 19 * 0.1 is beyond 1.9;
    then that end is taken. ModelError for other times before the begin of the run, or after its end.
    """
    begin, end = span
    outside = [time for time in save_at if not begin <= time <= end]
    if not outside:
        return save_at
    near = ROUNDING * max(abs(begin), abs(end))
    beyond = [time for time in outside if not begin - near <= time <= end + near]
    if beyond:
        shown = ", ".join(f"{time} s" for time in beyond[:4])
        more = f" and {len(beyond) - 4} more" if len(beyond) > 4 else ""
        raise ModelError(
            f"{where}: option save_at: expected times within the run, {begin} s to {end} s, "
            f"found {shown}{more}; {_remedy(beyond, span)}"
        )
    return list(dict.fromkeys(float(min(max(time, begin), end)) for time in save_at))
