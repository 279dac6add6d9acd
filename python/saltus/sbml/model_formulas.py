"""The formulas of a model: its numbers at the start, derivatives, outputs and guards."""

from __future__ import annotations

import math

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.sbml.events import events_of
from saltus.sbml.formula import Formula, evaluated
from saltus.sbml.instant import Instant
from saltus.sbml.kinds import FIRST, Kinds
from saltus.sbml.quantities import Declared
from saltus.sbml.running import RunningScope
from saltus.sbml.scope import InitialScope, Scope

__all__ = ["ModelFormulas", "Shown", "initial_values"]

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

    def __init__(self, kinds: Kinds, values: dict[str, float]):
        self.kinds, self.values = kinds, values
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

    def instant(self) -> Instant | None:
        """What happens at instants; None where nothing does. To be called when all other formulas
        are made.
        """
        events = events_of(self.scope)
        return Instant(self.scope, events) if events or self.scope.differences else None
