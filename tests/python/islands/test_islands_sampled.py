"""Sampled controllers with their plants: a loop is an island, whose ticks are its own."""

import numpy as np
import pytest
import saltus
from saltus.library import Adder, Constant, Gain, Integrator, ZeroOrderHold


def loops(count):
    """x' = u - x, u = gain (target - x) held for its period; loop k has its own period and target."""
    builder = saltus.DiagramBuilder()
    pull = builder.add(Constant(1.0, name="one"))  # each loop has a copy
    for k in range(count):
        plant = builder.add(Integrator(0.0, name=f"plant{k}"))
        rate = builder.add(Adder(2, operators="+-", name=f"rate{k}"))
        target = builder.add(Gain(1.0 + 0.01 * k, name=f"target{k}"))
        error = builder.add(Adder(2, operators="+-", name=f"error{k}"))
        gain = builder.add(Gain(3.0, name=f"gain{k}"))
        hold = builder.add(ZeroOrderHold(0.05 + 0.001 * k, name=f"hold{k}"))
        for source, to in (
            (pull.output(), target.input()),
            (target.output(), error.input(0)),
            (plant.output(), error.input(1)),
            (error.output(), gain.input()),
            (gain.output(), hold.input()),
            (hold.output(), rate.input(0)),
            (plant.output(), rate.input(1)),
            (rate.output(), plant.input()),
        ):
            builder.connect(source, to)
        builder.export_output(plant.output(), f"x{k}")
    return builder.build()


def test_a_hundred_sampled_loops_are_a_hundred_islands_of_closed_form():
    """Within a period x tends to u: x(k + 1) = u + (x - u) exp(-h).

    The error of a period is some rtol of x, and the loop contracts, so it stays there.
    """
    count, end = 100, 1.0
    results = saltus.simulate(
        loops(count),
        time_span=(0.0, end),
        islands=True,
        rtol=1e-9,
        atol=1e-11,
        ode_solver_method="dopri5",
    )
    assert len(results.islands) == count
    for k in range(count):
        period, x, t = 0.05 + 0.001 * k, 0.0, 0.0
        for tick in range(1, int(end / period) + 2):
            u = 3.0 * (1.0 + 0.01 * k - x)
            step = min(tick * period, end) - t
            x, t = u + (x - u) * np.exp(-step), t + step
            if t >= end:
                break
        assert results[f"x{k}"][-1] == pytest.approx(x, abs=1e-7)
        ticks = results.islands[k].statistics.instants
        assert ticks <= end / period + 2  # its own ticks only
