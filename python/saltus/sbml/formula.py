"""`Formula`: a callback of a block that is a tape already."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import Any

import numpy as np

from saltus import _core
from saltus.tracing import Dependencies, Known, Traced

__all__ = ["Assignment", "Formula", "evaluated"]

NO_INPUTS: list[Any] = []


def evaluated(tape: Any, time: float, x: Any, z: Any, p: Any) -> Any:
    """The numbers of a tape."""
    return tape(time, x, z, 0, 0, p, NO_INPUTS)


SIGNATURE = inspect.signature(lambda time, state, /, **parameters: None)


class Formula(Known):
    """Nodes of a graph as a callback, which is not traced, for it is a tape."""

    __signature__ = SIGNATURE  # a model of thousands of formulas need not be asked for each
    wrote_x = wrote_z = False

    def __init__(self, graph: _core.Graph, nodes: list[int], scalar: bool = False):
        self.tape = graph.tape(nodes)
        self.scalar = scalar

    def numbers(self, time: float, state: Any, parameters: Mapping[str, float]) -> Any:
        p = np.fromiter(parameters.values(), float, len(parameters))
        x, z = state.continuous_state, state.discrete_state
        return self.tape(time, x, z, 0, state.entry or 0, p, NO_INPUTS)

    def __call__(self, time: float, state: Any, /, **parameters: float) -> Any:
        found = self.numbers(time, state, parameters)
        return float(found[0]) if self.scalar else found

    def outcome(self) -> Traced:
        """As `tracing.trace` answers."""
        return Traced(
            tape=self.tape,
            shape=() if self.scalar else (self.tape.size,),
            boolean=False,
            residual=None,
            relations=None,
            wrote_x=self.wrote_x,
            wrote_z=self.wrote_z,
            wrote_mode=False,
            dependencies=Dependencies(),
        )


class Assignment(Formula):
    """Nodes for all entries of the states as a reset map; `x` is empty where it writes none."""

    def __init__(self, graph: _core.Graph, x: list[int], z: list[int]):
        super().__init__(graph, [*x, *z])
        self.wrote_x, self.wrote_z = bool(x), True

    def __call__(self, time: float, state: Any, /, **parameters: float) -> Any:
        found = self.numbers(time, state, parameters)
        first = len(state.continuous_state) if self.wrote_x else 0
        if first:
            state = state.with_continuous_state(found[:first])
        return state.with_discrete_state(found[first:])
