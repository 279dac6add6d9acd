"""TransportDelay: the past of a signal, in loops, over jumps, and in a context that is saved."""

import math

import numpy as np
import pytest
import saltus
from saltus.library import *

TIGHT = {"rtol": 1e-10, "atol": 1e-12}


def loop():
    """x' = -x(t - 1), x = 1 before and at 0."""
    builder = saltus.DiagramBuilder()
    x = builder.add(Integrator(1.0, name="x"))
    delay = builder.add(TransportDelay(1.0, initial_output=1.0, name="delay"))
    minus = builder.add(Gain(-1.0, name="minus"))
    builder.connect(x.output_ports[0], delay.input_ports[0])
    builder.connect(delay.output_ports[0], minus.input_ports[0])
    builder.connect(minus.output_ports[0], x.input_ports[0])
    return builder.build()


def method_of_steps(t):
    """The sum over k of (-1)^k (t - k + 1)^k / k!, for k = 0 and all k with t > k - 1."""
    return 1.0 + sum(
        (-1.0) ** k * (t - k + 1) ** k / math.factorial(k) for k in range(1, math.ceil(t) + 1)
    )


def run(diagram, context, span, **options):
    signals = {"x": diagram["x"].output_ports[0]}
    return saltus.simulate(diagram, context, span, recorded_signals=signals, **TIGHT, **options)


@pytest.mark.parametrize("method", ["dopri5", "dop853", "radau"])
def test_a_loop_follows_the_method_of_steps(method):
    diagram = loop()
    results = run(diagram, diagram.create_context(), (0.0, 5.0), ode_solver_method=method)
    exact = [method_of_steps(t) for t in results.time]
    # a hundred times the tolerance for the errors of some fifty steps
    np.testing.assert_allclose(results["x"], exact, atol=1e-8)


def test_a_run_that_continues_from_a_saved_context():
    diagram = loop()
    first = run(diagram, diagram.create_context(), (0.0, 2.6))
    saved = diagram.context_from_json(first.context.to_json())
    a = run(diagram, first.context, (2.6, 5.0))
    b = run(diagram, saved, (2.6, 5.0))
    assert a["x"].tolist() == b["x"].tolist()
    assert a["x"][-1] == pytest.approx(method_of_steps(5.0), abs=1e-8)


def test_a_jump_has_a_row_before_and_a_row_after_it():
    builder = saltus.DiagramBuilder()
    step = builder.add(Step(2.0, 5.0, step_time=0.5, name="step"))
    delay = builder.add(TransportDelay(0.25, initial_output=1.0, name="delay"))
    builder.connect(step.output_ports[0], delay.input_ports[0])
    diagram = builder.build()
    results = saltus.simulate(
        diagram,
        diagram.create_context(),
        (0.0, 1.0),
        recorded_signals={"y": delay.output_ports[0]},
    )
    jumps = np.flatnonzero(np.diff(results["y"]))
    assert results.time[jumps].tolist() == results.time[jumps + 1].tolist() == [0.25, 0.75]
    assert results["y"][jumps + 1].tolist() == [2.0, 5.0]


def test_runs_of_a_sweep_have_their_own_past():
    diagram = loop()
    pytest.importorskip("xarray")
    alone = [
        run(diagram, diagram.create_context().with_parameter("delay.initial_output", p), (0, 3))
        for p in (0.0, 1.0)
    ]
    together = saltus.sweep(diagram, {"delay.initial_output": [0.0, 1.0]}, (0.0, 3.0), **TIGHT)
    ends = together["continuous_state"].values[:, 0]
    assert ends.tolist() == [one["x"][-1] for one in alone]


def test_series_of_the_past_are_refused():
    diagram = loop()
    with pytest.raises(saltus.ModelError, match="taylor"):
        run(diagram, diagram.create_context(), (0.0, 1.0), ode_solver_method="taylor")


@pytest.mark.parametrize("delay", [0.0, -1.0, math.inf, math.nan])
def test_delays_that_are_none(delay):
    with pytest.raises(saltus.ModelError, match="delay"):
        TransportDelay(delay)


@pytest.mark.parametrize("method", ["dopri5", "dop853", "radau", "bdf", "adams", "auto"])
@pytest.mark.parametrize("cut", [0.2, 0.72, 0.9, 1.5])
def test_a_run_that_goes_on_at_a_jump_of_the_input(method, cut):
    """The jump happened in the instant that ended the first run. The pulse has four edges in the
    5.3 s that the integrator sees, so its area is 4 * 0.52.
    """
    builder = saltus.DiagramBuilder()
    pulse = builder.add(Pulse(1.0, period=1.3, pulse_width=0.4, phase_delay=0.2, name="pulse"))
    delay = builder.add(TransportDelay(0.7, name="delay"))
    area = builder.add(Integrator(0.0, name="area"))
    builder.connect(pulse.output(), delay.input())
    builder.connect(delay.output(), area.input())
    diagram = builder.build()
    options = {"ode_solver_method": method, "rtol": 1e-8, "atol": 1e-10}
    whole = saltus.simulate(diagram, (0.0, 6.0), **options)
    first = saltus.simulate(diagram, (0.0, cut), **options)
    second = saltus.simulate(diagram, first.context, (cut, 6.0), **options)
    assert len(first.events) + len(second.events) == len(whole.events)
    # Lines: each of some 40 restarts makes a rounding of 6 s.
    assert abs(second.context.continuous_state[0] - 4 * 0.52) < 40 * 6.0 * np.finfo(float).eps
