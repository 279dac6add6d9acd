"""Lyapunov exponents against closed forms, smooth and through events."""

import math

import numpy as np
import pytest
import saltus

EXACT = ("auto", "dopri5", "dop853", "radau")


def lorenz():
    return saltus.system_of(
        lambda t, x: [
            10.0 * (x[1] - x[0]),
            x[0] * (28.0 - x[2]) - x[1],
            x[0] * x[1] - 8.0 / 3.0 * x[2],
        ],
        [1.0, 1.0, 20.0],
    )


@pytest.mark.parametrize("method", EXACT)
def test_lorenz(method):
    """The divergence is constant, -(10 + 1 + 8/3), and with it the sum."""
    found = saltus.lyapunov(lorenz(), time=400.0, transient=20.0, ode_solver_method=method)
    # the determinant of each piece has the error of its derivatives, some 1e-9 a second
    np.testing.assert_allclose(found.sum, -41.0 / 3.0, rtol=1e-8)
    # known digits; a deviation of four standard errors happens once in 1e4 times
    apart = np.abs(found.exponents - [0.9056, 0.0, -14.572])
    assert np.all(apart <= 4.0 * found.errors + 1e-3)
    assert 2.04 < found.dimension < 2.08
    assert found.states == ("x[0]", "x[1]", "x[2]")


def test_the_errors_fall_as_the_root_of_the_time():
    short, long = (saltus.lyapunov(lorenz(), time=t, transient=20.0) for t in (100.0, 1600.0))
    # a factor 4 in the mean; each estimate from 7 degrees of freedom or more is off by 2 at most
    assert np.all(long.errors < short.errors) and not short.converged


@pytest.mark.parametrize("method", ["auto", "adams", "bdf", "radau"])
def test_a_linear_system_has_the_real_parts_of_its_poles(method):
    matrix = np.array([[-0.3, 2.0, 0.4], [-2.0, -0.3, 0.1], [0.0, 0.0, -1.5]])
    system = saltus.system_of(lambda t, x: list(matrix @ x), [1.0, 0.0, 1.0])
    found = saltus.lyapunov(system, time=200.0, ode_solver_method=method)
    # the directions turn by a bounded amount: its logarithm over 180 s is below 1e-3
    np.testing.assert_allclose(found.exponents, [-0.3, -0.3, -1.5], atol=2e-3)
    np.testing.assert_allclose(found.sum, -2.1, rtol=1e-6)
    assert found.dimension == 0.0


def test_a_saddle_far_from_its_own_directions():
    """One direction grows by e^20 over the other each second: pieces get shorter by themselves."""
    system = saltus.system_of(lambda t, x: [4.0 * x[0] + x[1], -16.0 * x[1]], [0.0, 0.0])
    found = saltus.lyapunov(system, time=100.0, every=100.0)
    np.testing.assert_allclose(found.exponents, [4.0, -16.0], rtol=1e-6)
    assert np.max(np.diff(found.times)) < 1.0 and found.converged


def test_a_driven_system():
    driven = saltus.system_of(lambda t, x: [-0.3 * x[0] + 2.0 * np.cos(t)], [3.0])
    np.testing.assert_allclose(saltus.lyapunov(driven, time=50.0).exponents, [-0.3], rtol=1e-8)


def test_an_orbit_has_the_logarithms_of_its_multipliers():
    oscillator = saltus.system_of(lambda t, x: [x[1], (1 - x[0] ** 2) * x[1] - x[0]], [2.0, 0.0])
    orbit = saltus.periodic_orbit(oscillator)
    expected = math.log(orbit.multipliers[0].real) / orbit.period
    found = saltus.lyapunov(oscillator, time=orbit.period * 400.0, transient=50.0)
    # the time that counts begins with no whole period: bounded terms over 2400 s
    np.testing.assert_allclose(found.exponents, [0.0, expected], atol=3e-3)


def test_a_rimless_wheel():
    """A step takes the time T and leaves the part 1/2 of a deviation: ln(1/2) / T."""
    wheel = saltus.scene("rimless-wheel")
    period = saltus.periodic_orbit(wheel.system, wheel.context, "wheel.spoke").period
    found = saltus.lyapunov(wheel.system, wheel.context, time=2000.0, transient=100.0)
    np.testing.assert_allclose(found.exponents, [0.0, math.log(0.5) / period], atol=2e-3)
    assert found.dimension == 1.0


class BallOnTable(saltus.LeafSystem):
    """A ball over the table a sin(w t)."""

    def __init__(self, e=0.8, a=0.05, w=40.0):
        super().__init__(name="ball")
        self.e, self.a, self.w = e, a, w
        self.declare_continuous_state([0.5, 0.0], ode=lambda t, s: [s.continuous_state[1], -9.81])
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - a * np.sin(w * t),
            self.hit,
            name="hit",
            direction="positive_then_non_positive",
        )

    def hit(self, t, state):
        y, v = state.continuous_state
        table = self.a * self.w * np.cos(self.w * t)
        return state.with_continuous_state([y, (1.0 + self.e) * table - self.e * v])


@pytest.mark.parametrize("e", [0.87, 0.9])  # with less, rounding decides whether it ever lies still
def test_each_impact_of_a_ball_on_a_table_has_the_determinant_of_e_squared(e):
    """Flight keeps the volume, so sum T = 2 n ln(e) with the number n of impacts."""
    found = saltus.lyapunov(BallOnTable(e=e), time=100.0, transient=10.0)
    impacts = found.sum * (found.times[-1] - found.begin) / (2.0 * math.log(e))
    # some 100 impacts, each with an error of 1e-8 or less
    np.testing.assert_allclose(impacts, round(impacts), atol=1e-5)
    assert 20 < round(impacts) < 1000
    assert found.exponents[0] > 4.0 * found.errors[0]  # chaotic


class Solvable(saltus.LeafSystem):
    """u'' - 2 b u' + (w^2 + b^2)(u - s) = 0, and s becomes the sign of u where u' = 0."""

    def __init__(self, b):
        super().__init__(name="oscillator")
        self.stiffness, self.b = (2.0 * np.pi) ** 2 + b**2, b
        self.declare_continuous_state([0.4, 0.0], ode=self.ode)
        self.declare_discrete_state([1.0])
        self.declare_zero_crossing(lambda t, s: s.continuous_state[1], self.choose, name="top")

    def ode(self, t, state):
        u, v = state.continuous_state
        return [v, 2.0 * self.b * v - self.stiffness * (u - state.discrete_state[0])]

    def choose(self, t, state):
        return state.with_discrete_state([1.0 if state.continuous_state[0] >= 0.0 else -1.0])


@pytest.mark.parametrize("b", [0.5, 0.65])
def test_a_solvable_chaotic_oscillator_with_a_switch(b):
    """Its exponents are b and 0 (N. Corron, J. Blakely, M. Stahl, Chaos 20 (2010) 023123): the flow
    has the divergence 2 b, so the jumps of the derivative at the switches take b away.
    """
    found = saltus.lyapunov(Solvable(b), time=600.0, transient=10.0)
    apart = np.abs(found.exponents - [b, 0.0])
    assert np.all(apart <= 4.0 * found.errors + 1e-6) and np.all(found.errors < 0.02)
    assert found.states == ("x[0]", "x[1]") and list(found.frozen) == ["z[0]"]


class Logistic(saltus.LeafSystem):
    """z -> 4 z (1 - z) each second, and a count; x' = z - x / 10."""

    def __init__(self):
        super().__init__(name="map")
        self.declare_continuous_state(
            [0.0], ode=lambda t, s: [s.discrete_state[0] - 0.1 * s.continuous_state[0]]
        )
        self.declare_discrete_state([0.0, 0.0])
        self.declare_periodic_update(self.tick, period=1.0)

    def tick(self, t, state):
        z, count = state.discrete_state
        return state.with_discrete_state([4.0 * z * (1.0 - z) if count else 0.3, count + 1.0])


def test_a_sampled_map():
    """ln 2 of the map, -0.1 of the lag. The first z is a whole number and no label."""
    found = saltus.lyapunov(Logistic(), time=2000.0, every=1.0, transient=0.0)
    np.testing.assert_allclose(found.exponents, [math.log(2.0), -0.1], atol=0.01)
    assert np.all(np.abs(found.exponents - [math.log(2.0), -0.1]) <= 4.0 * found.errors)
    assert found.frozen == {"z[1]": 2001.0} and found.states == ("x[0]", "z[0]")


class Loop(saltus.LeafSystem):
    """A double integrator under the force -0.8 x - 1.1 v, which is computed each 0.4 s."""

    def __init__(self):
        super().__init__(name="loop")
        self.declare_continuous_state(
            [1.0, 0.5], ode=lambda t, s: [s.continuous_state[1], s.discrete_state[0]]
        )
        self.declare_discrete_state([0.0])
        self.declare_periodic_update(self.tick, period=0.4)

    def tick(self, t, state):
        x, v = state.continuous_state
        return state.with_discrete_state([-0.8 * x - 1.1 * v])


def test_an_update_forgets_a_direction():
    found = saltus.lyapunov(Loop(), time=100.0)
    pair = np.log(np.abs(saltus.period_map(Loop(), 0.4).multipliers()[0])) / 0.4
    assert np.isneginf(found.exponents[2]) and found.errors[2] == 0.0
    # rotating directions: a bounded logarithm over 90 s
    np.testing.assert_allclose(found.exponents[:2], [pair, pair], atol=0.02)


def test_count_takes_the_largest():
    full = saltus.lyapunov(lorenz(), time=100.0, transient=20.0)
    two = saltus.lyapunov(lorenz(), time=100.0, transient=20.0, count=2)
    assert len(two.exponents) == 2 and two.history.shape == (len(two.times), 2)
    # other pieces, so another path of the chaos
    assert np.all(np.abs(two.exponents - full.exponents[:2]) < 4.0 * (two.errors + full.errors[:2]))


def test_the_same_call_has_the_same_bits():
    first, second = (saltus.lyapunov(lorenz(), time=20.0) for _ in range(2))
    np.testing.assert_array_equal(first.history, second.history)


def test_history_and_context():
    found = saltus.lyapunov(lorenz(), time=50.0, transient=5.0)
    np.testing.assert_array_equal(found.history[-1], found.exponents)
    assert np.all(np.diff(found.times) > 0.0) and found.begin < found.times[0]
    assert found.times[-1] == found.context.time == pytest.approx(55.0)
    assert "sum -13.66666" in repr(found)


def test_plot():
    pytest.importorskip("matplotlib").use("Agg")
    axes = saltus.lyapunov(lorenz(), time=20.0).plot(linewidth=2)
    assert len(axes.lines) == 3 and axes.get_ylabel() == "exponents [1/s]"
