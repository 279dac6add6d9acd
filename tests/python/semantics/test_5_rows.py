"""Section 5: rows, the event log, statistics, status."""

import dataclasses

import numpy as np
import pytest
import saltus
from blocks import Ball, Block, crossing, go, ramp, x
from saltus.library import (
    Comparator,
    Constant,
    Gain,
    Integrator,
    LogicalOperator,
    ReduceBlock,
    Step,
)

FINE = {"rtol": 1e-9, "atol": 1e-11}


def test_5_1_a_row_before_and_a_row_after_each_pass_and_none_twice():
    results = go(Ball(e=0.5, y=1.0), 1.5, **FINE)
    rows = list(zip(results.time.tolist(), results.jump.tolist(), strict=True))
    assert len(set(rows)) == len(rows)
    assert rows == sorted(rows)
    last = {e.jump: e for e in results.events}  # of a pass: a bounce and the rest it leads to
    assert list(last) == list(range(1, 1 + results.jump[-1]))
    for e in last.values():
        before, after = rows.index((e.time, e.jump - 1)), rows.index((e.time, e.jump))
        assert after == before + 1
        if e.kind == "zero_crossing":
            assert np.array_equal(results.outputs["x"][before], e.before)
        assert np.array_equal(results.outputs["x"][after], e.after)
    assert (rows[0][0], rows[-1][0]) == (0.0, 1.5)


@pytest.mark.parametrize("save_steps", [None, True, False])
def test_5_1_at_the_asked_for_times_or_at_each_step_or_both(save_steps):
    wanted = [0.0, 0.1, 0.25, 0.7, 1.0]
    results = go(Ball(e=0.5, y=1.0), 1.0, save_at=wanted, save_steps=save_steps)
    assert set(wanted) <= set(results.time.tolist())
    bounces = len(results.events)
    assert bounces == 2
    if save_steps:
        assert len(results.time) > len(wanted) + 2 * bounces
    else:
        assert len(results.time) == len(wanted) + 2 * bounces


def test_5_2_what_is_recorded_changes_no_bit():
    ball = Ball(e=0.9, y=1.0)
    context = ball.create_context()
    full = go(ball, 3.0)
    for options in ({"save_at": [0.1, 0.2]}, {"record_events": False}, {"recorded_signals": {}}):
        options = {"recorded_signals": {"x": ball.output()}} | options
        other = saltus.simulate(ball, context, (0.0, 3.0), **options)
        assert other.context == full.context
        assert other.statistics.steps == full.statistics.steps
        if options.get("record_events", True):
            assert [e[:6] for e in other.events] == [e[:6] for e in full.events]


def test_5_3_the_event_log_is_data():
    event = go(Ball(e=0.5, y=1.0), 0.5, **FINE).events[0]
    assert event.time == pytest.approx(np.sqrt(2.0 / 9.81), abs=1e-9)
    assert (event.jump, event.kind, event.direction) == (1, "zero_crossing", -1)
    assert (event.block, event.name) == ("ball", "bounce")
    speed = np.sqrt(2.0 * 9.81)
    assert event.before == pytest.approx([0.0, -speed], abs=1e-8)
    assert event.after == pytest.approx([0.0, 0.5 * speed], abs=1e-8)
    assert np.isnan(event.predicted)


def test_5_3_terminal_events_and_ticks_have_their_kind():
    def declare(self):
        self.declare_continuous_state([0.0], ode=lambda t, s: [1.0])
        self.declare_discrete_state([0.0])
        self.declare_periodic_update(lambda t, s: s.discrete_state, 0.25, 0.25, name="tick")
        self.declare_zero_crossing(lambda t, s: x(t, s) - 0.6, name="end", terminal=True)

    results = go(Block(declare), 1.0)
    assert [(e.kind, e.name) for e in results.events] == [
        ("time", "tick"),
        ("time", "tick"),
        ("terminal", "end"),
    ]


def test_5_4_statistics_are_summed_over_restarts():
    results = go(Ball(e=0.5, y=1.0), 1.5)
    counts = dataclasses.asdict(results.statistics)
    bounces = len(results.events.times("bounce"))
    assert counts["events_by_name"] == {"ball.bounce": bounces}
    assert counts["restarts"] == bounces
    assert counts["events"] >= bounces
    assert counts["instants"] >= counts["restarts"]
    assert counts["right_hand_side_calls"] > 6 * counts["steps"]
    assert counts["wall_time"] > 0.0


BAD = {
    "step_limit": (lambda: Ball(e=0.5, y=1.0), {"max_major_steps": 2}),
    "interrupted": (lambda: Ball(e=0.5, y=1.0), {"interrupt": lambda: True}),
    "failed": (lambda: crossing(lambda t, s: 0.5 - t, lambda t, s: 1 / 0), {}),
}


@pytest.mark.parametrize("status", BAD)
def test_5_5_a_bad_end_raises_or_is_returned(status):
    make, options = BAD[status]
    end = 1e6 if status == "interrupted" else 3.0
    options = options | {"max_minor_step_size": 0.05}
    returned = go(make(), end, throw=False, **options)
    assert returned.status == status
    assert returned.message
    assert len(returned.time) > 0
    error = ZeroDivisionError if status == "failed" else saltus.SimulationError
    with pytest.raises(error) as caught:
        go(make(), end, **options)
    if status != "failed":
        assert caught.value.results.status == status
        assert str(caught.value).startswith("t = ")


def test_5_5_a_good_end_has_no_message():
    results = go(Ball(e=0.5, y=1.0), 1.0)
    assert (results.status, results.message, results.cause) == ("reached_end", "", None)


@pytest.mark.parametrize("split", [0.3, 0.9, 1.2, 2.5])
def test_5_6_a_run_goes_on_from_its_context_as_the_unbroken_one(split):
    ball = Ball(e=0.5, y=1.0)
    whole = go(ball, 3.0, **FINE)
    first = go(ball, split, **FINE)
    second = go(ball, 3.0, split, first.context, **FINE)
    times = [e.time for e in (*first.events, *second.events) if e.kind == "zero_crossing"]
    expected = whole.events.times("bounce")
    n = min(len(times), len(expected), 12)
    np.testing.assert_allclose(times[:n], expected[:n], atol=1e-7)
    np.testing.assert_allclose(
        second.context.continuous_state, whole.context.continuous_state, atol=1e-9
    )


def test_5_7_the_same_run_twice_gives_the_same_bits():
    one, two = (go(Ball(e=0.9, y=1.0), 5.0) for _ in range(2))
    assert np.array_equal(one.time, two.time)
    assert np.array_equal(one.outputs["x"], two.outputs["x"])
    assert repr(one.events) == repr(two.events)


METHODS = ("dopri5", "dop853", "adams", "bdf", "radau", "taylor")


def resetting(trigger, y=1.0, *more):
    """A ball of two integrators, both reset by `trigger`, which reads height and floor; `more`
    follows the trigger, block by block. Returns the diagram and the recorded outputs.
    """
    reset = {"enable_reset": True, "enable_external_reset": True}
    builder = saltus.DiagramBuilder()
    accel, floor = builder.add(Constant(-9.81, name="accel"), Constant(0.0, name="floor"))
    vel, pos = builder.add(Integrator(0.0, name="vel", **reset), Integrator(y, name="pos", **reset))
    back = builder.add(Gain(-0.6, name="back"))
    builder.add(trigger, *more)
    builder.connect(pos.output(), trigger.input(0))
    builder.connect(floor.output(), trigger.input(1))
    signals, signal = {"trigger": trigger.output()}, trigger.output()
    for block in more:
        builder.connect(signal, block.input())
        signal = signals[block.name] = block.output()
    for source, target in (
        (accel.output(), vel.input("in")),
        (vel.output(), pos.input("in")),
        (vel.output(), back.input()),
        (back.output(), vel.input("reset_value")),
        (floor.output(), pos.input("reset_value")),
        (signal, vel.input("reset_trigger")),
        (signal, pos.input("reset_trigger")),
    ):
        builder.connect(source, target)
    return builder.build(), signals | {"pos": pos.output()}


TRIGGERS = {
    "comparison": lambda: (Comparator("<", name="impact"), []),
    "opaque": lambda: (ReduceBlock(2, lambda u: u[0] < u[1], name="impact"), []),
    "called": lambda: (ReduceBlock(2, lambda u: bool(float(u[0]) < float(u[1])), name="hit"), []),
    "through logic": lambda: (
        Comparator(">=", name="above"),
        [LogicalOperator("not", name="impact")],
    ),
}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kind", TRIGGERS)
def test_5_1_in_the_row_before_a_pass_a_trigger_that_fired_is_true(kind, method):
    trigger, more = TRIGGERS[kind]()
    diagram, signals = resetting(trigger, 1.0, *more)
    results = saltus.simulate(diagram, (0, 1.2), recorded_signals=signals, ode_solver_method=method)
    bounces = sorted({e.time for e in results.events if e.name.startswith("reset")})
    assert len(bounces) == 2
    last = results.outputs[more[-1].name if more else "trigger"]
    fired = results.time[last != 0]
    assert fired.tolist() == bounces  # in one row each, the row before
    for t in bounces:
        rows = np.flatnonzero(results.time == t)
        assert last[rows].tolist() == [1.0, 0.0]
        assert results.jump[rows[1]] == results.jump[rows[0]] + 1
    if more:  # what follows from the comparison follows it in the same row
        assert np.array_equal(last != 0, results.outputs["trigger"] == 0)


def test_5_1_a_trigger_that_fires_at_the_start_is_true_in_the_first_row():
    diagram, signals = resetting(Comparator("<", name="impact"), 0.0)
    context = diagram.create_context()
    context = context.with_subcontext(
        diagram["vel"].system_id, context[diagram["vel"]].with_continuous_state([-1.0])
    )
    results = saltus.simulate(diagram, context, (0, 0.05), recorded_signals=signals)
    assert results.events[0].time == 0.0
    assert results.outputs["trigger"][0] == 1.0
    assert not results.outputs["trigger"][1:].any()


def test_5_1_what_a_tick_changes_at_the_same_time_is_still_as_before_it():
    """x = t is above 0.5 from t = 0.5 s, where the step rises too."""
    builder = saltus.DiagramBuilder()
    one, half, step = builder.add(
        Constant(1.0, name="one"), Constant(0.5, name="half"), Step(step_time=0.5, name="step")
    )
    x_, above = builder.add(Integrator(0.0, name="x"), Comparator(">", name="above"))
    late = builder.add(Integrator(0.0, name="late"))  # makes the comparison a located one
    both = builder.add(LogicalOperator("and", name="both"))
    builder.connect(one.output(), x_.input())
    builder.connect(x_.output(), above.input(0))
    builder.connect(half.output(), above.input(1))
    builder.connect(above.output(), both.input(0))
    builder.connect(step.output(), both.input(1))
    builder.connect(both.output(), late.input())
    diagram = builder.build()
    signals = {"above": above.output(), "step": step.output()}
    results = saltus.simulate(diagram, (0, 1), recorded_signals=signals, max_minor_step_size=0.25)
    before = results.outputs["step"] == 0
    assert (results.time[before] <= 0.5).all() and (results.time[~before] >= 0.5).all()
    at = np.flatnonzero(results.time == 0.5)
    assert results.outputs["step"][at[0]] == 0
    assert results.outputs["step"][at[-1]] == 1


@pytest.mark.parametrize("method", METHODS)
def test_5_1_a_terminal_event_without_an_effect_leaves_one_row(method):
    def declare(self):
        ramp()(self)
        self.declare_zero_crossing(lambda t, s: x(t, s) - 0.6, name="end", terminal=True)

    results = go(Block(declare), 1.0, ode_solver_method=method)
    assert results.status == "terminal"
    assert (results.time == results.context.time).sum() == 1
    assert results.jump.tolist() == [0] * len(results.jump)
    assert [(e.kind, e.jump) for e in results.events] == [("terminal", 0)]


def test_5_1_a_terminal_event_with_a_reset_leaves_two_rows():
    def declare(self):
        ramp()(self)
        self.declare_zero_crossing(
            lambda t, s: x(t, s) - 0.6,
            lambda t, s: s.with_continuous_state([2.0]),
            name="end",
            terminal=True,
        )

    results = go(Block(declare), 1.0)
    assert results.jump[-2:].tolist() == [0, 1]
    assert results.time[-2] == results.time[-1]
    assert results.outputs["x"][-1].tolist() == [2.0]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(("begin", "end", "step"), [(0, 10, 0.1), (0.1, 1.1, 1 / 3), (0, 1, 1e-3)])
def test_5_1_major_steps_are_counted_and_the_end_is_one_row(method, begin, end, step):
    def declare(self):
        self.declare_discrete_state([0.0])
        self.declare_output_port(lambda t, s: t, name="x", shape=())

    block = Block(declare)
    options = {"max_major_step_length": step, "ode_solver_method": method}
    whole = go(block, end, begin=begin, **options)
    # the first row, and one for each step that has begun before the end, up to rounding
    assert len(whole.time) == 1 + int(np.ceil((end - begin) / step - 1e-9))
    assert np.diff(whole.time).min() > 1e-9
    assert whole.time[-1] == end


def test_5_3_a_firing_that_changes_nothing_is_no_jump_in_the_log():
    """Of three firings of a guard that ends the run at the third; a reset lies between."""

    def declare(self):
        ramp()(self)
        wave = lambda t, s: -np.sin(10.0 * np.pi * x(t, s))  # noqa: E731
        self.declare_zero_crossing(wave, name="end", direction="rising", terminal=True, max_count=3)
        self.declare_zero_crossing(
            lambda t, s: t - 0.2, lambda t, s: s.continuous_state, name="reset"
        )

    results = go(Block(declare), 1.0, max_minor_step_size=0.05)
    found = [(e.name, round(e.time, 9), e.jump) for e in results.events]
    assert found == [("end", 0.1, 0), ("reset", 0.2, 1), ("end", 0.3, 1), ("end", 0.5, 1)]
    assert len(results.time) == len(set(zip(results.time, results.jump, strict=True)))
