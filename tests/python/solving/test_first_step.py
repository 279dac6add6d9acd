"""`first_step`: the step a run begins with."""

import numpy as np
import pytest
import saltus
from saltus import Guard, solve
from systems import Ball

METHODS = ("auto", "dopri5", "dop853", "adams", "bdf", "radau", "taylor")


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("size", [1e-6, 1e-4])
@pytest.mark.parametrize("span", [(0.0, 1.0), (1.0, 0.0)])
def test_the_first_step_is_as_long_as_wished(method, size, span):
    run = solve(lambda t, x: -x, span, [1.0], method=method, first_step=size)
    assert abs(run.t[1] - run.t[0]) == pytest.approx(size, rel=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_a_first_step_that_misses_the_tolerance_is_shortened(method):
    run = solve(lambda t, x: -x, (0, 10), [1.0], method=method, first_step=5.0, rtol=1e-8)
    assert run.t[1] < 5.0
    assert abs(run.y[0, -1] - np.exp(-10.0)) < 1e-6


def test_only_the_first_step_of_a_run_is_affected():
    """After a reset the engine goes on with the steps it had."""
    flips = Guard(lambda t, x: t - 0.5, lambda t, x: -x, "rising")
    run = solve(lambda t, x: -x, (0, 1), [1.0], method="dopri5", events=flips, first_step=1e-7)
    steps = np.diff(run.t)
    assert steps[0] == pytest.approx(1e-7)
    assert steps[np.searchsorted(run.t, 0.5, side="right") - 1] > 1e-3


def test_it_is_an_option_of_simulate_too():
    ball = Ball()
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    recorded = {"ball": ball.output(0)}
    run = saltus.simulate(ball, context, (0, 1), recorded_signals=recorded, first_step=1e-3)
    assert run.time[1] == pytest.approx(1e-3)


@pytest.mark.parametrize("wrong", [0.0, -1.0, 2.0, np.nan, np.inf])
def test_a_first_step_outside_the_span_is_refused(wrong):
    with pytest.raises(saltus.ModelError, match="first_step: expected a time > 0 s within t_span"):
        solve(lambda t, x: -x, (0, 1), [1.0], first_step=wrong)


def test_what_is_no_step_is_refused():
    ball = Ball()
    with pytest.raises(saltus.ModelError, match="option first_step: expected a time > 0 s, or"):
        saltus.simulate(ball, ball.create_context(), (0, 1), first_step=-1.0)
    with pytest.raises(saltus.ModelError, match="option first_step: expected"):
        saltus.simulate(ball, ball.create_context(), (0, 1), first_step="short")
