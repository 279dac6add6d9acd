"""Runs back in time: the time is reversed, and all that a user sees has the user's times."""

import numpy as np
import pytest
import saltus
from saltus import Guard, solve

METHODS = ("auto", "dopri5", "dop853", "adams", "bdf", "radau", "taylor")
CLOSE = {"rtol": 1e-9, "atol": 1e-11}


def turn(t, x):
    """x0 = sin t, x1 = cos t"""
    return np.array([x[1], -x[0]])


def at(t):
    return np.array([np.sin(t), np.cos(t)])


@pytest.mark.parametrize("method", METHODS)
def test_the_way_back_is_the_way(method):
    back = solve(turn, (3.0, -2.0), at(3.0), method=method, dense_output=True, **CLOSE)
    assert (back.t[0], back.t[-1]) == (3.0, -2.0)
    assert np.all(np.diff(back.t) < 0) and back.success
    # a hundred tolerances: about fifty steps of at most one each, in a flow that keeps errors
    np.testing.assert_allclose(back.y, at(back.t), atol=100 * 1e-9)
    asked = np.linspace(3.0, -2.0, 7)
    np.testing.assert_allclose(back.sol(asked), at(asked), atol=100 * 1e-9)
    assert np.array_equal(back.sol(back.t), back.y)
    assert back.span == (3.0, -2.0)


@pytest.mark.parametrize("method", METHODS)
def test_it_has_the_bits_of_the_reversed_problem(method):
    back = solve(turn, (3.0, -2.0), at(3.0), method=method)
    mirrored = solve(lambda s, x: -turn(-s, x), (-3.0, 2.0), at(3.0), method=method)
    assert np.array_equal(back.t, -mirrored.t)
    assert np.array_equal(back.y, mirrored.y)
    assert back.nfev == mirrored.nfev


@pytest.mark.parametrize("direction", ["falling", "rising", "both"])
def test_directions_are_those_along_the_run(direction):
    """sin t falls through 0 at pi, on the way back it rises there; as SciPy has it."""
    integrate = pytest.importorskip("scipy.integrate")

    def zero(t, x):
        return x[0]

    zero.direction = {"falling": -1, "rising": 1, "both": 0}[direction]
    ours = solve(turn, (7.0, -7.0), at(7.0), events=zero, **CLOSE)
    theirs = integrate.solve_ivp(turn, (7.0, -7.0), at(7.0), events=zero, method="DOP853", **CLOSE)
    expected = {
        "falling": [2 * np.pi, 0.0, -2 * np.pi],
        "rising": [np.pi, -np.pi],
        "both": [2 * np.pi, np.pi, 0.0, -np.pi, -2 * np.pi],
    }[direction]
    np.testing.assert_allclose(ours.t_events[0], expected, atol=1e-7)
    np.testing.assert_allclose(theirs.t_events[0], expected, atol=1e-7)
    np.testing.assert_allclose(ours.y_events[0], at(np.array(expected)).T, atol=1e-7)
    assert [e.time for e in ours.events] == ours.t_events[0].tolist()


@pytest.mark.parametrize("method", METHODS)
def test_a_terminal_event_ends_it(method):
    half = Guard(lambda t, x: t - 0.5, terminal=True)
    run = solve(lambda t, x: x, (2.0, 0.0), [np.exp(2.0)], events=half, method=method, **CLOSE)
    assert run.status == "terminal" and run.t[-1] == pytest.approx(0.5, abs=1e-12)
    assert run.y[0, -1] == pytest.approx(np.exp(0.5), abs=1e-6)


def test_a_reset_happens_on_the_way_back():
    """x = t - 2 from 2 s back to 1 s, where 10 is added."""
    jump = Guard(lambda t, x: t - 1.0, lambda t, x: x + 10.0, name="jump")
    run = solve(lambda t, x: [1.0], (2.0, 0.0), [0.0], events=jump)
    assert run.y[0, -1] == pytest.approx(8.0, abs=1e-12)
    (event,) = run.events
    assert event.time == pytest.approx(1.0, abs=1e-12)
    assert (event.before[0], event.after[0]) == pytest.approx((-1.0, 9.0), abs=1e-12)


def test_t_eval_descends():
    times = [2.5, 1.0, 0.0]
    run = solve(turn, (3.0, 0.0), at(3.0), t_eval=times, **CLOSE)
    assert run.t.tolist() == times
    with pytest.raises(saltus.ModelError, match="t_eval: expected decreasing times within t_span"):
        solve(turn, (3.0, 0.0), at(3.0), t_eval=[0.5, 1.0])
    with pytest.raises(saltus.ModelError, match="t_eval: expected decreasing times within t_span"):
        solve(turn, (3.0, 0.0), at(3.0), t_eval=[4.0, 1.0])


def test_a_jacobian_is_turned_round():
    def fast(t, x):
        return 1e4 * (x - np.cos(t))  # stiff on the way back

    for jacobian in ([[1e4]], lambda t, x: [[1e4]], None):
        run = solve(fast, (2.0, 0.0), [np.cos(2.0)], method="bdf", jacobian=jacobian)
        assert run.y[0, -1] == pytest.approx(1.0, abs=1e-3)
        assert run.stats.steps < 500


def test_an_endless_way_back_needs_a_terminal_event():
    with pytest.raises(saltus.ModelError, match="the end is infinite"):
        solve(lambda t, x: [1.0], (0.0, -np.inf), [0.0])
    wall = Guard(lambda t, x: x[0] + 3.0, terminal=True)
    run = solve(lambda t, x: [1.0], (0.0, -np.inf), [0.0], events=[wall])
    assert run.t[-1] == pytest.approx(-3.0, abs=1e-12)


def test_errors_say_the_time_of_the_user():
    with pytest.raises(
        saltus.SimulationError, match=r"^t = (0\.999|1\.0)\d* s, on the way"
    ) as caught:
        solve(lambda t, x: -(x**2), (2.0, 0.0), [1.0])  # 1 / (t - 1)
    assert caught.value.time == pytest.approx(1.0, abs=1e-3)
    assert caught.value.results.t[-1] == pytest.approx(1.0, abs=1e-3)
    failed = solve(lambda t, x: -(x**2), (2.0, 0.0), [1.0], throw=False)
    assert failed.status == "failed" and failed.message == str(caught.value)


def test_it_can_be_saved_pickled_and_drawn(tmp_path):
    import pickle

    run = solve(turn, (3.0, 0.0), at(3.0), events=lambda t, x: x[1], dense_output=True)
    run.save(tmp_path / "back.npz")
    for copy in (saltus.load_results(tmp_path / "back.npz"), pickle.loads(pickle.dumps(run))):
        assert np.array_equal(copy.t, run.t) and np.array_equal(copy.y, run.y)
        assert np.array_equal(copy.t_events[0], run.t_events[0])
    pytest.importorskip("matplotlib")
    line = run.plot("x[0]").lines[0]
    np.testing.assert_allclose(line.get_ydata(), np.sin(line.get_xdata()), atol=1e-4)


def test_a_callback_that_traces_forward_traces_backward():
    run = solve(lambda t, x: [x[1], -x[0]], (1.0, 0.0), at(1.0))
    assert "called" not in str(run.system.explain()).lower()
