"""The arguments that `jax_function` and `torch_function` share. Neither package is needed."""

import sys

import numpy as np
import pytest
import saltus
from saltus.differentiable.run import Run
from saltus.errors import ModelError
from scenes_to_differentiate import Ball, Decay

ARGUMENTS = {
    "system": Ball(),
    "wrt": ["g"],
    "time_span": (0.0, 3.0),
    "context": None,
    "options": None,
    "recorded_signals": None,
    "save_at": None,
    "events": (),
    "gaps": "error",
}


def run(overrides=None, **changed):
    return Run("f", *(ARGUMENTS | changed).values(), overrides or {})


@pytest.mark.parametrize(
    "changed, message",
    [
        ({"system": 3}, "f: expected a system, found 3"),
        ({"wrt": "g"}, r"f: wrt: expected a list of .* such as \['g', 'x\[0\]'\], found 'g'"),
        ({"wrt": []}, r"f: wrt: expected a list of"),
        ({"wrt": ["q"]}, "unknown parameter or state 'q'; did you mean 'g'"),
        ({"wrt": ["mode"]}, "'mode' is a mode, an integer"),
        ({"wrt": ["g", "g"]}, "'g' is named twice"),
        ({"time_span": 3}, r"f: expected a span \(begin, end\) in seconds, found 3"),
        ({"context": 3}, "expected a context"),
        ({"context": Decay().create_context()}, "the context is not one of this system"),
        ({"options": 3}, "f: expected SimulatorOptions, found 3"),
        ({"recorded_signals": ["q"]}, "block 'ball' has no output 'q'"),
        ({"save_at": [4.0]}, "f: save_at: expected increasing times from 0.0 s to 3.0 s, found 4"),
        ({"save_at": [2.0, 1.0]}, "f: save_at: expected increasing times .* found 1.0 s"),
        ({"save_at": [1.0, 1.0]}, "f: save_at: expected increasing times"),
        ({"save_at": [np.nan]}, "f: save_at: expected increasing times .* found nan s"),
        ({"save_at": "a"}, "f: save_at: expected times"),
        ({"save_at": 1.0}, "f: save_at: expected times"),
        ({"events": {"bonce": 1}}, "no event is called 'bonce'; did you mean 'bounce'"),
        ({"events": {"bounce": 0}}, "f: events: expected a name and a count of 1 or more"),
        ({"events": {"bounce": True}}, "f: events: expected a name and a count of 1 or more"),
        ({"events": {"bounce": 1.5}}, "f: events: expected a name and a count of 1 or more"),
        ({"events": "bounce"}, "f: events: expected names and counts"),
        ({"gaps": "nn"}, "f: gaps: expected 'error' or 'nan', found 'nn'; did you mean 'nan'"),
        ({"overrides": {"rtoll": 1}}, "f: unknown option 'rtoll'; did you mean 'rtol'"),
        ({"overrides": {"dense_output": True}}, "f: no option 'dense_output' here: say save_at="),
        ({"overrides": {"sensitivity": ["e"]}}, "f: no option 'sensitivity' here: the names are"),
        ({"overrides": {"save_steps": True}}, "f: no option 'save_steps' here"),
        ({"overrides": {"event_rows": True}}, "f: no option 'event_rows' here"),
        ({"overrides": {"record_events": False}}, "f: no option 'record_events' here"),
        ({"overrides": {"throw": False}}, "f: no option 'throw' here"),
        (
            {"options": saltus.SimulatorOptions(dense_output=True)},
            "f: no option 'dense_output' here",
        ),
    ],
)
def test_what_is_refused(changed, message):
    with pytest.raises(ModelError, match=message):
        run(**changed)


def test_the_shapes_do_not_depend_on_the_parameters():
    found = run(save_at=[1.0, 2.0], recorded_signals=["state"], events=["bounce"])
    assert found.shapes == saltus.RunValues({"state": (2, 2)}, (2,), (0,), (), {"bounce": (1,)})
    for gravity in (9.0, 30.0):  # one impact, and three
        values = found.values(np.array([gravity]))
        assert values.outputs["state"].shape == (2, 2) and values.events["bounce"].shape == (1,)


def test_the_context_gives_what_the_parameters_do_not():
    ball = Ball()
    low = ball.create_context().with_continuous_state([5.0, 0.0])
    found = run(system=ball, context=low, events={"bounce": 1})
    assert found.values(np.array([10.0])).events["bounce"][0] == pytest.approx(1.0)
    assert low == ball.create_context().with_continuous_state([5.0, 0.0])


def test_options_reach_the_runs():
    options = saltus.SimulatorOptions(ode_solver_method="dop853", save_at=[1.0])
    found = run({"rtol": 1e-9}, options=options)
    assert (found.options.rtol, found.options.ode_solver_method) == (1e-9, "dop853")
    assert found.options.save_at == (1.0,)


@pytest.mark.parametrize("package", ["jax", "torch"])
def test_a_package_that_is_missing_is_named(monkeypatch, package):
    monkeypatch.setitem(sys.modules, package, None)
    function = getattr(saltus, f"{package}_function")
    message = rf"{package}_function needs {package}, which is not installed: .*saltus\[{package}\]"
    with pytest.raises(ImportError, match=message):
        function(Ball(), ["g"], (0.0, 1.0))
