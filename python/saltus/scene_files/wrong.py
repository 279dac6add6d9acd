"""A mistake in a scene: its key, and the message."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from saltus._core import known_names
from saltus.errors import ModelError

__all__ = ["Path", "Wrong", "found", "placed", "require_keys", "table_at"]

ELSEWHERE = {
    **dict.fromkeys(("initial", "init", "x0", "value"), "start"),
    **dict.fromkeys(("derivative", "der", "ode", "dot", "equation"), "rate"),
    **dict.fromkeys(("condition", "when", "zero", "expression"), "guard"),
    **dict.fromkeys(("reset", "effect", "action", "then"), "set"),
    **dict.fromkeys(("t_end", "end", "stop_time", "tf", "duration"), "until"),
    **dict.fromkeys(("t_begin", "t0", "start_time", "start"), "begin"),
    **dict.fromkeys(("solver", "ode_solver_method", "integrator"), "method"),
    **dict.fromkeys(("recorded_signals", "outputs", "log"), "record"),
    **dict.fromkeys(("connections", "links", "edges"), "wires"),
    **dict.fromkeys(("params", "constants"), "parameters"),
}
"""keys of other formats -> those here, where a table has them"""

Path = tuple[Any, ...]
"""keys and positions from the root of a scene: ("states", "v", "rate"), ("wires", 2)"""


class Wrong(Exception):
    """Raised by the readers of a scene, which know keys; the loader knows files and lines."""

    def __init__(self, path: Path, message: str, offset: int | None = None):
        super().__init__(message)
        self.path = path
        self.message = message
        self.offset = offset
        """the position in the text of an expression, from 0"""


@contextmanager
def placed(path: Path) -> Iterator[None]:
    """Adds the place of a key to a refusal of the engine or of Python."""
    try:
        yield
    except (ModelError, TypeError, ValueError, OverflowError) as error:
        raise Wrong(path, str(error)) from None


def found(value: Any) -> str:
    """A value of a scene, as an error shows it."""
    kinds = {bool: "a truth", dict: "a table", list: "a list", str: "text"}
    if isinstance(value, dict):
        return "a table" + (f" with {', '.join(list(value)[:4])}" if value else "")
    shown = repr(value)
    shown = shown if len(shown) <= 40 else f"{shown[:37]}..."
    kind = kinds.get(type(value))
    return f"{kind}, {shown}" if kind else shown


def table_at(path: Path, value: Any, example: str) -> dict[str, Any]:
    """A table; Wrong for anything else."""
    if not isinstance(value, dict):
        raise Wrong(path, f"expected a table such as {example}, found {found(value)}")
    return value


def require_keys(
    path: Path, table: dict[str, Any], known: Iterable[str], needed: Iterable[str] = ()
) -> None:
    """Wrong for an unknown key, with the nearest known key, and for a missing key."""
    known = list(known)
    for key in table:
        if key not in known:
            here = ELSEWHERE.get(key)
            hint = f"; it is '{here}' here" if here in known else known_names(key, known)
            raise Wrong((*path, key), f"unknown key '{key}'{hint}")
    for key in needed:
        if key not in table:
            raise Wrong(path, f"expected a key '{key}', found {', '.join(table) or 'no key'}")
