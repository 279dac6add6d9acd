"""States that rest in a context."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from saltus import _core

__all__ = ["at_rest"]


def at_rest(context: _core.Context, names: Sequence[str]) -> tuple[str, ...]:
    """The names of the continuous states that a Zeno hold keeps at rest; empty if all move."""
    saved = context.to_dict()["continuation"] or {}
    islands = [
        f"state {i} of island {k}"
        for k, island in enumerate(saved.get("islands", ()))
        for i in _resting(island)
    ]
    return (*(names[i] for i in _resting(saved)), *islands)


def _resting(saved: Mapping[str, Any]) -> list[int]:
    """The numbers of the states at rest, in the system or in an island."""
    waiting = saved.get("firings", ())
    return sorted({i for each in waiting if each["holding"] for i in each["states"]})
