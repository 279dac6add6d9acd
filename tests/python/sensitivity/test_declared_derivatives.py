"""Declared derivatives: exact where functions are called, and errors that name the place."""

import math

import numpy as np
import pytest
import saltus
from saltus.library import Constant, EnabledSubsystem, Pulse, Sine

K, FLOOR, GAIN = 0.5, 0.7, 0.25
NAMES = ["k", "floor", "gain", "x[0]"]
TIGHT = {"rtol": 1e-11, "atol": 1e-13}


class Decay(saltus.LeafSystem):
    """x' = -k x^2, which jumps to gain x + 2 at the floor. If it is strict, its functions raise at
    other parameters, so that there are no differences by them.
    """

    def __init__(self, strict=False, by_k=-1.0, declares=True):
        super().__init__(name="decay")
        self.strict, self.by_k = strict, by_k
        for name, value in {"k": K, "floor": FLOOR, "gain": GAIN}.items():
            self.declare_dynamic_parameter(name, value)
        declared = (self.of_ode, self.of_guard, self.of_reset) if declares else (None, None, None)
        self.declare_continuous_state([1.0], ode=self.ode, derivatives=declared[0])
        self.declare_continuous_state_output("x")
        self.declare_zero_crossing(
            self.guard,
            self.reset,
            name="floor",
            direction="falling",
            guard_derivatives=declared[1],
            reset_derivatives=declared[2],
        )

    def look_at(self, *parameters):
        if self.strict and parameters != (K, FLOOR, GAIN):
            raise ValueError("other parameters")

    def ode(self, time, state, *, k, floor, gain):
        self.look_at(k, floor, gain)
        x = state.continuous_state[0]
        return [-k * x * x]

    def of_ode(self, time, state, *, k, floor, gain):
        x = state.continuous_state[0]
        return {"continuous_state": [[-2 * k * x]], "k": [self.by_k * x * x]}

    def guard(self, time, state, *, k, floor, gain):
        self.look_at(k, floor, gain)
        return state.continuous_state[0] - floor

    def of_guard(self, time, state, **parameters):
        return {"continuous_state": 1.0, "floor": -1.0}

    def reset(self, time, state, *, k, floor, gain):
        self.look_at(k, floor, gain)
        return [gain * state.continuous_state[0] + 2.0]

    def of_reset(self, time, state, *, k, floor, gain):
        return {"continuous_state": gain, "gain": state.continuous_state}


def exact(t):
    """x = x0 / (1 + k x0 t) down to the floor at tau = (1 / floor - 1 / x0) / k, then from
    r = gain floor + 2."""
    tau, r = (1 / FLOOR - 1) / K, GAIN * FLOOR + 2
    x = r / (1 + K * r * (t - tau))
    by_r, rate = x * x / (r * r), -K * x * x
    by_tau = [-tau / K, -1 / (FLOOR * FLOOR * K), 0.0, 1 / K]
    fixed = [-x * x * (t - tau), by_r * GAIN, by_r * FLOOR, 0.0]
    return np.array([f - rate * d for f, d in zip(fixed, by_tau, strict=True)])


def run(block, **options):
    return saltus.simulate(
        block, (0.0, 1.5), sensitivity=NAMES, python="called", **TIGHT, **options
    )


# The derivatives of the state follow a run with the tolerance 1e-11, through one event.
def test_declared_derivatives_are_exact_where_there_are_no_differences():
    results = run(Decay(strict=True))
    np.testing.assert_allclose(results.sensitivities.continuous_state[0], exact(1.5), atol=1e-8)
    assert results.sensitivity_gaps == ()
    without = run(Decay(strict=True, declares=False))
    assert np.isnan(without.sensitivities.continuous_state[0, :3]).all()


@pytest.mark.parametrize("declares", [True, False])
def test_they_agree_with_differences_of_smooth_functions(declares):
    found = run(Decay(declares=declares)).sensitivities.continuous_state[0]
    np.testing.assert_allclose(found, exact(1.5), atol=1e-8)


def test_they_are_read_between_rows_too():
    results = run(Decay(strict=True), dense_output=True)
    np.testing.assert_allclose(
        results.sensitivities(1.2).continuous_state[0], exact(1.2), atol=1e-8
    )


class Follower(saltus.LeafSystem):
    """x' = a (u - x) of a vector input, and an output of both; opaque, with derivatives."""

    def __init__(self):
        super().__init__(name="follower")
        self.declare_dynamic_parameter("a", [2.0, 3.0])
        self.declare_input_port("u", shape=())
        self.declare_continuous_state([1.0, 0.0], ode=self.ode, derivatives=self.of_ode)
        self.declare_output_port(
            self.out,
            name="y",
            shape=(),
            derivatives=lambda t, s, u, a: {
                "continuous_state": [[u, 0.0]],
                "u": [[s.continuous_state[0]]],
                "time": 2.0,
            },
        )

    def ode(self, time, state, u, *, a):
        return a * (float(u) - state.continuous_state)

    def of_ode(self, time, state, u, *, a):
        return {
            "continuous_state": -np.diag(a),
            "a": np.diag(u - state.continuous_state),
            "u": a,
        }

    def out(self, time, state, u, *, a):
        return float(u) * state.continuous_state[0] + 2.0 * time


def diagram(frequency=3.0):
    builder = saltus.DiagramBuilder()
    source, follower = builder.add(Sine(frequency=frequency, name="source"), Follower())
    builder.connect(source.output(), follower.input())
    builder.export_output(follower.output(), name="y")
    return builder.build()


def test_inputs_and_vector_parameters_of_a_diagram():
    names = ["source.frequency", "follower.a", "follower.x[0]"]
    system = diagram()
    results = saltus.simulate(system, (0.0, 1.0), sensitivity=names, python="called", **TIGHT)
    found = results.sensitivities.continuous_state

    def at(**values):
        context = system.create_context().with_parameters(
            {"source.frequency": 3.0, "follower.a": [2.0, 3.0]} | values
        )
        return saltus.simulate(system, context, (0.0, 1.0), **TIGHT).context.continuous_state

    h = 1e-4  # h^2 / 6 of third derivatives of some 10, and 1e-11 / h by the runs: 1e-7
    by_frequency = at(**{"source.frequency": 3 + h}) - at(**{"source.frequency": 3 - h})
    np.testing.assert_allclose(found[:, 0], by_frequency / (2 * h), atol=1e-6)
    by_a = at(**{"follower.a": [2 + h, 3.0]}) - at(**{"follower.a": [2 - h, 3.0]})
    np.testing.assert_allclose(found[:, 1], by_a / (2 * h), atol=1e-6)
    np.testing.assert_allclose(found[:, 3], [math.exp(-2.0), 0.0], atol=1e-9)
    assert saltus.check_derivatives(system, system.create_context().with_time(0.3)) == ()


class Ramp(saltus.LeafSystem):
    """x' = 1 to the second of two guards, x - 2 and x - c - t / 2, which counts in z and doubles x.

    From x0 = 0 it is at tau = 2 c, and then x = 4 c + (t - tau) = 2 c + t, z = tau.
    """

    def __init__(self, declares):
        super().__init__(name="ramp")
        self.declare_dynamic_parameter("c", 0.3)
        self.declare_continuous_state(
            [0.0], ode=lambda t, s, c: [1.0], derivatives=lambda *a, **b: {}
        )
        self.declare_discrete_state([0.0])
        self.declare_zero_crossing(
            lambda t, s, c: [s.continuous_state[0] - 2.0, s.continuous_state[0] - c - 0.5 * t],
            self.reset,
            name="two",
            size=2,
            guard_derivatives=self.of_guard if declares else None,
            reset_derivatives=self.of_reset if declares else None,
        )

    def of_guard(self, time, state, *, c):
        return {"continuous_state": [1.0, 1.0], "c": [0.0, -1.0], "time": [0.0, -0.5]}

    def reset(self, time, state, *, c):
        return state.with_continuous_state([2.0 * state.continuous_state[0]]).with_discrete_state(
            [time]
        )

    def of_reset(self, time, state, *, c):
        return {"continuous_state": [2.0, 0.0], "time": [0.0, 1.0]}


@pytest.mark.parametrize("declares", [False, True])
def test_a_guard_and_a_reset_map_that_read_the_time(declares):
    run = saltus.simulate(
        Ramp(declares), (0.0, 0.9), sensitivity=["c", "x[0]"], python="called", **TIGHT
    )
    assert run.events.times("two") == pytest.approx([0.6])
    # x0 moves tau by -2 and the state before by 1: x = 2 (x0 + tau) + t - tau.
    np.testing.assert_allclose(run.events.dt_dp("two"), [[2.0, -2.0]], atol=1e-9)
    np.testing.assert_allclose(run.sensitivities.continuous_state, [[2.0, 0.0]], atol=1e-9)
    np.testing.assert_allclose(run.sensitivities.discrete_state, [[2.0, -2.0]], atol=1e-9)
    assert saltus.check_derivatives(Ramp(declares)) == ()


class Pair(saltus.LeafSystem):
    """x' = a v - u x of the inputs u and v, which its functions take in the other order."""

    def __init__(self, declares):
        super().__init__(name="pair")
        self.declare_dynamic_parameter("a", 1.5)
        self.declare_input_port("u", shape=())
        self.declare_input_port("v", shape=2)
        self.declare_continuous_state(
            [1.0],
            ode=lambda t, s, v, u, a: [a * float(v[1]) - float(u) * float(s.continuous_state[0])],
            derivatives=self.of_ode if declares else None,
            requires_inputs=[1, 0],
        )
        self.declare_continuous_state_output("x")

    def of_ode(self, time, state, v, u, a):
        return {"continuous_state": -u, "u": -state.continuous_state, "v": [0.0, a], "a": v[1]}


@pytest.mark.parametrize("enabled", [False, True])
def test_named_inputs_and_a_part_that_is_executed_at_times(enabled):
    def derivatives(declares):
        builder = saltus.DiagramBuilder()
        pair = Pair(declares)
        part = builder.add(EnabledSubsystem(pair, name="part") if enabled else pair)
        u, v = builder.add(Sine(frequency=2.0, name="u"), Constant([3.0, 4.0], name="v"))
        builder.connect(u.output(), part.input("u"))
        builder.connect(v.output(), part.input("v"))
        if enabled:
            pulse = builder.add(Pulse(period=1.0, name="pulse"))
            builder.connect(pulse.output(), part.input("enable"))
        names = ["u.frequency", "v.value", "part.pair.a" if enabled else "pair.a"]
        run = saltus.simulate(
            builder.build(), (0.0, 1.8), sensitivity=names, python="called", **TIGHT
        )
        return run.sensitivities.continuous_state

    # Differences of smooth functions have errors of 1e-10 of values of some 10.
    np.testing.assert_allclose(derivatives(True), derivatives(False), rtol=1e-7, atol=1e-8)
    assert np.abs(derivatives(True)[0, [0, 2, 3]]).min() > 1e-3


def test_linearize_takes_them():
    line = saltus.linearize(diagram(), outputs=None, inputs=["follower.a"])
    np.testing.assert_array_equal(line.A, [[-2.0, 0.0], [0.0, -3.0]])
    np.testing.assert_array_equal(line.B, [[-1.0, 0.0], [0.0, 0.0]])


def test_what_is_declared_is_said():
    words = saltus.Simulator(Decay(), sensitivity=["k"], python="called").describe()
    assert "declared derivatives of the derivative of block 'decay'" in words
    words = saltus.Simulator(Decay(declares=False), sensitivity=["k"], python="called").describe()
    assert "central differences of the derivative of block 'decay'" in words
    said = [one for one in Decay().explain() if one.callback.startswith("derivatives of")]
    assert len(said) == 3
    assert all("declared" in one.reason for one in said)


def test_a_wrong_derivative_is_found():
    (wrong,) = saltus.check_derivatives(Decay(by_k=1.0))
    assert wrong.function == "the derivative of block 'decay'"
    assert (wrong.by, wrong.row, wrong.declared) == ("k", 0, 1.0)
    assert wrong.difference == pytest.approx(-1.0)
    assert saltus.check_derivatives(Decay()) == ()


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"continuous_state": [[1.0, 2.0]]}, r"expected shape \(1, 1\), found \(1, 2\)"),
        ({"kk": 1.0}, "unknown value 'kk'.*'k'"),
        ([1.0], "expected a dict"),
        ({"k": math.nan}, "expected finite numbers, found nan in row 0, by k"),
    ],
)
def test_an_error_names_block_and_time(given, words):
    block = saltus.LeafSystem(name="tank")
    block.declare_dynamic_parameter("k", 2.0)
    block.declare_continuous_state(
        [1.0],
        ode=lambda t, s, k: [-k * float(s.continuous_state[0])],
        derivatives=lambda t, s, k: given,
    )
    with pytest.raises(saltus.Error, match=words) as raised:
        saltus.simulate(block, (0.0, 1.0), sensitivity=["k"], python="called")
    assert "t = " in str(raised.value)
    assert "block 'tank'" in str(raised.value)


def test_a_run_without_derivatives_does_not_call_them():
    calls = []
    block = saltus.LeafSystem(name="tank")
    block.declare_continuous_state(
        [1.0],
        ode=lambda t, s: [-float(s.continuous_state[0])],
        derivatives=lambda t, s: calls.append(t) or {"continuous_state": -1.0},
    )
    saltus.simulate(block, (0.0, 1.0), python="called")
    assert calls == []
    saltus.simulate(block, (0.0, 1.0), python="called", sensitivity=["x[0]"])
    assert calls
