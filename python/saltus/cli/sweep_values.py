"""`--vary NAME=V,V,...`: the values of a sweep on the command line."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from saltus.ensemble.table import Table, table_of
from saltus.errors import ModelError

__all__ = ["MOST_RUNS", "table_of_runs", "varied_of"]

MOST_RUNS = 1_000_000


def varied_of(texts: list[str]) -> dict[str, list[Any]]:
    """The values of each name. ModelError for what is none."""
    found: dict[str, list[Any]] = {}
    for text in texts:
        name, equals, values = text.partition("=")
        if not equals or not name.strip() or name.strip() in found:
            raise ModelError(f"--vary: expected NAME=V,V,... once for each name, found '{text}'")
        found[name.strip()] = _values(text, values)
    return found


def _values(text: str, values: str) -> list[Any]:
    try:
        if values.count(":") != 2:
            return [float(value) for value in values.split(",")]
        begin, end, count = values.split(":")
        if 1 <= int(count) <= MOST_RUNS:
            return [float(value) for value in np.linspace(float(begin), float(end), int(count))]
    except ValueError:
        pass
    raise ModelError(
        f"--vary: expected numbers V,V,... or BEGIN:END:COUNT, found '{text}'"
    ) from None


def table_of_runs(varied: dict[str, list[Any]], paired: bool) -> Table:
    """All combinations of the values; with `paired` their rows."""
    if not varied:
        raise ModelError("expected values to vary: --vary NAME=V,V,...")
    lengths = [len(values) for values in varied.values()]
    if paired and len(set(lengths)) > 1:
        raise ModelError(f"paired values: expected equally many of each name, found {lengths}")
    if not paired and math.prod(lengths) > MOST_RUNS:
        raise ModelError(f"expected at most {MOST_RUNS} runs, found {math.prod(lengths)}")
    return table_of(varied, paired)
