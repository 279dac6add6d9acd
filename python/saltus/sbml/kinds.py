"""Which rule determines each number of a model, and which memory holds it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from saltus.sbml.quantities import Declared, items

__all__ = [
    "FIRST",
    "LATER",
    "LOOK",
    "RUNNING",
    "STARTED",
    "Kinds",
    "assigned_by_events",
    "kinds_of",
]

STARTED, RUNNING, LOOK, LATER, FIRST = range(5)
"""positions in the discrete state: whether the run has started; the number of the event, from 1 on,
whose values wait to be assigned; whether the sides of the differences are to be looked at, at once
or when nothing else is due; the first number that events alone change. See `instant` for the others
"""


@dataclass
class Kinds:
    """The ids of a model by what determines them; each list is in the order of the model."""

    declared: Declared
    states: list[str]
    """followed by the solver: those of rate rules, and species of reactions"""
    held: list[str]
    """changed by events alone"""
    parameters: list[str]
    """constant"""
    unknown: list[str]
    """those of algebraic rules"""
    amounts: set[str]
    """species of `states`, `held` and `parameters` whose amount is kept, not their concentration:
    those in a compartment whose size changes
    """

    @cached_property
    def places(self) -> dict[str, tuple[str, int]]:
        """The place of the number of each id: ('x', 'z' or 'p', position)."""
        found = {name: ("x", i) for i, name in enumerate(self.states)}
        found |= {name: ("z", FIRST + i) for i, name in enumerate(self.held)}
        return found | {name: ("p", i) for i, name in enumerate(self.parameters)}


def kinds_of(declared: Declared, unknown: list[str], without_size: set[str]) -> Kinds:
    """The kinds of a model whose algebraic rules determine `unknown`.

    `without_size` are the compartments of size zero, in which there is no concentration.
    """
    reacted, by_events = declared.reacted(), assigned_by_events(declared)
    lists: dict[str, list[str]] = {"states": [], "held": [], "parameters": []}
    for name in declared.quantities:
        if name in declared.assigned or name in unknown:
            continue
        moves = name in declared.rates or name in reacted
        kind = "states" if moves else "held" if name in by_events else "parameters"
        lists[kind].append(name)
    changing = {*declared.rates, *declared.assigned, *unknown, *by_events}
    amounts = {
        name
        for names in lists.values()
        for name in names
        if (found := declared.quantities[name]).kind == "species"
        and not found.substance
        and name not in declared.rates
        and (found.compartment in changing or found.compartment in without_size)
    }
    return Kinds(declared, **lists, unknown=unknown, amounts=amounts)


def assigned_by_events(declared: Declared) -> set[str]:
    return {
        each.getVariable()
        for event in declared.events
        for each in items(event, "EventAssignment")
        if each.getMath() is not None
    }
