"""What the called functions of a system write outside of it, and who reads it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from saltus.callbacks.function import Block

__all__ = ["Found", "Others", "Place", "search"]

Place = tuple[int, int]  # the numbers of a block and of a function of it
Others = Sequence[tuple[str, Any]]  # functions that are no callbacks of a block, with words


@dataclass(frozen=True)
class Found:
    """What a search found, and where it looked."""

    called: dict[Place, Any] = field(default_factory=dict)
    """readers of written values, which could be traced and are called"""
    sharing: dict[int, tuple[list[int], list[int]]] = field(default_factory=dict)
    """block -> its called functions that read what one of them writes, and those that write"""
    looks: list[Any] = field(default_factory=list)
    """everything at which it looked: while that stays the same, so does the answer"""


def search(
    blocks: Sequence[Block], outcomes: Mapping[int, list[Any]], others: Others, traces: bool
) -> Found:
    """Searches the called functions, and `others`. `traces`: whether some function is traced."""
    from saltus import tracing

    looks: list[Any] = []
    called = tracing.readers_of_writes(blocks, outcomes, others, looks) if traces else {}
    sharing = tracing.sharing_of(blocks, outcomes, called, looks)
    return Found(called, sharing, looks)
