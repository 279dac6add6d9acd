"""Queued zero crossings in Python: delays and priorities traced and called, and what waits."""

import itertools
import pickle

import numpy as np
import pytest
import saltus
from saltus import ModelError, SimulationError

TWO = ("traced", "called")


def ramp(**queued):
    """x' = 1 from 0; `late` triggers at x = 1 and sets x to 0."""
    leaf = saltus.LeafSystem(name="ramp")
    leaf.declare_continuous_state([0.0], ode=lambda t, s: [1.0])
    queued = {"direction": "rising", "reset_map": lambda t, s: [0.0], **queued}
    leaf.declare_zero_crossing(
        guard=lambda t, s: s.continuous_state[0] - 1.0, name="late", **queued
    )
    return leaf


def run(leaf, end, **options):
    return saltus.simulate(leaf, leaf.create_context(), (0.0, end), **options)


def kinds(results):
    return [(e.kind, round(e.time, 8)) for e in results.events]


@pytest.mark.parametrize("python", TWO)
@pytest.mark.parametrize(
    "delay",
    [0.5, np.float64(0.5), lambda t, s: 0.5 * s.continuous_state[0]],
    ids=["number", "numpy", "function"],
)
def test_an_execution_follows_its_trigger_by_the_delay(python, delay):
    results = run(ramp(delay=delay), 3.5, python=python)
    both = [("scheduled", 1.0), ("executed", 1.5), ("scheduled", 2.5), ("executed", 3.0)]
    assert kinds(results) == both
    np.testing.assert_allclose(results.events.times("late"), [1.5, 3.0], atol=1e-8)
    first = results.events[0]
    assert first.due == results.events[1].time == results.events[1].due


def test_a_delay_and_a_priority_are_traced_or_say_why_not():
    seen = []

    def called(t, s):
        seen.append(t)
        return 0.25

    leaf = ramp(delay=lambda t, s: 2 * s.continuous_state[0], priority=called)
    explained = str(leaf.explain())
    assert "delay of 'late'" in explained and "priority of 'late'" in explained
    line = next(text for text in explained.splitlines() if "priority of 'late'" in text)
    assert "traced" not in line.split("'late'")[1] or "append" in explained


def both(priority_of_a, priority_of_b, **queued):
    """Two events that trigger at 1 s; each appends its digit to a number."""
    leaf = saltus.LeafSystem(name="leaf")
    leaf.declare_continuous_state([0.0], ode=lambda t, s: [1.0])
    leaf.declare_discrete_state([0.0])
    for digit, priority in enumerate((priority_of_a, priority_of_b), 1):
        leaf.declare_zero_crossing(
            guard=lambda t, s: s.continuous_state[0] - 1.0,
            reset_map=lambda t, s, digit=digit: s.with_discrete_state(
                10.0 * s.discrete_state + digit
            ),
            name=f"e{digit}",
            direction="rising",
            priority=priority,
            **queued,
        )
    return leaf


@pytest.mark.parametrize("python", TWO)
@pytest.mark.parametrize(("a", "b", "order"), [(1, 2, 21.0), (2, 1, 12.0), (1, None, 12.0)])
def test_the_highest_priority_comes_first(python, a, b, order):
    results = run(both(a, b, delay=0.5), 2.0, python=python)
    assert results.context.discrete_state[0] == order


@pytest.mark.parametrize("python", TWO)
def test_a_priority_is_a_function_of_the_present_state(python):
    results = run(both(lambda t, s: t, lambda t, s: 2.0 * t), 2.0, python=python)
    assert results.context.discrete_state[0] == 21.0


def test_ties_are_decided_by_the_seed():
    leaf = both(None, None, delay=0.0)
    orders = [run(leaf, 2.0, event_seed=seed).context.discrete_state[0] for seed in (*range(40), 0)]
    assert set(orders) == {12.0, 21.0} and orders[0] == orders[-1]
    with pytest.raises(ModelError, match="option event_seed: expected a finite number"):
        run(leaf, 2.0, event_seed=float("nan"))


@pytest.mark.parametrize("python", TWO)
@pytest.mark.parametrize("persistent", [True, False])
def test_a_trigger_over_several_comparisons(python, persistent):
    # sin t > 0.5 and cos t < 0: from pi/2 to 5 pi/6, for 1.047 s
    leaf = saltus.LeafSystem(name="leaf")
    leaf.declare_continuous_state(
        [0.0, 1.0], ode=lambda t, s: [s.continuous_state[1], -s.continuous_state[0]]
    )
    leaf.declare_discrete_state([0.0])
    leaf.declare_zero_crossing(
        guard=lambda t, s: (s.continuous_state[0] > 0.5) & ~(s.continuous_state[1] >= 0.0),
        reset_map=lambda t, s: s.with_discrete_state(s.discrete_state + 1.0),
        name="both",
        direction="rising",
        delay=1.5,
        persistent=persistent,
    )
    results = run(leaf, 4.0, rtol=1e-9, atol=1e-11, python=python)
    begin, end = np.pi / 2, 5 * np.pi / 6
    kind, time = ("executed", begin + 1.5) if persistent else ("cancelled", end)
    assert [e.kind for e in results.events] == ["scheduled", kind]
    np.testing.assert_allclose([e.time for e in results.events], [begin, time], atol=1e-7)


@pytest.mark.parametrize("python", TWO)
@pytest.mark.parametrize("early", [True, False])
def test_values_of_the_trigger_time(python, early):
    leaf = ramp(
        delay=0.5,
        reset_map=lambda t, s: [-s.continuous_state[0]],
        use_values_from_trigger_time=early,
    )
    results = run(leaf, 1.5 + 1e-6, python=python)
    after = results.events[1].after[0]
    np.testing.assert_allclose(after, -1.0 if early else -1.5, atol=1e-8)


@pytest.mark.parametrize(("before", "times"), [(True, []), (False, [0.0])])
def test_initial_value(before, times):
    leaf = ramp(initial_value=before, reset_map=lambda t, s: [5.0])
    start = leaf.create_context().with_continuous_state([3.0])
    results = saltus.simulate(leaf, start, (0.0, 1.0))
    assert results.events.times("late").tolist() == times


def through_pickle(leaf, context):
    return pickle.loads(pickle.dumps(context))


def through_json(leaf, context):
    return leaf.context_from_json(context.to_json())


@pytest.mark.parametrize("through", [through_pickle, through_json])
def test_a_saved_context_carries_what_waits(through):
    leaf = ramp(delay=0.75, use_values_from_trigger_time=True)
    whole = run(leaf, 4.0)
    context, events = leaf.create_context(), []
    for begin, end in itertools.pairwise([0.0, 0.5, 1.25, 1.5, 3.0, 4.0]):
        part = saltus.simulate(leaf, context, (begin, end))
        events += kinds(part)
        context = through(leaf, part.context)
    assert events == kinds(whole)
    np.testing.assert_allclose(context.continuous_state, whole.context.continuous_state, atol=1e-8)


def test_contexts_with_other_executions_are_not_equal():
    waits = run(ramp(delay=1.0), 1.5).context
    other = run(ramp(delay=2.0), 1.5).context
    np.testing.assert_array_equal(waits.continuous_state, other.continuous_state)
    assert waits == pickle.loads(pickle.dumps(waits)) and waits != other


def test_saved_results_have_the_kinds(tmp_path):
    results = run(ramp(delay=0.5), 2.0)
    results.save(tmp_path / "run.npz")
    loaded = saltus.load(tmp_path / "run.npz")
    assert [(e.kind, e.due) for e in loaded.events] == [(e.kind, e.due) for e in results.events]
    assert loaded.events.times("late").tolist() == results.events.times("late").tolist()
    assert results.events.times("late", "scheduled").size == 1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"delay": -1.0}, "has a delay of -1 s"),
        ({"delay": "soon"}, "delay of 'late'"),
        ({"delay": 1.0, "terminal": True}, "is queued and terminal"),
        ({"delay": 1.0, "reset_map": None}, "has neither a reset map nor an end_mode"),
        ({"delay": 1.0, "on_zeno": "stop"}, "has no Zeno monitor"),
        ({"persistent": False, "direction": "both"}, "has no firing side"),
        ({"persistent": "no"}, "persistent: expected True, False or None"),
    ],
)
def test_what_is_refused(options, message):
    with pytest.raises((ModelError, TypeError), match=message):
        ramp(**options)


@pytest.mark.parametrize("python", TWO)
def test_a_bad_delay_is_an_error_of_the_run(python):
    leaf = ramp(delay=lambda t, s: -s.continuous_state[0])
    with pytest.raises(SimulationError, match=r"the delay of 'ramp.late' is -1.*expected a finite"):
        run(leaf, 2.0, python=python)


def test_an_exception_of_a_delay_comes_out_as_it_was():
    def broken(t, s):
        raise KeyError("lost")

    with pytest.raises(KeyError, match="lost"):
        run(ramp(delay=broken), 2.0)
