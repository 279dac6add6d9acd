"""A fit as text: a table of its parameters, and what to know before they are used."""

from __future__ import annotations

import html
import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from saltus.fitting.result import FitResult

__all__ = ["as_html", "as_text"]

TITLES = ("parameter", "value", "standard error", "95 % confidence")


def as_text(fit: FitResult) -> str:
    cells = [TITLES, *_rows(fit)]
    widths = [max(len(row[k]) for row in cells) for k in range(len(TITLES))]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in cells
    ]
    warned = [*_why(fit), *(f"warning: {each}" for each in fit.warnings)]
    return "\n".join([_head(fit), *(f"  {line}" for line in lines), *warned])


def as_html(fit: FitResult) -> str:
    def row(tag: str, cells: tuple[str, ...]) -> str:
        inner = "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells)
        return f"<tr>{inner}</tr>"

    body = "".join(row("td", cells) for cells in _rows(fit))
    said = [*_why(fit), *(f"warning: {each}" for each in fit.warnings)]
    warned = "".join(f"<p>{html.escape(each)}</p>" for each in said)
    head = html.escape(_head(fit))
    return f"<p><b>{head}</b></p><table>{row('th', TITLES)}{body}</table>{warned}"


def _head(fit: FitResult) -> str:
    missing = f" ({fit.missing} missing)" if fit.missing else ""
    return (
        f"fit: {fit.status} after {fit.evaluations} evaluations, {len(fit.residuals)} data"
        f"{missing}, cost {fit.cost:.4g}"
    )


def _why(fit: FitResult) -> list[str]:
    """The reason, if it has not converged."""
    return [] if fit.success else [f"{fit.status}: {fit.message}"]


def _rows(fit: FitResult) -> list[tuple[str, ...]]:
    intervals = fit.confidence(0.95)
    return [
        (name, _value(value, error), f"{error:.2g}", _interval(intervals[name], error))
        for (name, value), error in zip(
            fit.parameters.items(), fit.standard_errors.values(), strict=True
        )
    ]


def _value(value: float, error: float) -> str:
    """The value to the second digit of its error, and never with fewer than four digits."""
    if not (math.isfinite(error) and error > 0.0 and value != 0.0):
        return f"{value:.6g}"
    digits = math.floor(math.log10(abs(value))) - math.floor(math.log10(error)) + 2
    return f"{value:#.{min(max(digits, 4), 15)}g}".rstrip(".")


def _interval(ends: tuple[float, float], error: float) -> str:
    if not math.isfinite(error):
        return "not determined"
    return " to ".join(_value(end, error) for end in ends)
