"""A system keeps a plan for each of the last few sets of options."""

import numpy as np
import pytest
import saltus
from whole_runs import SPAN, bits
from whole_runs import run as run_of

from models import Pendulum


def run(system, outputs=("energy",), **options):
    return run_of(system, outputs=outputs, **options)


OPTIONS = {
    "a tolerance": {"rtol": 1e-9},
    "tolerances by state": {"atol": [1e-9, 1e-7]},
    "tolerances as an array": {"atol": np.array([1e-9, 1e-7])},
    "a method": {"ode_solver_method": "dop853"},
    "times": {"save_at": [0.5, 1.0]},
    "times as an array": {"save_at": np.linspace(0.0, 2.0, 5)},
    "events": {"record_events": False},
    "steps": {"max_minor_step_size": 0.01},
    "no signals": {"outputs": ()},
    "called": {"python": "called"},
}


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS.keys())
def test_other_options_have_a_plan_of_their_own(options):
    model = Pendulum()
    for each in ({}, options, {}, options):
        assert bits(run(model, **each)) == bits(run(Pendulum(), **each))


def test_options_that_are_changed_in_place_are_seen():
    model, times = Pendulum(), [0.5, 1.0]
    options = saltus.SimulatorOptions(save_at=times, recorded_signals={"y": model.output()})
    context = model.create_context()
    for time in (1.5, 2.0):
        assert saltus.simulate(model, context, SPAN, options).time[-1] == SPAN[1]
        times.append(time)
        found = saltus.simulate(model, context, SPAN, options)
        assert set(times) <= set(found.time.tolist())
    options.recorded_signals["again"] = model.output("energy")
    assert set(saltus.simulate(model, context, SPAN, options).outputs) == {"y", "again"}


@pytest.mark.parametrize(
    "wrong",
    [
        {"rtol": -1.0},
        {"rtol": "tight"},
        {"throw": 1},
        {"dense_output": 1},
        {"python": "fast"},
        {"rtool": 1e-6},
        {"progress": 0.5},
        {"recorded_signals": {"y": 1}},
    ],
    ids=str,
)
def test_wrong_options_are_refused_as_before(wrong):
    model, messages = Pendulum(), []
    for system in (model, Pendulum()):
        saltus.simulate(model, model.create_context(), SPAN)  # the plan of right options is kept
        with pytest.raises(saltus.ModelError) as caught:
            saltus.simulate(system, system.create_context(), SPAN, **wrong)
        messages.append(str(caught.value))
    assert messages[0] == messages[1]


def test_few_plans_are_kept():
    model = Pendulum()
    for rtol in np.geomspace(1e-3, 1e-9, 50):
        run(model, rtol=float(rtol))
    assert len(model._callbacks.plans._kept) <= 4


def test_of_a_large_system_one_is_kept():
    builder = saltus.DiagramBuilder()
    builder.add(*(saltus.library.Constant(1.0, name=f"one_{i}") for i in range(1001)))
    diagram = builder.build()
    for rtol in (1e-3, 1e-4):
        saltus.simulate(diagram, SPAN, rtol=rtol)
    assert len(diagram._callbacks.plans._kept) == 1
