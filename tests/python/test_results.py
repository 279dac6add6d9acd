"""Results, the event log, statistics, and runs in pieces."""

import numpy as np
import pytest
import saltus
from saltus.library import Constant, Gain, Integrator, Sine
from systems import Ball, run


@pytest.fixture
def ball_results():
    ball = Ball()
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    return run(ball, (0.0, 12.0), context, rtol=1e-10, atol=1e-12)


def test_shapes_and_types():
    builder = saltus.DiagramBuilder()
    scalar, one, two = builder.add(Constant(1.0), Constant([1.0]), Constant([1.0, 2.0]))
    diagram = builder.build()
    recorded = {"scalar": scalar.output(), "one": one.output(), "two": two.output()}
    results = saltus.simulate(
        diagram, diagram.create_context(), (0.0, 1.0), recorded_signals=recorded
    )
    n = len(results.time)
    assert {name: array.shape for name, array in results.outputs.items()} == {
        "scalar": (n,),
        "one": (n, 1),
        "two": (n, 2),
    }
    assert results.time.dtype == results.outputs["two"].dtype == np.float64
    assert results.jump.dtype.kind == "i"


def test_rows_around_an_event(ball_results):
    """One row before and one after, told apart by j."""
    time, jump, (y, v) = ball_results.time, ball_results.jump, ball_results.outputs["state"].T
    for k, t in enumerate(ball_results.events.times("bounce")):
        rows = np.flatnonzero(time == t)
        assert jump[rows].tolist() == [k, k + 1]
        assert v[rows[1]] == -0.9 * v[rows[0]]
        assert abs(y[rows[0]]) < 1e-12


def test_events_are_data(ball_results):
    events = ball_results.events
    assert len(events) == 6
    first = events[0]
    assert (first.block, first.name, first.kind, first.direction, first.jump) == (
        "ball",
        "bounce",
        "zero_crossing",
        -1,
        1,
    )
    assert np.isnan(first.predicted)
    assert first.after[1] == -0.9 * first.before[1]
    assert events[-1].time == max(event.time for event in events)
    assert [event.time for event in events[1:3]] == events.times("bounce")[1:3].tolist()
    assert np.array_equal(events.times("ball.bounce"), events.times("bounce"))
    assert events.times("bounce", kind="zeno_enter").size == 0
    with pytest.raises(IndexError):
        events[6]
    with pytest.raises(saltus.ModelError, match="unknown kind of event 'zero'"):
        events.times("bounce", kind="zero")
    with pytest.raises(saltus.ModelError, match="called 'bonce'; did you mean 'bounce'"):
        events.times("bonce")
    with pytest.raises(saltus.ModelError, match=r"'ball\.bonce'; did you mean 'ball\.bounce'"):
        events[:2].times("ball.bonce")


def test_reprs(ball_results):
    assert repr(ball_results).startswith("<Results: reached_end, ")
    assert "state (" in repr(ball_results)
    assert "6 events" in repr(ball_results)
    assert repr(ball_results.events).splitlines()[0] == "6 events"
    assert "ball.bounce" in repr(ball_results.events)
    assert "method='dop" in repr(ball_results.statistics)


def test_statistics_count(ball_results):
    statistics = ball_results.statistics
    assert statistics.events == 6
    assert statistics.restarts == 6
    # dopri5: six evaluations a step, one more after each restart
    assert statistics.right_hand_side_calls >= 6 * statistics.steps
    assert statistics.wall_time > 0


def test_an_unknown_output_lists_the_known(ball_results):
    with pytest.raises(
        saltus.ModelError, match="nothing was recorded under 'stat'; did you mean 'state'"
    ):
        ball_results.outputs["stat"]


def test_the_final_context(ball_results):
    assert ball_results.context.time == 12.0
    assert np.array_equal(ball_results.context.continuous_state, ball_results.outputs["state"][-1])


def test_recording_changes_no_bit(ball_results):
    ball = Ball()
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    bare = saltus.simulate(ball, context, (0.0, 12.0), rtol=1e-10, atol=1e-12, recorded_signals=[])
    assert bare.context == ball_results.context
    assert np.array_equal(bare.events.times("bounce"), ball_results.events.times("bounce"))
    assert bare.time.size == 0


def test_the_same_run_twice_gives_the_same_bits(ball_results):
    ball = Ball()
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    again = run(ball, (0.0, 12.0), context, rtol=1e-10, atol=1e-12)
    assert np.array_equal(again.time, ball_results.time)
    assert np.array_equal(again.outputs["state"], ball_results.outputs["state"])


def test_a_run_in_pieces(ball_results):
    """The same events, and the same numbers to solver tolerance."""
    ball = Ball()
    simulator = saltus.Simulator(
        ball, rtol=1e-10, atol=1e-12, recorded_signals={"state": ball.output()}
    )
    simulator.initialize(ball.create_context().with_continuous_state([10.0, 0.0]))
    for t in (1.0, 5.0, 5.0, 12.0):
        assert simulator.advance_to(t) == "reached_end"
        assert simulator.time == simulator.context.time == t
    pieces = simulator.results
    np.testing.assert_allclose(
        pieces.events.times("bounce"), ball_results.events.times("bounce"), rtol=0, atol=1e-11
    )
    earlier = simulator.results
    with pytest.raises(saltus.ModelError, match="cannot run from t = 12 s back to t = 1 s"):
        simulator.advance_to(1.0)
    assert np.array_equal(earlier.time, pieces.time)


def test_a_run_goes_on_from_its_final_context(ball_results):
    ball = Ball()
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    half = run(ball, (0.0, 6.0), context, rtol=1e-10, atol=1e-12)
    rest = run(ball, (6.0, 12.0), half.context, rtol=1e-10, atol=1e-12)
    times = np.concatenate([half.events.times("bounce"), rest.events.times("bounce")])
    np.testing.assert_allclose(times, ball_results.events.times("bounce"), rtol=0, atol=1e-11)


def test_results_of_a_simulator_do_not_change_later():
    ball = Ball()
    simulator = saltus.Simulator(ball, recorded_signals={"state": ball.output()})
    simulator.initialize(ball.create_context().with_continuous_state([10.0, 0.0]))
    simulator.advance_to(1.0)
    early = simulator.results
    rows = len(early.time)
    copy = early.outputs["state"].copy()
    simulator.advance_to(100.0)
    assert len(early.time) == rows
    assert np.array_equal(early.outputs["state"], copy)


def test_tables(ball_results):
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    frame, dataset = ball_results.to_pandas(), ball_results.to_xarray()
    assert isinstance(frame, pandas.DataFrame)
    assert isinstance(dataset, xarray.Dataset)
    state = ball_results.outputs["state"]
    assert frame.index.is_unique  # that is what the jump is for
    assert np.array_equal(frame[["state[0]", "state[1]"]], state)
    assert np.array_equal(dataset["state"], state)
    assert np.array_equal(dataset["jump"], ball_results.jump)


def test_describe_says_what_is_never_computed():
    builder = saltus.DiagramBuilder()
    sine, gain, x = builder.add(Sine(name="sine"), Gain(2.0, name="unread"), Integrator(name="x"))
    builder.connect(sine.output(), gain.input())
    builder.connect(sine.output(), x.input())
    text = saltus.Simulator(builder.build()).describe()
    assert "dropped, nothing reads them: 1 (unread.out)" in text
    assert "no guards" in text


def test_a_span_of_no_length_has_the_rows_of_the_start():
    results = run(Ball(), (2.0, 2.0))
    assert set(results.time) == {2.0}


def test_events_are_counted_by_name(ball_results):
    """Six bounces by 12 s (t_k = t1 + 2 t1 (e + ... + e^(k-1)); the seventh is at 13.5 s)."""
    assert ball_results.statistics.events_by_name == {"ball.bounce": 6}
