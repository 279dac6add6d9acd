"""Lines in columns, on a terminal."""

from __future__ import annotations

import sys
from collections.abc import Sequence

__all__ = ["print_table"]


def print_table(rows: Sequence[tuple[str, ...]]) -> None:
    """One line for each row. On a terminal it is in colour, if rich is installed."""
    if sys.stdout.isatty() and _printed_by_rich(rows):
        return
    widths = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)]
    for row in rows:
        print("  ".join(c.ljust(w) for c, w in zip(row, widths, strict=True)).rstrip())


def _printed_by_rich(rows: Sequence[tuple[str, ...]]) -> bool:
    try:
        from rich.console import Console  # type: ignore[import-not-found,unused-ignore]
        from rich.table import Table  # type: ignore[import-not-found,unused-ignore]
        from rich.text import Text  # type: ignore[import-not-found,unused-ignore]
    except ImportError:
        return False
    table = Table.grid(padding=(0, 2))
    table.add_column(style="bold", no_wrap=True)
    for row in rows:
        table.add_row(*(Text(cell) for cell in row))
    Console().print(table)
    return True
