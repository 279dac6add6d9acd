"""Fits of exact data find the parameters of the closed forms."""

import numpy as np
import pytest
import saltus
from fit_scenes import Decay, Throw, heights, impacts

METHODS = ("auto", "dopri5", "dop853", "radau", "bdf", "taylor")


@pytest.mark.parametrize("method", METHODS)
def test_the_twin_of_a_ball(method):
    """g = 9.8 and e = 0.8 from the exact heights of a fall from 1 m, seen for 1 s.

    The error of a run is near rtol = 1e-10, and grows by the factor of order 1 of one bounce; bdf
    sums the errors of some hundred steps.
    """
    t = np.linspace(0.05, 1.0, 20)
    data = {"time": t, "height": heights(t, 9.8, 0.8)}
    options = {"ode_solver_method": method, "rtol": 1e-11, "atol": 1e-12}
    found = saltus.fit(Throw(), data, {"g": 9.0, "e": (0.5, 1.0)}, **options)
    assert found.success
    assert found.parameters == pytest.approx({"g": 9.8, "e": 0.8}, rel=1e-8)
    assert found.failures == 0 and found.warnings == ()


def test_a_ball_that_is_to_be_as_high_as_it_can_at_one_time():
    """A documented fit of SciML: 50 m, g = 9.8, 20 m wanted at 15 s. The ball cannot be that high
    there, so the fit ends where the height has its largest value over e: dy/de = 0.

    With 20 - y of order 0.6 and ftol = 1e-14, cost - least cost is below 1e-14, so e is off by the
    root of that over y'' (20 - y), y'' of order 1e4: 1e-7 / 77, taken ten times.
    """
    ball = Throw(9.8, 0.8, 50.0)
    data = {"time": [15.0], "height": [20.0]}
    found = saltus.fit(ball, data, {"e": saltus.Free(0.8, 0.1, 1.0)}, ftol=1e-14, xtol=1e-14)
    assert found.success
    (e,) = found.values
    d = 1e-4
    left, top, right = (heights([15.0], 9.8, e + shift, 50.0)[0] for shift in (-d, 0.0, d))
    vertex = d / 2 * (left - right) / (left - 2 * top + right)
    # the parabola through three points 1e-4 apart has its vertex right to their distance squared
    assert abs(vertex) < 1e-6
    assert e == pytest.approx(0.8665541, abs=2e-6)


def test_event_times_are_data():
    times = impacts(6, 9.81, 0.9, 10.0)
    ball = Throw(9.0, 0.8, 10.0)
    data = {"bounce": saltus.EventTimes(times)}
    found = saltus.fit(ball, data, {"g": (5.0, 15.0), "e": (0.5, 1.0)}, rtol=1e-11, atol=1e-12)
    assert found.success
    assert found.parameters == pytest.approx({"g": 9.81, "e": 0.9}, rel=1e-8)
    # dt6/de of the reference, for these values
    assert found.jacobian[5, 1] == pytest.approx(32.630498888252205, rel=1e-7)


def test_the_zeno_time_is_data():
    """t1 (1 + e) / (1 - e) = 27.129... at e = 0.9. The fit moves e, from 0.85 on, in the run."""
    zeno = saltus.EventTimes([27.12901933561423], kind="zeno_enter")
    ball = Throw(9.81, 0.85, 10.0)
    found = saltus.fit(ball, {"bounce": zeno}, {"e": (0.5, 0.99)}, rtol=1e-12, atol=1e-14)
    assert found.success
    # dt/de = 286 s, and the prediction is right to some 1e-7 s
    assert found.parameters["e"] == pytest.approx(0.9, abs=1e-8)
    assert found.jacobian[0, 0] == pytest.approx(285.56862458541303, rel=1e-5)


def test_an_event_that_the_run_does_not_have_is_at_its_end():
    """Three impacts are seen, and the run ends after the second."""
    times = impacts(3)
    end = (times[1] + times[2]) / 2
    data = {"bounce": saltus.EventTimes([*times[:2], end - 0.01])}
    found = saltus.fit(Throw(), data, {"e": (0.7, 0.9)}, t_span=(0.0, end), max_nfev=1)
    assert found.compared[0].model == pytest.approx([times[0], times[1], end], rel=1e-9)
    assert found.jacobian[2, 0] == 0.0


def test_events_after_a_zeno_point_are_at_that_point():
    """At e = 0.01 the ball rests after few impacts; the tenth of the data is at the Zeno time."""
    ball = Throw(9.81, 0.01)
    data = {"bounce": saltus.EventTimes(impacts(10, e=0.5))}
    found = saltus.fit(ball, data, {"e": saltus.Free(0.01, 0.0, 1.0)}, max_nfev=1)
    (first,) = impacts(1)
    assert found.compared[0].model[9] == pytest.approx(first * 1.01 / 0.99, abs=1e-6)
    assert found.jacobian[9, 0] == pytest.approx(2 * first / 0.99**2, rel=1e-4)


def test_a_parameter_by_its_logarithm():
    t = np.linspace(0.0, 2.0, 9)
    data = {"time": t, "y": np.exp(-1e-3 * t)}
    begin = {"k": saltus.Free(10.0, log=True)}
    found = saltus.fit(Decay(), data, begin, rtol=1e-12, atol=1e-14)
    assert found.success
    # y - 1 is 1e-3 t, known to 1e-12: nine digits less three
    assert found.parameters["k"] == pytest.approx(1e-3, rel=1e-6)
    assert all(low > 0.0 for low, _ in found.confidence(0.999).values())


def test_a_start_value_beside_a_parameter():
    t = np.linspace(0.0, 1.0, 11)
    data = {"time": t, "y": 3.0 * np.exp(-0.7 * t)}
    found = saltus.fit(Decay(), data, ["k", "x[0]"])
    assert found.parameters == pytest.approx({"k": 0.7, "x[0]": 3.0}, rel=1e-7)
    assert found.runs[0]["y"][0] == pytest.approx(3.0, rel=1e-7)
    assert found.contexts[0].continuous_state == pytest.approx([3.0], rel=1e-7)


def test_several_runs_share_parameters_and_have_their_own():
    """Two drops from heights that are known and not known; e and g are the same."""
    t = np.linspace(0.05, 1.2, 24)
    known = saltus.Experiment({"time": t, "height": heights(t, 9.81, 0.7, 2.0)},
                              values={"x[0]": 2.0})  # fmt: skip
    guessed = saltus.Experiment(
        {"bounce": saltus.EventTimes(impacts(3, 9.81, 0.7, 1.5))},
        free={"height": (0.5, 3.0)},
        name="low",
    )
    found = saltus.fit(Throw(), [known, guessed], {"e": (0.1, 1.0), "g": 9.0})
    assert found.success
    expected = {"e": 0.7, "g": 9.81, "low: height": 1.5}
    assert found.parameters == pytest.approx(expected, rel=1e-6)
    assert [each.experiment for each in found.compared] == ["run 1", "low"]
    assert np.all(found.jacobian[:24, 2] == 0.0)  # the height of one run moves no other


def test_an_experiment_has_a_context_and_a_time_of_its_own():
    t = np.linspace(2.0, 3.0, 11)
    system = Decay()
    late = system.create_context(time=2.0).with_continuous_state(5.0)
    data = saltus.Experiment({"time": t, "y": 5.0 * np.exp(-0.5 * (t - 2.0))}, context=late)
    found = saltus.fit(system, data, {"k": 1.0})
    assert found.parameters["k"] == pytest.approx(0.5, rel=1e-7)
    assert found.runs[0].time[0] == 2.0


def test_several_starts_leave_a_local_minimum():
    """A frequency from samples of a sine has a local minimum near each side lobe."""

    class Swing(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="swing")
            self.declare_dynamic_parameter("w", 1.0)
            self.declare_continuous_state([0.0, 1.0], ode=self.ode, names=["x1", "v"])

        def ode(self, time, state, *, w):
            x, v = state.continuous_state
            return [w * v, -w * x]

    t = np.linspace(0.0, 10.0, 51)
    data = {"time": t, "x1": np.sin(4.0 * t)}
    begin = {"w": saltus.Free(2.5, 1.0, 8.0)}
    single = saltus.fit(Swing(), data, begin)
    assert abs(single.parameters["w"] - 4.0) > 0.5 and single.cost > 1.0
    several = saltus.fit(Swing(), data, begin, starts=40, seed=3)
    assert several.parameters["w"] == pytest.approx(4.0, rel=1e-6)
    assert several.success and len(several.starts) == 40
    assert several.starts[0].parameters == single.starts[0].parameters
    again = saltus.fit(Swing(), data, begin, starts=40, seed=3)
    assert [s.start for s in again.starts] == [s.start for s in several.starts]


def test_the_value_at_a_data_time_that_is_an_event_is_the_one_after_it():
    """With e = 0.5 the velocity after the impact is half of that before it."""
    (hit,) = impacts(1)
    after = 0.5 * np.sqrt(2 * 9.81)
    ball = Throw(9.81, 0.5)
    located = saltus.simulate(ball, (0.0, 1.0), rtol=1e-8, atol=1e-10).events.times("bounce")[0]
    assert located == pytest.approx(hit, rel=1e-9)
    found = saltus.fit(
        ball,
        {"time": [float(located)], "velocity": [after]},
        {"e": (0.1, 0.9)},
        t_span=(0.0, 1.0),
        max_nfev=1,
    )
    assert found.compared[0].model[0] == pytest.approx(after, rel=1e-6)


def test_units_do_not_matter():
    """The data in units of 1e-9, and a start value of 1e6 beside a rate of 1e-3."""
    t = np.linspace(0.0, 1000.0, 11)
    for unit in (1e-9, 1.0, 1e6):
        data = {"time": t, "y": 3.0 * unit * np.exp(-0.002 * t)}
        begin = {"k": 0.001, "x[0]": unit}
        found = saltus.fit(Decay(), data, begin, rtol=1e-10, atol=1e-12 * unit)
        assert found.success
        assert found.parameters == pytest.approx({"k": 0.002, "x[0]": 3.0 * unit}, rel=1e-7)
