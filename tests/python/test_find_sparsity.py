"""A stiff method finds the sparsity of a Python block that declares none by calling it."""

import numpy as np
import pytest
import saltus


class Rod(saltus.LeafSystem):
    """x' = 100 (x[i-1] - 2 x[i] + x[i+1]), ends at 0; `check` may raise at some states."""

    def __init__(self, n=400, check=lambda time, x: None):
        super().__init__(name="rod")
        start = np.sin(np.pi * np.arange(1, n + 1) / (n + 1))

        def ode(time, state):
            x = state.continuous_state
            check(time, x - start)
            xdot = -200.0 * x
            xdot[1:] += 100.0 * x[:-1]
            xdot[:-1] += 100.0 * x[1:]
            return xdot

        self.declare_continuous_state(default_value=start, ode=ode)


def run(system, **options):
    return saltus.simulate(
        system,
        system.create_context(),
        (0.0, 1.0),
        ode_solver_method="bdf",
        python="called",
        **options,
    )


def beside(error):
    """Raises `error` where a state is not where it starts, as long as t = 0."""

    def check(time, moved):
        if time == 0.0 and np.any(moved != 0.0):
            raise error

    return check


def test_a_rod_is_found_to_be_one():
    found = run(Rod()).statistics.linear_solver
    assert found.startswith("band: n = 400, 1198 places, 3 colours, band 1 + 1 + 1")
    assert "block 'rod' declares no sparsity" in found
    assert run(Rod(), find_sparsity=False).statistics.linear_solver.startswith("dense: n = 400")


def test_what_is_raised_beside_the_state_is_told_and_ends_no_run():
    results = run(Rod(check=beside(ValueError("not here"))))
    assert results.status == "reached_end"
    assert "it threw: ValueError: not here" in results.statistics.linear_solver


def test_ctrl_c_is_no_failure_of_the_function():
    with pytest.raises(KeyboardInterrupt) as caught:
        run(Rod(check=beside(KeyboardInterrupt())))
    assert caught.value.results.status == "interrupted"
