"""`RunningScope`: the values of the ids during a run."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from saltus.errors import ModelError
from saltus.sbml.derivative import Jumps, along
from saltus.sbml.kinds import Kinds
from saltus.sbml.scope import Scope
from saltus.sbml.walk import Reads

__all__ = ["RunningScope"]

MIRRORED = {"gt": "lt", "ge": "le", "lt": "gt", "le": "ge", "eq": "eq", "ne": "ne"}


class RunningScope(Scope):
    """Ids as formulas of the time, the states, what is held, and the parameters.

    A comparison of numbers that move is read by the side of its difference: -1, 0 or 1 in the
    discrete state, which changes only where the difference crosses zero. So a formula is smooth
    between instants.
    """

    def __init__(self, graph: Any, kinds: Kinds, constants: np.ndarray, first_side: int):
        super().__init__(graph, kinds.declared, kinds.unknown)
        self.kinds, self.constants, self.first_side = kinds, constants, first_side
        self.differences: dict[int, int] = {}
        """node of a difference -> its number"""
        self.equalities: set[int] = set()
        """numbers of the differences that some formula compares by == or !="""
        self.zero_below: set[int] = set()
        self.zero_above: set[int] = set()
        """numbers of the differences of which a formula counts zero to the lower or upper side"""
        self.flows = Reads(graph, "time", "continuous_state", "input").of
        self.follows_states = Reads(graph, "continuous_state").of
        self.jumps = Jumps(graph, self.flows).of

    def time(self) -> int:
        return int(self.graph.time())

    def defined(self, name: str) -> int:
        declared = self.kinds.declared
        if name in declared.assigned:
            return self.formula(declared.assigned[name])
        stored = self.stored(name)
        if name not in self.kinds.amounts:
            return stored
        return self.apply("div", stored, self.value(declared.quantities[name].compartment))

    def stored(self, name: str) -> int:
        """The node of the number that memory has for an id. A constant that is not finite has a
        node of its own, because a parameter has to be finite.
        """
        memory, i = self.kinds.places[name]
        if memory == "x":
            return int(self.graph.continuous_state(i))
        if memory == "z":
            return int(self.graph.discrete_state(i))
        value = float(self.constants[i])
        return int(self.graph.parameter(i) if math.isfinite(value) else self.graph.constant(value))

    def stored_rate(self, name: str) -> int:
        """The derivative of the number of a state."""
        return self.amount_rate(name) if name in self.kinds.amounts else self.rate(name)

    def variable_rate(self, kind: str, index: int) -> int:
        if kind == "time":
            return int(self.graph.constant(1.0))
        if kind == "continuous_state":
            return self.stored_rate(self.kinds.states[index])
        return int(self.graph.constant(0.0))

    def comparison(self, op: str, a: int, b: int) -> int:
        difference = self.apply("sub", a, b)
        if not self.flows(difference):
            return self.apply(op, a, b)
        opposite = self.apply("sub", b, a)
        if opposite in self.differences:
            difference, op = opposite, MIRRORED[op]
        elif difference not in self.differences:
            if self.at_instants:
                return self.apply(op, a, b)
            self.differences[difference] = len(self.differences)
        k = self.differences[difference]
        if op in ("eq", "ne"):
            self.equalities.add(k)
        if op in ("gt", "le"):
            self.zero_below.add(k)
        elif op in ("ge", "lt"):
            self.zero_above.add(k)
        side = self.graph.discrete_state(self.first_side + k)
        return self.apply(op, side, self.graph.constant(0.0))

    @property
    def momentary(self) -> set[int]:
        """Numbers of the differences whose zero is a moment of its own: compared by == or !=, or
        counted to both sides, as by x >= 4 and x <= 4.
        """
        return self.equalities | (self.zero_above & self.zero_below)

    def fires_late(self, k: int) -> bool:
        """Whether difference k is one of the time alone that is zero at a time at which its
        comparison has not changed yet. Its guard fires just after that time: a row there shows the
        values before.
        """
        both = k in self.zero_above and k in self.zero_below
        return not (both or self.follows_states(list(self.differences)[k]))

    def size_of_terms(self, node: int) -> int:
        """A node for the size of the terms of a node: |a| + |b| for a - b."""
        if self.graph.value(node) is None:
            op, operands = self.graph.operation(node)
            if op in ("add", "sub"):
                return self.apply("add", *map(self.size_of_terms, operands))
            if op == "mul":
                return self.apply("mul", *map(self.size_of_terms, operands))
            if op == "neg":
                return self.size_of_terms(operands[0])
            if op == "div":
                below = self.apply("abs", operands[1])
                return self.apply("div", self.size_of_terms(operands[0]), below)
        return self.apply("abs", node)

    def curved(self, node: int) -> bool:
        """Whether a node is no straight line in the time and the states, between instants: also one
        that jumps by itself, as floor(x).
        """
        if self.jumps(node):
            return True

        def one(kind: str, index: int) -> int:
            moves = kind in ("time", "continuous_state")
            return int(self.graph.constant(1.0 if moves else 0.0))

        try:
            return self.flows(along(self.graph, node, one, "a comparison"))
        except ModelError:
            return True
