"""States that rest in a context."""

from __future__ import annotations

from collections.abc import Sequence

from saltus import _core

__all__ = ["at_rest"]


def at_rest(context: _core.Context, names: Sequence[str]) -> tuple[str, ...]:
    """The names of the continuous states that a Zeno hold keeps at rest; empty if all move."""
    waiting = (context.to_dict()["continuation"] or {}).get("firings", ())
    numbers = {i for each in waiting if each["holding"] for i in each["states"]}
    return tuple(names[i] for i in sorted(numbers))
