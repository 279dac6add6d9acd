"""What is no model, and what has no time course: the error names the element, and what to do."""

import math

import pytest

pytest.importorskip("libsbml", reason="python-libsbml reads the models")

import saltus
from saltus.cli import main
from saltus.sbml import load, time_course
from sbml_texts import model

ONE = {"c": (1.0, True)}
RULE = [("assignment", "y", "1")]
FAST = model(ONE, {"x": dict(amount=1.0)}, version=1, reactions=[
    {"law": "1", "products": ["x"], "name": "quick", "fast": True}])  # fmt: skip

TWO = model(parameters={"x": 1, "k": (2, True)}, rules=[("rate", "x", "1")])

REFUSED = {
    "no XML": ("<sbml", "libsbml finds errors.*line [0-9]+: "),
    "XML of another kind": ("<html></html>", "libsbml finds errors"),
    "no model": ('<sbml xmlns="http://www.sbml.org/sbml/level3/version2/core" level="3" '
                 'version="2"/>', "model"),
    "an unknown id": (model(parameters={"y": None}, rules=[("assignment", "y", "gone")]), "gone"),
    "a ring": (model(parameters={"a": None, "b": None}, rules=[
        ("assignment", "a", "b"), ("assignment", "b", "a")]),
        "line [0-9]+: .*[cC]ycl"),
    "an unknown function": (model(parameters={"y": None}, rules=[("assignment", "y", "f(1)")]),
                            "libsbml finds errors.*'f'"),
    "a fast reaction": (FAST, "'quick' is fast"),
    "a delay of a value": (model(parameters={"x": 0, "y": None}, rules=[
        ("rate", "x", "1"), ("assignment", "y", "delay(x, 1)")]), r"delay\(x, 1\)"),
    "an algebraic rule that is not linear": (model(parameters={"y": None}, rules=[
        ("algebraic", "y ^ 2 - 2")]), "algebraic rule 1: it is not linear in y"),
    "an algebraic rule without an unknown": (model(parameters={"y": None}, rules=[
        ("assignment", "y", "1"), ("algebraic", "y - 1")]), "overdetermined"),
    "algebraic rules that say the same": (model(parameters={"a": None, "b": None}, rules=[
        ("algebraic", "a + b - 1"), ("algebraic", "a + b - 1")]), "do not determine"),
    "a division by zero at the start": (model(parameters={"x": 0, "k": (0, True)},
        initial={"x": "1 / k"}, rules=[("rate", "x", "1")]), "'x' starts at inf"),
    "a rate that is not finite at the start": (model(parameters={"x": 0}, rules=[
        ("rate", "x", "1 / x")]), "the rate of 'x' is inf"),
    "an assignment of a ruled value": (model(parameters={"y": None}, rules=RULE, events=[
        dict(trigger="time > 1", assign={"y": "2"}, name="late")]), "libsbml finds errors.*'y'"),
    "the rate of a ruled value": (model(parameters={"x": 1, "y": None, "v": None}, rules=[
        ("rate", "x", "-x"), ("assignment", "v", "x ^ 2"), ("assignment", "y", "rateOf(v)")]),
        "rateOf.*'v'"),
    "an id twice": (TWO.replace('id="k"', 'id="x"'), "libsbml finds errors.*'x'"),
    "two rules for one id": (model(parameters={"x": 1}, rules=[
        ("rate", "x", "1"), ("assignment", "x", "7")]), "libsbml finds errors.*'x'"),
    "a rule for a constant": (model(parameters={"x": (1, True)}, rules=[("rate", "x", "1")]),
                              "libsbml finds errors.*'x'"),
    "an event that assigns a constant": (model(parameters={"x": (1, True)}, events=[
        dict(trigger="time > 1", assign={"x": "5"})]), "libsbml finds errors.*'x'"),
    "an assignment at the start of a ruled id": (model(parameters={"x": None}, rules=[
        ("assignment", "x", "2")], initial={"x": "9"}), "libsbml finds errors.*'x'"),
    "a rule for a species of a reaction": (model(ONE, {"x": dict(amount=1.0)}, rules=[
        ("rate", "x", "1")], reactions=[{"law": "1", "products": ["x"]}]),
        "libsbml finds errors.*'x'"),
    "no value": (model(parameters={"x": 1, "k": (None, True)}, rules=[("rate", "x", "1 + k")]),
                 "'k' has no value"),
    "no value of a state": (model(parameters={"x": None}, rules=[("rate", "x", "1 + x")]), "'x'"),
    "no value behind a rule": (model(parameters={"y": None, "k": (None, True)}, rules=[
        ("assignment", "y", "2 * k")]), "'k' has no value"),
    "no value in an initial assignment": (model(parameters={"y": 0, "k": (None, True)},
                                          initial={"y": "2 * k"}), "'k' has no value"),
    "NaN": (model(parameters={"x": 1, "k": (math.nan, True)}, rules=[("rate", "x", "1 + k")]),
            "'k' has no value"),
    "no size": (model({"c": (None, True)}, {"x": dict(amount=1.0)}, {"y": None}, rules=[
        ("assignment", "y", "x")]), "'c' has no value"),
    "a factorial that is not finite": (model(parameters={"x": 1}, rules=[
        ("rate", "x", "x / factorial(200)")]), r"'x'|factorial\(200\)"),
    "a factorial of a negative number": (model(parameters={"y": None}, rules=[
        ("assignment", "y", "factorial(-1)")]), r"factorial\(-1\): expected"),
    "a function of itself": (model(parameters={"y": None}, functions={"f": "lambda(a, f(a))"},
        rules=[("assignment", "y", "f(1)")]), "'f'"),
    "a deep formula": (model(parameters={"y": None}, rules=[
        ("assignment", "y", "sin(1 + " * 1500 + "time" + ")" * 1500)]),
        "line [0-9]+: assignmentRule.*at most 300"),
    "no text": ("", "an empty text"),
    "bytes": (b"<sbml/>", "found bytes"),
    "None": (None, "found NoneType"),
}  # fmt: skip


@pytest.mark.parametrize("what", REFUSED)
def test_refused(what):
    text, words = REFUSED[what]
    with pytest.raises(saltus.ModelError, match=f"(?s){words}"):
        load(text)


@pytest.mark.parametrize("value", [math.nan, "abc", None, [1.0], True])
def test_a_value_that_is_no_number(value):
    with pytest.raises(saltus.ModelError, match="'k' at the start: expected a number"):
        load(TWO, values={"k": value})


def test_what_nothing_reads_needs_no_value():
    text = model(parameters={"x": 1, "k": (None, True), "n": None}, rules=[("rate", "x", "1")],
                 events=[dict(trigger="time > 1", assign={"n": "5"})])  # fmt: skip
    assert load(text).output("x") is not None


def test_the_size_is_1_in_level_2():
    text = model({"c": (None, True)}, {"x": dict(amount=3.0)}, {"y": None}, level=2, version=4,
                 rules=[("assignment", "y", "2 * x")])  # fmt: skip
    row = time_course(text, start=0, duration=1.0, steps=1, variables=["y"])[-1]
    assert row[1] == 6.0


def test_no_file(tmp_path):
    with pytest.raises(saltus.ModelError, match="no file"):
        load(tmp_path / "gone.xml")


def test_a_file_needs_no_declaration_of_its_encoding(tmp_path):
    text = model(parameters={"x": (4, True)})
    file = tmp_path / "bare.xml"
    file.write_text(text[text.index("?>") + 2 :])
    assert load(file).create_context().parameters["x"] == 4.0


def test_an_unknown_variable():
    text = model(parameters={"x": 0}, rules=[("rate", "x", "1")])
    with pytest.raises(saltus.ModelError, match="unknown id 'z'"):
        time_course(text, start=0, duration=1.0, steps=1, variables=["z"])


@pytest.mark.parametrize(("end", "words"), [(["--t-end", "1"], "0.13533"), ([], "--t-end")])
def test_from_the_command_line(tmp_path, capsys, end, words):
    file = tmp_path / "decay.xml"
    file.write_text(model(parameters={"x": 1, "k": (1, True)}, rules=[("rate", "x", "-k*x")]))
    code = main(["run", str(file), "--set", "k=2", "--rtol", "1e-9", *end])
    said = capsys.readouterr()
    assert words in said.out + said.err
    assert (code == 0) == bool(end)


def test_described_from_the_command_line(tmp_path, capsys):
    file = tmp_path / "decay.xml"
    file.write_text(model(parameters={"x": 1}, rules=[("rate", "x", "-x")]))
    assert main(["describe", str(file)]) == 0
    assert "small" in capsys.readouterr().out


def test_a_long_chain_of_rules_is_read_or_refused():
    """Each value reads the next one: no check takes minutes, and no traceback is Python's."""
    count = 2000
    parameters = {f"p{i}": (None, False) for i in range(count)}
    rules = [("assignment", f"p{i}", f"p{i + 1} + 1") for i in range(count - 1)]
    text = model(parameters=parameters, rules=[*rules, ("assignment", f"p{count - 1}", "1")])
    try:
        assert load(text).create_context() is not None
    except saltus.ModelError as error:
        assert "nested too deep" in str(error)


@pytest.mark.parametrize("healed", [True, False])
def test_a_rate_that_an_event_at_the_start_makes_finite(healed):
    """y is 0 before the event at the start: the run looks at the rate after it."""
    text = model(
        parameters={"x": 0, "y": 0, "n": 0},
        rules=[("rate", "x", "1 / y")],
        events=[dict(trigger="time >= 0", initial=False, assign={"y" if healed else "n": "1"})],
    )
    if healed:
        assert saltus.simulate(load(text), (0.0, 2.0)).context.continuous_state[0] == pytest.approx(
            2.0
        )
    else:
        with pytest.raises(saltus.SimulationError, match="not finite"):
            saltus.simulate(load(text), (0.0, 2.0))
