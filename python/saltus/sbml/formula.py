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
        return _traced(self.tape, () if self.scalar else (self.tape.size,), False, False)


class Assignment(Known):
    """Nodes of a graph for the entries of the states as a reset map. All others stay."""

    __signature__ = SIGNATURE

    def __init__(self, graph: _core.Graph, x: list[int], z: list[int]):
        """`x` and `z` are nodes for all entries; `x` is empty where no state is written."""
        self.all = Formula(graph, [*x, *z])
        self.tape = self.all.tape
        self.first = len(x)

    def __call__(self, time: float, state: Any, /, **parameters: float) -> Any:
        found = self.all.numbers(time, state, parameters)
        if self.first:
            state = state.with_continuous_state(found[: self.first])
        return state.with_discrete_state(found[self.first :])

    def outcome(self) -> Traced:
        """As `tracing.trace` answers."""
        return _traced(self.tape, (), self.first > 0, True)


def _traced(tape: Any, shape: tuple[int, ...], wrote_x: bool, wrote_z: bool) -> Traced:
    return Traced(
        tape=tape,
        shape=shape,
        boolean=False,
        comparison=None,
        relations=None,
        wrote_x=wrote_x,
        wrote_z=wrote_z,
        wrote_mode=False,
        dependencies=Dependencies(),
    )
