"""After a failure the context is the last accepted state, and a run goes on from it."""

import math

import numpy as np
import pytest
import saltus

METHODS = ["auto", "dopri5", "dop853", "adams", "bdf", "radau"]
PLACES = ["ode", "guard", "reset", "update", "output"]


class Fragile(saltus.LeafSystem):
    """x' = -x from 1, back to 1 at 1/2, a tick each 0.25 s; `place` fails after `since`."""

    def __init__(self, place, since, failure):
        super().__init__(name="fragile")
        self.place, self.since, self.failure = place, since, failure
        self.declare_continuous_state([1.0], ode=self.ode)
        self.declare_discrete_state(default_value=[0.0])
        self.declare_output_port(self.shown, name="y", shape=())
        self.declare_continuous_state_output("x")
        self.declare_discrete_state_output("z")
        self.declare_periodic_update(self.update, period=0.25)
        self.declare_zero_crossing(self.guard, self.reset, name="half", direction="falling")

    def trouble(self, place, time):
        if place != self.place or not time > self.since:
            return 0.0
        if isinstance(self.failure, BaseException):
            raise self.failure
        return self.failure

    def ode(self, time, state):
        return [-state.continuous_state[0] + self.trouble("ode", time)]

    def guard(self, time, state):
        return state.continuous_state[0] - 0.5 + self.trouble("guard", time)

    def reset(self, time, state):
        return state.with_continuous_state([1.0 + self.trouble("reset", time)])

    def update(self, time, state):
        return state.discrete_state + 1.0 + self.trouble("update", time)

    def shown(self, time, state):
        return state.continuous_state[0] + self.trouble("output", time)


def simulate(block, context, method):
    recorded = {name: block.output(name) for name in ("x", "y", "z")}
    span = (context.time, 2.0)
    options = {"ode_solver_method": method, "python": "called", "throw": False}
    return saltus.simulate(block, context, span, recorded_signals=recorded, **options)


@pytest.mark.parametrize("failure", [ArithmeticError("mine"), KeyboardInterrupt(), math.nan])
@pytest.mark.parametrize("since", [0.0, 0.7, 1.3])
@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("method", METHODS)
def test_the_context_is_accepted_and_the_run_goes_on(method, place, since, failure):
    block = Fragile(place, since, failure)
    failed = simulate(block, block.create_context(), method)
    assert failed.status in ("failed", "interrupted")
    context = failed.context
    assert failed.time[-1] <= context.time
    if place != "output":  # a row that failed is no row
        assert failed.time[-1] == context.time
        assert np.array_equal(failed.outputs["x"][-1], context.continuous_state)
        assert np.array_equal(failed.outputs["z"][-1], context.discrete_state)

    block.place = "nowhere"
    whole = simulate(block, block.create_context(), method)
    rest = simulate(block, context, method)
    names = [(event.name, event.kind) for event in whole.events]
    assert [(e.name, e.kind) for e in [*failed.events, *rest.events]] == names
    # Two runs within the tolerances 1e-6 |x| + 1e-8, with |x| <= 1; ten tolerances each.
    assert rest.context.continuous_state == pytest.approx(whole.context.continuous_state, abs=2e-5)
    assert np.array_equal(rest.context.discrete_state, whole.context.discrete_state)


@pytest.mark.parametrize("method", METHODS)
def test_a_guard_that_is_not_finite_leaves_the_state_of_the_last_row(method):
    """x' = 1 from 0.25; a step ends where the guard is NaN."""
    block = saltus.LeafSystem(name="leaf")
    block.declare_continuous_state([0.25], ode=lambda t, s: [1.0])
    block.declare_continuous_state_output("x")
    block.declare_zero_crossing(
        lambda t, s: math.nan if s.continuous_state[0] > 0.75 else 1.0,
        lambda t, s: s.with_continuous_state([0.0]),
        name="pole",
    )
    ends = []
    for _ in range(2):
        results = saltus.simulate(
            block,
            block.create_context(),
            (0, 2),
            throw=False,
            ode_solver_method=method,
            recorded_signals={"x": block.output("x")},
        )
        assert results.status == "failed"
        assert results.context.time == results.time[-1]
        assert np.array_equal(results.context.continuous_state, results.outputs["x"][-1])
        ends.append(results.context)
    assert ends[0] == ends[1]
