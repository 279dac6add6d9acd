"""Jumps of the flow without an event: their times move, and the derivatives have the jump term."""

import math

import numpy as np
import pytest
import saltus
from saltus.library import Adder, FunctionBlock, Gain, Integrator, Sine
from scenes_with_derivatives import METHODS

T = 6.1
VALUES = {"w": 1.3, "p": 0.2}
JUMPING = [m for m in METHODS if m != "taylor"]  # which refuses flows with kinks and jumps

# x' = f - x/2 with one of these f, a function of the time, w and p that jumps where w and p say.
FORCINGS = {
    "where": lambda t, w, p: np.where(np.sin(w * t + p) > 0.3, np.sin(w * t + p), -np.cos(t)),
    "a step": lambda t, w, p: np.where(t > 5 * p, w, 0.0),
    "a pulse": lambda t, w, p: np.where((t > 5 * p) & (t < 3 * w), w, p),
    "equal": lambda t, w, p: np.where(np.floor(2 * np.sin(w * t + p)) == 1.0, 1.0, -0.5),
    "floor": lambda t, w, p: np.floor(2 * np.sin(w * t + p)),
    "ceil": lambda t, w, p: np.ceil(2 * np.sin(w * t + p)),
    "trunc": lambda t, w, p: np.trunc(2 * np.sin(w * t + p)),
    "rint": lambda t, w, p: np.rint(3 * np.sin(w * t + p)),
    "sign": lambda t, w, p: np.sign(np.sin(w * t + p)),
    "copysign": lambda t, w, p: np.copysign(w, np.sin(w * t + p)),
    "mod": lambda t, w, p: np.mod(np.sin(w * t + p), 0.4),
    "fmod": lambda t, w, p: np.fmod(np.sin(w * t + p), 0.4),
    "floor divide": lambda t, w, p: t // (w * p + 0.2),
    "a period": lambda t, w, p: np.where(t % (w / 2) < p, w, 0.0),
    "arctan2": lambda t, w, p: np.arctan2(np.sin(w * t + p), np.cos(w * t + p)),
    "arctan of tan": lambda t, w, p: np.arctan(np.tan(w * t + p)),
    "sign of a pole": lambda t, w, p: np.sign(1.0 / (t - 3 * w)),
    "nested": lambda t, w, p: np.where(np.floor(w * t + p) > 2.5, w, p),
    "two at once": lambda t, w, p: np.where(t > 5 * p, w, 0.0) + np.where(t <= 5 * p, 0.0, 1.0),
    "selected": lambda t, w, p: np.where(t > w, np.where(t < 5.0 - p, 1.0, w), np.floor(t + p)),
}


def forced(forcing):
    return saltus.system_of(
        lambda t, x, w, p: [forcing(t, w, p) - 0.5 * x[0]], [0.0], parameters=dict(VALUES)
    )


def differences(system, names, end=T, shift=1e-4):
    """Central differences of runs that find each jump to the tolerance 1e-11. With the shift h the
    error is 1e-11 / h by the runs, and x''' h^2 / 6 with some 20 for x''': below 1e-6.
    """

    def run(name, value):
        start = system.create_context().with_parameter(name, value)
        options = {"rtol": 1e-11, "atol": 1e-13, "max_minor_step_size": 5e-3}
        return saltus.simulate(system, start, (0.0, end), **options).context.continuous_state

    at = system.create_context().parameters
    found = []
    for name in names:
        value = float(np.ravel(at[name])[0])
        found.append((run(name, value + shift) - run(name, value - shift)) / (2 * shift))
    return np.transpose(found)


@pytest.mark.parametrize("name", FORCINGS)
def test_a_jump_that_a_parameter_moves(name):
    system = forced(FORCINGS[name])
    expected = differences(system, ["w", "p"])
    for method in JUMPING:
        results = saltus.simulate(
            system, (0.0, T), sensitivity=["w", "p"], ode_solver_method=method,
            rtol=1e-9, atol=1e-11)  # fmt: skip
        assert results.sensitivity_gaps == (), method
        found = results.sensitivities.continuous_state
        # 1e-6 of the differences; the scenes have derivatives up to 60.
        np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-5, err_msg=method)


@pytest.mark.parametrize("name", [name for name in FORCINGS if name != "sign of a pole"])
def test_a_called_function_that_jumps_has_a_gap(name):
    system = forced(FORCINGS[name])
    results = saltus.simulate(
        system, (0.0, T), sensitivity=["w", "p"], python="called", rtol=1e-9, atol=1e-11
    )
    expected = differences(system, ["w", "p"])
    found = results.sensitivities.continuous_state
    lost = {gap.parameter for gap in results.sensitivity_gaps}
    for k, parameter in enumerate(("w", "p")):
        if parameter in lost:
            assert np.isnan(found[:, k]).all()
        else:  # as w of a step at 5 p, which moves nothing
            np.testing.assert_allclose(found[:, k], expected[:, k], rtol=1e-5, atol=1e-5)
    assert lost


@pytest.mark.parametrize("method", JUMPING)
@pytest.mark.parametrize("size", [1.0, 1e-2, 1e-3])
def test_a_small_jump_of_a_called_function_has_a_gap(size, method):
    """Beside a smooth part that varies by 1: p moves the jump only, q nothing but the smooth part."""
    system = saltus.system_of(
        lambda t, x, p, q: [q * np.sin(3 * t) + (size if t > 5 * p else 0.0)], [0.0],
        parameters={"p": 0.2, "q": 1.0})  # fmt: skip
    results = saltus.simulate(
        system, (0.0, 3.0), sensitivity=["p", "q"], python="called", ode_solver_method=method
    )
    assert {gap.parameter for gap in results.sensitivity_gaps} == {"p"}
    found = results.sensitivities.continuous_state[0]
    assert np.isnan(found[0])
    assert found[1] == pytest.approx((1 - np.cos(9.0)) / 3, rel=1e-5)


@pytest.mark.parametrize("method", JUMPING)
def test_a_traced_block_beside_a_called_one_has_a_gap(method):
    b = saltus.DiagramBuilder()
    s, k, c, x, e = b.add(
        Sine(frequency=1.3, name="s"), FunctionBlock(lambda u: np.sign(u - 0.3), name="k"),
        FunctionBlock(lambda u: 0.0 if float(u) > 9.0 else math.sin(float(u)), name="c"), Integrator(0.0, name="x"),
        Adder("++", name="e"))  # fmt: skip
    for source, target in ((s, k.input()), (x, c.input()), (k, e.input(0)), (c, e.input(1)),
                           (e, x.input())):  # fmt: skip
        b.connect(source.output(), target)
    results = saltus.simulate(
        b.build(), (0.0, 3.0), sensitivity=["s.phase", "x.x[0]"], ode_solver_method=method
    )
    assert {gap.parameter for gap in results.sensitivity_gaps} == {"s.phase"}
    found = results.sensitivities.continuous_state[0]
    assert np.isnan(found[0]) and np.isfinite(found[1])


@pytest.mark.parametrize("python", ["traced", "called"])
def test_a_jump_at_a_fixed_time_has_no_gap(python):
    """x' = p where t > 2 and 0 before, less x: dx(3)/dp = 1 - 1/e."""
    system = saltus.system_of(
        lambda t, x, p: [np.where(t > 2.0, p, 0.0) - x[0]], [0.0], parameters={"p": 0.7}
    )
    results = saltus.simulate(system, (0.0, 3.0), sensitivity=["p", "x[0]"], python=python,
                              rtol=1e-9, atol=1e-11)  # fmt: skip
    assert results.sensitivity_gaps == ()
    np.testing.assert_allclose(
        results.sensitivities.continuous_state[0], [1 - np.exp(-1.0), np.exp(-3.0)], rtol=1e-6
    )


@pytest.mark.parametrize("method", JUMPING)
def test_a_kink_that_moves_has_no_jump_term(method):
    """x' = |t - p|: x(2) = (p^2 + (2 - p)^2) / 2, so dx/dp = 2 p - 2."""
    kinks = {
        "abs": lambda t, x, p: [np.abs(t - p)],
        "maximum": lambda t, x, p: [np.maximum(t - p, p - t)],
        "where": lambda t, x, p: [np.where(t > p, t - p, p - t)],
    }
    for kink in kinks.values():
        system = saltus.system_of(kink, [0.0], parameters={"p": 0.7})
        results = saltus.simulate(system, (0.0, 2.0), sensitivity=["p"], rtol=1e-8, atol=1e-10,
                                  ode_solver_method=method)  # fmt: skip
        assert results.sensitivity_gaps == ()
        # A step across the kink has an error of sqrt(rtol) at most.
        assert results.sensitivities.continuous_state[0, 0] == pytest.approx(-0.6, abs=2e-4)


@pytest.mark.parametrize("method", JUMPING)
@pytest.mark.parametrize("formula", [False, True])
@pytest.mark.parametrize("name", ["where", "floor", "mod"])
def test_a_block_behind_a_source(name, formula, method):
    function = {
        "where": lambda u: np.where(u > 0.3, u, -u),
        "floor": np.floor,
        "mod": lambda u: np.mod(u, 0.4),
    }[name]
    b = saltus.DiagramBuilder()
    s, k, x, h, e = b.add(
        Sine(amplitude=1.9, frequency=1.3, phase=0.2, name="s"),
        FunctionBlock(function, name="k", formula=formula), Integrator(0.0, name="x"),
        Gain(-0.5, name="h"), Adder("++", name="e"))  # fmt: skip
    for source, target in ((s, k.input()), (k, e.input(0)), (x, h.input()), (h, e.input(1)),
                           (e, x.input())):  # fmt: skip
        b.connect(source.output(), target)
    diagram = b.build()
    names = ["s.phase", "s.amplitude"]
    results = saltus.simulate(
        diagram, (0.0, T), sensitivity=names, ode_solver_method=method, rtol=1e-9, atol=1e-11
    )
    assert results.sensitivity_gaps == ()
    np.testing.assert_allclose(
        results.sensitivities.continuous_state, differences(diagram, names), rtol=1e-5, atol=1e-5
    )


class Timer(saltus.LeafSystem):
    """A level with the rate r is full at 1 / r, and 1/2 s later the outflow 3 begins."""

    def __init__(self):
        super().__init__(name="timer")
        self.declare_dynamic_parameter("r", 1.0)
        self.declare_continuous_state([0.0, 0.0], ode=self.ode)
        self.declare_discrete_state([1e9])
        self.declare_zero_crossing(
            lambda t, s, r: s.continuous_state[0] - 1.0,
            lambda t, s, r: s.with_discrete_state([t + 0.5]), name="full",
            direction="rising")  # fmt: skip

    def ode(self, t, s, r):
        return [r, np.where(t > s.discrete_state[0], 3.0, 0.0)]


@pytest.mark.parametrize("python", ["traced", "called"])
def test_a_time_that_an_event_wrote(python):
    results = saltus.simulate(Timer(), (0.0, 4.0), sensitivity=["r", "x[0]"], python=python)
    found = results.sensitivities.continuous_state[1]
    if python == "called":
        assert np.isnan(found).all() and len(results.sensitivity_gaps) == 2
    else:  # 3 (4 - (1 - x0) / r - 1/2)
        np.testing.assert_allclose(found, [3.0, 3.0], rtol=1e-6)


BRANCHES = {
    "where": lambda t, s, a: [np.where(s.continuous_state[0] < a, 2.0, 1.0)],
    "sign": lambda t, s, a: [1.5 - 0.5 * np.sign(s.continuous_state[0] - a)],
    "floor": lambda t, s, a: [2.0 - np.clip(np.floor(s.continuous_state[0] / a), 0.0, 1.0)],
}


def block_of(ode, start, **parameters):
    block = saltus.LeafSystem(name="block")
    for name, value in parameters.items():
        block.declare_dynamic_parameter(name, value)
    block.declare_continuous_state(start, ode=ode)
    return block


@pytest.mark.parametrize("method", JUMPING)
@pytest.mark.parametrize("branch", BRANCHES)
def test_a_jump_at_a_state(branch, method):
    """x' = 2 below a and 1 above: x(2) = a + 2 - (a - x0) / 2."""
    block = block_of(BRANCHES[branch], [0.3], a=1.0)
    results = saltus.simulate(
        block, (0.0, 2.0), sensitivity=["x[0]", "a"], ode_solver_method=method
    )
    assert results.sensitivity_gaps == ()
    np.testing.assert_allclose(results.sensitivities.continuous_state, [[0.5, 0.5]], rtol=1e-6)


# --- where there is none

NONE = {
    "two that move apart": (
        lambda t, x, p: [np.where(t > p, 1.0, 0.0) * np.where(t > 1.4 - p, 2.0, 3.0)], 0.0, 0.7),
    "at the start": (lambda t, x, p: [np.where(t > p, 1.0, 0.0)], 0.0, 0.0),
    "at the end": (lambda t, x, p: [np.where(t > p, 1.0, 0.0)], 0.0, 2.0),
    "a state at the start": (lambda t, x, p: [np.where(x[0] > p, 2.0, 1.0)], 0.7, 0.7),
}  # fmt: skip


@pytest.mark.parametrize("method", JUMPING)
@pytest.mark.parametrize("name", NONE)
def test_there_is_a_gap_where_there_is_no_derivative(name, method):
    ode, start, p = NONE[name]
    system = saltus.system_of(ode, np.atleast_1d(start), parameters={"p": p})
    results = saltus.simulate(system, (0.0, 2.0), sensitivity=["p"], ode_solver_method=method)
    assert np.isnan(results.sensitivities.continuous_state[-1]).all()
    assert {gap.parameter for gap in results.sensitivity_gaps} == {"p"}
    assert all("jump" in gap.reason for gap in results.sensitivity_gaps)


@pytest.mark.parametrize("fixed", [True, False])
def test_an_event_at_the_time_of_a_jump(fixed):
    """A tick at 0.4 s samples x, which the jump at t = d makes one-sided; a jump at a fixed time does not."""
    block = block_of(
        (lambda t, s, d: [np.where(t > 0.4, d, 0.0)]) if fixed
        else (lambda t, s, d: [np.where(t > d, 1.0, 0.0)]), [0.0], d=0.4)  # fmt: skip
    block.declare_discrete_state([0.0])
    block.declare_periodic_update(
        lambda t, s, d: s.with_discrete_state([s.continuous_state[0]]), period=0.2
    )
    results = saltus.simulate(block, (0.0, 1.0), sensitivity=["d"])
    if fixed:
        assert results.sensitivity_gaps == ()
        assert results.sensitivities.continuous_state[0, 0] == pytest.approx(0.6, rel=1e-6)
    else:
        assert np.isnan(results.sensitivities.continuous_state).all()
        assert "the flow jumps at the time of the event" in results.sensitivity_gaps[0].reason


def test_an_event_that_moves_with_the_jump():
    """A guard t - p adds 1 to y at the time at which x' goes from 0 to 3: dx/dp = -3, dy/dp = 0."""
    block = block_of(lambda t, s, p: [np.where(t > p, 3.0, 0.0), 0.0], [0.0, 0.0], p=0.7)
    block.declare_zero_crossing(
        lambda t, s, p: t - p,
        lambda t, s, p: s.continuous_state + np.array([0.0, 1.0]), name="on",
        direction="rising")  # fmt: skip
    results = saltus.simulate(block, (0.0, 2.0), sensitivity=["p"])
    assert results.sensitivity_gaps == ()
    np.testing.assert_allclose(results.sensitivities.continuous_state[:, 0], [-3.0, 0.0], atol=1e-6)


@pytest.mark.parametrize("method", JUMPING)
def test_rows_and_times_between_them(method):
    """x' = 1 after p: dx/dp is 0 before, -1 after, and has one-sided values at the row t = p."""
    block = block_of(lambda t, s, p: [np.where(t > p, 1.0, 0.0)], [0.0], p=0.5)
    block.declare_continuous_state_output("x")
    results = saltus.simulate(
        block, (0.0, 1.0), sensitivity=["p"], save_at=[0.25, 0.5, 0.75], dense_output=True,
        recorded_signals={"x": block.output("x")}, ode_solver_method=method)  # fmt: skip
    rows = np.ravel(results.sensitivities["x"])
    assert results.time.tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]
    np.testing.assert_allclose(rows, [0.0, 0.0, np.nan, -1.0, -1.0], atol=1e-6)
    assert [gap.time for gap in results.sensitivity_gaps] == [0.5]
    dense = results.sensitivities([0.4, 0.499, 0.501, 0.9])
    np.testing.assert_allclose(dense.continuous_state[:, 0, 0], [0, 0, -1, -1], atol=1e-6)


@pytest.mark.parametrize("duty", [0.4, 0.25])
def test_a_buck_converter_in_its_period(duty):
    """x' = 1 - x in the part d of each second, else -x. In the periodic state x0 = (e^d - 1) / (e - 1),
    so dx0/dd = e^d / (e - 1); over one period dx(1)/dd = e^(d - 1).
    """
    buck = saltus.system_of(
        lambda t, x, d: [np.where(t % 1.0 < d, 1.0, 0.0) - x[0]], [0.3], parameters={"d": duty}
    )
    orbit = saltus.periodic_orbit(buck, period=1.0, wrt=["d"])
    assert np.ravel(orbit.dx0("d"))[0] == pytest.approx(np.exp(duty) / (np.e - 1), rel=1e-6)
    gamma = saltus.period_map(buck, 1.0, inputs=["d"]).Gamma
    assert np.ravel(gamma)[0] == pytest.approx(np.exp(duty - 1), rel=1e-6)


def test_a_fit_of_the_time_of_a_dose():
    """x' = 5 - k x from the time `start` on; the data are exact, so are the parameters."""
    dose = saltus.system_of(
        lambda t, x, start, k: [np.where(t > start, 5.0, 0.0) - k * x[0]], [0.0],
        parameters={"start": 1.01, "k": 0.7})  # fmt: skip
    times = np.linspace(0.1, 5.0, 50)
    data = np.where(times > 1.4, 5 / 0.7 * (1 - np.exp(-0.7 * (times - 1.4))), 0.0)
    found = saltus.fit(
        dose, {"time": times, "x[0]": data}, {"start": saltus.Free(1.01, 0.2, 3.0), "k": 0.7}
    )
    assert found.parameters["start"] == pytest.approx(1.4, rel=1e-6)
    assert found.parameters["k"] == pytest.approx(0.7, rel=1e-6)


def test_islands_have_their_own_jumps():
    """x' = 1 where sin(2 t + phase) > 0.5, in two islands: on from (pi/6 - phase)/2 to (5 pi/6 - phase)/2."""
    b = saltus.DiagramBuilder()
    for k in ("a", "b"):
        s, f, x = b.add(Sine(frequency=2.0, name=f"s{k}"),
                        FunctionBlock(lambda u: np.where(u > 0.5, 1.0, 0.0), name=f"f{k}"),
                        Integrator(0.0, name=f"x{k}"))  # fmt: skip
        b.connect(s.output(), f.input())
        b.connect(f.output(), x.input())
    results = saltus.simulate(b.build(), (0.0, 1.0), sensitivity=["sa.phase"], islands=True)
    assert results.sensitivity_gaps == ()
    np.testing.assert_allclose(results.sensitivities.continuous_state[:, 0], [0.5, 0.0], atol=1e-6)
