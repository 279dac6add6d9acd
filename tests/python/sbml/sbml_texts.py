"""Small models in SBML, written from formulas."""

import libsbml


def formula(text):
    tree = libsbml.parseL3Formula(text)
    assert tree is not None, libsbml.getLastParseL3Error()
    return tree


def model(
    compartments=(),
    species=(),
    parameters=(),
    rules=(),
    initial=(),
    reactions=(),
    events=(),
    functions=(),
    level=3,
    version=2,
    **attributes,
):
    """The text of a model.

    compartments, parameters: {id: value}, or {id: (value, constant)}; not constant if not said.
    species: {id: dict(compartment=, amount= or concentration=, ...)}.
    rules: [("rate" or "assignment", id, formula) or ("algebraic", formula)].
    initial, functions: {id: formula}. events: dicts. reactions: dicts with reactants, products.
    """
    document = libsbml.SBMLDocument(level, version)
    made = document.createModel()
    made.setId(attributes.pop("id", "small"))
    for name, value in attributes.items():
        getattr(made, f"set{name}")(value)
    for name, text in dict(functions).items():
        each = made.createFunctionDefinition()
        each.setId(name)
        each.setMath(formula(text))
    for name, value in dict(compartments).items():
        each = made.createCompartment()
        each.setId(name)
        each.setSpatialDimensions(3)
        _value(each, "Size", value)
    for name, said in dict(species).items():
        _species(made, name, **said)
    for name, value in dict(parameters).items():
        each = made.createParameter()
        each.setId(name)
        _value(each, "Value", value)
    for name, text in dict(initial).items():
        each = made.createInitialAssignment()
        each.setSymbol(name)
        each.setMath(formula(text))
    for rule in rules:
        _rule(made, *rule)
    for said in reactions:
        _reaction(made, **said)
    for said in events:
        _event(made, **said)
    return libsbml.writeSBMLToString(document)


def _value(each, what, value):
    number, constant = value if isinstance(value, tuple) else (value, False)
    if number is not None:
        getattr(each, f"set{what}")(number)
    each.setConstant(constant)


def _species(made, name, compartment="c", amount=None, concentration=None, substance=False,
             boundary=False, constant=False, conversion=None):  # fmt: skip
    each = made.createSpecies()
    each.setId(name)
    each.setCompartment(compartment)
    if amount is not None:
        each.setInitialAmount(amount)
    if concentration is not None:
        each.setInitialConcentration(concentration)
    each.setHasOnlySubstanceUnits(substance)
    each.setBoundaryCondition(boundary)
    each.setConstant(constant)
    if conversion is not None:
        each.setConversionFactor(conversion)


def _rule(made, kind, *rest):
    each = getattr(made, f"create{kind.title()}Rule")()
    if len(rest) == 2:
        each.setVariable(rest[0])
    if rest[-1] is not None:
        each.setMath(formula(rest[-1]))


def _reaction(made, law, reactants=(), products=(), local=(), name="r", fast=False):
    each = made.createReaction()
    each.setId(name)
    each.setReversible(False)
    if made.getLevel() == 3 and made.getVersion() == 1:
        each.setFast(fast)
    for side, create in ((reactants, each.createReactant), (products, each.createProduct)):
        for said in side:
            species, number, reference = (*said, None, None)[:3] if isinstance(said, tuple) else (
                said, 1.0, None)  # fmt: skip
            one = create()
            one.setSpecies(species)
            if number is not None:
                one.setStoichiometry(number)
            one.setConstant(reference is None)
            if reference is not None:
                one.setId(reference)
    if law is not None:
        kinetic = each.createKineticLaw()
        kinetic.setMath(formula(law))
        for key, value in dict(local).items():
            one = kinetic.createLocalParameter()
            one.setId(key)
            one.setValue(value)


def _event(made, trigger, assign, name=None, delay=None, priority=None, initial=True,
           persistent=True, early=True):  # fmt: skip
    each = made.createEvent()
    if name:
        each.setId(name)
    each.setUseValuesFromTriggerTime(early)
    one = each.createTrigger()
    one.setInitialValue(initial)
    one.setPersistent(persistent)
    if trigger is not None:
        one.setMath(formula(trigger))
    for what, text in (("Delay", delay), ("Priority", priority)):
        if text is not None:
            getattr(each, f"create{what}")().setMath(formula(text))
    for variable, text in assign.items():
        one = each.createEventAssignment()
        one.setVariable(variable)
        one.setMath(formula(text))
