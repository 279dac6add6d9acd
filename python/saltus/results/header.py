"""The checks of the header of a results file, before any of it is used."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import fields
from typing import Any, NoReturn

import numpy as np

from saltus import _core
from saltus._quantities import Quantity
from saltus.errors import ModelError
from saltus.results.statistics import Statistics

__all__ = [
    "checked_arrays",
    "checked_events",
    "checked_quantities",
    "checked_statistics",
    "strings",
    "text",
]

KINDS = (
    "zero_crossing", "time", "zeno_enter", "zeno_release", "terminal",
    "scheduled", "cancelled", "executed",
)  # fmt: skip
EVENT = 8
"""jump, kind, direction, block, name, entry, number of states, entries that rest"""


def refuse(what: str, expected: str, found: object) -> NoReturn:
    raise ModelError(f"{what}: expected {expected}, found {str(found)[:60]}")


def text(what: str, value: object) -> str:
    if not isinstance(value, str):
        refuse(what, "a text", value)
    return value


def strings(what: str, value: object) -> list[str]:
    if not isinstance(value, list):
        refuse(what, "a list", value)
    return [text(what, item) for item in value]


def count(what: str, value: object, least: int = 0) -> int:
    """An integer of 64 bits; JSON has longer ones."""
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value < 2**63:
        refuse(what, f"an integer from {least}", value)
    return value


def number(what: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        refuse(what, "a number", value)
    return float(value)


def column(name: str, array: np.ndarray, kinds: str, dimensions: tuple[int, ...] = (1,)) -> None:
    if array.dtype.kind not in kinds or array.ndim not in dimensions:
        refuse(f"'{name}'", "a column of numbers", f"{array.dtype} of shape {array.shape}")


def checked_arrays(names: list[str], arrays: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The recorded signals by name, each with a row for each time."""
    if len(set(names)) != len(names):
        refuse("'outputs'", "names that differ", names)
    column("time", arrays["time"], "f")
    column("jump", arrays["jump"], "i")
    outputs = {name: arrays[f"output {i}"] for i, name in enumerate(names)}
    for name, array in outputs.items():
        column(name, array, "f", (1, 2, 3))
    rows = len(arrays["time"])
    for name, array in [("jump", arrays["jump"]), *outputs.items()]:
        if len(array) != rows:
            raise ModelError(f"'{name}' has {len(array)} rows, 'time' has {rows}")
    time = arrays["time"]
    if not (np.isfinite(time).all() and (np.diff(time) >= 0).all()):
        raise ModelError("'time' decreases, or is not finite")
    return outputs


def checked_quantities(data: object, outputs: dict[str, np.ndarray]) -> dict[str, Quantity]:
    """The units and the names of modes of the signals that have them."""
    if not isinstance(data, dict):
        refuse("'quantities'", "an object", data)
    found = {}
    for name, one in data.items():
        if name not in outputs or not isinstance(one, dict) or set(one) != {"units", "modes"}:
            refuse("'quantities'", "units and modes of recorded signals", {name: one})
        units, modes = (strings(f"'{key}' of '{name}'", one[key]) for key in ("units", "modes"))
        if units and len(units) != outputs[name][:1].size and len(outputs[name]):
            refuse(f"'units' of '{name}'", "one for each entry", units)
        found[name] = Quantity(tuple(units), tuple(modes))
    return found


def _stretch(part: Any) -> tuple[str, float, float, int]:
    method, begin, end, steps = part
    what = "a stretch of 'statistics'"
    return text(what, method), number(what, begin), number(what, end), count(what, steps)


def checked_statistics(found: Any) -> dict[str, Any]:
    if not isinstance(found, dict):
        raise ModelError(f"'statistics': expected a record, found {type(found).__name__}")
    reads: dict[str, Callable[[str, Any], Any]] = {
        "method": text,
        "linear_solver": text,
        "wall_time": number,
        "stretches": lambda _, parts: [_stretch(part) for part in parts],
        "events_by_name": lambda what, counts: {
            text(what, name): count(what, n) for name, n in counts.items()
        },
    }
    names = [field.name for field in fields(Statistics)]
    if set(found) != set(names):
        raise ModelError(f"'statistics': expected {names}, found {sorted(found)}")
    return {name: reads.get(name, count)(name, found[name]) for name in names}


def _row(row: Any) -> tuple[int, str, int, str, str, int, int, tuple[int, ...]]:
    if isinstance(row, list) and len(row) == EVENT - 1:  # of an earlier version
        row = [*row, []]
    if not isinstance(row, list) or len(row) != EVENT or not isinstance(row[-1], list):
        raise ModelError(f"an event: expected {EVENT} entries, found {str(row)[:60]}")
    jump, kind, direction, block, name, entry, width, rests = row
    if kind not in KINDS:
        raise ModelError(f"an event is of kind {str(kind)[:60]}{_core.known_names('', KINDS)}")
    what = "an event"
    if count(what, direction, -(2**62)) not in (-2, -1, 0, 1):
        refuse("the direction of an event", "-1, 0 or 1", direction)
    return (
        count(what, jump),
        kind,
        direction,
        text(what, block),
        text(what, name),
        count(what, entry),
        count(what, width),
        tuple(count(what, i, 0) for i in rests),
    )


def checked_events(rows: Any, arrays: dict[str, np.ndarray]) -> list[tuple[Any, ...]]:
    """The events, in the form of `KeptRun`."""
    if not isinstance(rows, list):
        raise ModelError(f"'events': expected a list, found {type(rows).__name__}")
    for name in ("event time", "event predicted", "event states"):
        column(name, arrays[name], "f")
    times, predicted = arrays["event time"].tolist(), arrays["event predicted"].tolist()
    read = [_row(row) for row in rows]
    states, events, at = arrays["event states"], [], 0
    expected = 2 * sum(row[6] for row in read)
    if expected != len(states):
        raise ModelError(f"expected {expected} numbers of events, found {len(states)}")
    for t, p, (jump, kind, direction, block, name, entry, width, rests) in zip(
        times, predicted, read, strict=True
    ):
        middle, end = at + width, at + 2 * width
        p = math.nan if math.isnan(p) else p
        change = states[at:middle].copy(), states[middle:end].copy()
        events.append((t, jump, kind, direction, block, name, p, *change, entry, rests))
        at = end
    return events
