"""A fit goes on where runs fail, have no derivative, or the cost jumps, and says so."""

import signal

import numpy as np
import pytest
import saltus
from fit_scenes import Decay, Throw, heights

T = np.linspace(0.0, 1.0, 11)


class Explosive(saltus.LeafSystem):
    """x' = k x²: x = 1 / (1 - k t), which ends at t = 1 / k."""

    def __init__(self, k=0.1):
        super().__init__(name="pole")
        self.declare_dynamic_parameter("k", k)
        self.declare_continuous_state([1.0], ode=self.ode)
        self.declare_continuous_state_output("x")

    def ode(self, time, state, *, k):
        return k * state.continuous_state**2


def test_steps_into_runs_that_fail_are_shortened():
    """A step from k = 0.7 goes beyond 1, where the run ends before the data do: the linear model of
    the last value, 10 = 3.3 + 11 (k - 0.7), has k = 1.3.
    """
    data = {"time": T, "x": 1 / (1 - 0.9 * T)}
    found = saltus.fit(Explosive(), data, {"k": 0.7})
    assert found.success
    assert found.parameters["k"] == pytest.approx(0.9, rel=1e-6)
    assert found.failures >= 1
    assert "pole" in found.first_failure and found.first_failure in found.warnings[-1]


def test_a_start_that_fails_raises_with_its_run():
    data = {"time": T, "x": 1 / (1 - 0.9 * T)}
    with pytest.raises(saltus.SimulationError, match="fit: the run with the start values failed"):
        saltus.fit(Explosive(), data, {"k": 2.0})
    try:
        saltus.fit(Explosive(), data, {"k": 2.0})
    except saltus.SimulationError as error:
        assert error.time == pytest.approx(0.5, rel=1e-3)
        assert error.results.status == "failed"


def test_of_several_starts_some_may_fail():
    data = {"time": T, "x": 1 / (1 - 0.9 * T)}
    found = saltus.fit(Explosive(), data, {"k": saltus.Free(2.0, -3.0, 5.0)}, starts=8, seed=1)
    assert found.success and found.parameters["k"] == pytest.approx(0.9, rel=1e-6)
    assert found.starts[0].status == "failed" and found.starts[0].cost == np.inf


def test_an_exception_of_a_callback_is_a_failure_of_its_run():
    class Picky(Decay):
        def ode(self, time, state, *, k, **others):
            if k > 3.0:
                raise ValueError("k is too large")
            return [-k * state.continuous_state[0]]

    data = {"time": T, "y": np.exp(-2.9 * T)}
    found = saltus.fit(Picky(), data, {"k": 0.01}, python="called")
    assert found.parameters["k"] == pytest.approx(2.9, rel=1e-5)
    if found.failures:
        assert "ValueError: k is too large" in found.first_failure
    with pytest.raises(saltus.SimulationError, match="k is too large") as caught:
        saltus.fit(Picky(), data, {"k": 3.5}, python="called")
    assert isinstance(caught.value.__cause__, ValueError)


def test_a_run_that_ends_before_the_data_is_a_failure():
    class Short(Decay):
        def __init__(self):
            super().__init__()
            self.declare_zero_crossing(
                lambda time, state, **others: state.continuous_state[0] - 0.5,
                name="half",
                terminal=True,
            )

    with pytest.raises(saltus.SimulationError, match="before the last time of the data, 1 s"):
        saltus.fit(Short(), {"time": T, "y": np.exp(-T)}, {"k": 1.0})


class Tie(saltus.LeafSystem):
    """x' = k and y' = 1, and a guard each for 0.5. For k = 1 they fire together."""

    def __init__(self):
        super().__init__(name="tie")
        self.declare_dynamic_parameter("k", 1.0)
        self.declare_continuous_state([0.0, 0.0], ode=lambda time, state, k: [k, 1.0])
        self.declare_continuous_state_output("state")
        self.declare_zero_crossing(
            lambda time, state, k: state.continuous_state[0] - 0.5,
            lambda time, state, k: state.with_continuous_state(state.continuous_state),
            name="one",
            direction="negative_then_non_negative",
        )
        self.declare_zero_crossing(
            lambda time, state, k: state.continuous_state[1] - 0.5,
            lambda time, state, k: state.with_continuous_state(state.continuous_state),
            name="two",
            direction="negative_then_non_negative",
        )


def test_differences_replace_derivatives_that_a_run_has_not():
    """At the start k = 1 two guards fire together, so the run has no derivative after that; x = k t
    all the same.
    """
    system = Tie()
    check = saltus.simulate(system, (0.0, 1.0), recorded_signals=["state"], sensitivity=["k"])
    assert check.sensitivity_gaps  # what this test is about
    found = saltus.fit(system, {"time": T, "state[0]": 2.0 * T}, ["k"])
    assert found.success
    assert found.parameters["k"] == pytest.approx(2.0, rel=1e-6)
    (said,) = found.warnings
    assert "differences of runs replace missing derivatives" in said and "'k'" in said
    assert "tie." in said and "t = 0.5" in said
    alone = saltus.fit(system, {"time": T, "state[0]": T}, ["k"], max_nfev=1)
    # the steps have the cube root of rtol = 1e-8, and x is linear in k: 1e-8 over 2e-3
    assert alone.jacobian[:, 0] == pytest.approx(T, abs=1e-5)


def test_a_system_without_derivatives_is_fitted_by_differences():
    from saltus.library import TransportDelay

    builder = saltus.DiagramBuilder()
    x, delay = builder.add(Decay(), TransportDelay(0.3, name="late"))
    builder.connect(x.output("y"), delay.input())
    diagram = builder.build()
    late = np.exp(-0.5 * np.maximum(T - 0.3, 0.0))
    found = saltus.fit(diagram, {"time": T, "late.out": late}, {"decay.k": 1.0})
    assert found.success
    # a delay is as exact as the interpolation of its past, some 1e-7 at these tolerances
    assert found.parameters["decay.k"] == pytest.approx(0.5, rel=1e-5)
    (said,) = found.warnings
    assert "differences of runs" in said and "late" in said


def test_a_fit_that_does_not_converge_returns_what_it_has():
    data = {"time": T, "height": heights(T)}
    found = saltus.fit(Throw(), data, {"e": (0.1, 1.0), "g": 2.0}, max_nfev=2)
    assert found.status == "max_nfev" and not found.success
    assert "max_nfev" in found.message
    assert found.runs[0].status == "reached_end"


class Step(saltus.LeafSystem):
    """y = a, and 5 more where a is above 1: the cost of y = 2 jumps up at a = 1."""

    def __init__(self):
        super().__init__(name="step")
        self.declare_dynamic_parameter("a", 0.0)
        self.declare_continuous_state([0.0], ode=lambda time, state, a: [1.0])
        self.declare_output_port(lambda time, state, a: a + 5.0 * (a > 1.0), name="y")


def test_a_fit_that_meets_a_jump_of_its_cost_is_stalled():
    found = saltus.fit(Step(), {"time": [1.0, 2.0], "y": [2.0, 2.0]}, {"a": 0.5})
    assert found.status == "stalled" and not found.success
    assert "the cost jumps" in found.message
    assert found.parameters["a"] == pytest.approx(1.0, abs=1e-5)


def pressing(when):
    """A decay whose derivative presses Ctrl-C at its call number `when`."""

    class Pressing(Decay):
        calls = 0

        def ode(self, time, state, *, k, **others):
            Pressing.calls += 1
            if Pressing.calls == when:
                signal.raise_signal(signal.SIGINT)
            return [-k * state.continuous_state[0]]

    return Pressing()


def calls_of(run):
    """How many calls of a derivative `run` needs, of a system that it gets."""
    system = pressing(-1)
    run(system)
    return type(system).calls


def test_ctrl_c_in_a_run_keeps_the_best_values():
    def run(system):
        data = {"time": T, "y": np.exp(-2.0 * T)}
        return saltus.fit(system, data, {"k": 0.1}, python="called")

    middle = calls_of(run) * 2 // 3
    with pytest.raises(KeyboardInterrupt, match="has the best values") as caught:
        run(pressing(middle))
    found = caught.value.results
    assert isinstance(found, saltus.FitResult)
    assert found.status == "interrupted" and not found.success
    assert abs(found.parameters["k"] - 2.0) < 1.9  # better than the start


def test_ctrl_c_between_runs_keeps_the_best_values(monkeypatch):
    monkeypatch.setattr("saltus.fitting.progress.NOTED", 0.0)

    def press(now):
        if now.evaluations == 3:
            signal.raise_signal(signal.SIGINT)

    data = {"time": T, "height": heights(T)}
    with pytest.raises(KeyboardInterrupt) as caught:
        saltus.fit(Throw(), data, {"e": (0.1, 1.0), "g": 2.0}, progress=press)
    assert caught.value.results.evaluations == 3


def test_the_option_interrupt_ends_a_fit():
    """It is asked after each evaluation too, because a run of a few steps does not ask it."""
    asked = []

    def stop():
        asked.append(1)
        return len(asked) > 2

    data = {"time": T, "y": np.exp(-2.0 * T)}
    found = saltus.fit(Decay(), data, {"k": 0.1}, interrupt=stop)
    assert found.status == "interrupted" and found.evaluations <= 3
    assert "interrupt" in found.message


class Wave(saltus.LeafSystem):
    """x' = cos(w t) w / w: x = sin(w t) / w, whose steps are as many as its periods."""

    def __init__(self, w=3.0):
        super().__init__(name="wave")
        self.declare_dynamic_parameter("w", w)
        self.declare_continuous_state([0.0], ode=self.ode)
        self.declare_continuous_state_output("x")

    def ode(self, time, state, *, w):
        return [np.cos(w * time)]


@pytest.mark.parametrize("python", ["traced", "called"])
def test_a_trial_run_that_is_endless_is_ended(python):
    """The drawn starts are some 1e8 rad/s, of which a run has some 1e9 steps: hours."""
    data = {"time": T, "x": np.sin(3.1 * T) / 3.1}
    free = {"w": saltus.Free(3.0, 1.0, 1e9)}
    found = saltus.fit(Wave(), data, free, starts=3, seed=1, python=python)
    assert found.success and found.parameters["w"] == pytest.approx(3.1, rel=1e-6)
    assert [start.status for start in found.starts] == ["converged", "failed", "failed"]
    assert "the run was ended after 1616 steps" in found.first_failure


def test_the_bound_counts_from_the_first_run():
    from saltus.fitting.step_bound import FACTOR, LEAST, POLL, StepBound

    bound = StepBound(None)
    assert not any(bound() for _ in range(10 * LEAST))  # the first run has none
    bound.begin()
    for _ in range(50):
        assert not bound()
    bound.well()
    bound.begin()
    calls = [bound() for _ in range(50 * FACTOR + 1)]
    assert calls[-1] and not any(calls[:-1]) and bound.reached
    assert str(POLL * len(calls)) in bound.message
    bound.begin()
    assert not bound() and not bound.reached
    short = StepBound(None)
    short.well()
    assert not any(short() for _ in range(LEAST // POLL))
    assert short()


def test_the_interrupt_of_the_user_is_asked_too():
    from saltus.fitting.step_bound import StepBound

    bound = StepBound(lambda: True)
    assert bound() and not bound.reached
