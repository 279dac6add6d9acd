"""Derivatives by the parameters of a diagram, in everything that takes derivatives."""

import pickle

import numpy as np
import pytest
import saltus
from saltus import Parameter
from saltus.library import Constant, Gain, Integrator
from scenes_with_derivatives import Room

TIGHT = {"rtol": 1e-10, "atol": 1e-12}


class Spring(saltus.LeafSystem):
    """v' = -k x - c v + force, x' = v, from x = 1."""

    def __init__(self, k, c, force=0.0):
        super().__init__(name="spring")
        self.declare_dynamic_parameter("k", k)
        self.declare_dynamic_parameter("c", c)
        self.declare_dynamic_parameter("force", force)
        self.declare_continuous_state(
            [1.0, 0.0],
            names=["place", "speed"],
            ode=lambda t, s, k, c, force: [
                s.continuous_state[1],
                -k * s.continuous_state[0] - c * s.continuous_state[1] + force,
            ],
        )
        self.declare_continuous_state_output("state")


def car(omega=3.0):
    """An oscillator x = cos(omega t), where omega is a parameter of the diagram around it."""
    w = Parameter("omega", omega)
    builder = saltus.DiagramBuilder()
    builder.add(Spring(w * w, 0.0))
    builder.export_output("spring.state", "state")
    return builder.build("car", parameters={"omega": w})


def by_omega(t, w):
    """The derivatives of cos(w t) and of -w sin(w t) by w."""
    return np.array([-t * np.sin(w * t), -np.sin(w * t) - w * t * np.cos(w * t)]).T


@pytest.mark.parametrize("python", ["called", "traced"])
@pytest.mark.parametrize("method", ["auto", "dopri5", "dop853", "radau", "adams", "bdf"])
def test_an_oscillator(method, python):
    results = saltus.simulate(
        car(),
        time_span=(0.0, 1.0),
        sensitivity=["omega"],
        dense_output=True,
        recorded_signals=["state"],
        python=python,
        ode_solver_method=method,
        **TIGHT,
    )
    # some hundred tolerances for the methods of many steps; differences have 1e-10 in each rate
    near = 1e-6 if method in ("adams", "bdf") else 1e-8
    expected = by_omega(results.time, 3.0)
    np.testing.assert_allclose(results.sensitivities["state"][..., 0], expected, atol=near)
    between = results.sensitivities(0.5)
    np.testing.assert_allclose(between["state"][:, 0], by_omega(0.5, 3.0), atol=near)


def test_vectors_subexpressions_and_contexts_that_were_pickled():
    k = Parameter("k", [4.0, 0.5])
    builder = saltus.DiagramBuilder()
    builder.add(Spring(k[0] * k[1], np.sin(k[1])))
    diagram = builder.build(parameters={"k": k})
    start = diagram.create_context().with_parameter("k", [9.0, 0.25])
    names = ["k", "spring.k", "spring.c"]
    for context in (start, pickle.loads(pickle.dumps(start))):
        results = saltus.simulate(
            diagram, context, (0.0, 1.0), python="traced", sensitivity=names, **TIGHT
        )
        sensitivities = results.sensitivities
        assert sensitivities.parameters == ("k[0]", "k[1]", "spring.k", "spring.c")
        k0, k1, by_k, by_c = np.asarray(sensitivities.continuous_state).T
        # one linear equation for all columns: rounding
        np.testing.assert_allclose(k0, 0.25 * by_k, atol=1e-12)
        np.testing.assert_allclose(k1, 9.0 * by_k + np.cos(0.25) * by_c, atol=1e-12)


def test_the_trajectory_keeps_its_bits():
    plain = saltus.simulate(car(), time_span=(0.0, 1.0))
    with_them = saltus.simulate(car(), time_span=(0.0, 1.0), sensitivity=["omega"])
    assert plain.context == with_them.context


def test_linearize():
    system = saltus.linearize(car(), inputs=["omega"])
    np.testing.assert_array_equal(system.B, [[0.0], [-6.0]])  # d(-w^2 x)/dw at x = 1
    np.testing.assert_array_equal(system.u, [3.0])
    other = saltus.linearize(car(), inputs={"omega": 5.0})
    np.testing.assert_array_equal(other.B, [[0.0], [-10.0]])


def test_a_kink_of_an_expression():
    m = Parameter("m", 0.0)
    builder = saltus.DiagramBuilder()
    rate, x = builder.add(Constant(abs(m), name="rate"), Integrator(name="x"))
    builder.connect(rate.output(), x.input())
    diagram = builder.build(parameters={"m": m})
    results = saltus.simulate(diagram, time_span=(0.0, 1.0), sensitivity=["m"])
    assert np.isnan(results.sensitivities.continuous_state).all()
    (gap,) = results.sensitivity_gaps
    assert gap.parameter == "m" and "'rate.value'" in gap.reason and "kink" in gap.reason
    with pytest.raises(saltus.ModelError, match=r"by 'm': parameter 'rate.value'.* has a kink"):
        saltus.linearize(diagram, inputs=["m"])


def test_fit():
    t = np.linspace(0.1, 2.0, 20)
    data = {"time": t, "state": np.array([np.cos(2.5 * t), -2.5 * np.sin(2.5 * t)]).T}
    found = saltus.fit(car(), data, {"omega": 2.9}, rtol=1e-11, atol=1e-12)
    assert found.success and found.failures == 0 and found.warnings == ()
    assert found.parameters == pytest.approx({"omega": 2.5}, rel=1e-8)


def test_trim_and_equilibria():
    force = Parameter("force", 1.0)
    builder = saltus.DiagramBuilder()
    builder.add(Spring(4.0, 0.1, force * force))
    diagram = builder.build(parameters={"force": force})
    point = saltus.trim(diagram, ["force", "spring.speed"], hold={"spring.place": 4.0})
    assert point.status == "converged"
    assert point.values["force"] == pytest.approx(4.0, rel=1e-12)  # force^2 = 4 x
    found = saltus.equilibria(diagram, {"spring.place": (-3.0, 3.0), "spring.speed": (-1.0, 1.0)})
    assert [p.values["spring.place"] for p in found] == pytest.approx([0.25])


def test_periodic_orbit():
    """The period by a shift of both levels is that by each of them."""
    low, high = saltus.periodic_orbit(Room(), section="cold", wrt=["low", "high"]).dperiod()
    shift = Parameter("shift", 0.0)
    builder = saltus.DiagramBuilder()
    builder.add(Room(low=19.0 + shift, high=21.0 + 3 * shift))
    diagram = builder.build(parameters={"shift": shift})
    orbit = saltus.periodic_orbit(diagram, section="room.cold", wrt=["shift"])
    by = [low + 3 * high]
    np.testing.assert_allclose(orbit.dperiod(), by, rtol=1e-8)


def test_lyapunov():
    """A block with a computed parameter has the exponents of its values."""
    rate = Parameter("rate", 0.25)
    builder = saltus.DiagramBuilder()
    gain, x = builder.add(Gain(-2 * rate, name="gain"), Integrator(1.0, name="x"))
    builder.connect(x.output(), gain.input())
    builder.connect(gain.output(), x.input())
    diagram = builder.build(parameters={"rate": rate})
    for value in (0.25, 0.5):
        start = diagram.create_context().with_parameter("rate", value)
        found = saltus.lyapunov(diagram, start, time=20.0)
        np.testing.assert_allclose(found.exponents, [-2 * value], rtol=1e-8)


def test_jax():
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    f = saltus.jax_function(car(), ["omega"], (0.0, 1.0), **TIGHT)
    slope = jax.jacrev(f)(jax.numpy.array([3.0])).continuous_state
    np.testing.assert_allclose(np.asarray(slope)[:, 0], by_omega(1.0, 3.0), atol=1e-8)


@pytest.mark.parametrize("islands", [False, True])
def test_islands_share_it(islands):
    speed = Parameter("speed", 2.0)
    builder = saltus.DiagramBuilder()
    for i in (1, 2):
        rate, x = builder.add(Constant(speed**i, name=f"rate{i}"), Integrator(name=f"x{i}"))
        builder.connect(rate.output(), x.input())
    diagram = builder.build(parameters={"speed": speed})
    results = saltus.simulate(
        diagram, time_span=(0.0, 1.0), sensitivity=["speed", "rate2.value"], islands=islands
    )
    np.testing.assert_allclose(
        results.sensitivities.continuous_state, [[1.0, 0.0], [4.0, 1.0]], rtol=1e-9
    )
