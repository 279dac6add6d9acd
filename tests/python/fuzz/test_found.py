"""The smallest scenes of what random ones found."""

import pytest
from properties import check_end
from running import run, run_in_pieces
from scene import Part, Scene

LIMIT = 0.5  # [s]; each takes a millisecond

# on its floor, which is at 0.5
RESTING = Part("Ball", {"x0": (0.5, 0.0), "e": 0.5}, (None,))


def check_runs(scene, status="reached_end", **overrides):
    results = run(scene, limit=LIMIT, **overrides)
    check_end(scene, results, [f"{part.kind}{i}" for i, part in enumerate(scene.parts)])
    assert results.status == status
    return results


def test_a_ball_at_rest_at_an_instant_at_zero_that_is_the_end():
    check_runs(Scene((RESTING,), (0.0, 0.0)))


def test_a_ball_at_rest_stays_after_a_piece_of_no_length():
    scene = Scene((RESTING,), (-1.5, -0.5))
    results = run_in_pieces(scene, [-1.5], limit=LIMIT)
    assert results.context.continuous_state.tolist() == [0.5, 0.0]


@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_a_ball_at_rest_without_zeno_monitor_chatters_in_bounded_time(e):
    ball = Part("Ball", {"x0": (0.5, 0.0), "e": e, "zeno_tolerance": 0.0}, (None,))
    check_runs(Scene((ball,)), "chattering")


def test_chattering_names_its_block_without_an_event_log():
    ball = Part("Ball", {"e": 0.0, "zeno_tolerance": 0.0}, (None,))
    check_runs(Scene((ball,)), "chattering", record_events=False)


@pytest.mark.parametrize("method", ["adams", "bdf"])
def test_a_tick_an_ulp_before_the_end(method):
    """3 * 0.7 < 2.1"""
    x = Part("Integrator", {"enable_hold": True}, (None, (1, 0)))
    pulse = Part("Pulse", {"period": 0.7})
    check_runs(Scene((x, pulse), (0.1, 2.1), {"ode_solver_method": method}))


def test_a_block_that_blows_up_is_named():
    """dx/dt = x^2"""
    x = Part("Integrator", {"initial_state": 1.0}, ((1, 0),))
    square = Part("Product", {"operators": "**"}, ((0, 0), (0, 0)))
    results = run(Scene((x, square), (0.0, 2.0)), limit=LIMIT)
    assert results.status == "failed"
    assert "Integrator0" in results.message


@pytest.mark.parametrize("method", ["adams", "bdf"])
def test_a_first_piece_far_below_rounding(method):
    scene = Scene((Part("Integrator", {}, (None,)),), options={"ode_solver_method": method})
    results = run_in_pieces(scene, [1e-300], limit=LIMIT)
    assert results.status == "reached_end"
    assert results.context.continuous_state == pytest.approx([0.5], rel=1e-9)


def thrown(of):
    """dx/dt = 1 - x^3, thrown up by 2 where x rises through 0, at the start."""
    guard = {"of": of, "level": 0.0, "reset": "add", "value": 2.0}
    guard["direction"] = "negative_then_non_negative"
    numbers = {"x0": [0.0], "a": [[[0.0]]] * 2, "b": [[1.0]] * 2, "guards": [guard]}
    return Scene((Part("Leaf", numbers, (None,)),))


def test_what_a_reset_throws_far_from_its_surface_flows_on():
    results = check_runs(thrown("first"))
    assert [e.kind for e in results.events] == ["zero_crossing"]
    assert 1.0 < results.context.continuous_state[0] < 1.3


def test_two_guards_in_one_fire_once_each():
    assert len(check_runs(thrown("pair")).events) == 2
