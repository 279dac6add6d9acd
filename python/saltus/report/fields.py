"""The fields of a report in JSON, each with the kind of its value."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from saltus.errors import ModelError

__all__ = ["require_report"]

LARGEST_COUNT = 2**63
"""integers are counts; a larger integer is no number of a report, and may be no double"""


def _is_text(value: Any) -> bool:
    return isinstance(value, str)


def _is_number(value: Any) -> bool:
    if isinstance(value, int) and not isinstance(value, bool):
        return abs(value) < LARGEST_COUNT
    return isinstance(value, float)


def _is_known_or_not(value: Any) -> bool:
    return value is None or _is_text(value) or _is_number(value)


def _is_number_or_unknown(value: Any) -> bool:
    return value is None or _is_number(value)


Kind = tuple[str, Callable[[Any], bool]]
TEXT: Kind = ("a text", _is_text)
NUMBER: Kind = ("a number", _is_number)
MAYBE: Kind = ("a number or null", _is_number_or_unknown)
ANY: Kind = ("a number, a text or null", _is_known_or_not)
TABLE: Kind = ("an object", lambda value: isinstance(value, dict))
LIST: Kind = ("a list", lambda value: isinstance(value, list))

REPORT: dict[str, Kind] = {
    "scene": TEXT, "title": TEXT, "begin": NUMBER, "end": NUMBER, "growth": NUMBER, "cold": TEXT,
    "reference": TABLE, "environment": TABLE, "orders": TABLE, "rows": LIST,
}  # fmt: skip
REFERENCE: dict[str, Kind] = {"kind": TEXT, "provenance": TEXT}
ROW: dict[str, Kind] = {
    "method": TEXT, "status": TEXT, "message": TEXT, "rtol": NUMBER, "error": MAYBE,
    "event_error": MAYBE, "event_mismatch": MAYBE, "penetration": MAYBE, "invariant_drift": MAYBE,
    "accumulation_error": MAYBE, "rest_error": MAYBE, "release_error": MAYBE, "seconds": MAYBE,
    "cold_seconds": MAYBE, "steps": MAYBE, "right_hand_side_calls": MAYBE, "guard_calls": MAYBE,
}  # fmt: skip


def require_report(data: Mapping[str, Any]) -> None:
    """ModelError for the first field that is missing or of another kind."""
    _require(data, REPORT, "")
    _require(data["reference"], REFERENCE, "reference: ")
    for name, value in data["orders"].items():
        _require_kind(value, MAYBE, f"orders: '{name}'")
    for i, row in enumerate(data["rows"]):
        _require_kind(row, TABLE, f"row {i}")
        _require(row, ROW, f"row {i}: ")


def _require(data: Mapping[str, Any], fields: Mapping[str, Kind], where: str) -> None:
    for name, kind in fields.items():
        if name not in data:
            raise ModelError(f"a report in JSON: {where}expected '{name}', {kind[0]}; found none")
        _require_kind(data[name], kind, f"{where}'{name}'")
    for name in data.keys() - fields.keys():
        if fields is not REPORT:
            _require_kind(data[name], ANY, f"{where}'{name}'")


def _require_kind(value: Any, kind: Kind, where: str) -> None:
    expected, good = kind
    if not good(value):
        found = f"{value!r}"
        found = found if len(found) <= 60 else f"{found[:60]}..."
        raise ModelError(f"a report in JSON: {where}: expected {expected}, found {found}")
