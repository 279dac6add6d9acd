"""Section 5: rows, the event log, statistics, status."""

import dataclasses

import numpy as np
import pytest
import saltus
from blocks import Ball, Block, crossing, go, x

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
