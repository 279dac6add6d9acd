"""What a fit refuses, before any run and with what to do."""

import sys

import numpy as np
import pytest
import saltus
from fit_scenes import Decay, Throw

T = [0.1, 0.2, 0.3]
Y = [1.0, 0.9, 0.8]
GOOD = {"time": T, "height": Y}
E = {"e": (0.1, 1.0)}
EXPECTED_DATA = "expected a dict with 'time' and signals"

PARAMETERS = {
    "unknown": ({"f": 1.0}, "unknown parameter or state 'f'.*Known: 'g', 'e'"),
    "near": ({"heigth": 1.0}, "unknown parameter or state 'heigth'; did you mean 'height'"),
    "a mode": ({"mode": 1.0}, "'mode' is a mode, an integer"),
    "a vector": ({"x": 1.0}, r"'x' has 2 entries; name each, such as 'x\[0\]'"),
    "twice": ({"x[0]": 1.0, "height": 1.0}, r"'x\[0\]' and 'height' are one value"),
    "in a list": (["e", "e"], "named twice"),
    "none": ({}, "expected at least one, found none"),
    "not finite": ({"e": np.inf}, "'e': expected a finite start value, found inf"),
    "nan": ({"e": np.nan}, "'e': start: expected a number, found nan"),
    "text": ({"e": "fast"}, "'e': start: expected a number, found 'fast'"),
    "three": ({"e": (0, 1, 2)}, r"'e': expected \(lower, upper\), found \(0, 1, 2\)"),
    "bounds": ({"e": (1.0, 0.1)}, "'e': expected a lower bound below the upper bound"),
    "no start": ({"e": (1.0, np.inf)}, "'e': the value 0.8 of the context is no start"),
    "a number": (3, "parameters: expected a dict of names"),
}


@pytest.mark.parametrize("case", PARAMETERS)
def test_parameters(case):
    parameters, message = PARAMETERS[case]
    with pytest.raises(saltus.ModelError, match=message):
        saltus.fit(Throw(), GOOD, parameters)


def test_starts_outside_of_their_bounds():
    for make in (lambda: saltus.Free(2.0, 0.1, 1.0), lambda: saltus.Free(0.0, 0.1, 1.0)):
        with pytest.raises(saltus.ModelError, match=r"outside of the bounds 0.1 to 1"):
            make()
    with pytest.raises(saltus.ModelError, match="log=True needs a start value above 0"):
        saltus.Free(-1.0, log=True)
    with pytest.raises(saltus.ModelError, match="log=True needs an upper bound above 0"):
        saltus.Free(None, -2.0, -1.0, log=True)


def test_an_attribute_is_no_parameter():
    with pytest.raises(saltus.ModelError, match=r"'fixed' is an attribute of 'decay'.*declare_dyn"):
        saltus.fit(Decay(), {"time": T, "y": Y}, {"fixed": 1.0})


DATA = {
    "no time": ({"height": Y}, f"the data have no 'time'; {EXPECTED_DATA}"),
    "no signal": ({"time": T}, "no signal and no event"),
    "none": ([], "at least one data set"),
    "a list of numbers": ([1.0, 2.0], f"{EXPECTED_DATA}.*found 1.0"),
    "unknown": ({"time": T, "hight": Y}, "unknown signal 'hight'; did you mean 'height'"),
    "length": (
        {"time": T, "height": Y[:2]},
        "'height': expected a value, a vector or a matrix for each of 3",
    ),
    "text": ({"time": T, "height": ["a", "b", "c"]}, "'height': expected numbers"),
    "infinite": ({"time": T, "height": [1, np.inf, 1]}, "'height' is infinite at t = 0.2 s"),
    "nan in time": (
        {"time": [0.1, np.nan, 0.3], "height": Y},
        "'time': expected a list of finite times .s., found nan in row 1; leave the row out",
    ),
    "width": ({"time": T, "state": Y}, "'state': expected 2 numbers for each time, found 1"),
    "entry": ({"time": T, "state[2]": Y}, r"'state\[2\]': the signal has 2 entries"),
    "before": ({"time": [-0.1, 0.2, 0.3], "height": Y}, "t = -0.1 s is outside of the run"),
    "event": ({"bonce": saltus.EventTimes([1.0])}, "no event is called 'bonce'; did you mean"),
    "kind": ({"bounce": saltus.EventTimes([1.0], kind="bump")}, "unknown kind of event 'bump'"),
    "early event": ({"bounce": saltus.EventTimes([-1.0, 1.0])}, "t = -1 s is outside of the run"),
    "all missing": ({"time": T, "height": [np.nan] * 3}, "found 0, without 3 that are nan"),
}


@pytest.mark.parametrize("case", DATA)
def test_data(case):
    data, message = DATA[case]
    with pytest.raises(saltus.ModelError, match=message):
        saltus.fit(Throw(), data, E)


def test_data_after_the_end_of_the_run():
    with pytest.raises(
        saltus.ModelError, match=r"t = 0.3 s is outside of the run, which goes from"
    ):
        saltus.fit(Throw(), GOOD, E, t_span=(0.0, 0.25))


def test_event_times_that_go_back():
    with pytest.raises(saltus.ModelError, match="increasing times; sort them"):
        saltus.EventTimes([2.0, 1.0])
    with pytest.raises(saltus.ModelError, match="write nan for a missing value"):
        saltus.EventTimes([np.inf])
    for sigma in (0.0, -1.0, np.nan, [0.1, 0.0]):
        with pytest.raises(saltus.ModelError, match="expected standard deviations above 0 s"):
            saltus.EventTimes([1.0, 2.0], sigma=sigma)


def test_fewer_data_than_parameters():
    message = r"at least 2 data, as many as parameters \(e, g\), found 1"
    with pytest.raises(saltus.ModelError, match=message):
        saltus.fit(Throw(), {"time": [0.1], "height": [1.0]}, ["e", "g"])


OPTIONS = {
    "sigma": ({"sigma": {"height": 0.0}}, "standard deviations above 0, found 0;"),
    "one sigma": ({"sigma": {"height": [1.0, -2.0, 1.0]}}, "above 0, found -2 in row 1"),
    "sigma nan": ({"sigma": np.nan}, "above 0, found nan"),
    "sigma true": ({"sigma": True}, "expected a number, found True"),
    "sigma of what": ({"sigma": {"heigth": 1.0}}, "the data have no 'heigth'; did you mean"),
    "sigma shape": ({"sigma": {"height": [1.0, 2.0]}}, "expected a number or the shape"),
    "absolute": ({"absolute_sigma": True}, "sigma has none of 'height'"),
    "loss": ({"loss": "l1"}, "loss: expected one of linear, soft_l1"),
    "f_scale": ({"f_scale": 0.0}, "f_scale: expected a number above 0"),
    "starts": ({"starts": 0}, "starts: expected a number of starts"),
    "seed": ({"starts": 2, "seed": "x"}, "seed: expected an integer"),
    "progress": ({"progress": 3}, "progress: expected True, False or a function"),
    "save_at": ({"save_at": [1.0]}, "option save_at: the data give the times"),
    "sensitivity": ({"sensitivity": ["e"]}, "option sensitivity: the parameters give it"),
    "unknown": ({"rtoll": 1e-3}, "rtoll.*did you mean 'rtol'"),
    "options": ({"options": 3}, "expected SimulatorOptions, found 3"),
    "max_nfev": ({"max_nfev": -1}, "max_nfev"),
    "method": ({"ode_solver_method": "rk5"}, "rk5"),
}


@pytest.mark.parametrize("case", OPTIONS)
def test_options(case):
    options, message = OPTIONS[case]
    with pytest.raises(saltus.ModelError, match=message):
        saltus.fit(Throw(), GOOD, E, **options)


def test_drawn_starts_need_bounds():
    with pytest.raises(saltus.ModelError, match="'g' has none"):
        saltus.fit(Throw(), GOOD, {"e": (0.1, 1.0), "g": 9.0}, starts=3)


def test_a_value_that_is_fitted_and_given():
    data = saltus.Experiment(GOOD, values={"e": 0.5})
    with pytest.raises(
        saltus.ModelError, match="'e' is fitted, and has a value in this experiment"
    ):
        saltus.fit(Throw(), data, E)
    twice = saltus.Experiment(GOOD, free={"e": 0.5})
    with pytest.raises(saltus.ModelError, match="'e' and 'e' are one value"):
        saltus.fit(Throw(), twice, E)
    wrong = saltus.Experiment(GOOD, values={"f": 0.5})
    with pytest.raises(saltus.ModelError, match="run 1: values: unknown parameter"):
        saltus.fit(Throw(), wrong, E)


def test_two_experiments_of_one_name():
    one = saltus.Experiment(GOOD, name="a")
    with pytest.raises(saltus.ModelError, match="one name"):
        saltus.fit(Throw(), [one, one], E)


def test_what_is_no_system():
    with pytest.raises(saltus.ModelError, match="fit: expected a system, found 3"):
        saltus.fit(3, GOOD, E)
    other = Decay().create_context()
    with pytest.raises(saltus.ModelError):
        saltus.fit(Throw(), GOOD, E, context=other)


def test_nothing_is_run_before_a_refusal():
    """The last check is that of the number of data; a callback counts the runs."""
    calls = []

    class Counting(Decay):
        def ode(self, time, state, **parameters):
            calls.append(time)
            return super().ode(time, state, **parameters)

    with pytest.raises(saltus.ModelError, match="at least 2 data"):
        saltus.fit(Counting(), {"time": [0.1], "y": [1.0]}, ["k", "a"], python="called")
    assert len(calls) <= 2  # an ode may be called at the start, to see its shape


def test_without_scipy(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy", None)
    with pytest.raises(ImportError, match="fit needs scipy, which is not installed: pip install"):
        saltus.fit(Throw(), GOOD, E)
