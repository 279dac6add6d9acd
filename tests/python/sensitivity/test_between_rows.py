"""Derivatives between the rows: `results.sensitivities(t)`, by each method."""

import copy
import math
import pickle

import numpy as np
import pytest
import saltus
from saltus.library import Integrator, Sine
from scenes_with_derivatives import METHODS, Throw

TIGHT = {"rtol": 1e-10, "atol": 1e-12, "dense_output": True}
TIMES = np.linspace(0.0, 3.0, 41)


def both_ways(test):
    """With each method, traced and called; taylor needs expressions."""
    ways = [(m, p) for m in METHODS for p in ("traced", "called") if (m, p) != ("taylor", "called")]
    return pytest.mark.parametrize(("method", "python"), ways)(test)


def decay():
    """x' = -k x, x(0) = 2."""
    block = saltus.LeafSystem(name="decay")
    block.declare_dynamic_parameter("k", 0.7)
    block.declare_continuous_state([2.0], ode=lambda t, s, *, k: -k * s.continuous_state)
    block.declare_continuous_state_output("x")
    return block


def swing():
    """x'' = -k x, x(0) = 1, with its energy."""
    block = saltus.LeafSystem(name="swing")
    block.declare_dynamic_parameter("k", 4.0)

    def ode(time, state, *, k):
        x, v = state.continuous_state
        return [v, -k * x]

    def energy(time, state, *, k):
        x, v = state.continuous_state
        return 0.5 * (v * v + k * x * x)

    block.declare_continuous_state([1.0, 0.0], ode=ode)
    block.declare_output_port(energy, name="energy")
    return block


# The multistep methods follow the state by a hundred tolerances over three units of time, and the
# coefficients of the derivatives follow the state: 1e-8 relative.
@both_ways
def test_an_exponential(method, python):
    block = decay()
    run = saltus.simulate(
        block,
        (0.0, 3.0),
        sensitivity=["k", "x[0]"],
        recorded_signals={"x": block.output_ports[0]},
        ode_solver_method=method,
        python=python,
        **TIGHT,
    )
    found = run.sensitivities(TIMES)
    e = np.exp(-0.7 * TIMES)
    expected = np.stack([-2.0 * TIMES * e, e], axis=-1)
    np.testing.assert_allclose(found["x"][:, 0], expected, atol=3e-8)
    assert found.continuous_state.shape == (41, 1, 2)
    assert run.sensitivities(1.0)["x"].shape == (1, 2)
    np.testing.assert_array_equal(run.sensitivities(1.0)["x"], run.sensitivities([1.0])["x"][0])


@both_ways
def test_an_oscillator_and_its_energy(method, python):
    block = swing()
    run = saltus.simulate(
        block,
        (0.0, 3.0),
        sensitivity=["k"],
        recorded_signals={"energy": block.output_ports[0]},
        ode_solver_method=method,
        python=python,
        **TIGHT,
    )
    found = run.sensitivities(TIMES)
    t, w = TIMES, 2.0
    x = -t / (2 * w) * np.sin(w * t)
    v = -1 / (2 * w) * np.sin(w * t) - t / 2 * np.cos(w * t)
    expected = np.stack([x, v], axis=-1)
    np.testing.assert_allclose(found.continuous_state[..., 0], expected, atol=1e-7)
    np.testing.assert_allclose(found["energy"][:, 0], 0.5, atol=1e-6)


@both_ways
def test_a_ball_between_impacts_and_at_them(method, python):
    """y0 = 10, t1 = sqrt(2 y0 / g); after it y = e g t1 s - g s^2 / 2 with s = t - t1."""
    g, e, y0 = 9.81, 0.9, 10.0
    run = saltus.simulate(
        Throw(g, e, y0),
        (0.0, 3.0),
        sensitivity=["g", "e", "x[0]"],
        ode_solver_method=method,
        python=python,
        **TIGHT,
    )
    t1 = math.sqrt(2 * y0 / g)
    dt1 = np.array([-t1 / (2 * g), 0.0, t1 / (2 * y0)])

    def after(t):
        s = t - t1
        y = (e * g * s - e * g * t1 + g * s) * dt1 + [e * t1 * s - 0.5 * s * s, g * t1 * s, 0.0]
        v = (e * g + g) * dt1 + [e * t1 - s, g * t1, 0.0]
        return np.array([y, v])

    def before(t):
        return np.array([[-0.5 * t * t, 0.0, 1.0], [-t, 0.0, 0.0]])

    for t in (0.0, 0.3, 1.42, 1.44, 2.5, 3.0):
        expected = before(t) if t < t1 else after(t)
        np.testing.assert_allclose(run.sensitivities(t).continuous_state, expected, atol=1e-6)
    impact = run.events[0].time
    left = run.sensitivities(impact, side="left")
    np.testing.assert_allclose(left.continuous_state, before(t1), atol=1e-6)
    np.testing.assert_allclose(run.sensitivities(impact).continuous_state, after(t1), atol=1e-6)


@pytest.mark.parametrize("method", METHODS)
def test_at_a_row_they_are_those_of_the_row(method):
    ball = Throw(9.81, 0.9, 10.0)
    run = saltus.simulate(
        ball,
        (0.0, 5.0),
        sensitivity=["g", "e"],
        recorded_signals={"state": ball.output("state")},
        ode_solver_method=method,
        save_at=[0.5, 2.0, 3.3],
        save_steps=True,
        dense_output=True,
    )
    rows = run.sensitivities["state"]
    for i, t in enumerate(run.time):
        before = i + 1 < len(run.time) and run.time[i + 1] == t
        found = run.sensitivities(t, side="left" if before else "right")
        # Inside a step x(t) of dense output differs from that of a row by some eps, and so does f.
        np.testing.assert_allclose(found["state"], rows[i], rtol=1e-13, atol=1e-13)
        np.testing.assert_array_equal(found["state"], found.continuous_state)
    np.testing.assert_allclose(
        found.continuous_state, run.sensitivities.continuous_state, rtol=1e-13, atol=1e-13
    )


def test_two_runs_of_a_diagram_differ_by_them():
    """A matrix of an input that depends on the time: central differences of two runs."""
    builder = saltus.DiagramBuilder()
    source, x = builder.add(Sine(frequency=3.0, name="source"), Integrator(0.0, name="x"))
    builder.connect(source.output(), x.input())
    system, signals = builder.build(), {"x": x.output(), "source": source.output()}

    def run(frequency):
        context = system.create_context().with_parameters({"source.frequency": frequency})
        return saltus.simulate(
            system,
            context,
            (0.0, 3.0),
            sensitivity=["source.frequency"],
            recorded_signals=signals,
            **TIGHT,
        )

    h = 1e-4
    up, down, middle = run(3.0 + h), run(3.0 - h), run(3.0)
    found = middle.sensitivities(TIMES)
    for name in signals:
        # h^2 / 6 of the third derivative, t^3 < 27, is 5e-8; the runs have errors of 1e-10 / h.
        slope = (up(TIMES)[name] - down(TIMES)[name]) / (2 * h)
        np.testing.assert_allclose(found[name][:, 0], slope, atol=5e-6)


def test_the_run_is_the_same_with_them():
    ball = Throw(9.81, 0.9, 10.0)
    alone = saltus.simulate(ball, (0.0, 3.0), dense_output=True)
    with_them = saltus.simulate(ball, (0.0, 3.0), dense_output=True, sensitivity=["e"])
    assert alone(TIMES).continuous_state.tobytes() == with_them(TIMES).continuous_state.tobytes()


def test_what_has_no_derivatives_between_rows_says_why():
    ball = Throw(9.81, 0.9, 10.0)
    rows = saltus.simulate(ball, (0.0, 1.0), sensitivity=["e"])
    with pytest.raises(saltus.ModelError, match="dense_output=True"):
        rows.sensitivities(0.5)
    dense = saltus.simulate(ball, (0.0, 1.0), sensitivity=["e"], dense_output=True)
    with pytest.raises(saltus.ModelError, match="outside the run"):
        dense.sensitivities(1.5)
    with pytest.raises(saltus.ModelError, match="unknown side 'up'"):
        dense.sensitivities(0.5, side="up")
    with pytest.raises(saltus.ModelError, match="'y'"):
        dense.sensitivities(0.5)["y"]


def test_copies_know_the_run_and_pickles_do_not():
    ball = Throw(9.81, 0.9, 10.0)
    run = saltus.simulate(ball, (0.0, 1.0), sensitivity=["e"], dense_output=True)
    assert copy.deepcopy(run.sensitivities) == run.sensitivities
    assert copy.deepcopy(run).sensitivities(0.5) == run.sensitivities(0.5)
    kept = pickle.loads(pickle.dumps(run.sensitivities))
    assert kept == run.sensitivities
    for sensitivities in (kept, pickle.loads(pickle.dumps(run.sensitivities))):
        with pytest.raises(saltus.ModelError, match="keep no dense output"):
            sensitivities(0.5)
