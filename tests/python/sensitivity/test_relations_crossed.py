"""Relations of library blocks, and guards that return truths, pass their roots with a derivative."""

import numpy as np
import pytest
import saltus
from saltus.library import (
    Abs,
    Adder,
    Clock,
    Comparator,
    DeadZone,
    EnabledSubsystem,
    FunctionBlock,
    Gain,
    Integrator,
    LookupTable1d,
    MinMax,
    Quantizer,
    RateLimiter,
    Relay,
    Saturate,
    Sign,
    Sine,
    StateMachine,
    Transition,
    TriggeredSubsystem,
    UnitDelay,
    ZeroOrderHold,
)

METHODS = ["auto", "dop853", "radau", "bdf"]


def differences(system, names, end, shift=1e-5):
    """Central differences of runs: 1e-12 / h by their tolerance, and some h^2; below 1e-6."""

    def run(name, value):
        start = system.create_context().with_parameter(name, value)
        ended = saltus.simulate(system, start, (0.0, end), rtol=1e-12, atol=1e-14).context
        return np.concatenate([ended.continuous_state, ended.discrete_state])

    at = system.create_context().parameters
    values = [float(np.ravel(at[name])[0]) for name in names]
    return np.transpose([
        (run(name, value + shift) - run(name, value - shift)) / (2 * shift)
        for name, value in zip(names, values, strict=True)
    ])  # fmt: skip


def check(system, names, end):
    expected = differences(system, names, end)
    for method in METHODS:
        for rtol in (1e-6, 1e-8, 1e-10):
            results = saltus.simulate(
                system, (0.0, end), sensitivity=names, ode_solver_method=method, rtol=rtol,
                atol=rtol / 100)  # fmt: skip
            assert results.sensitivity_gaps == (), (method, rtol)
            found = np.vstack(
                [results.sensitivities.continuous_state, results.sensitivities.discrete_state]
            )
            # The events are off by some hundred tolerances with multistep methods (S grows by 40 here).
            allowed = max(1e4 * rtol, 1e-5)
            np.testing.assert_allclose(
                found, expected, rtol=allowed, atol=allowed, err_msg=f"{method} {rtol}"
            )


def loop(block, second=False):
    """x' = f(2 sin(1.3 t + 0.2) + 0.3 x) - x/2, where f crosses its relations with a slope."""
    b = saltus.DiagramBuilder()
    s, x, a, g, h, e, k = b.add(
        Sine(amplitude=1.9, frequency=1.3, phase=0.2, name="s"), Integrator(0.3, name="x"),
        Adder("++", name="a"), Gain(0.3, name="g"), Gain(-0.5, name="h"), Adder("++", name="e"),
        block)  # fmt: skip
    for source, target in ((x, g.input()), (s, a.input(0)), (g, a.input(1)), (a, k.input(0)),
                           (k, e.input(0)), (x, h.input()), (h, e.input(1)),
                           (e, x.input())):  # fmt: skip
        b.connect(source.output(), target)
    if second:
        b.connect(x.output(), k.input(1))
    return b.build()


BLOCKS = {
    "Abs": lambda: loop(Abs(name="k")),
    "Sign": lambda: loop(Sign(name="k")),
    "MinMax max": lambda: loop(MinMax("max", 2, name="k"), True),
    "MinMax min": lambda: loop(MinMax("min", 2, name="k"), True),
    "Quantizer": lambda: loop(Quantizer(0.3, name="k")),
    "Quantizer with hysteresis": lambda: loop(Quantizer(0.3, hysteresis=0.1, name="k")),
    "Saturate": lambda: loop(Saturate(-1.0, 0.5, name="k")),
    "DeadZone": lambda: loop(DeadZone(0.5, name="k")),
    "Relay": lambda: loop(Relay(0.5, -0.4, 1.0, -1.0, name="k")),
    "Comparator": lambda: loop(Comparator(">", name="k"), True),
    "LookupTable1d": lambda: loop(LookupTable1d([-1.0, 0.0, 1.0], [1.0, 0.0, 3.0], name="k")),
    "LookupTable1d flat": lambda: loop(
        LookupTable1d([-1.0, 0.0, 1.0], [1.0, 0.0, 3.0], "flat", name="k")
    ),
    "RateLimiter": lambda: loop(RateLimiter(1.0, -0.8, name="k")),
    "FunctionBlock of a truth": lambda: loop(FunctionBlock(lambda u: u > 0.3, name="k")),
    "ZeroOrderHold": lambda: loop(ZeroOrderHold(dt=0.13, name="k")),
}


@pytest.mark.parametrize("block", BLOCKS)
def test_a_relation_in_a_loop(block):
    check(BLOCKS[block](), ["g.gain", "s.frequency", "s.phase"], 7.3)


def machine(first, second):
    """A thermostat as a state machine: x' = u - 0.4 x, with u = 1.5 up to hi and -0.7 down to lo."""
    transitions = [
        Transition("a", "b", **{first: lambda x, hi: x > hi},
                   action=lambda n, time: {"n": n + time}),
        Transition("b", "a", **{second: lambda x, lo: x < lo}),
    ]  # fmt: skip
    b = saltus.DiagramBuilder()
    m, x, g, a = b.add(
        StateMachine(["a", "b"], transitions, inputs=["x"], variables={"n": 0.0},
                     parameters={"hi": 1.0, "lo": 0.3}, outputs={"u": {"a": 1.5, "b": -0.7}},
                     name="m"),
        Integrator(0.0, name="x"), Gain(-0.4, name="g"), Adder("++", name="a"))  # fmt: skip
    b.connect(x.output(), m.input("x"))
    b.connect(m.output("u"), a.input(0))
    b.connect(x.output(), g.input())
    b.connect(g.output(), a.input(1))
    b.connect(a.output(), x.input())
    return b.build()


@pytest.mark.parametrize("first", ["trigger", "guard"])
@pytest.mark.parametrize("second", ["trigger", "guard"])
def test_transitions_by_truths(first, second):
    system, names = machine(first, second), ["m.hi", "m.lo", "g.gain"]
    expected = differences(system, names, 9.0)
    results = saltus.simulate(system, (0.0, 9.0), sensitivity=names, rtol=1e-10, atol=1e-12)
    assert results.sensitivity_gaps == ()
    end = results.sensitivities
    found = np.vstack([end.continuous_state, end.discrete_state])
    # The time at which a state was entered is a discrete state of the machine, too.
    np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-5)


def enabled(states):
    inner = saltus.DiagramBuilder()
    x, g = inner.add(Integrator(1.0, name="x"), Gain(-0.5, name="g"))
    inner.connect(x.output(), g.input())
    inner.connect(g.output(), x.input())
    inner.export_output(x.output(), "y")
    b = saltus.DiagramBuilder()
    part, s, y = b.add(
        EnabledSubsystem(inner.build(name="i"), name="part", states=states),
        Sine(frequency=1.7, phase=0.3, bias=0.2, name="s"), Integrator(0.0, name="y"))  # fmt: skip
    b.connect(s.output(), part.input(0))
    b.connect(part.output(0), y.input())
    return b.build()


@pytest.mark.parametrize("states", ["held", "reset"])
def test_an_enabled_subsystem(states):
    check(enabled(states), ["s.phase", "s.bias"], 7.0)


def test_a_triggered_subsystem():
    inner = saltus.DiagramBuilder()
    u, a = inner.add(UnitDelay(-1, name="u"), Adder("++", name="a"))
    inner.connect(u.output(), a.input(0))
    inner.connect(a.output(), u.input())
    inner.export_input(a.input(1), "in")
    inner.export_output(a.output(), "out")
    b = saltus.DiagramBuilder()
    t, s, c, y = b.add(
        TriggeredSubsystem(inner.build(name="i"), name="t"),
        Sine(frequency=1.7, phase=0.3, bias=0.2, name="s"), Clock(name="c"),
        Integrator(0.0, name="y"))  # fmt: skip
    b.connect(c.output(), t.input(0))
    b.connect(s.output(), t.input(1))
    b.connect(t.output(0), y.input())
    check(b.build(), ["s.phase", "s.frequency"], 9.0)


# A guard that jumps from -1 to 1 at t = p, or where x = t reaches p.
JUMPING = {
    "where": lambda t, s, p: np.where(t > p, 1.0, -1.0),
    "a truth": lambda t, s, p: t > p,
    "sign": lambda t, s, p: np.sign(t - p),
    "floor": lambda t, s, p: np.floor(t / p) - 0.5,
    "a state": lambda t, s, p: np.where(s.continuous_state[0] > p, 1.0, -1.0),
}


@pytest.mark.parametrize("guard", JUMPING)
def test_a_traced_guard_that_jumps(guard):
    """x' = 1, y' = x, and at p y gains x: y(2) = 2 + p, and the event moves with p."""
    block = saltus.LeafSystem(name="block")
    block.declare_dynamic_parameter("p", 0.7)
    block.declare_continuous_state([0.0, 0.0], ode=lambda t, s, p: [1.0, s.continuous_state[0]])
    block.declare_zero_crossing(
        JUMPING[guard],
        lambda t, s, p: [s.continuous_state[0], s.continuous_state[1] + s.continuous_state[0]],
        name="g", direction="rising")  # fmt: skip
    results = saltus.simulate(block, (0.0, 2.0), sensitivity=["p"])
    assert results.sensitivity_gaps == ()
    np.testing.assert_allclose(results.sensitivities.continuous_state[:, 0], [0.0, 1.0], atol=1e-9)
    assert results.events.dt_dp("g")[0, 0] == pytest.approx(1.0, rel=1e-9)
