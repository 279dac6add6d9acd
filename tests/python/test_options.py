"""SimulatorOptions: the names, what they do, and what is refused."""

import dataclasses
import inspect
import math

import numpy as np
import pytest
import saltus
from saltus import _core
from saltus._engine import PYTHON_ONLY
from saltus.simulation import SimulatorOptions
from systems import Ball, flow, run

FIELDS = {field.name for field in dataclasses.fields(SimulatorOptions)}


def ball_run(**options):
    ball = Ball()
    return run(
        ball, (0.0, 5.0), ball.create_context().with_continuous_state([10.0, 0.0]), **options
    )


def test_defaults_are_those_of_the_engine():
    core, python = _core.SimulatorOptions(), SimulatorOptions()
    for name in FIELDS - PYTHON_ONLY:
        assert (
            list(getattr(core, name)) == []
            if name in ("save_at", "sensitivity")
            else getattr(core, name) == getattr(python, name)
        )


def test_every_option_of_the_engine_is_there():
    engine = {name for name in vars(_core.SimulatorOptions) if not name.startswith("_")} - {
        "set_recorded_signals"
    }
    assert engine == FIELDS - PYTHON_ONLY


def test_signature_is_shown():
    assert set(inspect.signature(SimulatorOptions).parameters) == FIELDS


def test_overrides_win_over_options_and_change_neither():
    options = SimulatorOptions(rtol=1e-3, max_minor_step_size=0.1)
    many = ball_run(options=options, max_minor_step_size=0.01).statistics.steps
    assert many >= 500
    assert 50 <= ball_run(options=options).statistics.steps < 100
    assert options.max_minor_step_size == 0.1
    with pytest.raises(dataclasses.FrozenInstanceError):
        options.rtol = 1.0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"rtoll": 1e-6},
            "Simulator: unknown option 'rtoll'; did you mean 'rtol'? Known: 'rtol', 'atol', ",
        ),
        (
            {"math_backend": "numpy"},
            "Simulator: no option 'math_backend': there is one backend, compiled; leave it out",
        ),
        (
            {"enable_tracing": True},
            "Simulator: no option 'enable_tracing': see system.explain(); python='called' switches it "
            "off",
        ),
        (
            {"zc_bisection_loop_count": 40},
            "Simulator: no option 'zc_bisection_loop_count': events are located to the last digits",
        ),
        (
            {"results_options": None},
            "Simulator: no option 'results_options': say save_at=[...] for rows at chosen times",
        ),
        ({"rtol": 0.0}, "option rtol: expected a positive number, found 0"),
        ({"rtol": "small"}, "option rtol: expected numbers, found 'small'"),
        ({"atol": math.nan}, "option atol: expected a positive number, found nan"),
        (
            {"max_major_steps": 0},
            "option max_major_steps: expected a positive number, or none, found 0",
        ),
        ({"max_major_steps": 1.5}, "option max_major_steps: expected int | None, found 1.5"),
        (
            {"max_major_step_length": 0},
            "option max_major_step_length: expected a time > 0 s, found 0",
        ),
        (
            {"ode_solver_method": "dopri"},
            "unknown ode_solver_method 'dopri'; did you mean 'dopri5'? Known: ",
        ),
        ({"save_at": [1.0, 0.5]}, "option save_at: expected increasing times, found 0.5"),
        ({"zeno_tolerance": -1.0}, "option zeno_tolerance: expected a time >= 0 s, found -1"),
        ({"options": {"rtol": 1e-3}}, "expected SimulatorOptions, found {'rtol': 0.001}"),
    ],
)
def test_refusals(options, message):
    with pytest.raises(saltus.ModelError) as caught:
        ball_run(**options)
    assert str(caught.value).startswith(message)


NOT_MEANT = {"bool": 1, "int": True, "float": True, "ArrayLike": True}


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        (field.name, NOT_MEANT[kind])
        for field in dataclasses.fields(SimulatorOptions)
        if (kind := str(field.type).partition(" ")[0]) in NOT_MEANT and field.name != "progress"
    ],
)
def test_a_number_is_no_truth_and_a_truth_is_no_number(name, wrong):
    with pytest.raises(saltus.ModelError, match=f"option {name}: expected .*, found {wrong}"):
        ball_run(**{name: wrong})


def test_refused_in_the_options_themselves():
    with pytest.raises(
        saltus.ModelError, match="SimulatorOptions: unknown option 'atoll'; did you mean 'atol'"
    ):
        SimulatorOptions(atoll=1e-9)


@pytest.mark.parametrize(
    "name",
    ["math_backend", "buffer_length", "int_time_scale", "postprocess", "major_step_callback"],
)
def test_options_of_similar_tools_are_refused_with_a_remedy(name):
    with pytest.raises(saltus.ModelError, match=f"no option '{name}': ..."):
        SimulatorOptions(**{name: 1})


def test_bad_calls():
    ball = Ball()
    context = ball.create_context()
    with pytest.raises(saltus.ModelError, match="expected a span with begin <= end, found 1"):
        saltus.simulate(ball, context, (1.0, 0.0))
    with pytest.raises(
        saltus.ModelError,
        match=r"recorded signal 'y': expected a port, such as block.output_ports\[0\]",
    ):
        saltus.simulate(ball, context, (0.0, 1.0), recorded_signals={"y": ball})
    with pytest.raises(
        saltus.ModelError,
        match="recorded signal 'y' belongs to block 'ball', which is not part of this system",
    ):
        saltus.simulate(ball, context, (0.0, 1.0), recorded_signals={"y": Ball().output()})
    with pytest.raises(saltus.ModelError, match="expected a dict of names with ports"):
        saltus.simulate(ball, context, (0.0, 1.0), recorded_signals=[ball.output()])
    with pytest.raises(saltus.ModelError, match="expected a system, found 3"):
        saltus.simulate(3, context, (0.0, 1.0))


@pytest.mark.parametrize(
    "method", ["auto", "dopri5", "dop853", "rk45", "DOP853", "non-stiff", "adams", "bdf", "stiff"]
)
def test_methods(method):
    # 1e-9 a step, at most a few hundred steps of a contracting equation
    assert flow(
        lambda t, x: -x, [1.0], (0.0, 1.0), ode_solver_method=method, rtol=1e-9, atol=1e-12
    ) == pytest.approx(math.exp(-1.0), abs=3e-7)


def test_none_means_no_limit():
    assert (
        ball_run(
            max_minor_step_size=None, max_major_step_length=None, min_minor_step_size=None
        ).status
        == "reached_end"
    )


def test_numpy_numbers_are_numbers():
    results = ball_run(
        rtol=np.float64(1e-9), max_major_steps=np.int64(100), event_scan_points=np.int32(2)
    )
    assert results.status == "reached_end"


def test_save_at():
    wanted = np.linspace(0.0, 5.0, 11)
    results = ball_run(save_at=wanted)
    assert set(wanted) <= set(results.time)
    bounces = results.events.times("bounce")
    # start and end are wanted; what else there is are two rows for each bounce
    assert len(results.time) == len(wanted) + 2 * len(bounces)
    y = results.outputs["state"][:, 0]
    first = results.time < bounces[0]
    np.testing.assert_allclose(
        y[first], 10.0 - 9.81 / 2 * results.time[first] ** 2, atol=1e-12
    )  # a parabola is exact
    assert len(ball_run(save_at=wanted, save_steps=True).time) > len(results.time)


def test_recorded_signals_in_the_options():
    ball = Ball()
    options = SimulatorOptions(recorded_signals={"s": ball.output()})
    assert set(saltus.simulate(ball, ball.create_context(), (0.0, 0.1), options).outputs) == {"s"}
    assert set(saltus.simulate(ball, (0.0, 0.1)).outputs) == {"state"}
    none = SimulatorOptions(recorded_signals={})
    assert not saltus.simulate(ball, (0.0, 0.1), options=none).outputs


def test_recording_events_can_be_switched_off():
    with_log, without = ball_run(), ball_run(record_events=False)
    assert len(with_log.events) > 0 == len(without.events)
    assert np.array_equal(with_log.outputs["state"], without.outputs["state"])


def test_zeno_tolerance_of_the_options_and_of_a_guard():
    """Over 30 s the ball comes to rest at t1 (1 + e) / (1 - e) = 27.129 s."""

    def entered(crossing, **options):
        ball = Ball(**crossing)
        context = ball.create_context().with_continuous_state([10.0, 0.0])
        results = run(ball, (0.0, 30.0), context, rtol=1e-10, atol=1e-12, throw=False, **options)
        return results.status, [e.predicted for e in results.events if e.kind == "zeno_enter"]

    rest = math.sqrt(20.0 / 9.81) * 1.9 / 0.1
    for status, times in (
        entered({}),
        entered({"zeno_tolerance": 1e-3}),
        entered({}, zeno_tolerance=1e-4),
    ):
        assert status == "reached_end"
        assert times == pytest.approx([rest], abs=1e-8)
    for status, times in (entered({"zeno_tolerance": 0.0}), entered({}, zeno_tolerance=0.0)):
        assert status == "chattering"
        assert times == []


def ticking(monitors=False):
    """x'' = -x, with ticks at 0.5, 1.5, ...; zeros of x are seen by a monitor, which is no instant."""
    system = saltus.LeafSystem(name="ticking")
    system.declare_continuous_state(
        [1.0, 0.0], ode=lambda t, s: [s.continuous_state[1], -s.continuous_state[0]]
    )
    system.declare_discrete_state([0.0])
    system.declare_periodic_update(
        lambda t, s: s.with_discrete_state(s.discrete_state + 1.0), period=1.0, offset=0.5
    )
    if monitors:
        system.declare_zero_crossing(lambda t, s: s.continuous_state[0], name="zero")
    return system


@pytest.mark.parametrize("monitors", [False, True])
def test_major_steps_are_counted_by_instants(monitors):
    """To 4.2 s: the start, four ticks and the end. Minor steps and monitors do not count."""
    system = ticking(monitors)
    run = saltus.simulate(system, (0.0, 4.2))
    assert run.statistics.instants == 6 and run.statistics.steps > 6
    assert saltus.simulate(system, (0.0, 4.2), max_major_steps=6).status == "reached_end"
    for most in range(1, 6):
        short = saltus.simulate(system, (0.0, 4.2), max_major_steps=most, throw=False)
        assert short.status == "step_limit" and short.statistics.instants == most
        assert short.context.discrete_state[0] == most - 1


def test_lengths_of_major_and_minor_steps():
    """Instants at 0, 0.25, ..., 1; of the minor steps none is longer than its bound."""
    system = saltus.system_of(lambda t, x: [-x[0]], [1.0])
    run = saltus.simulate(system, (0.0, 1.0), max_major_step_length=0.25, recorded_signals=["x"])
    assert run.statistics.instants == 5
    run = saltus.simulate(system, (0.0, 1.0), max_minor_step_size=0.01, recorded_signals=["x"])
    assert run.statistics.instants == 2 and np.diff(run.time).max() <= 0.01 * (1.0 + 1e-12)
