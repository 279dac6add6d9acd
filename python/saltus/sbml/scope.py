"""`Scope`: the value and the rate of each id, as nodes of an expression graph."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from saltus.errors import ModelError
from saltus.sbml.algebraic import names_in, solved
from saltus.sbml.derivative import along
from saltus.sbml.mathematics import node_of
from saltus.sbml.quantities import Declared, Reaction

__all__ = ["InitialScope", "Scope"]


class Scope:
    """The meaning of the ids. A derived class has the places of numbers without a formula."""

    at_instants = False
    """whether formulas are read at instants only: an event may have set what the model has not"""

    def __init__(self, graph: Any, declared: Declared, unknown: list[str]):
        self.graph, self.declared, self.unknown = graph, declared, unknown
        self.functions: Mapping[str, Any] = declared.functions
        self._values: dict[str, int] = {}
        self._open: list[str] = []
        self._changes: dict[str, list[tuple[Reaction, float, Any]]] = {}
        for reaction in declared.reactions.values():
            for species, sign, number in reaction.changes:
                self._changes.setdefault(species, []).append((reaction, sign, number))

    def value(self, name: str) -> int:
        """The node of the value that an id has in a formula."""
        if name not in self._values:
            for each in self._order(name):
                if each not in self._values:
                    self._keep(each)
        return self._values[name]

    def _keep(self, name: str) -> None:
        if name in self._open:
            ring = " -> ".join([*self._open[self._open.index(name) :], name])
            raise ModelError(f"'{name}' is defined by itself: {ring}")
        self._open.append(name)
        try:
            self._values[name] = self._made(name)
        finally:
            self._open.pop()

    def _order(self, name: str) -> list[str]:
        """The ids that its formula reads, then the id: a long chain of rules is no deep one."""
        found: list[str] = []
        seen = {name, *self._open}
        waiting = [(name, self._read(name))]
        while waiting:
            new = next((each for each in waiting[-1][1] if each not in seen), None)
            if new is None:
                found.append(waiting.pop()[0])
            elif new not in self._values:
                seen.add(new)
                waiting.append((new, self._read(new)))
            else:
                seen.add(new)
        return found

    def _read(self, name: str) -> Iterator[str]:
        """The ids with a formula that the formula of an id reads."""
        tree = self.definition(name)
        return iter(()) if tree is None else filter(self.definition, names_in(tree))

    def definition(self, name: str) -> Any:
        """The formula of an id; None if it has none."""
        return self.declared.assigned.get(name)

    def _made(self, name: str) -> int:
        declared = self.declared
        if name in self.unknown:
            self._values |= self._solved()
            return self._values[name]
        if name in declared.reactions:
            return self.speed(declared.reactions[name])
        if name not in declared.quantities:
            raise ModelError(f"unknown id '{name}'; a formula of the model reads it")
        if not self.at_instants and declared.is_unset(name):
            raise ModelError(unset(name))
        try:
            return self.defined(name)
        except ModelError as error:
            raise _placed(error, name) from None

    def defined(self, name: str) -> int:
        raise NotImplementedError

    def time(self) -> int:
        raise NotImplementedError

    def comparison(self, op: str, a: int, b: int) -> int:
        raise NotImplementedError

    def formula(self, tree: Any, local: Mapping[str, int] | None = None) -> int:
        return node_of(self, tree, local)

    def speed(self, reaction: Reaction) -> int:
        """The rate of a reaction, in extent per time; 0 without a law."""
        if reaction.law is None:
            return int(self.graph.constant(0.0))
        for name in names_in(reaction.law):
            if math.isnan(reaction.local.get(name, 0.0)):
                raise ModelError(f"reaction {reaction.id}: {unset(name)}")
        local = {name: int(self.graph.constant(v)) for name, v in reaction.local.items()}
        try:
            return self.formula(reaction.law, local)
        except ModelError as error:
            raise _placed(error, f"reaction {reaction.id}") from None

    def amount_rate(self, species: str) -> int:
        """The rate of the amount of a species by the reactions."""
        total = None
        for reaction, sign, number in self._changes.get(species, ()):
            rate = self.value(reaction.id)
            if number == 1.0:
                term = rate
            else:
                term = self.apply("mul", self.stoichiometry(number), rate)
            if total is None:
                total = term if sign > 0 else self.apply("neg", term)
            else:
                total = self.apply("add" if sign > 0 else "sub", total, term)
        if total is None:
            return int(self.graph.constant(0.0))
        factor = self.declared.quantities[species].conversion
        return self.apply("mul", total, self.value(factor)) if factor else total

    def stoichiometry(self, number: Any) -> int:
        if isinstance(number, float):
            return int(self.graph.constant(number))
        return self.value(number) if isinstance(number, str) else self.formula(number)

    def rate(self, name: str) -> int:
        """The derivative of the value of an id with respect to time."""
        declared = self.declared
        found = declared.quantities.get(name)
        if name in declared.rates:
            return self.formula(declared.rates[name])
        if found is None or name in declared.assigned or name in self.unknown:
            return self.derivative(self.value(name), name)
        follows = found.kind == "species" and declared.follows_reactions(name)
        change = self.amount_rate(name) if follows else int(self.graph.constant(0.0))
        if found.kind != "species" or found.substance:
            return change
        size = found.compartment
        if self.moves(size):
            change = self.apply("sub", change, self.apply("mul", self.value(name), self.rate(size)))
        return self.apply("div", change, self.value(size))

    def moves(self, name: str) -> bool:
        """Whether a rule changes the id."""
        declared = self.declared
        return name in declared.rates or name in declared.assigned or name in self.unknown

    def derivative(self, node: int, name: str) -> int:
        return along(self.graph, node, self.variable_rate, name)

    def variable_rate(self, kind: str, index: int) -> int:
        """The derivative of a variable of the graph along the flow."""
        raise NotImplementedError

    def apply(self, op: str, *operands: int) -> int:
        return int(self.graph.apply(op, *operands))

    def _solved(self) -> dict[str, int]:
        """The unknowns of the algebraic rules, which are built with symbols in their places."""
        kept, opened = self._values, self._open
        symbols = {name: int(self.graph.input(0, k)) for k, name in enumerate(self.unknown)}
        self._values, self._open = dict(symbols), []
        try:
            zeros = [self.formula(rule.getMath()) for rule in self.declared.algebraic]
        finally:
            self._values, self._open = kept, opened
        found = solved(self.graph, zeros, len(symbols), self.unknown)
        return dict(zip(self.unknown, found, strict=True))


def _placed(error: ModelError, name: str) -> ModelError:
    """The error with the id whose formula it is about; the innermost id is named."""
    text = str(error)
    return error if "in the formula" in text else ModelError(f"'{name}': in the formula: {text}")


class InitialScope(Scope):
    """The values at the start, before any event."""

    def time(self) -> int:
        return int(self.graph.constant(0.0))

    def comparison(self, op: str, a: int, b: int) -> int:
        return self.apply(op, a, b)

    def definition(self, name: str) -> Any:
        return self.declared.initial.get(name, self.declared.assigned.get(name))

    def defined(self, name: str) -> int:
        tree = self.definition(name)
        return self._given(name) if tree is None else self.formula(tree)

    def _given(self, name: str) -> int:
        found = self.declared.quantities[name]
        unset = math.isnan(found.value)
        value = int(self.graph.constant(usual(found.kind) if unset else found.value))
        if unset or found.kind != "species" or found.given_amount == found.substance:
            return value
        size = self.value(found.compartment)
        return self.apply("mul" if found.substance else "div", value, size)

    def derivative(self, node: int, name: str) -> int:
        raise ModelError(
            f"rateOf '{name}' in an initial assignment: '{name}' has no rate of its own; "
            "write its derivative as a formula"
        )


def unset(name: str) -> str:
    return (
        f"'{name}' has no value, and a formula reads it; expected one in the model or in `values`"
    )


def usual(kind: str) -> float:
    """The value of a quantity of which the model says none."""
    return 1.0 if kind in ("compartment", "stoichiometry") else 0.0
