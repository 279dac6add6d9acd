"""Results as text, for `print(results)` and for a notebook."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING

from saltus._status import WELL

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["as_html", "as_text"]

NOTHING = "nothing recorded; name some: recorded_signals=['block.port']"


def _span(results: Results) -> str:
    if results._core.apart:
        return f"to t = {results.context.time:g} s"
    if not len(results.time):
        return f"t = {results.context.time:g} s"
    return f"t = {results.time[0]:g} to {results.time[-1]:g} s"


def _rows(results: Results) -> str:
    if results._core.apart:
        return f"{sum(len(one.time) for one in results.islands)} rows"
    return f"{len(results.time)} rows"


def _duration(seconds: float) -> str:
    for factor, unit in ((1.0, "s"), (1e3, "ms")):
        if seconds * factor >= 1.0:
            return f"{seconds * factor:.3g} {unit}"
    return f"{seconds * 1e6:.3g} µs"


def _events(results: Results) -> str:
    by_name = results.statistics.events_by_name
    shown = [f"{name} {count}" for name, count in list(by_name.items())[:5]]
    more = [f"{len(by_name) - 5} other kinds"] if len(by_name) > 5 else []
    names = ", ".join(shown + more)
    return f"{len(results.events)} events" + (f": {names}" if names else "")


def _method(results: Results) -> str:
    s = results.statistics
    if len(s.stretches) < 2:
        return s.method
    used = list(dict.fromkeys(stretch[0] for stretch in s.stretches))
    return f"{' and '.join(used)} ({len(s.stretches)} stretches)"


def _unit(results: Results, name: str) -> str:
    """' [m]', or ' [m, m/s, -]' of a vector with a plain number; '' of a signal without a unit."""
    units = results.units.get(name, "")
    entries = (units,) if isinstance(units, str) else units
    return f" [{', '.join(unit or '-' for unit in entries)}]" if units else ""


def _facts(results: Results) -> list[tuple[str, str]]:
    """The content of each line after the status."""
    s = results.statistics
    signals = ", ".join(
        f"{name} {array.shape}{_unit(results, name)}" for name, array in results.outputs.items()
    )
    rests = [e for e in results.events if e.kind == "zeno_enter"] if s.events else []
    facts = [
        ("why", results.message),
        ("outputs", signals or NOTHING),
        ("islands", f"{len(results.islands)} that stepped apart" if results.islands else ""),
        ("events", _events(results)),
        ("at rest", ", ".join(f"{e.block} from {e.time:.6g} s" for e in rests[:5])),
        (
            "steps",
            f"{s.steps} steps of {_method(results)}, {s.rejected} rejected, {s.restarts} restarts",
        ),
        ("calls", f"{s.right_hand_side_calls} right-hand side, {s.guard_calls} guards"),
        ("took", _duration(s.wall_time)),
        ("dense output", "at any time from {:g} to {:g} s".format(*results.span))
        if results.dense
        else ("dense output", ""),
    ]
    return [(name, text) for name, text in facts if text]


def as_text(results: Results) -> str:
    head = f"{results.status}, {_rows(results)}, {_span(results)}"
    lines = [f"  {name:<12}  {text}" for name, text in _facts(results)]
    return "\n".join([f"<{type(results).__name__}: {head}", *lines]) + ">"


def as_html(results: Results) -> str:
    def row(name: str, text: str) -> str:
        return (
            f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
            f"<td style='text-align:left'>{html.escape(text)}</td></tr>"
        )

    good = results.status in WELL
    title = (
        f"<b>{type(results).__name__}</b>: "
        f"<span style='color:{'#2a7d2a' if good else '#b3261e'}'>{results.status}</span>, "
        f"{_rows(results)}, {html.escape(_span(results))}"
    )
    rows = "".join(row(name, text) for name, text in _facts(results))
    return f"<div>{title}<table><tbody>{rows}</tbody></table></div>"
