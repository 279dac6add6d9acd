"""`Formula`: a callback of a block that is a tape already."""

from __future__ import annotations

import inspect
from typing import Any

import numpy as np

from saltus import _core
from saltus.tracing import Dependencies, Known, Refused, Traced

__all__ = ["Called", "Formula", "evaluated"]

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

    def __call__(self, time: float, state: Any, /, **parameters: float) -> Any:
        p = np.fromiter(parameters.values(), float, len(parameters))
        x, z = state.continuous_state, state.discrete_state
        found = evaluated(self.tape, time, x, z, p)
        return float(found[0]) if self.scalar else found

    def outcome(self) -> Traced:
        """As `tracing.trace` answers."""
        return Traced(
            tape=self.tape,
            shape=() if self.scalar else (self.tape.size,),
            boolean=False,
            comparison=None,
            relations=None,
            wrote_x=False,
            wrote_z=False,
            wrote_mode=False,
            dependencies=Dependencies(),
        )


class Called(Known):
    """A callback that is called, and that writes nothing but the state it returns."""

    def outcome(self) -> Refused:
        return Refused("the events of a model in SBML wait in a queue, which Python keeps")
