"""`saltus.period_map`: sampled loops with known maps, and what it refuses."""

import numpy as np
import pytest
import saltus

T = 0.4
GAINS = np.array([0.8, 1.1])
AD = np.array([[1.0, T], [0.0, 1.0]])
BD = np.array([T**2 / 2.0, T])
# rtol 1e-10 of polynomials that the methods integrate exactly, and of exponentials
CLOSE = {"rtol": 1e-8, "atol": 1e-10}


class Sampled(saltus.LeafSystem):
    """A double integrator, whose force z = r - K x is computed each T seconds."""

    def __init__(self, counts=False):
        super().__init__(name="loop")
        self.counts = counts
        self.declare_dynamic_parameter("r", 0.0)
        self.declare_continuous_state([0.3, -0.2], ode=self.ode)
        self.declare_discrete_state([0.0, 0.0] if counts else [0.0])
        self.declare_periodic_update(self.tick, period=T)
        self.declare_output_port(self.energy, name="energy")

    def ode(self, time, state, r):
        return [state.continuous_state[1], state.discrete_state[0]]

    def tick(self, time, state, r):
        force = r - GAINS[0] * state.continuous_state[0] - GAINS[1] * state.continuous_state[1]
        count = [state.discrete_state[1] + 1.0] if self.counts else []
        return state.with_discrete_state([force, *count])

    def energy(self, time, state, r):
        x, v = state.continuous_state
        return 0.5 * v**2 + x * r + 3.0 * state.discrete_state[0]


def closed_form():
    phi = np.block([[AD, BD[:, None]], [-GAINS @ AD, -GAINS @ BD]])
    return phi, np.array([[0.0], [0.0], [1.0]])


@pytest.mark.parametrize("method", ["auto", "dopri5", "radau"])
def test_a_sampled_double_integrator(method):
    found = saltus.period_map(Sampled(), T, inputs=["r"], ode_solver_method=method)
    phi, gamma = closed_form()
    np.testing.assert_allclose(found.Phi, phi, **CLOSE)
    np.testing.assert_allclose(found.Gamma, gamma, **CLOSE)
    assert found.states == ("x[0]", "x[1]", "z[0]") and found.inputs == ("r",)
    # the force is a function of the state, so its multiplier is 0
    loop = np.linalg.eigvals(AD - np.outer(BD, GAINS))
    expected = sorted([*np.abs(loop), 0.0], reverse=True)
    np.testing.assert_allclose(np.abs(found.multipliers()), expected, rtol=1e-8, atol=1e-8)
    assert found.stability == "stable" and not found.is_fixed_point


def test_the_start_is_after_the_instant():
    found = saltus.period_map(Sampled(), T)
    x = np.array([0.3, -0.2])
    np.testing.assert_allclose(found.x0, [*x, -GAINS @ x], rtol=1e-14)
    np.testing.assert_allclose(found.x1, closed_form()[0] @ found.x0, **CLOSE)


def test_two_periods_are_the_square():
    one, two = (saltus.period_map(Sampled(), n * T, inputs=["r"]) for n in (1, 2))
    np.testing.assert_allclose(two.Phi, one.Phi @ one.Phi, **CLOSE)
    np.testing.assert_allclose(two.Gamma, one.Gamma + one.Phi @ one.Gamma, **CLOSE)


def test_outputs_and_scipy():
    found = saltus.period_map(Sampled(), T, inputs=["r"], outputs=["energy"])
    # by the state after the instant: d(v^2/2 + x r + 3 z)
    np.testing.assert_allclose(found.C, [[0.0, -0.2, 3.0]], rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(found.D, [[0.3]], rtol=1e-12)
    discrete = found.to_scipy()
    assert discrete.dt == T
    np.testing.assert_array_equal(discrete.A, found.Phi)


def test_a_count_is_a_label():
    found = saltus.period_map(Sampled(counts=True), T, inputs=["r"])
    assert found.frozen == {"z[1]": 1.0}
    np.testing.assert_allclose(found.Phi, closed_form()[0], **CLOSE)


def test_rest_is_a_fixed_point():
    start = Sampled().create_context().with_continuous_state([0.0, 0.0])
    found = saltus.period_map(Sampled(), T, start)
    assert found.is_fixed_point
    np.testing.assert_allclose(found.Phi, closed_form()[0], **CLOSE)


def test_at_rest_a_wrong_period_is_refused_too():
    start = Sampled().create_context().with_continuous_state([0.0, 0.0])
    with pytest.raises(saltus.ModelError, match="this is no period of the clocks"):
        saltus.period_map(Sampled(), 0.3, start)


def test_a_continuous_system_has_the_matrix_exponential():
    lag = saltus.system_of(lambda t, x, u: [-2.0 * x[0] + u], [1.0], parameters={"u": 0.5})
    found = saltus.period_map(lag, 0.7, inputs=["u"])
    np.testing.assert_allclose(found.Phi, [[np.exp(-1.4)]], rtol=1e-8)
    np.testing.assert_allclose(found.Gamma, [[(1.0 - np.exp(-1.4)) / 2.0]], rtol=1e-8)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"period": -1.0}, "period: expected a positive time"),
        ({"period": 0.3}, "this is no period of the clocks"),
        ({"inputs": "r"}, "inputs: expected a list of names"),
        ({"inputs": ["x[0]"]}, "is a state; expected a parameter"),
        ({"inputs": ["rr"]}, "unknown parameter or state 'rr'"),
        ({"outputs": ["energi"]}, "did you mean 'energy'"),
        ({"sensitivity": ["r"]}, "the option 'sensitivity' is set by it"),
    ],
)
def test_wrong_arguments(arguments, words):
    with pytest.raises(saltus.ModelError, match=words):
        saltus.period_map(Sampled(), **({"period": T} | arguments))


def test_an_open_input_needs_a_block():
    class Open(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="open")
            self.declare_input_port(name="u")
            self.declare_continuous_state([1.0], ode=lambda t, s, u: [u])

    with pytest.raises(saltus.ModelError, match="'u' is an open input; connect a Constant"):
        saltus.period_map(Open(), T, inputs=["u"])


def test_a_mode_that_does_not_return():
    class Switch(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="switch")
            self.declare_continuous_state([0.0], ode=lambda t, s: [1.0])
            self.declare_default_mode(0)
            self.declare_zero_crossing(
                lambda t, s: s.continuous_state[0] - 0.5, name="half", start_mode=0, end_mode=1
            )

    with pytest.raises(saltus.ModelError, match="the mode of 'switch' did not return"):
        saltus.period_map(Switch(), 1.0)


def test_without_an_input_there_is_no_state_space():
    with pytest.raises(saltus.ModelError, match="to_scipy: the map has no input"):
        saltus.period_map(Sampled(), T).to_scipy()


def test_an_output_may_read_a_state_that_nothing_writes():
    """x' = -x and z = 2.5, which stays: y = z x has dy/dx = z = 2.5 and dy/dz = x = 1 at the start."""

    class System(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="system")
            self.declare_continuous_state([1.0], ode=lambda t, s: -s.continuous_state)
            self.declare_discrete_state([2.5])
            self.declare_output_port(
                lambda t, s: s.continuous_state * s.discrete_state, name="y", shape=1
            )

    found = saltus.period_map(System(), 1.0, outputs=["y"])
    columns = dict(zip(found.states, np.ravel(found.C), strict=True))
    assert columns == pytest.approx({"x[0]": 2.5, "z[0]": 1.0}, rel=1e-12)
