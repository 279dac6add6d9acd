"""`results(t)`: state and signals at any time of a run."""

import gc
import threading
import weakref

import numpy as np
import pytest
import saltus
from saltus.library import Constant, Gain, Integrator, ReduceBlock, Sine, ZeroOrderHold
from systems import Ball, Decay, run

METHODS = ["dopri5", "dop853", "adams", "bdf", "radau", "taylor", "auto"]


class Circle(saltus.LeafSystem):
    """x' = y, y' = -x from (1, 0): cos t and -sin t; an output of time and state."""

    def __init__(self):
        super().__init__(name="circle")
        self.declare_continuous_state(
            default_value=[1.0, 0.0],
            ode=lambda t, s: [s.continuous_state[1], -s.continuous_state[0]],
        )
        self.declare_continuous_state_output("x")
        self.declare_output_port(lambda t, s: t + s.continuous_state[0] ** 2, name="square")


def ball_run(**options):
    ball = Ball(g=10.0, e=0.5)
    context = ball.create_context().with_continuous_state([5.0, 0.0])
    return run(ball, (0.0, 4.0), context, dense_output=True, **options)


@pytest.mark.parametrize("method", METHODS)
def test_it_says_what_a_row_at_that_time_would(method):
    times = np.linspace(0.05, 9.95, 400)
    options = {"ode_solver_method": method, "rtol": 1e-7, "atol": 1e-9}
    dense = run(Circle(), (0.0, 10.0), dense_output=True, **options)
    rows = run(Circle(), (0.0, 10.0), save_at=times, **options)
    inner = slice(1, -1)  # without the rows of start and end
    np.testing.assert_allclose(dense(times)["x"], rows.outputs["x"][inner], rtol=0, atol=1e-14)
    square = rows.outputs["square"][inner]
    np.testing.assert_allclose(dense(times)["square"], square, rtol=0, atol=1e-13)


@pytest.mark.parametrize(("method", "order"), [("dopri5", 5), ("dop853", 8)])
def test_it_has_the_order_of_the_method(method, order):
    """The interpolant errs by h^(degree + 1), the steps by h^order in the end: 5 and 8 for both."""

    def error(h):
        results = run(
            Circle(),
            (0.0, 4.0),
            ode_solver_method=method,
            rtol=1e6,
            atol=1e6,
            max_minor_step_size=h,
            dense_output=True,
        )
        times = np.linspace(1.0, 4.0, 401)
        return np.max(np.abs(results(times).continuous_state[:, 0] - np.cos(times)))

    h = 0.2 if method == "dopri5" else 0.5
    observed = np.log2(error(h) / error(h / 2))
    assert order - 0.5 < observed < order + 1.0


@pytest.mark.parametrize("method", ["dopri5", "dop853", "auto"])
def test_a_ball_at_bounces_and_at_rest(method):
    """g = 10 m/s^2 from 5 m: 1 s down, 1 s up and down at half the speed, ... rest from 3 s on."""
    results = ball_run(ode_solver_method=method)
    bounce = results.events.times("bounce")[0]
    before, after = results(bounce, side="left"), results(bounce)
    assert before.continuous_state[1] == pytest.approx(-10.0, abs=1e-12)
    assert after.continuous_state[1] == -0.5 * before.continuous_state[1]
    assert results(1.5)["state"][0] == pytest.approx(1.25, abs=1e-12)
    held = results(np.linspace(3.1, 4.0, 20)).continuous_state
    assert np.all(held == held[0])
    assert np.array_equal(held[0], results.context.continuous_state)


@pytest.mark.parametrize("method", METHODS)
def test_rows_come_back_to_the_last_bit(method):
    results = ball_run(ode_solver_method=method)
    time, state = results.time, results.outputs["state"]
    last = np.append(np.diff(time) > 0, True)
    first = np.append(True, np.diff(time) > 0)
    held = [e.time for e in results.events if e.kind == "zeno_enter"]
    last &= ~np.isin(time, held)  # the hold moves the state after the last row of its instant
    assert np.array_equal(results(time[last])["state"], state[last])
    assert np.array_equal(results(time[first], side="left")["state"], state[first])


def test_shapes_follow_the_times():
    results = run(Circle(), (0.0, 1.0), dense_output=True)
    one = results(0.5)
    assert np.ndim(one["square"]) == 0
    assert one["x"].shape == one.continuous_state.shape == (2,)
    assert one.time == 0.5
    grid = results(np.array([[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]]))
    assert grid["square"].shape == (2, 3)
    assert grid["x"].shape == grid.continuous_state.shape == (2, 3, 2)
    assert np.array_equal(grid["x"][1, 1], one["x"])
    assert results([])["x"].shape == (0, 2)
    assert dict(one).keys() == {"x", "square"}
    assert "continuous_state = " in repr(one)
    assert "square" in one and "circle" not in one


def test_held_signals_and_opaque_booleans():
    builder = saltus.DiagramBuilder()
    sine, hold = builder.add(Sine(name="sine"), ZeroOrderHold(0.5, name="hold"))
    zero, positive = builder.add(Constant(0.0), ReduceBlock(2, lambda u: u[0] > u[1], name="pos"))
    twice, x = builder.add(Gain(2.0, name="twice"), Integrator(name="x"))
    builder.connect(sine.output(), hold.input())
    builder.connect(sine.output(), positive.input(0))
    builder.connect(zero.output(), positive.input(1))
    builder.connect(hold.output(), twice.input())
    builder.connect(twice.output(), x.input())
    diagram = builder.build()
    recorded = {b.name: b.output() for b in (sine, hold, positive, twice, x)}
    results = saltus.simulate(
        diagram,
        diagram.create_context(),
        (0.0, 4.0),
        recorded_signals=recorded,
        dense_output=True,
    )
    t = np.linspace(0.01, 3.97, 100)  # never at a tick
    values = results(t)
    ticks = np.sin(np.floor(t / 0.5) * 0.5)
    np.testing.assert_allclose(values["hold"], ticks, atol=1e-15)
    np.testing.assert_allclose(values["twice"], 2 * ticks, atol=1e-15)
    assert np.array_equal(values["pos"] != 0, np.sin(t) > 0)
    assert results(1.0, side="left")["hold"] == np.sin(0.5)
    assert results(1.0)["hold"] == np.sin(1.0)


def test_errors():
    results = run(Circle(), (0.0, 1.0), dense_output=True)
    for outside in (-1e-9, 1.1, np.nan, [0.5, 2.0]):
        with pytest.raises(saltus.ModelError, match="is outside the run, which went from 0 s to 1"):
            results(outside)
    with pytest.raises(saltus.ModelError, match="side: unknown side 'lefft'; did you mean 'left'"):
        results(0.5, side="lefft")
    with pytest.raises(saltus.ModelError, match="expected a time or an array of times"):
        results("soon")
    with pytest.raises(saltus.ModelError, match=r"nothing was recorded under 'xx'.*'x'"):
        results(0.5)["xx"]
    with pytest.raises(saltus.ModelError, match="dense_output=True"):
        run(Circle(), (0.0, 1.0))(0.5)


def test_what_an_output_raises_comes_out_as_it_was():
    class Late(Circle):
        angry = False

        def __init__(self):
            super().__init__()
            self.declare_output_port(self.grumble, name="late", shape=())

        def grumble(self, time, state):
            if self.angry:
                raise LookupError("not now")
            return 1.0

    late = Late()
    # Called: a traced output stays as it was in the run.
    results = run(late, (0.0, 1.0), dense_output=True, python="called")
    late.angry = True
    with pytest.raises(LookupError, match="not now"):
        results(0.5)
    late.angry = False
    assert results(0.5)["late"] == 1.0


@pytest.mark.parametrize("method", METHODS)
def test_asking_for_it_changes_no_bit(method):
    plain, dense = (
        run(
            Ball(),
            (0.0, 12.0),
            Ball().create_context().with_continuous_state([10.0, 0.0]),
            dense_output=wanted,
            ode_solver_method=method,
        )
        for wanted in (False, True)
    )
    assert np.array_equal(plain.time, dense.time)
    assert np.array_equal(plain.outputs["state"], dense.outputs["state"])
    assert plain.context == dense.context
    assert not plain.dense and dense.dense
    assert dense.span == (0.0, 12.0)
    more = dense.stats.right_hand_side_calls - plain.stats.right_hand_side_calls
    assert more == 0 or (method == "dop853" and more <= 3 * dense.stats.steps)


def test_a_run_in_pieces_and_results_that_do_not_change_later():
    simulator = saltus.Simulator(Circle(), dense_output=True)
    simulator.initialize(simulator.system.create_context())
    simulator.advance_to(1.0)
    early = simulator.results
    simulator.advance_to(2.0)
    assert early.span == (0.0, 1.0)
    assert simulator.results.span == (0.0, 2.0)
    assert simulator.results(1.5).continuous_state[0] == pytest.approx(np.cos(1.5), abs=1e-5)
    with pytest.raises(saltus.ModelError, match="outside the run"):
        early(1.5)


def test_it_keeps_its_system_alive_and_lets_it_go():
    system = Circle()
    gone = weakref.ref(system)
    results = run(system, (0.0, 1.0), dense_output=True)
    del system
    gc.collect()
    assert results(0.5)["square"] == pytest.approx(0.5 + np.cos(0.5) ** 2, abs=1e-5)
    del results
    gc.collect()
    assert gone() is None


def test_threads_read_the_same_results():
    results = run(Decay(lambda t, s: None, where="never"), (0.0, 5.0), dense_output=True)
    t = np.linspace(0, 5, 2000)
    expected, found = results(t)["x"], []
    threads = [threading.Thread(target=lambda: found.append(results(t)["x"])) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(30)
    assert len(found) == 4
    assert all(np.array_equal(each, expected) for each in found)


def test_a_failed_run_can_be_read_up_to_where_it_failed():
    def fail(time, state):
        if time > 0.5:
            raise ArithmeticError("no more")

    results = run(Decay(fail), (0.0, 2.0), dense_output=True, throw=False)
    assert results.status == "failed"
    begin, end = results.span
    assert begin == 0.0 and 0.0 <= end <= 0.5
    assert results(end)["x"][0] == pytest.approx(np.exp(-end), abs=1e-6)
