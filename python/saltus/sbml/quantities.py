"""The numbers of a model: what it declares, and what determines each."""

from __future__ import annotations

import math
import numbers
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from saltus._core import known_names
from saltus.errors import ModelError

__all__ = ["Declared", "Quantity", "Reaction", "declared", "items"]


@dataclass
class Quantity:
    """A compartment, species, parameter or stoichiometry of a model."""

    id: str
    kind: str
    value: float
    """the value that the model gives; NaN for none"""
    constant: bool
    compartment: str = ""
    """of a species"""
    substance: bool = True
    """whether the id of a species means its amount, not its concentration"""
    given_amount: bool = True
    """whether `value` is an amount"""
    boundary: bool = False
    conversion: str = ""


@dataclass
class Reaction:
    """A reaction with the species that it changes."""

    id: str
    law: Any
    local: dict[str, float]
    changes: list[tuple[str, float, Any]]
    """(species, sign, stoichiometry: a number, the id of a quantity, or mathematics)"""


@dataclass
class Declared:
    """What the elements of a model say, by id."""

    quantities: dict[str, Quantity] = field(default_factory=dict)
    reactions: dict[str, Reaction] = field(default_factory=dict)
    functions: dict[str, Any] = field(default_factory=dict)
    assigned: dict[str, Any] = field(default_factory=dict)
    rates: dict[str, Any] = field(default_factory=dict)
    algebraic: list[Any] = field(default_factory=list)
    initial: dict[str, Any] = field(default_factory=dict)
    events: list[Any] = field(default_factory=list)
    unknown: list[str] = field(default_factory=list)
    """the ids that algebraic rules determine"""

    def reacted(self) -> set[str]:
        """The species whose amount is changed by reactions."""
        return {
            species
            for reaction in self.reactions.values()
            for species, _, _ in reaction.changes
            if self.follows_reactions(species)
        }

    def begin(self, name: str, value: float) -> None:
        """Another value of an id at the start."""
        free = sorted(self.quantities.keys() - self.assigned.keys())
        if name not in free:
            raise ModelError(f"'{name}' has no value at the start{known_names(name, free)}")
        if isinstance(value, bool) or not isinstance(value, numbers.Real) or math.isnan(value):
            raise ModelError(f"'{name}' at the start: expected a number, found {value!r}")
        found = self.quantities[name]
        found.value, found.given_amount = float(value), found.substance
        self.initial.pop(name, None)

    def is_unset(self, name: str) -> bool:
        """Whether the model gives no value at the start. A stoichiometry is 1 then."""
        found = self.quantities.get(name)
        given = found is None or not math.isnan(found.value) or found.kind == "stoichiometry"
        determined = name in self.initial or name in self.assigned or name in self.unknown
        return not (given or determined)

    def follows_reactions(self, species: str) -> bool:
        found = self.quantities[species]
        ruled = species in self.assigned or species in self.rates
        return not (found.boundary or found.constant or ruled)


def items(model: Any, what: str) -> Iterator[Any]:
    """The elements of a list of a model, such as items(model, "Species")."""
    count = getattr(model, f"getNum{what if what == 'Species' else what + 's'}")()
    get = getattr(model, f"get{what}")
    return (get(i) for i in range(count))


def declared(model: Any) -> Declared:
    """What a model says."""
    found = Declared()
    for each in items(model, "FunctionDefinition"):
        found.functions[each.getId()] = each.getMath()
    for each in items(model, "Compartment"):
        usual = 1.0 if each.getLevel() < 3 else math.nan
        size = each.getSize() if each.isSetSize() else usual
        _add(found, Quantity(each.getId(), "compartment", size, each.getConstant()))
    for each in items(model, "Species"):
        _add(found, _species(each, model))
    for each in items(model, "Parameter"):
        value = each.getValue() if each.isSetValue() else math.nan
        _add(found, Quantity(each.getId(), "parameter", value, each.getConstant()))
    for each in items(model, "Reaction"):
        found.reactions[each.getId()] = _reaction(each, found)
    _rules(model, found)
    return found


def _add(found: Declared, quantity: Quantity) -> None:
    found.quantities[quantity.id] = quantity


def _species(each: Any, model: Any) -> Quantity:
    compartment = model.getCompartment(each.getCompartment())
    if compartment is None:
        raise ModelError(
            f"species '{each.getId()}': expected the id of a compartment, found "
            f"'{each.getCompartment()}'"
        )
    points = compartment.isSetSpatialDimensions() and compartment.getSpatialDimensions() == 0
    amount = each.isSetInitialAmount()
    value = each.getInitialAmount() if amount else each.getInitialConcentration()
    known = amount or each.isSetInitialConcentration()
    return Quantity(
        each.getId(),
        "species",
        value if known else math.nan,
        each.getConstant(),
        compartment=each.getCompartment(),
        substance=each.getHasOnlySubstanceUnits() or points,
        given_amount=amount or not known,
        boundary=each.getBoundaryCondition(),
        conversion=each.getConversionFactor() or model.getConversionFactor(),
    )


def _reaction(each: Any, found: Declared) -> Reaction:
    law = each.getKineticLaw()
    local: dict[str, float] = {}
    if law is not None:
        for what in ("Parameter", "LocalParameter"):
            for one in items(law, what):
                local[one.getId()] = one.getValue() if one.isSetValue() else math.nan
    changes = [
        (side.getSpecies(), sign, _stoichiometry(side, found))
        for what, sign in (("Reactant", -1.0), ("Product", 1.0))
        for side in items(each, what)
    ]
    for species, _, _ in changes:
        if species not in found.quantities:
            raise ModelError(f"reaction '{each.getId()}': unknown species '{species}'")
    return Reaction(each.getId(), law.getMath() if law is not None else None, local, changes)


def _stoichiometry(side: Any, found: Declared) -> Any:
    """A number, the id of the quantity that the reference names, or mathematics (level 2)."""
    if side.isSetStoichiometryMath() and side.getStoichiometryMath().getMath() is not None:
        return side.getStoichiometryMath().getMath()
    number = side.getStoichiometry()
    if side.getLevel() < 3:
        number = number / (side.getDenominator() or 1)
    if not side.getId():
        return 1.0 if math.isnan(number) else number
    constant = side.getConstant() if side.getLevel() > 2 else True
    _add(found, Quantity(side.getId(), "stoichiometry", number, constant))
    return side.getId()


def _rules(model: Any, found: Declared) -> None:
    """The rules and assignments that have mathematics."""
    for each in items(model, "Rule"):
        if each.getMath() is None:
            continue
        if each.isAlgebraic():
            found.algebraic.append(each)
        else:
            _require_known(found, "rule", each.getVariable())
            (found.rates if each.isRate() else found.assigned)[each.getVariable()] = each.getMath()
    for each in items(model, "InitialAssignment"):
        if each.getMath() is not None:
            _require_known(found, "initial assignment", each.getSymbol())
            found.initial[each.getSymbol()] = each.getMath()
    found.events = [each for each in items(model, "Event") if each.getTrigger() is not None]
    for event in found.events:
        for each in items(event, "EventAssignment"):
            _require_known(found, f"event '{event.getId()}'", each.getVariable())


def _require_known(found: Declared, what: str, name: str) -> None:
    if name not in found.quantities:
        raise ModelError(
            f"{what}: expected the id of a compartment, species, parameter or species reference, "
            f"found '{name}'"
        )
