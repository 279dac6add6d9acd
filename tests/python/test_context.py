"""Semantics 1: a context is a value."""

import copy

import numpy as np
import pytest
import saltus
from hypothesis import given
from hypothesis import strategies as st
from saltus.library import Constant, Gain, Integrator, Sine
from systems import Ball

numbers = st.floats(-1e300, 1e300)


def loop():
    builder = saltus.DiagramBuilder()
    x, minus = builder.add(Integrator(1.0, name="x"), Gain(-1.0, name="minus"))
    builder.connect(x.output(), minus.input())
    builder.connect(minus.output(), x.input())
    return builder.build()


@given(st.lists(numbers, min_size=2, max_size=2), numbers)
def test_with_returns_a_new_one_and_leaves_the_old(x, g):
    ball = Ball()
    old = ball.create_context()
    new = old.with_continuous_state(x).with_parameter("g", g).with_time(2.0)
    assert list(new.continuous_state) == x
    assert new.parameters == {"g": g}
    assert new.time == 2.0
    assert old == ball.create_context()
    assert old.time == 0.0


def test_changing_a_context_changes_no_system():
    ball = Ball()
    ball.create_context().with_parameter("g", 1.6)
    assert ball.create_context().parameters == {"g": 9.81}


def test_arrays_of_a_context_cannot_be_written_to_and_outlive_it():
    context = Ball().create_context().with_continuous_state([10.0, 0.0])
    x = context.continuous_state
    with pytest.raises(ValueError):
        x[0] = 1.0
    del context
    assert list(x) == [10.0, 0.0]


def test_what_was_given_may_change_afterwards():
    x = np.array([10.0, 0.0])
    context = Ball().create_context().with_continuous_state(x)
    x[0] = 3.0
    assert context.continuous_state[0] == 10.0


def test_equality_copy_and_repr():
    ball = Ball()
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    assert context == ball.create_context().with_continuous_state([10.0, 0.0])
    assert context != context.with_time(1.0)
    assert context != context.with_parameter("g", 1.0)
    assert context != 3
    assert copy.copy(context) == copy.deepcopy(context) == context
    assert repr(context) == "Context(time=0, continuous_state=[10, 0], mode=0)"


def test_part_of_a_diagram_by_block_or_by_id():
    diagram = loop()
    context = diagram.create_context()
    block = diagram["x"]
    part = context[block.system_id].with_continuous_state(3)
    assert part.continuous_state == [3.0]
    assert context[block] == context[block.system_id]
    changed = context.with_subcontext(block.system_id, part)
    assert changed.continuous_state == [3.0]
    assert context.continuous_state == [1.0]
    assert context.with_subcontext(block, part) == changed


def test_parameters_of_a_diagram_have_paths():
    builder = saltus.DiagramBuilder()
    builder.add(loop_as("inner"), Constant([1.0, 2.0], name="c"))
    context = builder.build().create_context()
    assert set(context.parameters) == {"inner.x.initial_state", "inner.minus.gain", "c.value"}
    changed = context.with_parameters({"inner.minus.gain": -2, "c.value": [3, 4]})
    assert changed.parameters["inner.minus.gain"] == -2.0
    assert list(changed.parameters["c.value"]) == [3.0, 4.0]
    assert list(context.with_parameter("c.value", 7.0).parameters["c.value"]) == [7.0, 7.0]


def loop_as(name):
    builder = saltus.DiagramBuilder()
    x, minus = builder.add(Integrator(1.0, name="x"), Gain(-1.0, name="minus"))
    builder.connect(x.output(), minus.input())
    builder.connect(minus.output(), x.input())
    return builder.build(name=name)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda c: c.with_continuous_state([1.0]), "continuous state: expected 2 values, found 1"),
        (
            lambda c: c.with_continuous_state([1.0, float("nan")]),
            "continuous state: entry 1 is nan; give a finite value",
        ),
        (
            lambda c: c.with_continuous_state("up"),
            "continuous state: expected numbers, found 'up' (str)",
        ),
        (lambda c: c.with_continuous_state(None), "continuous state: expected numbers, found None"),
        (
            lambda c: c.with_continuous_state([1j, 0]),
            "continuous state: expected numbers, found a list whose entry [0] is 1j (complex)",
        ),
        (
            lambda c: c.with_parameter("G", 1.0),
            "unknown parameter 'G'; did you mean 'g'? Known: 'g'",
        ),
        (lambda c: c.with_parameter("g", [1.0, 2.0]), "parameter 'g': expected 1 values, found 2"),
        (lambda c: c.with_time(float("inf")), "time: inf is not finite"),
        (lambda c: c["ball"], "expected a system or its system_id, found 'ball'"),
    ],
)
def test_refusals(change, message):
    with pytest.raises(saltus.ModelError) as caught:
        change(Ball().create_context())
    assert str(caught.value) == message


def test_context_of_another_system_is_refused():
    ball, sine = Ball(), Sine(name="sine")
    with pytest.raises(saltus.ModelError, match="the context is not one of this system"):
        saltus.simulate(ball, sine.create_context(), (0.0, 1.0))
    with pytest.raises(saltus.ModelError, match="no system with id"):
        ball.create_context()[sine]


def parameter_block(name, parameter):
    block = saltus.LeafSystem(name=name)
    block.declare_dynamic_parameter(parameter, 1.0)
    block.declare_continuous_state([0.0], ode=lambda t, s, **p: [next(iter(p.values()))])
    return block


@pytest.mark.parametrize("name, parameter", [("a", "spring"), ("b", "mass"), ("b", "spring")])
def test_a_context_of_another_system_of_the_same_size_is_refused(name, parameter):
    a, other = parameter_block("a", "mass"), parameter_block(name, parameter).create_context()
    message = "the context is not one of this system"
    with pytest.raises(saltus.ModelError, match=message):
        saltus.simulate(a, other, (0, 1))
    with pytest.raises(saltus.ModelError, match=message):
        saltus.Simulator(a).initialize(other)
    with pytest.raises(saltus.ModelError, match=message):
        saltus.sweep(a, {"mass": [1.0, 2.0]}, (0, 1), context=other)
    same = parameter_block("a", "mass").create_context()  # other objects, the same structure
    assert saltus.simulate(a, same, (0, 1)).status == "reached_end"


def test_a_refused_context_leaves_the_simulator_as_it_was():
    a = parameter_block("a", "mass")
    simulator = saltus.Simulator(a)
    simulator.initialize(a.create_context())
    simulator.advance_to(0.5)
    before = simulator.context
    with pytest.raises(saltus.ModelError):
        simulator.initialize(parameter_block("a", "spring").create_context())
    assert simulator.context == before
    assert simulator.advance_to(1.0) == "reached_end"


@pytest.mark.parametrize(
    "values",
    [
        {"a": 2.0, "zz": 3.0},
        {"zz": 3.0, "a": 2.0},
        {"a": 2.0, "b": "x"},
        {"a": 2.0, "b": [1.0, 2.0]},
        {"a": 2.0, "b": float("nan")},
    ],
)
def test_with_parameters_changes_all_or_none(values):
    leaf = saltus.LeafSystem(name="leaf")
    for name in "abc":
        leaf.declare_dynamic_parameter(name, 1.0)
    context = leaf.create_context()
    with pytest.raises(saltus.ModelError):
        context.with_parameters(values)
    assert context.parameters == {"a": 1.0, "b": 1.0, "c": 1.0}
