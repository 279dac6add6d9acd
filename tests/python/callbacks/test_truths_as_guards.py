"""A guard that returns a truth: comparisons have smooth differences, other truths jump."""

import numpy as np
import pytest
import saltus
from saltus import Guard, solve
from saltus.library import Sine

LEVEL = 0.25
FINE = {"rtol": 1e-10, "atol": 1e-12}  # some 100 steps: times are right to 1e-8

COMPARISONS = {
    ">": (lambda t, x: x[0] > LEVEL, "falling"),
    ">=": (lambda t, x: x[0] >= LEVEL, "falling"),
    "<": (lambda t, x: x[0] < LEVEL, "rising"),
    "<=": (lambda t, x: x[0] <= LEVEL, "rising"),
    "sides exchanged": (lambda t, x: LEVEL >= x[0], "rising"),
    "np.greater": (lambda t, x: np.greater(x[0], LEVEL), "falling"),
    "not": (lambda t, x: np.logical_not(x[0] > LEVEL), "rising"),
    "of a vector": (lambda t, x: x[:1] > LEVEL, "falling"),
    "np.logical_and": (lambda t, x: np.logical_and(x[0] > LEVEL, x[0] < 10.0), "falling"),
    "|": (lambda t, x: (x[0] < LEVEL) | (x[0] > 10.0), "rising"),
    "not or": (lambda t, x: ~((x[0] <= LEVEL) | (t < -1.0)), "falling"),
    "where": (lambda t, x: np.where(x[0] > LEVEL, x[0] < 10.0, t < -1.0), "falling"),
    "beside NaN": (lambda t, x: (x[0] < LEVEL) | (np.sqrt(x[0] - 0.5) < -1.0), "rising"),
}
CALLED = {
    "and": lambda t, x: x[0] > LEVEL and x[0] < 10.0,
    "or": lambda t, x: x[0] > LEVEL or x[0] < -10.0,
    "not": lambda t, x: not x[0] <= LEVEL,
    "equal": lambda t, x: (np.floor(2.0 * x[0]) == 5.0) | (x[0] > LEVEL),
}
RETURNED = {
    "bool": bool,
    "np.bool_": np.bool_,
    "array of no dimension": lambda truth: np.array(bool(truth)),
    "array": lambda truth: np.array([bool(truth)]),
    "list": lambda truth: [bool(truth)],
    "tuple of np.bool_": lambda truth: (np.bool_(truth),),
}


class Decay(saltus.LeafSystem):
    """dx/dt = -x from 1."""

    def __init__(self, guard, **options):
        super().__init__(name="decay")
        self.declare_continuous_state([1.0], ode=lambda t, s: -s.continuous_state)
        self.declare_zero_crossing(
            lambda t, s: guard(t, s.continuous_state), name="level", **options
        )


def run(system, **options):
    return saltus.simulate(system, system.create_context(), (0.0, 3.0), **FINE, **options)


def runs(system, of="guard of 'level'"):
    return next(c for c in system.explain() if c.callback == of)


@pytest.mark.parametrize("name", COMPARISONS)
@pytest.mark.parametrize("opposite", [False, True])
def test_a_comparison_is_traced_to_its_smooth_difference(name, opposite):
    """True is the positive side: it falls where the comparison becomes false."""
    guard, direction = COMPARISONS[name]
    if opposite:
        direction = {"falling": "rising", "rising": "falling"}[direction]
    system = Decay(guard, direction=direction)
    assert runs(system).runs == "traced"
    events = run(system).events
    assert len(events) == (0 if opposite else 1)
    for event in events:
        assert event.time == pytest.approx(np.log(1.0 / LEVEL), rel=1e-8)


@pytest.mark.parametrize("name", COMPARISONS)
def test_so_it_is_in_solve(name):
    guard, direction = COMPARISONS[name]
    solution = solve(
        lambda t, x: -x, (0, 3), [1.0], events=Guard(guard, direction=direction), **FINE
    )
    assert [c.runs for c in solution.system.explain()] == ["traced"] * 2
    assert solution.t_events[0] == pytest.approx([np.log(1.0 / LEVEL)], rel=1e-8)


@pytest.mark.parametrize("name", CALLED)
def test_any_other_truth_is_called(name):
    assert runs(Decay(CALLED[name])).runs == "called"


def test_the_reason_says_that_it_jumps():
    assert "not made of comparisons" in runs(Decay(CALLED["equal"])).reason


@pytest.mark.parametrize(
    ("truth", "count"),
    [
        (lambda u: u > 0.3, 16),
        (lambda u: (u > 0.3) & (u < 0.8), 32),
        (lambda u: (u > 0.3) | (u < -0.3), 32),
        (lambda u: np.logical_not(u <= 0.3), 16),
        (lambda u: np.where(u > 0.0, u > 0.3, u < -0.3), 32),
    ],
)
def test_truths_of_a_fast_signal_where_nothing_shortens_the_steps(truth, count):
    """Until t = 100 sin t has 15.9 periods: 16 times it rises through 0.3, and the band is entered
    twice in each. The scene has no state, so the looks follow the guard alone."""
    block = saltus.LeafSystem(name="b")
    block.declare_input_port("u", shape=())
    block.declare_discrete_state(0.0)
    for mode in (False, True):  # the held part of a truth
        block.declare_zero_crossing(
            lambda t, s, u, mode=mode: np.logical_and(s.mode == 0, truth(u)) if mode else truth(u),
            lambda t, s, u: s.with_discrete_state(s.discrete_state + 1.0),
            name=f"truth {mode}",
            direction="rising",
        )
    builder = saltus.DiagramBuilder()
    block, wave = builder.add(block, Sine())
    builder.connect(wave.output(), block.input())
    results = saltus.simulate(builder.build(), (0.0, 100.0))
    assert results.context[block].discrete_state == 2.0 * count


@pytest.mark.parametrize("form", RETURNED)
@pytest.mark.parametrize("direction", ["falling", "rising", "both"])
def test_a_called_truth_is_one_or_minus_one(form, direction):
    """It would never change its sign as 1 or 0; it is located where it jumps."""
    made = RETURNED[form]
    system = Decay(lambda t, x: made(x[0] > LEVEL), direction=direction, size=1)
    events = run(system, python="called").events
    assert len(events) == (0 if direction == "rising" else 1)
    for event in events:
        assert event.time == pytest.approx(np.log(1.0 / LEVEL), rel=1e-8)


def test_several_truths_in_one_guard():
    levels = np.array([0.5, 0.25])
    found = []
    for python in ("traced", "called"):
        system = Decay(lambda t, x: x[0] > levels, size=2)
        found.append([event.time for event in run(system, python=python).events])
    assert found[0] == pytest.approx(np.log(1.0 / levels), rel=1e-8)
    assert found[1] == pytest.approx(found[0], rel=1e-8)


def test_a_relation_by_a_truth():
    for python in ("traced", "called"):
        block = saltus.LeafSystem(name="b")
        block.declare_continuous_state([1.0], ode=lambda t, s: -s.continuous_state)
        block.declare_relation(lambda t, s: s.continuous_state[0] > LEVEL, name="high")
        block.declare_output_port(lambda t, s: 1.0 if s.relations[0] else 0.0, name="y")
        results = saltus.simulate(
            block, block.create_context(), (0.0, 3.0), python=python,
            recorded_signals={"y": block.output()},
        )  # fmt: skip
        y = results.outputs["y"]
        assert (y[0], y[-1]) == (1.0, 0.0)


# A ball that falls from 5 m, g = 10 m/s^2, each impact keeps 0.8 of the speed; or its mirror image
# below a ceiling. Impacts at 1 s, and after flights of 2 * 0.8^k s.
IMPACTS = np.cumsum([1.0, 1.6, 1.28, 1.024, 0.8192])
BOUNCES = {
    "above the floor": (1.0, lambda x: x > 0.0, "falling"),
    "below the floor": (1.0, lambda x: x < 0.0, "rising"),
    "in both directions": (1.0, lambda x: x >= 0.0, "both"),
    "below the ceiling": (-1.0, lambda x: x < 0.0, "falling"),
    "above the ceiling": (-1.0, lambda x: x > 0.0, "rising"),
    "any change, above the floor": (1.0, lambda x: x > 0.0, "edge_detection"),
    "any change, below the floor": (1.0, lambda x: x <= 0.0, "edge_detection"),
    "any change, of two comparisons": (1.0, lambda x: (x > 0.0) & (x < 9.0), "edge_detection"),
}


def bounced(up, x):
    return [up * abs(x[0]), -0.8 * x[1]]


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize("name", BOUNCES)
@pytest.mark.parametrize("method", ["auto", "dopri5", "dop853", "adams", "bdf", "radau"])
def test_a_ball_bounces_on_a_truth(name, method, python):
    up, truth, direction = BOUNCES[name]
    ball = saltus.LeafSystem(name="ball")
    ball.declare_continuous_state(
        [5.0 * up, 0.0], ode=lambda t, s: [s.continuous_state[1], -10.0 * up]
    )
    ball.declare_zero_crossing(
        lambda t, s: truth(s.continuous_state[0]),
        lambda t, s: s.with_continuous_state(bounced(up, s.continuous_state)),
        name="bounce",
        direction=direction,
    )
    found = saltus.simulate(ball, (0.0, 6.0), ode_solver_method=method, python=python, **FINE)
    # A flight errs by its tolerance in each of some tens of steps, divided by the speed of the
    # impact, above 3.
    assert found.events.times("bounce") == pytest.approx(IMPACTS, abs=1e-7)
    assert up * found.context.continuous_state[0] >= 0.0


@pytest.mark.parametrize("name", BOUNCES)
def test_so_it_does_in_solve(name):
    up, truth, direction = BOUNCES[name]
    bounce = Guard(lambda t, x: truth(x[0]), lambda t, x: bounced(up, x), direction)
    found = solve(lambda t, x: [x[1], -10.0 * up], (0, 6), [5.0 * up, 0.0], events=bounce, **FINE)
    assert found.t_events[0] == pytest.approx(IMPACTS, abs=1e-7)
