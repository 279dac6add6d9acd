"""A run that cannot take another step says so, and keeps what it has."""

import numpy as np
import pytest
import saltus
from troubles import METHODS, Everything, check_works, go


class Blow(saltus.LeafSystem):
    """dx/dt = x^2 from 1: x = 1 / (1 - t)."""

    def __init__(self):
        super().__init__(name="blow")
        self.declare_continuous_state(default_value=[1.0], ode=lambda t, s: s.continuous_state**2)
        self.declare_continuous_state_output("x")


@pytest.mark.parametrize("method", METHODS)
def test_a_solution_that_blows_up_ends_at_that_time(method):
    system = Blow()
    with np.errstate(over="ignore", invalid="ignore"):
        with pytest.raises(
            saltus.SimulationError, match=r"^t = 1\S* s: |^t = 0\.99\S* s: "
        ) as caught:
            go(system, method=method)
    error = caught.value
    assert error.time == pytest.approx(1.0, abs=1e-3)
    t, x = error.results.time, error.results.outputs["x"][:, 0]
    assert error.results.status == "failed"
    assert t[-1] == error.results.context.time == pytest.approx(1.0, abs=1e-3)
    early = t < 0.9
    np.testing.assert_allclose(x[early], 1.0 / (1.0 - t[early]), rtol=1e-3)
    again = saltus.simulate(
        system, system.create_context(), (0.0, 0.5), ode_solver_method=method, rtol=1e-9
    )
    assert again.context.continuous_state == pytest.approx([2.0], rel=1e-6)


@pytest.mark.parametrize("method", ["dopri5", "auto", "adams", "bdf", "radau"])
def test_a_step_below_the_least_names_the_option(method):
    system = Blow()
    with pytest.raises(saltus.SimulationError, match="below min_minor_step_size") as caught:
        go(system, method=method, min_minor_step_size=1e-3)
    assert 0.5 < caught.value.time < 1.0
    results = caught.value.results
    assert results.time[-1] == results.context.time == caught.value.time
    assert go(system, end=0.4, method=method).status == "reached_end"


def test_a_first_step_below_the_least_is_raised_to_it():
    class Still(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="still")
            self.declare_continuous_state(1, ode=lambda t, s: [0.0])

    assert go(Still(), min_minor_step_size=1e-3).status == "reached_end"


@pytest.mark.parametrize("method", METHODS)
def test_a_step_limit_keeps_the_rows_and_the_events(method):
    system = Everything()
    with pytest.raises(saltus.SimulationError, match=r"^t = 0.5 s: .*max_major_steps") as caught:
        go(system, method=method, max_major_steps=3)
    results = caught.value.results
    assert results.status == "step_limit"
    assert results.events.times("tick", "time").tolist() == [0.0, 0.25, 0.5]
    assert results.time[-1] == results.context.time == caught.value.time == 0.5
    check_works(system, method)
