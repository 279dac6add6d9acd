"""What a model in SBML says about values and rates: each rule by a closed form."""

import math

import numpy as np
import pytest

pytest.importorskip("libsbml", reason="python-libsbml reads the models")

import saltus
from saltus.sbml import load, time_course
from sbml_texts import model

e = math.exp
ONE = {"c": (1.0, True)}
DECAY = {"law": "k * x", "reactants": ["x"]}


def at_end(text, name, end=1.0, **how):
    """The value of an id at the end of a run."""
    return time_course(text, start=0, duration=end, steps=4, variables=[name], **how)[-1, 1]


# (what, model, id, value at time 1); the tolerance of a run is 1e-9 a step, of some tens of steps
VALUES = {
    "a rate rule": (model(parameters={"x": 1, "k": (2, True)}, rules=[("rate", "x", "-k*x")]),
                    "x", e(-2)),
    "an assignment rule": (model(parameters={"x": 1, "y": None}, rules=[
        ("rate", "x", "-x"), ("assignment", "y", "3 * x + time")]), "y", 3 * e(-1) + 1),
    "a rule before the rule it reads": (model(parameters={"a": None, "b": None}, rules=[
        ("assignment", "a", "2 * b"), ("assignment", "b", "time")]), "a", 2.0),
    "a rule without mathematics": (model(parameters={"x": 4}, rules=[
        ("assignment", "x", None)]), "x", 4.0),
    "an initial assignment": (model(parameters={"x": 1, "k": (2, True)}, initial={"x": "k + 1"},
                              rules=[("rate", "x", "0")]), "x", 3.0),
    "initial assignments in any order": (model(parameters={"a": 0, "b": 0},
                                         initial={"a": "b + 1", "b": "5"}), "a", 6.0),
    "an initial assignment of a rule's value": (model(parameters={"a": 0, "b": None},
        initial={"a": "b"}, rules=[("assignment", "b", "time + 7")]), "a", 7.0),
    "a species by concentration": (model(ONE, {"x": dict(concentration=2.0)}, {"k": (1, True)},
                                   reactions=[DECAY]), "x", 2 * e(-1)),
    "a reaction is amount per time": (model({"c": (4.0, True)}, {"x": dict(concentration=2.0)},
        {"k": (1, True)}, reactions=[DECAY]), "x", 2 * e(-0.25)),
    "a species by amount": (model({"c": (4.0, True)}, {"x": dict(amount=2.0, substance=True)},
                            {"k": (1, True)}, reactions=[DECAY]), "x", 2 * e(-1)),
    "an amount as a concentration": (model({"c": (4.0, True)}, {"x": dict(amount=2.0)},
        rules=[("rate", "x", "0")]), "x", 0.5),
    "a concentration as an amount": (model({"c": (4.0, True)},
        {"x": dict(concentration=2.0, substance=True)}, rules=[("rate", "x", "0")]), "x", 8.0),
    "a compartment that grows": (model({"c": 1.0}, {"x": dict(concentration=3.0)},
                                 rules=[("rate", "c", "2")]), "x", 1.0),
    "a growing compartment with a reaction": (model({"c": 1.0}, {"x": dict(concentration=1.0)},
        rules=[("rate", "c", "1")], reactions=[{"law": "1", "products": ["x"]}]), "x", 1.0),
    "a compartment by a rule": (model({"c": None}, {"x": dict(amount=3.0)},
                                rules=[("assignment", "c", "1 + 2 * time")]), "x", 1.0),
    "a concentration by a rate rule in a growing compartment": (model({"c": 1.0},
        {"x": dict(concentration=1.0, boundary=True)}, rules=[("rate", "c", "1"),
        ("rate", "x", "2")]), "x", 3.0),
    "a boundary species": (model(ONE, {"x": dict(concentration=2.0, boundary=True)},
                           {"k": (1, True)}, reactions=[DECAY]), "x", 2.0),
    "a constant species": (model(ONE, {"x": dict(concentration=2.0, boundary=True, constant=True),
        "y": dict(concentration=0.0)}, reactions=[{"law": "x", "products": ["y"],
        "reactants": ["x"]}]), "y", 2.0),
    "stoichiometries": (model(ONE, {"x": dict(concentration=1.0), "y": dict(concentration=0.0)},
        reactions=[{"law": "0.1", "reactants": [("x", 2.0)], "products": [("y", 3.0)]}]),
        "y", 0.3),
    "a species on both sides": (model(ONE, {"x": dict(concentration=1.0)}, reactions=[
        {"law": "x", "reactants": ["x"], "products": [("x", 2.0)]}]), "x", e(1)),
    "a stoichiometry by a rule": (model(ONE, {"x": dict(concentration=0.0)},
        rules=[("assignment", "n", "2 * time")], reactions=[
            {"law": "1", "products": [("x", None, "n")]}]), "x", 1.0),
    "a stoichiometry by a rate rule": (model(ONE, {"x": dict(concentration=0.0)},
        rules=[("rate", "n", "1")], reactions=[{"law": "1", "products": [("x", 1.0, "n")]}]),
        "x", 1.5),
    "a stoichiometry that is assigned": (model(ONE, {"x": dict(concentration=0.0)},
        initial={"n": "3"}, reactions=[{"law": "1", "products": [("x", 1.0, "n")]}]), "x", 3.0),
    "a local parameter hides a global one": (model(ONE, {"x": dict(concentration=1.0)},
        {"k": (5, True)}, reactions=[{**DECAY, "local": {"k": 1.0}}]), "x", e(-1)),
    "a reaction without a law": (model(ONE, {"x": dict(concentration=1.0)}, reactions=[
        {"law": None, "reactants": ["x"]}]), "x", 1.0),
    "the rate of a reaction by its id": (model(ONE, {"x": dict(concentration=1.0)},
        {"k": (2, True), "y": None}, rules=[("assignment", "y", "r")], reactions=[DECAY]),
        "y", 2 * e(-2)),
    "a conversion factor of a species": (model(ONE, {"x": dict(amount=0.0, substance=True,
        conversion="f")}, {"f": (3, True)}, reactions=[{"law": "1", "products": ["x"]}]),
        "x", 3.0),
    "a conversion factor of the model": (model(ONE, {"x": dict(amount=0.0, substance=True)},
        {"f": (3, True)}, reactions=[{"law": "1", "products": ["x"]}], ConversionFactor="f"),
        "x", 3.0),
    "a function": (model(parameters={"x": 1}, functions={"f": "lambda(a, b, a - b)"},
                   rules=[("rate", "x", "f(1, x)")]), "x", 1.0),
    "a function of a function": (model(parameters={"y": None}, functions={
        "f": "lambda(a, a ^ 2)", "g": "lambda(b, f(b) + 1)"},
        rules=[("assignment", "y", "g(time + 1)")]), "y", 5.0),
    "avogadro": (model(parameters={"y": None}, rules=[("assignment", "y", "avogadro / 1e23")]),
                 "y", 6.02214179),
    "the rate of a state": (model(parameters={"x": 1, "y": None}, rules=[
        ("rate", "x", "-x"), ("assignment", "y", "rateOf(x)")]), "y", -e(-1)),
    "the rate of a species": (model({"c": (2.0, True)}, {"x": dict(concentration=1.0)},
        {"k": (2, True), "y": None}, rules=[("assignment", "y", "rateOf(x)")], reactions=[DECAY]),
        "y", -e(-1)),
    "the rate in a growing compartment": (model({"c": 1.0}, {"x": dict(concentration=1.0)},
        {"y": None}, rules=[("rate", "c", "1"), ("assignment", "y", "rateOf(x)")]), "y", -0.25),
    "the rate of a constant": (model(parameters={"k": (2, True), "y": None}, rules=[
        ("assignment", "y", "rateOf(k)")]), "y", 0.0),
    "an algebraic rule": (model(parameters={"x": 1, "y": None}, rules=[
        ("rate", "x", "-x"), ("algebraic", "x + 2 * y - 3")]), "y", (3 - e(-1)) / 2),
    "an algebraic rule with a coefficient that moves": (model(parameters={"y": None}, rules=[
        ("algebraic", "(1 + time) * y - 4")]), "y", 2.0),
    "two algebraic rules": (model(parameters={"a": None, "b": None}, rules=[
        ("algebraic", "a + b - 5"), ("algebraic", "a - b - time")]), "b", 2.0),
    "an algebraic rule behind a rule": (model(parameters={"s": None, "y": None}, rules=[
        ("algebraic", "s - 7"), ("assignment", "s", "y + time")]), "y", 6.0),
    "a piecewise rate": (model(parameters={"x": 0}, rules=[
        ("rate", "x", "piecewise(1, time < 0.25, 3)")]), "x", 2.5),
    "a piecewise rate of the state": (model(parameters={"x": 0}, rules=[
        ("rate", "x", "piecewise(1, x < 0.5, x < 0.75, 2, 4)".replace("x < 0.75, 2, ", ""))]),
        "x", 2.5),
    "and, or, not": (model(parameters={"x": 0}, rules=[("rate", "x",
        "piecewise(1, (time > 0.25 && time < 0.5) || !(time < 0.75), 0)")]), "x", 0.5),
    "xor and implies": (model(parameters={"y": None}, rules=[("assignment", "y",
        "piecewise(1, xor(true, false, true), 2) + piecewise(10, implies(true, false), 20)")]),
        "y", 22.0),
    "a chain of comparisons": (model(parameters={"y": None}, rules=[
        ("assignment", "y", "piecewise(1, lt(0, time, 2), 0)")]), "y", 1.0),
    "functions of numbers": (model(parameters={"y": None}, rules=[("assignment", "y",
        "quotient(7, 2) + rem(-7, 4) + max(1, 5, 2) + min(4, 3) + factorial(4) + ceil(0.2)")]),
        "y", 3 - 3 + 5 + 3 + 24 + 1.0),
    "logarithms and roots": (model(parameters={"y": None}, rules=[("assignment", "y",
        "log(2, 8) + log10(100) + ln(exp(1)) + root(3, 27) + sqrt(16)")]), "y", 13.0),
    "inverse functions": (model(parameters={"y": None}, rules=[("assignment", "y",
        "arccot(tan(1)) + arcsec(sec(0.5)) + arccsch(csch(2)) + arctanh(tanh(0.3))")]),
        "y", math.pi / 2 - 1 + 0.5 + 2 + 0.3),
    "empty sums and products": (model(parameters={"y": None}, rules=[
        ("assignment", "y", "plus() + 2 * times()")]), "y", 2.0),
}  # fmt: skip


@pytest.mark.parametrize("what", VALUES)
def test_value_at_the_end(what):
    text, name, expected = VALUES[what]
    assert at_end(text, name) == pytest.approx(expected, rel=1e-6, abs=1e-9)


def test_amounts_and_concentrations_are_shown_as_asked():
    text = model({"c": 1.0}, {"x": dict(amount=3.0)}, rules=[("rate", "c", "2")])
    how = dict(start=0, duration=1.0, steps=2, variables=["x", "c"])
    assert time_course(text, **how, amount=["x"])[:, 1] == pytest.approx([3, 3, 3])
    assert time_course(text, **how, concentration=["x"])[:, 1] == pytest.approx([3, 1.5, 1])


def test_values_that_are_not_finite_are_shown():
    text = model(parameters={"a": (math.inf, True), "y": None}, rules=[
        ("assignment", "y", "1 / time")])  # fmt: skip
    table = time_course(text, start=0, duration=1.0, steps=1, variables=["a", "y"])
    assert table[:, 1].tolist() == [math.inf] * 2 and table[:, 2].tolist() == [math.inf, 1.0]


def test_the_table_begins_at_its_start():
    text = model(parameters={"x": 0}, rules=[("rate", "x", "2")])
    table = time_course(text, start=1.0, duration=2.0, steps=2, variables=["x"])
    assert np.allclose(table, [[1, 2], [2, 4], [3, 6]])


def test_a_model_of_level_2():
    text = model(ONE, {"x": dict(concentration=2.0)}, {"k": (1, True)}, level=2, version=4,
                 rules=[("rate", "x", "-k * x")])  # fmt: skip
    assert at_end(text, "x") == pytest.approx(2 * e(-1), rel=1e-6)


def test_ids_are_parameters_outputs_and_columns():
    text = model(parameters={"x": 1, "k": (2, True), "y": None}, rules=[
        ("rate", "x", "-k*x"), ("assignment", "y", "2 * x")])  # fmt: skip
    small = load(text)
    assert {"x", "y"} <= set(small.output_names)
    results = saltus.simulate(
        small,
        small.create_context().with_parameter("k", 1.0),
        (0.0, 1.0),
        recorded_signals={"y": small.output("y")},
        rtol=1e-9,
        atol=1e-12,
    )
    assert results["y"][-1] == pytest.approx(2 * e(-1), rel=1e-7)
    table = saltus.sweep(small, {"k": [0.0, 1.0]}, (0.0, 1.0), rtol=1e-9, atol=1e-12, as_dict=True)
    assert table["status"].tolist() == ["reached_end"] * 2


def test_values_at_the_start_reach_the_initial_assignments():
    text = model(parameters={"x": 1, "k": (2, True)}, initial={"x": "k + 1"},
                 rules=[("rate", "x", "0")])  # fmt: skip
    assert load(text, values={"k": 4.0}).create_context().continuous_state[0] == 5.0
    with pytest.raises(saltus.ModelError, match=r"'kk' has no value at the start.*k"):
        load(text, values={"kk": 1.0})


def test_everything_that_flows_is_a_formula():
    text = model(parameters={"x": 0}, rules=[("rate", "x", "piecewise(1, time < 0.25, 3)")])
    said = str(load(text).explain()).splitlines()
    assert all("traced" in line for line in said if "reset map" not in line)


def test_a_chain_of_rules_may_be_long():
    """Longer than Python's calls may be nested."""
    n = 600
    rules = [("assignment", f"a{i}", f"a{i + 1} + 1") for i in range(n)]
    text = model(parameters={f"a{i}": None for i in range(n + 1)},
                 rules=[*rules, ("assignment", f"a{n}", "time")])  # fmt: skip
    assert at_end(text, "a0") == n + 1.0
