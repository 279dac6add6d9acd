"""A fit where the cost does not change with the parameters: it ends there, and says why."""

import math

import numpy as np
import pytest
import saltus
from fit_scenes import Decay, Throw, impacts

FALL = math.sqrt(2 * 10.0 / 9.81)


def stone(g):
    """A stone that falls from 10 m; where it hits the ground, the run ends."""
    system = saltus.LeafSystem(name="stone")
    system.declare_dynamic_parameter("g", g)
    system.declare_continuous_state([10.0, 0.0], ode=lambda t, s, g: [s.continuous_state[1], -g])
    system.declare_zero_crossing(
        lambda t, s, g: s.continuous_state[0], name="hit", direction="falling", terminal=True
    )
    return system


@pytest.mark.parametrize("span", [(0.0, 1.45), None])
def test_a_terminal_event_beyond_the_end_of_the_run(span):
    """At g = 9 the stone falls for 1.49 s, at g = 2 for 3.16 s: longer than the run, which by
    default takes twice the measured 1.43 s.
    """
    g, end = (9.0, 1.45) if span else (2.0, 2 * FALL)
    data = {"hit": saltus.EventTimes([FALL])}
    found = saltus.fit(stone(g), data, {"g": g}, t_span=span)
    assert found.status == "stalled" and not found.success
    assert found.parameters["g"] == g and np.isinf(found.standard_errors["g"])
    assert found.evaluations == 1 and found.failures == 0
    assert found.cost == pytest.approx((end - FALL) ** 2 / 2)
    assert "no residual depends on a parameter" in found.message
    words = f"the run has 0 of the 1 events 'hit' before its end at t = {end:g} s"
    assert words in found.warnings[0] and "make t_span longer" in found.warnings[0]


def test_with_a_longer_run_it_is_found():
    data = {"hit": saltus.EventTimes([FALL])}
    found = saltus.fit(stone(9.0), data, {"g": 9.0}, t_span=(0.0, 3.0))
    assert found.success and found.parameters["g"] == pytest.approx(9.81, rel=1e-6)
    assert not any("before its end" in said for said in found.warnings)


@pytest.mark.parametrize("loss", ["linear", "soft_l1"])
def test_a_step_onto_the_plateau_of_missing_events_is_not_taken(loss):
    """From g = 20 (1 s) the first step overshoots to falls that the run does not see."""
    data = {"hit": saltus.EventTimes([FALL])}
    found = saltus.fit(stone(20.0), data, {"g": (0.1, 30.0)}, t_span=(0.0, 1.45), loss=loss)
    assert found.success and found.parameters["g"] == pytest.approx(9.81, rel=1e-6)


def test_of_several_runs_the_one_that_lacks_an_event_is_named():
    seen = saltus.EventTimes(impacts(3))
    runs = [
        saltus.Experiment({"bounce": seen}, name="long"),
        saltus.Experiment({"bounce": seen}, t_span=(0.0, impacts(3)[2] + 0.01), name="short"),
    ]
    # two of three impacts at e = 0.9, and the fit begins and ends there
    found = saltus.fit(Throw(e=0.9), runs, {"e": 0.9}, max_nfev=1)
    assert found.warnings[0].startswith("short: the run has 2 of the 3 events 'bounce'")
    assert not any(said.startswith("long:") for said in found.warnings)


def test_impacts_that_accumulate_are_not_missing():
    data = {"bounce": saltus.EventTimes(impacts(10, e=0.5))}
    found = saltus.fit(Throw(9.81, 0.01), data, {"e": saltus.Free(0.01, 0.0, 1.0)}, max_nfev=1)
    assert not any("before its end" in said for said in found.warnings)


@pytest.mark.parametrize("loss", ["linear", "soft_l1"])
def test_only_parameters_without_effect(loss):
    t = np.linspace(0.0, 2.0, 11)
    found = saltus.fit(Decay(), {"time": t, "y": np.exp(-0.5 * t)}, ["c"], loss=loss)
    assert found.status == "stalled" and found.failures == 0
    assert "the data do not determine 'c'" in found.warnings[0]
    misfit = np.exp(-t) - np.exp(-0.5 * t)
    rho = misfit**2 if loss == "linear" else 2 * (np.sqrt(1 + misfit**2) - 1)
    assert found.cost == pytest.approx(rho.sum() / 2, rel=1e-6)


def test_a_start_without_residuals_has_converged():
    """The data are those of the run, to the bit; `a` matters, and `c` does not."""
    t = np.linspace(0.0, 2.0, 11)
    run = saltus.simulate(
        Decay(), (0.0, 2.0), rtol=1e-8, atol=1e-10, save_at=t, recorded_signals=["y"],
        event_rows=False, save_steps=False,
    )  # fmt: skip
    found = saltus.fit(Decay(), {"time": t, "y": run["y"]}, ["a", "c"])
    assert found.success and found.failures == 0
    assert found.parameters == {"a": 1.0, "c": 1.0}


def test_a_robust_fit_that_begins_at_the_mean_goes_on():
    """The sum of the residuals is zero to the bit, and the sum weighted by the loss is not."""
    system = saltus.LeafSystem(name="rest")
    system.declare_continuous_state([1.0], ode=lambda t, s: [0.0], names=["y"])
    data = {"time": [1.0, 2.0, 3.0], "y": [3.0, 0.0, 0.0]}
    found = saltus.fit(system, data, {"y": 1.0}, loss="soft_l1")
    x = found.parameters["y"]
    slopes = [(x - y) / np.sqrt(1 + (x - y) ** 2) for y in data["y"]]
    # ftol = 1e-8 ends where a step lowers the cost of 1.9 by less than 2e-8; at a curvature of at
    # most 3 the gradient there is below sqrt(2 * 3 * 2e-8) = 3.5e-4. At the mean it is 0.52.
    assert found.success and abs(sum(slopes)) < 3.5e-4
