"""`saltus.linearize`: matrices by hand, traced against called, and every refusal."""

import numpy as np
import pytest
import saltus
from saltus.library import PID, Adder, Constant, Integrator, Saturate

G, LENGTH, CART, BOB = 9.81, 0.5, 1.2, 0.3


class CartPole(saltus.LeafSystem):
    """A cart with a pole that stands up at angle 0 (A. Barto et al. 1983, without friction)."""

    def __init__(self):
        super().__init__(name="cart")
        self.declare_input_port(name="force")
        self.declare_continuous_state([0.0, 0.0, 0.0, 0.0], ode=self.ode)
        self.declare_continuous_state_output("state")

    def ode(self, time, state, force):
        _, v, angle, rate = state.continuous_state
        sin, cos = np.sin(angle), np.cos(angle)
        push = (force + BOB * LENGTH * rate**2 * sin) / (CART + BOB)
        turn = (G * sin - cos * push) / (LENGTH * (1.0 - BOB * cos**2 / (CART + BOB)))
        return [v, push - BOB * LENGTH * turn * cos / (CART + BOB), rate, turn]


def by_hand():
    # point mass on a massless rod, at the upright position
    a = np.zeros((4, 4))
    a[0, 1] = a[2, 3] = 1.0
    a[1, 2] = -BOB * G / CART
    a[3, 2] = (CART + BOB) * G / (CART * LENGTH)
    return a, np.array([[0.0], [1.0 / CART], [0.0], [-1.0 / (CART * LENGTH)]])


def test_cart_pole_by_hand():
    lin = saltus.linearize(CartPole(), inputs={"force": 0.0})
    a, b = by_hand()
    # exact derivatives: some ten roundings of values up to 25
    np.testing.assert_allclose(lin.A, a, rtol=1e-14, atol=1e-13)
    np.testing.assert_allclose(lin.B, b, rtol=1e-14, atol=1e-13)
    np.testing.assert_array_equal(lin.C, np.eye(4))
    assert lin.method == "exact"
    assert lin.states == ("x[0]", "x[1]", "x[2]", "x[3]")
    assert lin.outputs == ("state[0]", "state[1]", "state[2]", "state[3]")
    assert lin.inputs == ("force",) and not lin.frozen


def test_traced_and_called_agree():
    cart = CartPole()
    start = cart.create_context().with_continuous_state([0.4, -0.3, 0.7, 1.1])
    traced = saltus.linearize(cart, start, inputs={"force": 2.0})
    called = saltus.linearize(cart, start, inputs={"force": 2.0}, python="called")
    assert "differences of the derivative of block 'cart'" in called.method
    # central differences have an error of 1e-10 of a derivative; the largest one is 30
    np.testing.assert_allclose(called.A, traced.A, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(called.B, traced.B, rtol=1e-9, atol=1e-9)
    np.testing.assert_array_equal(called.xdot, traced.xdot)


def loop(limit=None, start=0.0):
    """A PID controller around an integrator; optionally with a limit of the force."""
    builder = saltus.DiagramBuilder()
    target = builder.add(Constant(0.0, name="target"))
    error = builder.add(Adder("+-", name="error"))
    pid = builder.add(PID(kp=3.0, ki=2.0, kd=0.5, n=10.0, name="pid"))
    plant = builder.add(Integrator(start, name="plant"))
    builder.connect(target.output(), error.input(0))
    builder.connect(plant.output(), error.input(1))
    builder.connect(error.output(), pid.input())
    last = pid
    if limit is not None:
        last = builder.add(Saturate(lower_limit=-limit, upper_limit=limit, name="limiter"))
        builder.connect(pid.output(), last.input())
    builder.connect(last.output(), plant.input())
    builder.export_output(plant.output(), "y")
    return builder.build()


def test_poles_of_a_pid_loop():
    # (kp + ki/s + kd n s / (s + n)) / s = -1:
    # s^2 (s + n) + kp s (s + n) + ki (s + n) + kd n s^2 = 0
    lin = saltus.linearize(loop(), inputs=["target.value"])
    expected = np.sort_complex(np.roots([1.0, 10.0 + 3.0 + 5.0, 30.0 + 2.0, 20.0]))
    # simple roots: an eigenvalue has the error eps |A| times its condition, below 100 here
    np.testing.assert_allclose(lin.poles(), expected, rtol=1e-12)


def test_scipy_has_the_same_matrices():
    lin = saltus.linearize(loop(), inputs=["target.value"])
    assert lin.D.shape == (1, 1)
    np.testing.assert_array_equal(lin.to_scipy().A, lin.A)
    with pytest.raises(saltus.ModelError, match="to_scipy: the linearisation has no input"):
        saltus.linearize(loop()).to_scipy()


def test_control_has_the_same_poles():
    pytest.importorskip("control")
    lin = saltus.linearize(loop(), inputs=["target.value"])
    np.testing.assert_allclose(np.sort_complex(lin.to_control().poles()), lin.poles(), rtol=1e-9)


def test_a_saturated_loop_is_open():
    lin = saltus.linearize(loop(limit=0.1, start=1.0), inputs=["target.value"])
    row = lin.A[lin.states.index("plant.x[0]")]
    np.testing.assert_array_equal(row, 0.0)
    assert any(name.startswith("limiter.") and value for name, value in lin.frozen.items())


@pytest.mark.parametrize("seed", range(20))
def test_random_flows_against_differences(seed):
    rng = np.random.default_rng(seed)
    w, v, gain = rng.normal(size=(5, 5)), rng.normal(size=(5, 5)), rng.normal(size=5)

    class Net(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="net")
            self.declare_input_port(name="u")
            self.declare_continuous_state(rng.normal(size=5), ode=self.ode)
            self.declare_output_port(self.y, name="y")

        def ode(self, time, state, u):
            x = state.continuous_state
            return np.tanh(w @ x) * np.exp(-(x**2)) + gain * np.sin(u) + v @ x

        def y(self, time, state, u):
            return np.sum(state.continuous_state**3) * u

    net = Net()
    start = net.create_context()
    lin = saltus.linearize(net, start, inputs={"u": 0.4})
    x, h = start.continuous_state, 1e-5

    def rates(x, u):
        return np.tanh(w @ x) * np.exp(-(x**2)) + gain * np.sin(u) + v @ x

    a = np.column_stack(
        [(rates(x + h * e, 0.4) - rates(x - h * e, 0.4)) / (2 * h) for e in np.eye(5)]
    )
    # h^2 / 6 of third derivatives up to 1e3, and eps / h of values up to 10: 2e-8 and 2e-10
    np.testing.assert_allclose(lin.A, a, rtol=0, atol=1e-7)
    np.testing.assert_allclose(lin.B[:, 0], gain * np.cos(0.4), rtol=1e-14)
    np.testing.assert_allclose(lin.C[0], 3.0 * x**2 * 0.4, rtol=1e-14)
    np.testing.assert_allclose(lin.D[0, 0], np.sum(x**3), rtol=1e-13)


@pytest.mark.parametrize(
    ("inputs", "outputs", "words"),
    [
        (["force"], None, "is open and has no value"),
        ({"force": 0.0, "x[0]": None}, None, "is a state or a mode"),
        ({"force": 0.0, "mass": None}, None, "unknown parameter or state 'mass'"),
        ({"force": [[[0.0]]]}, None, "expected a number, a vector or a matrix"),
        ({"force": 0.0}, ["stat"], "did you mean 'state'"),
        ("force", None, "expected a list of names"),
    ],
)
def test_wrong_names_are_refused(inputs, outputs, words):
    with pytest.raises(saltus.ModelError, match=words.replace("[", r"\[")):
        saltus.linearize(CartPole(), inputs=inputs, outputs=outputs)


def test_a_guard_at_zero_is_refused():
    ball = saltus.scene("bouncing-ball").system
    on_floor = ball.create_context().with_continuous_state([0.0, -1.0])
    with pytest.raises(
        saltus.ModelError, match=r"guard .ball\.bounce. has an effect and is at zero"
    ):
        saltus.linearize(ball, on_floor)


@pytest.mark.parametrize(("rate", "smooth"), [(np.abs, False), (lambda x: x * abs(x), True)])
def test_kinks_of_traced_functions(rate, smooth):
    class Leaf(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="leaf")
            self.declare_continuous_state([0.0], ode=lambda t, s: rate(s.continuous_state))

    if smooth:
        np.testing.assert_array_equal(saltus.linearize(Leaf()).A, [[0.0]])
    else:
        with pytest.raises(saltus.ModelError, match="kink"):
            saltus.linearize(Leaf())


def test_an_exception_of_a_callback_does_not_give_a_number():
    class Leaf(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="leaf")
            self.declare_continuous_state([1.0], ode=self.ode)

        def ode(self, time, state):
            if float(state.continuous_state[0]) > 1.0:
                raise ValueError("beyond one")
            return state.continuous_state

    with pytest.raises(saltus.ModelError, match="beyond one"):
        saltus.linearize(Leaf(), python="called")
