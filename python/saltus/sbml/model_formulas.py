"""The formulas of a model: its numbers at the start, derivatives, outputs and guards."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.sbml.events import DUE, NEVER, STARTED, Program, events_of
from saltus.sbml.formula import Formula, evaluated
from saltus.sbml.kinds import FIRST, Kinds
from saltus.sbml.quantities import Declared
from saltus.sbml.running import RunningScope
from saltus.sbml.scope import InitialScope, Scope

__all__ = ["ModelFormulas", "Shown", "initial_values"]

AFTER = 1e-13
"""relative; how much later than its zero a strict comparison of the time changes"""
Shown = tuple[str, str]
"""(id, 'value', 'amount' or 'concentration')"""


def initial_values(says: Declared, unknown: list[str]) -> dict[str, float]:
    """The value of each id at the start, except ids whose values a run finds by a rule."""
    graph = _core.Graph()
    scope = InitialScope(graph, says, unknown)
    found = {*says.assigned, *unknown}
    nodes = {
        name: scope.value(name)
        for name, quantity in says.quantities.items()
        if (name not in found or quantity.kind == "compartment") and not says.is_unset(name)
    }
    numbers = evaluated(graph.tape(list(nodes.values())), 0.0, (), (), ())
    unset = {name: math.nan for name in says.quantities if says.is_unset(name)}
    return {**unset, **dict(zip(nodes, numbers.tolist(), strict=True))}


class ModelFormulas:
    """The formulas of a model."""

    def __init__(self, kinds: Kinds, values: dict[str, float], seed: int):
        self.kinds, self.values, self.seed = kinds, values, seed
        self.x, self.z, self.p = (
            np.array([self.stored(name) for name in names], dtype=float)
            for names in (kinds.states, kinds.held, kinds.parameters)
        )
        self._require_finite()
        self.graph = _core.Graph()
        self.scope = RunningScope(self.graph, kinds, self.p, FIRST + len(kinds.held))

    def stored(self, name: str) -> float:
        """The number that memory has for an id at the start."""
        value = self.values[name]
        if name in self.kinds.held and self.kinds.declared.is_unset(name):
            return 0.0  # which nothing reads before an event has set it
        if name not in self.kinds.amounts:
            return value
        found = self.kinds.declared.quantities[name]
        if found.given_amount and name not in self.kinds.declared.initial:
            return 0.0 if math.isnan(found.value) else found.value
        return value * self.values[found.compartment]

    def _require_finite(self) -> None:
        for names, numbers in ((self.kinds.states, self.x), (self.kinds.held, self.z)):
            for name, value in zip(names, numbers, strict=True):
                if not math.isfinite(value):
                    raise ModelError(
                        f"'{name}' starts at {value:g}; expected a finite number: look at its "
                        "initial assignment, and at divisions by zero"
                    )

    def derivatives(self) -> Formula:
        return Formula(self.graph, [self.scope.stored_rate(n) for n in self.kinds.states])

    def outputs(self, shown: list[Shown] | None) -> dict[str, Formula]:
        if shown is not None:
            return {"shown": Formula(self.graph, [self.shown(*one) for one in shown])}
        says = self.kinds.declared
        names = [n for n in says.quantities if n not in self.kinds.parameters]
        names += [n for n in self.kinds.parameters if says.quantities[n].kind == "species"]
        names = [n for n in names if not says.is_unset(n) or n in self.kinds.held]
        names += [name for name in says.reactions if name]
        return {name: Formula(self.graph, [self.number(name)], True) for name in names}

    def number(self, name: str) -> int:
        """The node of an id that is shown, which may be unset."""
        unset = self.kinds.declared.is_unset(name)
        return self.scope.defined(name) if unset else self.scope.value(name)

    def shown(self, name: str, how: str) -> int:
        """The node of an id as it is to be shown."""
        scope: Scope = self.scope
        found = self.kinds.declared.quantities.get(name)
        if found is None or found.kind != "species" or how == "value":
            return self.number(name)
        if how == "amount" and name in self.kinds.amounts:
            return self.scope.stored(name)
        if (how == "amount") == found.substance:
            return self.number(name)
        op = "mul" if how == "amount" else "div"
        return scope.apply(op, self.number(name), scope.value(found.compartment))

    def program(self, flow: Any) -> Program:
        return events_of(self.scope, flow, self.seed)

    def discrete(self, program: Program) -> np.ndarray:
        """The discrete state before the start."""
        z = np.zeros(program.discrete)
        z[DUE] = NEVER
        z[FIRST : FIRST + len(self.z)] = self.z
        return z

    def started(self) -> Formula:
        """1 before the start of the run, -1 from then on."""
        graph = self.graph
        twice = graph.apply("mul", graph.constant(2.0), graph.discrete_state(STARTED))
        return Formula(graph, [graph.apply("sub", graph.constant(1.0), twice)], True)

    def guards(self) -> Formula:
        """The differences, their negatives, and the time since an execution became due."""
        scope, graph, found = self.scope, self.graph, list(self.scope.differences)
        up = [self.late(n, k not in scope.zero_above) for k, n in enumerate(found)]
        down = [self.late(graph.apply("neg", n), k not in scope.zero_below)
                for k, n in enumerate(found)]  # fmt: skip
        due = graph.apply("sub", graph.time(), graph.discrete_state(DUE))
        return Formula(graph, [*up, *down, due])

    def late(self, node: int, strictly: bool) -> int:
        """A guard for a difference that becomes positive. One of the time alone that is zero at a
        time at which its comparison has not changed yet fires just after that time: a row there
        shows the values before.
        """
        if not (strictly and self.scope.only_time(node)):
            return node
        graph = self.graph
        size = graph.apply("add", graph.constant(1.0), graph.apply("abs", graph.time()))
        return self.scope.apply("sub", node, graph.apply("mul", graph.constant(AFTER), size))
