"""The method `taylor` on traced callbacks: what is constant in a flight, and what it refuses."""

import numpy as np
import pytest
import saltus
from saltus.library import Adder, Gain, Integrator, Sine

FINE = {"rtol": 1e-12, "atol": 1e-12}


class Room(saltus.LeafSystem):
    """A heater with a lag: x = (heater, room) [degC]. It switches at 19 and 21 in the room."""

    def __init__(self):
        super().__init__(name="room")
        self.declare_dynamic_parameter("lag", 60.0)
        self.declare_continuous_state([19.0, 19.0], ode=self.ode)
        self.declare_continuous_state_output("x")
        self.declare_default_mode(1)
        self.declare_zero_crossing(
            lambda t, s, **p: s.continuous_state[1] - 21.0, name="warm",
            direction="negative_then_non_negative", start_mode=1, end_mode=0,
        )  # fmt: skip
        self.declare_zero_crossing(
            lambda t, s, **p: s.continuous_state[1] - 19.0, name="cold",
            direction="positive_then_non_positive", start_mode=0, end_mode=1,
        )  # fmt: skip

    def ode(self, time, state, **parameters):
        heater, room = state.continuous_state
        aim = 10.0 + 30.0 * state.mode
        return [(aim - heater) / 1800.0, (heater - room) / parameters["lag"]]


def ends(system, method, end, **options):
    results = saltus.simulate(system, (0.0, end), ode_solver_method=method, **(FINE | options))
    return results, results.context.continuous_state


def test_modes_and_parameters_are_constants_of_a_flight():
    room = Room()
    (ours, x), (theirs, y) = (ends(room, method, 20000.0) for method in ("taylor", "dop853"))
    assert ours.statistics.method == "taylor"
    for name in ("warm", "cold"):
        a, b = ours.events.times(name), theirs.events.times(name)
        # ten tolerances of a temperature of 21 for each flight, at slopes above 2 / 1800 degC/s
        np.testing.assert_allclose(a, b, rtol=0.0, atol=len(a) * 10 * 21e-12 / (2 / 1800))
    np.testing.assert_allclose(x, y, rtol=0.0, atol=len(ours.events) * 10 * 21e-12)


def test_a_discrete_state_is_a_constant_of_a_flight():
    """x' = -z x, and z doubles each second: x(3) = exp(-1 - 2 - 4)."""

    class Decay(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="decay")
            self.declare_discrete_state([1.0])
            self.declare_continuous_state(
                [1.0], ode=lambda t, s: -s.discrete_state[0] * s.continuous_state
            )
            self.declare_periodic_update(
                lambda t, s: s.with_discrete_state(2.0 * s.discrete_state), period=1.0, offset=1.0
            )

    _, x = ends(Decay(), "taylor", 3.0)
    assert x[0] == pytest.approx(np.exp(-7.0), rel=1e-11)


def test_blocks_of_the_library_are_expressions():
    """x'' = -4 x + sin(t) from 0: x = (sin t - sin(2 t) / 2) / 3."""
    builder = saltus.DiagramBuilder()
    force = builder.add(Sine(name="force"))
    spring = builder.add(Gain(-4.0, name="spring"))
    total = builder.add(Adder(2, name="total"))
    v = builder.add(Integrator(0.0, name="v"))
    x = builder.add(Integrator(0.0, name="x"))
    builder.connect(spring.output(), total.input(0))
    builder.connect(force.output(), total.input(1))
    builder.connect(total.output(), v.input())
    builder.connect(v.output(), x.input())
    builder.connect(x.output(), spring.input())
    system = builder.build()
    results = saltus.simulate(
        system, (0.0, 10.0), recorded_signals={"x": x.output()}, ode_solver_method="taylor", **FINE
    )
    t = results.time
    exact = (np.sin(t) - 0.5 * np.sin(2.0 * t)) / 3.0
    # steps of one tolerance each
    np.testing.assert_allclose(results.outputs["x"], exact, rtol=0.0, atol=len(t) * 1e-12)


@pytest.mark.parametrize("gap", [1e-1, 1e-3, 1e-5])
def test_no_pair_of_crossings_is_missed(gap):
    """x' = 1 lets a step be as long as the run; the guard is negative for `gap` seconds of it."""
    leaf = saltus.LeafSystem(name="dips")
    leaf.declare_continuous_state(1, ode=lambda t, s: [1.0])
    leaf.declare_zero_crossing(lambda t, s: (t - 0.7) * (t - 0.7 - gap), name="dip")
    run = saltus.simulate(leaf, (0.0, 100.0), ode_solver_method="taylor")
    # the rounding of 100^2 over the slope `gap`
    np.testing.assert_allclose(
        run.events.times("dip"), [0.7, 0.7 + gap], rtol=0.0, atol=1e-11 / gap
    )


def test_a_callback_that_changes_between_two_pieces_has_a_new_series():
    class Decay(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="decay")
            self.k = 1.0
            self.declare_continuous_state([1.0], ode=lambda t, s: -self.k * s.continuous_state)

    decay = Decay()
    simulator = saltus.Simulator(decay, ode_solver_method="taylor", **FINE)
    simulator.initialize(decay.create_context())
    simulator.advance_to(1.0)
    decay.k = 3.0
    simulator.advance_to(2.0)
    assert simulator.context.continuous_state[0] == pytest.approx(np.exp(-4.0), rel=1e-10)


def test_a_callback_that_has_no_series_any_more_is_refused_each_time():
    class Decay(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="decay")
            self.k, self.kink = 1.0, False
            self.declare_continuous_state([1.0], ode=self.ode)

        def ode(self, time, state):
            x = state.continuous_state
            return -self.k * (np.abs(x) if self.kink else x)

    decay = Decay()
    simulator = saltus.Simulator(decay, ode_solver_method="taylor", **FINE)
    simulator.initialize(decay.create_context())
    simulator.advance_to(1.0)
    decay.k, decay.kink = 3.0, True
    for _ in range(2):
        with pytest.raises(saltus.ModelError, match="'abs'"):
            simulator.advance_to(2.0)
    decay.kink = False
    simulator.advance_to(2.0)
    assert simulator.context.continuous_state[0] == pytest.approx(np.exp(-4.0), rel=1e-10)


@pytest.mark.parametrize("rtol", [1e-6, 1e-10, 1e-12, 1e-14])
def test_dense_output_at_each_order(rtol):
    run = saltus.solve(
        lambda t, x: [x[1], -x[0]], (0, 6.0), [1.0, 0.0],
        method="taylor", dense_output=True, rtol=rtol, atol=rtol,
    )  # fmt: skip
    t = np.linspace(0.0, 6.0, 501)
    # some ten steps of one tolerance each, and roundings
    np.testing.assert_allclose(run.sol(t)[0], np.cos(t), rtol=0.0, atol=20 * max(rtol, 1e-15))


@pytest.mark.parametrize(
    ("ode", "words"),
    [
        (lambda t, s: [-1.0 if s.continuous_state[0] > 0.5 else 1.0], "derivative of block 'leaf'"),
        (lambda t, s: [float(str(s.continuous_state[0]))], "derivative of block 'leaf'"),
        (lambda t, s: -np.abs(s.continuous_state - 0.5), "'abs'"),
        (lambda t, s: np.maximum(s.continuous_state, 0.0), "'maximum'"),
        (lambda t, s: np.floor(s.continuous_state), "'floor'"),
    ],
)
def test_a_derivative_without_a_series_is_refused_with_the_reason(ode, words):
    leaf = saltus.LeafSystem(name="leaf")
    leaf.declare_continuous_state([1.0], ode=ode)
    with pytest.raises(saltus.ModelError, match="ode_solver_method 'taylor'") as caught:
        saltus.simulate(leaf, (0.0, 1.0), ode_solver_method="taylor")
    assert words in str(caught.value) and "dop853" in str(caught.value)


def test_a_guard_that_is_called_is_found_by_looks():
    """The pendulum of every book, with a guard that no trace follows."""

    def below(t, s):
        return float(str(s.continuous_state[0])) - 0.01

    leaf = saltus.LeafSystem(name="pendulum")
    leaf.declare_continuous_state(
        [0.05, 0.0], ode=lambda t, s: [s.continuous_state[1], -9.8 * np.sin(s.continuous_state[0])]
    )
    leaf.declare_zero_crossing(below, name="below")
    ours = saltus.simulate(leaf, (0.0, 20.0), ode_solver_method="taylor", **FINE)
    theirs = saltus.simulate(leaf, (0.0, 20.0), ode_solver_method="dop853", **FINE)
    assert len(ours.events) == len(theirs.events) == 20
    np.testing.assert_allclose(
        ours.events.times("below"), theirs.events.times("below"), rtol=0.0, atol=1e-9
    )
