"""A system keeps the plans of `simulate`: a kept plan has the bits of a new one, whatever changes
between two runs, and while nothing changes nothing is traced or planned again.
"""

import copy
import gc
import pickle
import weakref

import numpy as np
import pytest
import saltus
from saltus import _core
from saltus.tracing import tracing
from systems import Ball
from whole_runs import SPAN, bits, run

from models import Pendulum, leaf

GRAVITY = 9.81


@pytest.fixture
def plans(monkeypatch):
    """One entry for each plan that is made."""
    made, plan = [], _core.Plan
    monkeypatch.setattr(_core, "Plan", lambda *a: made.append(1) or plan(*a))
    return made


@pytest.fixture
def traces(monkeypatch):
    """One entry for each function that is traced."""
    made, sandbox = [], tracing.Sandbox
    monkeypatch.setattr(tracing, "Sandbox", lambda: made.append(1) or sandbox())
    return made


class Model(saltus.LeafSystem):
    """A ball that reads from everywhere."""

    loss = 0.9

    def __init__(self):
        super().__init__(name="model")
        self.push = 0.0
        self.table = {"drag": 0.1}
        self.wind = np.array([0.0, 0.25])
        self.branch = False
        self.declare_dynamic_parameter("g", 9.81)
        self.declare_continuous_state(default_value=[1.0, 0.0], ode=self.ode)
        self.declare_continuous_state_output("state")
        self.declare_output_port(self.energy, name="energy")
        self.declare_zero_crossing(
            self.height, self.bounce, name="bounce", direction="positive_then_non_positive"
        )

    def ode(self, time, state, *, g):
        _, v = state.continuous_state
        drag = self.table["drag"] * v
        return np.array([v, -g * GRAVITY / 9.81 - drag + self.wind[1]]) + self.force(time)

    def force(self, time):
        return np.array([0.0, self.push])

    def height(self, time, state, *, g):
        return state.continuous_state[0]

    def bounce(self, time, state, *, g):
        y, v = state.continuous_state
        if self.branch and v > 0.0:  # cannot be traced then
            return state
        return state.with_continuous_state(np.array([np.abs(y), -self.loss * v]))

    def energy(self, time, state, *, g):
        y, v = state.continuous_state
        return g * y + 0.5 * v * v


def set_global(model):
    globals()["GRAVITY"] = 1.62


def raised(self, time, state, *, g):
    """A floor 0.1 m higher."""
    return state.continuous_state[0] - 0.1


RAISED = raised.__code__
CHANGES = {
    "an attribute": lambda model: setattr(model, "push", 1.0),
    "an entry of a dictionary": lambda model: model.table.update(drag=0.5),
    "an array written in place": lambda model: model.wind.__setitem__(1, -0.5),
    "another array": lambda model: setattr(model, "wind", np.array([0.0, -0.5])),
    "an attribute of the class": lambda model: setattr(Model, "loss", 0.5),
    "an attribute that hides that of the class": lambda model: setattr(model, "loss", 0.5),
    "a method that a callback calls": lambda model: setattr(
        model, "force", lambda time: np.array([0.0, 2.0 * time])
    ),
    "a global": set_global,
    "the code of a callback": lambda model: setattr(Model.height, "__code__", RAISED),
    "another declared guard": lambda model: model.declare_zero_crossing(
        lambda t, s, *, g: s.continuous_state[0] - 0.5, name="half"
    ),
}
"""what changes between two runs of one system, and changes its bits"""

SAME = {
    "nothing": lambda model: None,
    "an attribute of the name of a callback": lambda model: setattr(
        model, "ode", lambda *a, **p: 1 / 0
    ),
    "an equal value": lambda model: setattr(model, "push", float("0.0")),
    "a callback that can no longer be traced": lambda model: setattr(model, "branch", True),
    "another declared mode": lambda model: model.declare_default_mode(3),
}
"""what changes between two runs, and changes no bit: a declared function is the one it was"""


@pytest.fixture
def restored():
    """What the changes write outside a model."""
    code = Model.height.__code__
    yield
    globals()["GRAVITY"], Model.loss = 9.81, 0.9
    Model.height.__code__ = code


@pytest.mark.usefixtures("restored")
@pytest.mark.parametrize("what", [*CHANGES, *SAME])
@pytest.mark.parametrize("method", ["dopri5", "bdf"])
def test_a_kept_plan_has_the_bits_of_a_new_one(what, method):
    model, new, change = Model(), Model(), (CHANGES | SAME)[what]
    before = bits(run(model, ode_solver_method=method))
    assert bits(run(model, ode_solver_method=method)) == before
    change(model)
    after = bits(run(model, ode_solver_method=method))
    change(new)
    assert after == bits(run(new, ode_solver_method=method))
    assert (after != before) == (what in CHANGES)


VALUES = {
    "the state": lambda context: context.with_continuous_state([2.0, 1.0]),
    "a parameter": lambda context: context.with_parameter("g", 1.62),
    "the time": lambda context: context.with_time(0.5),
}


@pytest.mark.parametrize("values", VALUES.values(), ids=VALUES.keys())
def test_other_values_of_a_kept_plan(values, plans):
    model = Model()
    run(model)
    assert bits(run(model, values)) == bits(run(Model(), values))
    assert len(plans) == 2


def test_nothing_is_traced_or_planned_again(plans, traces):
    model, pendulum = Model(), Pendulum()
    builder = saltus.DiagramBuilder()
    builder.add(Ball())
    diagram = builder.build()
    systems = [model, pendulum, diagram, saltus.scene("bouncing-ball").system]
    for system in systems:
        saltus.simulate(system, SPAN)
    first = len(plans), len(traces)
    for system in systems:
        for _ in range(3):
            saltus.simulate(system, SPAN)
    assert (len(plans), len(traces)) == first


def test_what_changes_is_traced_and_planned_once(plans, traces):
    model = Model()
    run(model)
    first = len(plans), len(traces)
    model.push = 1.0
    run(model), run(model)
    assert len(plans) == first[0] + 1
    assert len(traces) == first[1] + 1


def test_a_progress_function_and_an_interrupt_are_not_kept():
    model, seen = Model(), []

    def look(now):
        seen.append(now)

    def stop():
        return bool(seen) and False

    run(model, progress=look)
    run(model, interrupt=stop)
    gone = weakref.ref(look), weakref.ref(stop)
    del look, stop
    gc.collect()
    assert [one() for one in gone] == [None, None]
    assert seen


def test_a_kept_plan_keeps_no_system():
    gc.collect()
    gc.disable()
    try:
        model = Ball()
        results = run(model)
        gone = weakref.ref(model)
        del model
        assert gone() is None
        assert results.outputs["state"].size > 0
    finally:
        gc.enable()


def test_dense_output_keeps_the_values_it_was_made_from():
    model = Model()
    first = run(model, dense_output=True)
    before = first([0.2, 0.9]).continuous_state.tobytes(), first([0.2])["state"].tobytes()
    model.push = 1.0
    run(model, dense_output=True)
    after = first([0.2, 0.9]).continuous_state.tobytes(), first([0.2])["state"].tobytes()
    assert after == before


def test_a_copy_of_a_context_and_of_results_says_the_same():
    model = Model()
    run(model)
    results = run(model)
    for copied in (copy.copy(results), copy.deepcopy(results), pickle.loads(pickle.dumps(results))):
        assert bits(copied) == bits(results)


def test_a_signal_is_known_by_its_block():
    """Two wrappers of one block of the shelf, and two blocks of one name."""
    scene = saltus.scene("bouncing-ball")
    leaf_one, leaf_two = (
        leaf(lambda t, s: -s.continuous_state),
        leaf(lambda t, s: -s.continuous_state),
    )
    for block in (leaf_one, leaf_two):
        block.declare_continuous_state_output("state")
    run(leaf_one)
    with pytest.raises(saltus.ModelError, match="not part of this system"):
        saltus.simulate(leaf_one, SPAN, recorded_signals={"state": leaf_two.output("state")})
    for _ in range(2):
        recorded = {"y": scene.system.output(0)}
        assert saltus.simulate(scene.system, scene.context, SPAN, recorded_signals=recorded).outputs


def test_a_copy_of_a_system_has_no_plan_of_the_other():
    scene = saltus.scene("bouncing-ball")
    expected = saltus.simulate(scene.system, scene.context, SPAN).context.continuous_state
    copies = [copy.copy(scene.system), pickle.loads(pickle.dumps(scene.system))]
    assert not any(getattr(one, "_callbacks", None) for one in copies)
    del scene
    gc.collect()
    for one in copies:
        context = one.create_context().with_continuous_state([10.0, 0.0])
        assert saltus.simulate(one, context, SPAN).context.continuous_state.tobytes() == (
            expected.tobytes()
        )
