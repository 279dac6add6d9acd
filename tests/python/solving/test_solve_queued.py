"""Guards of `solve` with a delay, a priority and the like."""

import numpy as np
import pytest
import saltus


def ramp(t, x):
    return [1.0]


def log(run):
    return [(e.name, e.kind, round(e.time, 9)) for e in run.events]


def late(**options):
    return saltus.Guard(lambda t, x: x[0] - 1, lambda t, x: [0.0], "rising", "late", **options)


@pytest.mark.parametrize("delay", [0.5, lambda t, x: 0.5 * x[0], lambda t, x: np.array(t / 2)])
def test_an_effect_comes_later(delay):
    run = saltus.solve(ramp, (0, 2), [0.0], events=late(delay=delay))
    assert log(run) == [("late", "scheduled", 1.0), ("late", "executed", 1.5)]
    assert run.y[0, -1] == pytest.approx(0.5, abs=1e-9)
    assert run.t_events[0] == pytest.approx([1.5])  # when it has its effect
    assert run.y_events[0] == pytest.approx(np.array([[1.5]]))


def test_a_delay_gets_args_and_parameters():
    guard = saltus.Guard(lambda t, x, d: x[0] - 1, lambda t, x, d: [0.0], "rising", "late",
                         delay=lambda t, x, d: d)  # fmt: skip
    with_args = saltus.solve(lambda t, x, d: [1.0], (0, 2), [0.0], args=(0.5,), events=guard)
    named = saltus.solve(ramp, (0, 2), [0.0], parameters={"d": 0.5},
                         events=late(delay=lambda t, x, *, d: d))  # fmt: skip
    for run in (with_args, named):
        assert log(run)[-1] == ("late", "executed", 1.5)


def test_a_run_backward_has_the_delay_along_the_run():
    guard = saltus.Guard(lambda t, x: x[0] - 1, lambda t, x: [9.0], "falling", "late", delay=0.5)
    run = saltus.solve(ramp, (2, 0), [2.0], events=guard)
    assert run.y[0, -1] == pytest.approx(8.5, abs=1e-9)


def test_priorities_order_effects():
    def one(name, priority, reset):
        return saltus.Guard(lambda t, x: t - 1, reset, "rising", name, priority=priority)

    events = [
        one("low", 1, lambda t, x: 10 * x),
        one("high", lambda t, x: x[0], lambda t, x: x + 1),
    ]
    run = saltus.solve(lambda t, x: [0.0], (0, 2), [2.0], events=events)
    assert run.y[0, -1] == 30.0


@pytest.mark.parametrize(("persistent", "kind"), [(True, "executed"), (False, "cancelled")])
def test_a_guard_that_goes_back_cancels(persistent, kind):
    guard = saltus.Guard(lambda t, x: np.sin(2 * np.pi * x[0]), lambda t, x: x + 0.0, "rising",
                         "up", delay=0.7, persistent=persistent)  # fmt: skip
    run = saltus.solve(ramp, (0, 1.25), [-0.5], events=guard, max_step=0.1)
    assert kind in [row[1] for row in log(run)]


@pytest.mark.parametrize("early", [True, False])
def test_values_of_the_trigger(early):
    guard = saltus.Guard(lambda t, x: x[0] - 1, lambda t, x: [x[0], 10 * x[0]], "rising",
                         delay=0.5, use_values_from_trigger_time=early)  # fmt: skip
    run = saltus.solve(lambda t, x: [1.0, 0.0], (0, 2), [0.0, 0.0], events=guard)
    assert run.y[:, -1] == pytest.approx([2.0, 10.0 if early else 15.0], abs=1e-8)


def test_initial_value():
    counts = [
        len(saltus.solve(ramp, (0, 1), [2.0], events=late(initial_value=before)).events)
        for before in (True, False)
    ]
    assert counts[0] == 0 and counts[1] > 0


def test_another_delay_is_another_system():
    """Of calls that differ in it alone no system is kept for the other."""
    ends = [saltus.solve(ramp, (0, 2), [0.0], events=late(delay=d)).y[0, -1] for d in (0.25, 0.5)]
    assert ends == pytest.approx([0.75, 0.5], abs=1e-9)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (dict(delay="1"), "Guard: delay: expected a number or a function"),
        (dict(priority=True), "Guard: priority: expected a number or a function"),
        (dict(delay=-1.0), "delay"),
        (dict(persistent="no"), "persistent"),
    ],
)
def test_a_mistake_is_named(options, words):
    with pytest.raises(saltus.ModelError, match=words):
        saltus.solve(ramp, (0, 2), [0.0], events=late(**options))
