"""An expression in a file has the value of the same expression in Python."""

import math

import numpy as np
import pytest
import saltus
from saltus.scene_files import loads
from saltus.scene_files.vocabulary import FUNCTIONS

VALUES = {"a": 0.3, "b": -1.7, "k": 2}
SAME = {
    "a + b * k": lambda a, b, k: a + b * k,
    "-a**k": lambda a, b, k: -(a**k),
    "2**-1": lambda a, b, k: 0.5,
    "a - b - k": lambda a, b, k: a - b - k,
    "b % k": lambda a, b, k: b % k,
    "max(a, b, k)": lambda a, b, k: max(a, b, k),
    "min(a, b, k)": lambda a, b, k: min(a, b, k),
    "a if b < 0 < k else k": lambda a, b, k: a,
    "where(a > 1 or not b > 0, 1, 2)": lambda a, b, k: 1,
    "where(a > 0 and b > 0, 1, 2)": lambda a, b, k: 2,
    "sin(pi * a)": lambda a, b, k: np.sin(math.pi * a),
    "atan2(b, a)": lambda a, b, k: np.arctan2(b, a),
    "clip(b, -1, 1)": lambda a, b, k: -1,
    "interp(a, [0, 1], [10, 20])": lambda a, b, k: np.interp(a, [0, 1], [10, 20]),
    "  a\n + b": lambda a, b, k: a + b,
    "(1 if a == 0.3 else 0) + (1 if a != 0.3 else 0)": lambda a, b, k: 1,
    "1_000 * a": lambda a, b, k: 1000 * a,
}


def scene_of(text, **tables):
    return {
        "version": 1,
        "parameters": VALUES,
        "outputs": {"y": text},
        "run": {"until": 1.0},
    } | tables


def load(tree, **parameters):
    import json

    return loads(json.dumps(tree), "json", **parameters)


@pytest.mark.parametrize("text", SAME)
def test_a_parameter_of_an_expression(text):
    expected = SAME[text](**VALUES)
    tree = scene_of("a", parameters={**VALUES, "made": text})
    assert load(tree).parameters["made"] == float(expected)


@pytest.mark.parametrize("text", SAME)
def test_an_output_of_an_expression_of_inputs_is_traced(text):
    """The same of signals: a leaf with three inputs."""
    leaf = {"inputs": list(VALUES), "outputs": {"y": text}}
    blocks = {name: {"block": "Constant", "value": value} for name, value in VALUES.items()}
    wires = [f"{name} -> f.{name}" for name in VALUES]
    scene = load({"version": 1, "systems": {"f": leaf}, "blocks": {**blocks, "f": {"system": "f"}},
                  "wires": wires, "outputs": {"y": "f.y"}, "run": {"until": 1.0}})  # fmt: skip
    assert [c.runs for c in scene.system.explain()] == ["traced"]
    assert scene.simulate().outputs["y"][-1] == pytest.approx(
        float(SAME[text](**VALUES)), rel=1e-15
    )


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_every_function_is_numpys_and_is_traced(name):
    function, count = FUNCTIONS[name]
    if name == "interp":
        return  # it takes vectors, see above
    numbers = [1.25, 0.5, 2.0][: count or 2]
    text = f"{name}({', '.join(f'{n} * one' for n in numbers)})"
    scene = load(
        {"version": 1, "discrete": {"one": 1.0}, "outputs": {"y": text}, "run": {"until": 1}}
    )
    if name in ("acos", "asin", "atanh"):
        return  # not a number at 1.25
    assert scene.simulate().outputs["y"][-1] == pytest.approx(
        getattr(np, function)(*numbers), rel=4e-16
    )
    assert {c.runs for c in scene.system.explain()} == {"traced"}


def test_variables_may_be_made_of_variables_and_doubling_costs_nothing():
    chain = {"v0": "t"} | {f"v{i}": f"v{i - 1} + v{i - 1}" for i in range(1, 40)}
    scene = load(scene_of("v39", variables=chain))
    assert scene.simulate().outputs["y"][-1] == 2.0**39


def test_an_output_is_computed_as_often_as_what_it_reads():
    text = """
version = 1
[states]
x = { start = 1.0, rate = "-x" }
[discrete]
k = 0
[updates.tick]
period = 0.1
set = { k = "k + 1" }
[outputs]
held = "2 * k"
flowing = "x + k"
[run]
until = 1.0
"""
    plan = saltus.Simulator(loads(text).system, recorded_signals=["held", "flowing"]).describe()
    assert "computed at instants: 1 (scene.held)" in plan


def test_all_that_is_set_is_computed_from_the_state_before():
    text = """
version = 1
modes = ["first", "second"]
[states]
a = { start = 1.0 }
b = { start = 2.0 }
[discrete]
n = 0
[updates.swap]
at = [0.25, 0.5, 0.75]
set = { a = "b", b = "a", n = "n + a", mode = "second" }
[run]
until = 1.0
"""
    end = loads(text).simulate().context
    assert end.continuous_state.tolist() == [2.0, 1.0]
    assert end.discrete_state.tolist() == [1.0 + 2.0 + 1.0]
    assert list(end.modes) == [1]


def test_an_edge_of_an_input_sets_states():
    text = """
version = 1
wires = ["pulse -> counter.gate"]
[systems.counter]
inputs = ["gate"]
discrete = { n = 0 }
outputs = { n = "n" }
edges = { count = { input = "gate", edge = "falling", set = { n = "n + 1" } } }
[blocks]
pulse = { block = "Pulse", period = 1.0 }
counter = { system = "counter" }
[outputs]
n = "counter.n"
[run]
until = 3.75
"""
    assert loads(text).simulate().outputs["n"][-1] == 4.0


def test_functions_of_blocks():
    text = """
version = 1
wires = ["line -> sum.in_0", "square -> sum.in_1", "line -> square"]
[parameters]
k = 3.0
most = inf
[blocks]
line = { block = "SourceBlock", function = "min(k * t, most)" }
square = { block = "FunctionBlock", function = "u**2" }
sum = { block = "ReduceBlock", n_inputs = 2, function = "u[0] + u[1]" }
[outputs]
y = "sum.out"
[run]
until = 2.0
"""
    assert loads(text).simulate().outputs["y"][-1] == 6.0 + 36.0
    assert loads(text, "toml", k=1).simulate().outputs["y"][-1] == 2.0 + 4.0
