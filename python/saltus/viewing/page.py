"""The page: its parts, in one file without anything from elsewhere."""

from __future__ import annotations

import dataclasses
import html
from typing import Any

from saltus import _core, _picture
from saltus.results.text import as_html
from saltus.system import System
from saltus.viewing.pictures import picture_of, plots_of

__all__ = ["page_of"]

MOST_EVENTS = 1000
CSS = """
body { font: 15px/1.5 system-ui, sans-serif; color: #1a1a1a; background: #fff;
       max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; margin-bottom: 0; } h2 { font-size: 1.15rem; margin-top: 2.2rem; }
img { max-width: 100%; height: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: 0.15rem 0.9rem 0.15rem 0; vertical-align: top; }
thead th { border-bottom: 1px solid #aaa; position: sticky; top: 0; background: #fff; }
.scroll { max-height: 24rem; overflow: auto; } pre { overflow: auto; }
.plots { display: flex; flex-wrap: wrap; gap: 1rem; align-items: flex-start; }
.quiet { color: #666; } .animation { margin: 0; } .animation img { max-width: 100%; }
"""


def page_of(
    title: str, subtitle: str, results: Any, system: System | None, film: str | None
) -> str:
    """The page as text."""
    parts = [("", as_html(results)), ("Film", film or "")]
    plots = plots_of(results)
    parts.append(("Plots", f'<div class="plots">{"".join(plots)}</div>' if plots else ""))
    parts.append(("Diagram", _diagram(system)))
    parts.append(("Events", _events(results)))
    parts.append(("Statistics", _statistics(results)))
    body = "".join(_section(name, content) for name, content in parts if content)
    said = f'<p class="quiet">{html.escape(subtitle)}</p>' if subtitle else ""
    return (
        f'<!DOCTYPE html>\n<html lang="en">\n<head><meta charset="utf-8">'
        f'<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{html.escape(title)}</title>\n<style>{CSS}</style></head>\n"
        f"<body><h1>{html.escape(title)}</h1>{said}{body}"
        f'<p class="quiet">Saltus {_core.__version__}</p></body></html>\n'
    )


def _section(name: str, content: str) -> str:
    heading = f"<h2>{name}</h2>" if name else ""
    return f"<section>{heading}{content}</section>\n"


def _diagram(system: System | None) -> str:
    if system is None:
        return ""
    svg = _picture.in_svg(system)
    if svg is not None:
        return picture_of(svg, f"The blocks and wires of {system.name}")
    return (
        "<p>Graphviz is not installed, so here is the diagram as text of Mermaid:</p>"
        f"<pre>{html.escape(system.to_mermaid())}</pre>"
    )


def _events(results: Any) -> str:
    """The log; its middle is left out if it is very long."""
    log = results.events
    if not len(log):
        return '<p class="quiet">No event happened.</p>'
    first = log[: MOST_EVENTS // 2] if len(log) > MOST_EVENTS else log
    last = log[-(MOST_EVENTS // 2) :] if len(log) > MOST_EVENTS else log[:0]
    rows = [_event(e) for e in first]
    if len(last):
        rows.append(f"<tr><td colspan=5>... {len(log) - MOST_EVENTS} more ...</td></tr>")
        rows += [_event(e) for e in last]
    head = "".join(f"<th>{t}</th>" for t in ("time [s]", "jump", "kind", "event", "x⁻ → x⁺"))
    table = f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"
    return f'<p>{len(log)} events</p><div class="scroll">{table}</div>'


def _event(e: Any) -> str:
    change = f"{_short(e.before)} → {_short(e.after)}" if len(e.before) else ""
    cells = (f"{e.time:.12g}", str(e.jump), e.kind, f"{e.block}.{e.name}", change)
    return "<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in cells) + "</tr>"


def _short(state: Any) -> str:
    more = ", ..." if len(state) > 6 else ""
    return "[" + ", ".join(f"{x:.4g}" for x in state[:6]) + more + "]"


def _statistics(results: Any) -> str:
    values = dataclasses.asdict(results.statistics)
    rows = "".join(
        f"<tr><th>{html.escape(name.replace('_', ' '))}</th><td>{html.escape(_said(value))}</td>"
        for name, value in values.items()
        if value not in (None, "", [], {}, ())
    )
    return f"<table><tbody>{rows}</tbody></table>"


def _said(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{key} {count}" for key, count in value.items())
    if isinstance(value, (list, tuple)):
        return f"{len(value)}"
    return f"{value:.4g}" if isinstance(value, float) else str(value)
