"""5.6: a run goes on from `results.context` as it was, also where its functions are called now and
were traced before, or the other way round. What rests is part of how it was.
"""

import json

import numpy as np
import pytest
import saltus
from saltus.errors import ModelError

G, E = 9.81, 0.5
ONE_STEP = ["dopri5", "dop853", "radau"]
METHODS = [*ONE_STEP, "bdf", "adams"]


class WithClock(saltus.LeafSystem):
    """A ball that falls from 1 m, and a clock. Traced, the hold stops height and speed alone."""

    end = 3.0  # [s]; it rests from 1.3546 s on

    def __init__(self):
        super().__init__(name="ball")
        self.declare_continuous_state([1.0, 0.0, 0.0], ode=lambda t, s: self.flow(s))
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0],
            name="bounce",
            direction="positive_then_non_positive",
            reset_map=self.bounce,
        )

    def flow(self, s):
        return [s.continuous_state[1], -G, 1.0]

    def bounce(self, t, state):
        y, v, clock = state.continuous_state
        return state.with_continuous_state([y, -E * v, clock])


class Twisting(saltus.LeafSystem):
    """x'' = -3 sign(x) - sign(x'), with both signs as discrete states: it rests at 5.1213 s."""

    end = 6.0

    def __init__(self):
        super().__init__(name="twist")
        self.declare_continuous_state(
            [1.0, 0.0],
            ode=lambda t, s: self.flow(s),
        )
        self.declare_discrete_state([1.0, -1.0])
        for i in (0, 1):
            self.declare_zero_crossing(
                lambda t, s, i=i: s.continuous_state[i],
                name=f"sign{i}",
                reset_map=lambda t, s, i=i: s.with_discrete_state(
                    s.discrete_state * np.array([-1.0, 1.0] if i == 0 else [1.0, -1.0])
                ),
            )

    def flow(self, s):
        return [s.continuous_state[1], -3.0 * s.discrete_state[0] - s.discrete_state[1]]


class Counting(saltus.LeafSystem):
    """A ball whose bounce is one guard, and a second guard that counts it in a discrete state."""

    end = 3.0

    def __init__(self):
        super().__init__(name="counting")
        self.declare_continuous_state([1.0, 0.0], ode=lambda t, s: self.flow(s))
        self.declare_discrete_state([0.0])
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0],
            name="bounce",
            direction="positive_then_non_positive",
            reset_map=lambda t, s: s.with_continuous_state(
                [s.continuous_state[0], -E * s.continuous_state[1]]
            ),
        )
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[1],
            name="top",
            direction="positive_then_non_positive",
            reset_map=lambda t, s: s.with_discrete_state([s.discrete_state[0] + 1.0]),
        )

    def flow(self, s):
        return [s.continuous_state[1], -G]


SCENES = [WithClock, Twisting, Counting]
SPLITS = [0.5, 0.7, 0.97, 0.99, 0.999999, 1.000001, 1.05]
"""as parts of the time at which the scene comes to rest; each guard has fired before"""


def rest_of(results):
    return next(e.time for e in results.events if e.kind == "zeno_enter")


def run(system, span, python, method, context=None):
    return saltus.simulate(
        system,
        context,
        span,
        python=python,
        ode_solver_method=method,
        rtol=1e-9,
        atol=1e-11,
    )


# The multistep methods are off in flights below atol, which decide which of two signs is the last.
@pytest.mark.parametrize(
    "scene, method",
    [(WithClock, m) for m in METHODS] + [(s, m) for s in SCENES[1:] for m in ONE_STEP],
)
@pytest.mark.parametrize("before, after", [("traced", "called"), ("called", "traced")])
def test_a_run_goes_on_as_it_was_with_other_traces(scene, before, after, method):
    system = scene()
    whole = run(system, (0.0, system.end), before, method)
    for part in SPLITS:
        split = min(part * rest_of(whole), system.end)
        first = run(system, (0.0, split), before, method)
        second = run(system, (split, system.end), after, method, first.context)
        # Where two guards fire at one point, the rounding decides which of them is at rest.
        at_rest = {i for r in (first, second) for e in r.events for i in e.rests}
        assert at_rest == {i for e in whole.events for i in e.rests}, part
        # Two predictions of one Zeno point differ by the tolerance over the last gap's remainder.
        np.testing.assert_allclose(
            second.context.continuous_state, whole.context.continuous_state, atol=2e-6
        )


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize("scene", SCENES)
def test_the_flow_at_the_end_of_a_run_is_that_of_its_states(scene, python):
    system = scene()
    whole = run(system, (0.0, system.end), python, "dopri5")
    rest = next(e for e in whole.events if e.kind == "zeno_enter")
    for part in SPLITS:
        context = run(system, (0.0, part * rest.time), python, "dopri5").context
        flow = np.array(system.flow(context))
        flow[list(rest.rests if part >= 1.0 else ())] = 0.0
        assert system.eval_time_derivatives(context).tolist() == flow.tolist(), part


def test_a_hold_of_states_of_another_block_is_refused():
    context = run(WithClock(), (0.0, 3.0), "traced", "dopri5").context
    data = json.loads(context.to_json())
    for states in ([0, 5], [1, 0], [0, 0], [-1, 0]):
        data["continuation"]["firings"][0]["states"] = states
        with pytest.raises(ModelError, match="damaged"):
            saltus.simulate(
                WithClock(), WithClock().context_from_json(json.dumps(data)), (3.0, 4.0)
            )
