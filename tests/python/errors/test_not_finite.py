"""NaN or Inf ends a run, and the message says from which function of which block, and when."""

import re

import numpy as np
import pytest
import saltus
from troubles import CALLBACKS, METHODS, Everything, after, check_kept, check_works, go

MESSAGES = {
    "ode": r"the derivative of block 'all' is not finite \(NaN or Inf\): "
    r"xdot\[0\] = (nan|inf) where x = \[0.5488\d*\]; check its equation and "
    "parameters at this state",
    "guard": r"guard 'all.half' is not finite \(NaN or Inf\); check it at this state",
    "reset": r"'all.half' set a state that is not finite \(NaN or Inf\)",
    "update": r"'all.tick' set a state that is not finite \(NaN or Inf\)",
    "output": r"output 'all.y', recorded as 'y', is not finite \(NaN or Inf\); check it at this "
    "time",
}
FIRST = {
    "ode": 0.6,
    "guard": 0.6,
    "reset": np.log(2.0),
    "update": 0.75,
}  # of the others it depends on the steps

CASES = [(where, value) for where in CALLBACKS for value in (np.nan, np.inf)]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(("where", "value"), CASES)
def test_a_value_that_is_not_finite_is_named_with_its_block_and_its_time(where, value, method):
    system = Everything(after(0.6, where, lambda: value))
    with np.errstate(invalid="ignore"), pytest.raises(saltus.SimulationError) as caught:
        go(system, method=method)
    error = caught.value
    number, message = re.fullmatch(r"t = (\S+) s: (.*)", str(error)).groups()
    assert re.fullmatch(MESSAGES[where], message)
    assert error.block == "all"
    assert error.time == float(number)
    if where in FIRST:
        assert error.time == pytest.approx(FIRST[where], abs=1e-4)
    if where == "guard":  # seen within a step, which is not taken
        assert error.results.context.time <= error.time
    else:
        assert error.results.context.time == pytest.approx(error.time, abs=1e-12)
    if where != "output":  # it has no row at that time
        assert error.results.time[-1] == error.results.context.time
    check_kept(error.results, method)
    check_works(system, method)


def test_the_row_of_an_output_that_is_not_finite_is_left_out_or_shows_it():
    results = go(Everything(after(0.6, "output", lambda: np.nan)), throw=False)
    y = results.outputs["y"]
    assert np.isnan(y[-1]) or y[-1] == pytest.approx(np.exp(-results.time[-1]), abs=1e-4)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("where", ["ode", "guard", "output"])
def test_not_finite_from_the_start_leaves_the_start(where, method):
    system = Everything(after(-1.0, where, lambda: np.nan))
    with (
        np.errstate(invalid="ignore"),
        pytest.raises(saltus.SimulationError, match="not finite") as caught,
    ):
        go(system, method=method)
    assert caught.value.time == pytest.approx(0.0, abs=1e-15)
    assert caught.value.results.context.time == 0.0
    assert len(caught.value.results.time) <= 2  # the first tick is at t = 0
    check_works(system, method)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_where_a_jacobian_is_not_finite_differences_stand_in_and_that_is_told(value):
    results = go(Everything(after(0.6, "jacobian", lambda: value)), method="bdf")
    assert results.status == "reached_end"
    told = r"entry \(0, 0\) of the Jacobian of block 'all' was not finite at t = "
    assert re.search(told, results.statistics.linear_solver)
    well = go(Everything(), method="bdf")
    assert "not finite" not in well.statistics.linear_solver
    assert len(results.events) == len(well.events)


@pytest.mark.parametrize("method", METHODS)
def test_with_throw_off_it_is_the_cause_in_what_is_returned(method):
    results = go(Everything(after(0.6, "reset", lambda: np.nan)), method=method, throw=False)
    assert isinstance(results.cause, saltus.SimulationError)
    assert results.message == str(results.cause)
    assert results.cause.block == "all"
    check_kept(results, method)


def test_a_value_behind_an_event_that_is_not_finite_is_no_error():
    """The square root of x is NaN for x < 0, where the run never gets."""

    class Tank(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="tank")
            self.declare_continuous_state(
                default_value=[1.0], ode=lambda t, s: -1.0 - np.sqrt(s.continuous_state)
            )
            self.declare_zero_crossing(
                lambda t, s: s.continuous_state[0] - 1e-6, name="empty", terminal=True
            )

    tank = Tank()
    with np.errstate(invalid="ignore"):
        results = saltus.simulate(tank, tank.create_context(), (0.0, 9.0))
    assert results.status == "terminal"
    # dx/dt = -1 - sqrt(x) takes 2 (1 - ln 2) down to 0
    assert results.context.time == pytest.approx(2.0 * (1.0 - np.log(2.0)), abs=1e-4)
