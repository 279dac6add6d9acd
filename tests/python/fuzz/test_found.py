"""The smallest scenes of what random ones found."""

import pytest
from properties import check_end
from running import run, run_in_pieces
from scene import Part, Scene

LIMIT = 0.5  # [s]; each takes a millisecond

# on its floor, which is at 0.5
RESTING = Part("Ball", {"x0": (0.5, 0.0), "e": 0.5}, (None,))


def todo(reason):
    return pytest.mark.xfail(strict=True, reason=reason)


def check_runs(scene, status="reached_end", **overrides):
    results = run(scene, limit=LIMIT, **overrides)
    check_end(scene, results, [f"{part.kind}{i}" for i, part in enumerate(scene.parts)])
    assert results.status == status
    return results


@todo("the flow is followed for no time at all, for ever")
def test_a_ball_at_rest_at_an_instant_at_zero_that_is_the_end():
    check_runs(Scene((RESTING,), (0.0, 0.0)))


@todo("the side of a guard is not told if the first piece has no length")
def test_a_ball_at_rest_stays_after_a_piece_of_no_length():
    scene = Scene((RESTING,), (-1.5, -0.5))
    results = run_in_pieces(scene, [-1.5], limit=LIMIT)
    assert results.context.continuous_state.tolist() == [0.5, 0.0]


@todo("the watchdog looks at gaps of rounding only")
@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_a_ball_at_rest_without_zeno_monitor_chatters_in_bounded_time(e):
    ball = Part("Ball", {"x0": (0.5, 0.0), "e": e, "zeno_tolerance": 0.0}, (None,))
    check_runs(Scene((ball,)), "chattering")


@todo("the name is taken from the event log")
def test_chattering_names_its_block_without_an_event_log():
    ball = Part("Ball", {"e": 0.0, "zeno_tolerance": 0.0}, (None,))
    check_runs(Scene((ball,)), "chattering", record_events=False)


@todo("CVODE refuses the distance")
@pytest.mark.parametrize("method", ["adams", "bdf"])
def test_a_tick_an_ulp_before_the_end(method):
    """3 * 0.7 < 2.1"""
    x = Part("Integrator", {"enable_hold": True}, (None, (1, 0)))
    pulse = Part("Pulse", {"period": 0.7})
    check_runs(Scene((x, pulse), (0.1, 2.1), {"ode_solver_method": method}))


@todo("the message of a step that underflows has no block")
def test_a_block_that_blows_up_is_named():
    """dx/dt = x^2"""
    x = Part("Integrator", {"initial_state": 1.0}, ((1, 0),))
    square = Part("Product", {"operators": "**"}, ((0, 0), (0, 0)))
    results = run(Scene((x, square), (0.0, 2.0)), limit=LIMIT)
    assert results.status == "failed"
    assert "Integrator0" in results.message
