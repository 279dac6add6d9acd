"""The states of a system as one vector, with the names that the option `sensitivity` knows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from saltus import _core
from saltus.errors import ModelError

__all__ = ["States", "moved"]


class States:
    """The continuous states of a system, and after them its discrete states."""

    def __init__(self, context: _core.Context):
        blocks = context.to_dict()["blocks"]
        prefix = (lambda path: "") if len(blocks) == 1 else (lambda path: f"{path}.")
        self.blocks = [block["block"] for block in blocks]
        self.continuous = _names(blocks, prefix, "continuous_state", "x")
        self.discrete = _names(blocks, prefix, "discrete_state", "z")
        self.names = [*self.continuous, *self.discrete]

    def __len__(self) -> int:
        return len(self.names)

    def of(self, context: _core.Context) -> np.ndarray:
        """The values of all states in a context."""
        return np.concatenate([context.continuous_state, context.discrete_state])

    def put(self, context: _core.Context, values: np.ndarray) -> _core.Context:
        """The context with these states."""
        count = len(self.continuous)
        context = context.with_continuous_state(values[:count])
        return context.with_discrete_state(values[count:]) if self.discrete else context


def _names(blocks: Sequence[Any], prefix: Any, kind: str, letter: str) -> list[str]:
    return [
        f"{prefix(block['block'])}{letter}[{i}]"
        for block in blocks
        for i in range(len(block[kind]))
    ]


def moved(context: _core.Context, name: str, part: float) -> _core.Context:
    """The context with a parameter that is larger by this part of its value (of 1 if it is 0).

    Parameters
    ----------
    name
        As the option `sensitivity` spells it: 'e', 'ball.e', 'k[2]'.
    """
    for known, value in context.parameters.items():
        for i, number in enumerate(values := np.atleast_1d(np.array(value, dtype=float))):
            spellings = (f"{known}[{i}]", known) if values.size == 1 else (f"{known}[{i}]",)
            if any(name == each or name.endswith(f".{each}") for each in spellings):
                values[i] += part * (abs(number) or 1.0)
                return context.with_parameter(known, values)
    raise ModelError(
        f"unknown parameter '{name}'{_core.known_names(name, list(context.parameters))}"
    )
