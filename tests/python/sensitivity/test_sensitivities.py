"""Laws of the option `sensitivity`: the run stays as it is, gaps are named, errors help."""

import pickle

import numpy as np
import pytest
import saltus
from saltus.library import Gain, Integrator, Sine
from scenes_with_derivatives import METHODS, Room, Throw


def bits(results):
    arrays = [results.time, results.jump, results.context.continuous_state]
    arrays += [results.outputs[name] for name in results.outputs]
    return [array.tobytes() for array in arrays] + [
        (e.time, e.kind, e.name, e.after.tobytes()) for e in results.events
    ]


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("make", [lambda: Throw(9.81, 0.5, 2.0), Room], ids=["ball", "room"])
def test_the_run_is_the_same_to_the_bit(make, method, python):
    if (method, python) == ("taylor", "called"):
        pytest.skip("taylor needs expressions")
    system = make()
    options = {"ode_solver_method": method, "python": python, "save_at": [0.3, 0.7, 1.9]}
    if system.output_ports:
        options["recorded_signals"] = {"state": system.output("state")}
    alone = saltus.simulate(system, (0.0, 3.0), **options)
    with_derivatives = saltus.simulate(system, (0.0, 3.0), sensitivity=["x[0]"], **options)
    assert bits(alone) == bits(with_derivatives)


def diagram():
    """x' = gain * amplitude sin(frequency t)"""
    builder = saltus.DiagramBuilder()
    source = builder.add(Sine(amplitude=2.0, frequency=3.0, name="source"))
    gain, x = builder.add(Gain(0.5, name="gain"), Integrator(0.0, name="x"))
    builder.connect(source.output(), gain.input())
    builder.connect(gain.output(), x.input())
    return builder.build(), {"x": x.output(), "gain": gain.output()}


def test_parameters_of_sources_and_gains_count():
    system, signals = diagram()
    names = ["gain.gain", "x.x[0]"]
    options = {"recorded_signals": signals, "rtol": 1e-10, "atol": 1e-12}
    results = saltus.simulate(system, (0.0, 2.0), sensitivity=names, **options)
    t = results.time
    by_gain = 2.0 * (1.0 - np.cos(3.0 * t)) / 3.0
    np.testing.assert_allclose(results.sensitivities["x"][:, 0], by_gain, atol=1e-8)
    np.testing.assert_allclose(results.sensitivities["x"][:, 1], 1.0)
    np.testing.assert_allclose(
        results.sensitivities["gain"][:, 0], 2.0 * np.sin(3.0 * t), atol=1e-8
    )


class Grazing(saltus.LeafSystem):
    """A parabola that touches zero at t = 1."""

    def __init__(self, lift=0.0):
        super().__init__(name="parabola")
        self.declare_dynamic_parameter("lift", lift)
        self.declare_continuous_state(
            [1.0, -2.0], ode=lambda t, s, lift: [s.continuous_state[1], 2.0]
        )
        self.declare_zero_crossing(
            lambda time, state, *, lift: state.continuous_state[0] + lift,
            lambda time, state, lift: state.with_continuous_state([5.0, 0.0]),
            name="touch",
            direction="positive_then_non_positive",
        )


def test_a_grazing_guard_is_a_gap_and_never_a_number():
    results = saltus.simulate(
        Grazing(-1e-10), (0.0, 2.0), sensitivity=["lift"], rtol=1e-6, atol=1e-8
    )
    (gap,) = results.sensitivity_gaps
    assert (gap.event, gap.parameter) == ("parabola.touch", "lift")
    assert gap.time == pytest.approx(1.0, abs=1e-4)
    assert "grazes" in gap.reason
    assert np.isnan(results.events.dt_dp("touch")).all()
    assert np.isnan(results.sensitivities.continuous_state).all()


class Twins(saltus.LeafSystem):
    """Two guards that are reached at one time, and reset maps that do not commute."""

    def __init__(self):
        super().__init__(name="twins")
        self.declare_continuous_state([1.0, 1.0], ode=lambda t, s: [-1.0, -1.0])
        for i in (0, 1):
            self.declare_zero_crossing(
                lambda time, state, i=i: state.continuous_state[i],
                lambda time, state, i=i: state.with_continuous_state(
                    [2.0, state.continuous_state[1]] if i == 0 else [state.continuous_state[0], 3.0]
                ),
                name=f"down{i}",
                direction="positive_then_non_positive",
            )


def test_a_tie_is_a_gap():
    results = saltus.simulate(Twins(), (0.0, 1.5), sensitivity=["x[0]"])
    (gap,) = results.sensitivity_gaps
    assert "another event happens at the same time" in gap.reason


@pytest.mark.parametrize(
    ("names", "words"),
    [
        (["h"], "unknown parameter or state 'h'"),
        (["mode"], "'mode' is a mode"),
        (["e", "e"], "'e' is named twice"),
        (["x[2]"], "'x' has 2 entries"),
        (["gg"], "did you mean 'g'"),
    ],
)
def test_a_name_without_a_derivative_is_refused(names, words):
    with pytest.raises(saltus.ModelError, match=words.replace("[", r"\[")):
        saltus.simulate(Throw(9.81, 0.5, 2.0), (0.0, 1.0), sensitivity=names)


def test_a_run_without_derivatives_says_how_to_get_them():
    results = saltus.simulate(Throw(9.81, 0.5, 2.0), (0.0, 1.0))
    with pytest.raises(saltus.ModelError, match="sensitivity="):
        _ = results.sensitivities
    with pytest.raises(saltus.ModelError, match="sensitivity="):
        results.events.dt_dp("bounce")


def test_describe_says_how_they_are_made():
    words = {}
    for python in ("traced", "called"):
        simulator = saltus.Simulator(Throw(9.81, 0.5, 2.0), sensitivity=["e"], python=python)
        words[python] = simulator.describe()
    assert "exact derivatives of the flow" in words["traced"]
    assert "central differences of the derivative of block 'ball'" in words["called"]


def van_der_pol(mu):
    block = saltus.LeafSystem(name="oscillator")
    block.declare_dynamic_parameter("mu", mu)

    def ode(time, state, *, mu):
        x, v = state.continuous_state
        return [v, mu * (1 - x * x) * v - x]

    block.declare_continuous_state([2.0, 0.0], ode=ode)
    return block


@pytest.mark.parametrize("mu", [1.0, 100.0])
@pytest.mark.parametrize("method", ["auto", "bdf", "radau"])
def test_van_der_pol_against_differences_of_tight_runs(method, mu):
    def end(value):
        run = saltus.simulate(
            van_der_pol(value), (0.0, 5.0), rtol=1e-13, atol=1e-14, ode_solver_method="radau"
        )
        return run.context.continuous_state

    step = 1e-4 * mu
    expected = (end(mu + step) - end(mu - step)) / (2 * step)
    results = saltus.simulate(
        van_der_pol(mu),
        (0.0, 5.0),
        sensitivity=["mu"],
        rtol=1e-9,
        atol=1e-11,
        ode_solver_method=method,
    )
    found = results.sensitivities.continuous_state[:, 0]
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-8)


def test_solve_sweep_and_pickle_have_them():
    options = {"sensitivity": ["k", "x[0]"], "rtol": 1e-9}
    solution = saltus.solve(lambda t, x, k: -k * x, (0, 1), [1.0], parameters={"k": 2.0}, **options)
    expected = [[-np.exp(-2.0), np.exp(-2.0)]]
    kept = pickle.loads(pickle.dumps(solution))
    for results in (solution, kept):
        np.testing.assert_allclose(results.sensitivities.continuous_state, expected, rtol=1e-8)
    with pytest.raises(saltus.ModelError, match="no place for derivatives"):
        solution.save("decay.npz")

    def slope(results):
        return results.sensitivities.continuous_state[1, 0]

    ball = Throw(9.81, 0.5, 2.0)
    swept = saltus.sweep(ball, {"e": [0.5, 0.7]}, (0.0, 1.0), sensitivity=["e"], reduce=slope)
    alone = saltus.simulate(ball, (0.0, 1.0), sensitivity=["e"])
    assert swept["slope"].values[0] == slope(alone) != 0.0
    with pytest.raises(saltus.ModelError, match="say with reduce"):
        saltus.sweep(ball, {"e": [0.5]}, (0.0, 1.0), sensitivity=["e"])
