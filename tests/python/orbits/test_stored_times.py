"""Orbits and period maps of systems whose discrete states keep the time of an event: they return
when the time since that event does.
"""

import numpy as np
import pytest
import saltus
from saltus.library import (
    Adder,
    Gain,
    Integrator,
    Pulse,
    Relay,
    StateMachine,
    Transition,
    TransferFunction,
)

RATE = 0.4
NEAR = 1e-8
"""ten times the sum of the errors of some hundred steps at the default rtol of 1e-10"""


def loop(controller, output, name="root"):
    """x' = u - RATE x, where the controller makes u of x."""
    builder = saltus.DiagramBuilder()
    m, x, gain, rate = builder.add(
        controller, Integrator(0.5, name="x"), Gain(-RATE, name="g"), Adder("++", name="rate")
    )
    builder.connect(x.output(), m.input(0))
    builder.connect(m.output(output), rate.input(0))
    builder.connect(x.output(), gain.input())
    builder.connect(gain.output(), rate.input(1))
    builder.connect(rate.output(), x.input())
    return builder.build(name=name)


def two_points():
    return StateMachine(
        ["a", "b"],
        [
            Transition("a", "b", trigger=lambda x: x > 1.0),
            Transition("b", "a", trigger=lambda x: x < 0.3),
        ],
        inputs=["x"],
        outputs={"u": {"a": 1.5, "b": -0.7}},
        name="m",
    )


def way(begin, end, u):
    """[s] The time from one level to another."""
    return np.log((u / RATE - begin) / (u / RATE - end)) / RATE


@pytest.mark.parametrize("section", ["m.a_to_b", "m.b_to_a", None])
def test_a_two_point_controller(section):
    orbit = saltus.periodic_orbit(loop(two_points(), "u"), section=section)
    assert orbit.status == "converged" and orbit.stable
    np.testing.assert_allclose(orbit.period, way(0.3, 1.0, 1.5) + way(1.0, 0.3, -0.7), atol=NEAR)


def test_its_derivatives_are_those_of_the_same_loop_without_a_stored_time():
    relay = Relay(1.0, 0.3, on_value=-0.7, off_value=1.5, name="m")
    found = [
        saltus.periodic_orbit(loop(block, output), section=section, wrt=["g.gain"])
        for block, output, section in ((two_points(), "u", "m.a_to_b"), (relay, "out", "m.turn_on"))
    ]
    np.testing.assert_allclose(found[0].dperiod(), found[1].dperiod(), rtol=1e-7)
    np.testing.assert_allclose(found[0].dx0(), found[1].dx0(), atol=1e-7)


def test_a_time_after_which_a_state_is_left():
    """x rises from 0.3 for 0.8 s, and falls back to 0.3."""
    timer = StateMachine(
        ["up", "down"],
        [
            Transition("up", "down", after=0.8),
            Transition("down", "up", trigger=lambda x: x < 0.3),
        ],
        inputs=["x"],
        outputs={"u": {"up": 1.5, "down": -0.7}},
        name="m",
    )
    orbit = saltus.periodic_orbit(loop(timer, "u"), section="m.up_to_down")
    top = 1.5 / RATE + (0.3 - 1.5 / RATE) * np.exp(-RATE * 0.8)
    np.testing.assert_allclose(orbit.period, 0.8 + way(top, 0.3, -0.7), atol=NEAR)
    np.testing.assert_allclose(orbit.x0, [top], atol=NEAR)


class Ramp(saltus.LeafSystem):
    """x' = (t - z) - x + drive sin(1.7 t); z becomes the time, t + ahead, where x rises to 1."""

    def __init__(self, drive=0.0, ahead=0.0):
        super().__init__(name="ramp")
        self.declare_continuous_state([0.2], ode=self.ode)
        self.declare_discrete_state([0.0])
        self.drive, self.ahead = drive, ahead
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - 1.0, self.keep, name="full", direction="rising"
        )

    def ode(self, t, state):
        since = t - state.discrete_state[0]
        return [since - state.continuous_state[0] + self.drive * np.sin(1.7 * t)]

    def keep(self, t, state):
        return state.with_discrete_state([t + self.ahead])


@pytest.mark.parametrize("begin", [0.0, 1000.0])
def test_a_leaf_that_keeps_the_time_of_a_reset(begin):
    """x(s) = s - 1 + 2 exp(-s) after a reset, which is 1 again at the root of s - 2 + 2 exp(-s)."""
    system = Ramp()
    start = system.create_context().with_time(begin).with_discrete_state([begin])
    orbit = saltus.periodic_orbit(system, start, section="full")
    period = 1.5936242600400401
    assert abs(period - 2 + 2 * np.exp(-period)) < 1e-15
    # times near 1000 s are doubles 1e-13 apart
    np.testing.assert_allclose(orbit.period, period, atol=NEAR)
    np.testing.assert_allclose(orbit.x0, [1.0], atol=NEAR)
    np.testing.assert_allclose(orbit.trivial, 1.0, atol=1e-6)


def test_a_drive_beside_a_stored_time_is_refused():
    with pytest.raises(saltus.ModelError, match="the time moves the system"):
        saltus.periodic_orbit(Ramp(drive=0.1), section="full")


def test_a_stored_time_that_is_no_event_s_is_refused_with_a_remedy():
    with pytest.raises(saltus.ModelError, match=r"keep the time of an event itself"):
        saltus.periodic_orbit(Ramp(ahead=0.25), section="full")


def pulsed():
    """A machine that is on for 0.5 s from each pulse, every 2 s, before a lag of 1 s."""
    machine = StateMachine(
        ["off", "on"],
        [
            Transition("off", "on", trigger=lambda call: call > 0.5),
            Transition("on", "off", after=0.5),
        ],
        inputs=["call"],
        outputs={"u": {"on": 1.0}},
        name="m",
    )
    builder = saltus.DiagramBuilder()
    call = builder.add(Pulse(period=2.0, pulse_width=0.1, phase_delay=0.25))
    m, lag = builder.add(machine, TransferFunction([1.0], [1.0, 1.0], name="lag"))
    builder.connect(call.output(), m.input(0))
    builder.connect(m.output("u"), lag.input())
    return builder.build()


def test_a_driven_system():
    """x(T) = x(0) e^-2 + e^-1.25 (1 - e^-0.5)."""
    system = pulsed()
    orbit = saltus.periodic_orbit(system, period=2.0)
    x0 = np.exp(-1.25) * (1 - np.exp(-0.5)) / (1 - np.exp(-2.0))
    assert orbit.status == "converged"
    np.testing.assert_allclose(orbit.x0, [x0], atol=NEAR)
    np.testing.assert_allclose(max(abs(orbit.multipliers)), np.exp(-2.0), atol=NEAR)


def test_a_period_map():
    system = pulsed()
    orbit = saltus.periodic_orbit(system, period=2.0)
    found = saltus.period_map(system, 2.0, orbit.context)
    assert found.is_fixed_point and found.stability == "stable"
    assert found.states == ("lag.x[0]", "m.z[0] - t")
    np.testing.assert_allclose(found.x1, found.x0, atol=NEAR)
    np.testing.assert_allclose(found.x0[1], 0.75 - 2.0, atol=1e-12)  # it went off at 0.75 s


def test_a_count_that_happens_to_be_the_time_of_a_tick():
    """z = 2, 1, 2, ... at 0 s, 1 s, 2 s, ...: no time, although it has the values of event times."""
    sides = saltus.LeafSystem(name="sides")
    sides.declare_continuous_state([0.0], ode=lambda t, s: s.discrete_state - s.continuous_state)
    sides.declare_discrete_state([1.0])
    sides.declare_periodic_update(
        lambda t, s: s.with_discrete_state(3.0 - s.discrete_state), period=1.0
    )
    orbit = saltus.periodic_orbit(sides, period=2.0)
    low = (np.exp(-1.0) + 2.0) / (1 + np.exp(-1.0))  # the value after the second with z = 2
    assert orbit.status == "converged"
    assert np.isclose(orbit.x0[0], low, atol=NEAR) or np.isclose(orbit.x0[0], 3 - low, atol=NEAR)
    np.testing.assert_allclose(orbit.multipliers, [np.exp(-2.0)], atol=NEAR)


def test_a_time_that_is_kept_and_never_read_again_is_no_unknown():
    """A machine that starts up after 0.37 s stays in its state; the loop has its own orbit."""
    boot = StateMachine(["boot", "run"], [Transition("boot", "run", after=0.37)], name="boot")
    builder = saltus.DiagramBuilder()
    inner = loop(Relay(1.0, 0.3, on_value=-0.7, off_value=1.5, name="m"), "out", "loop")
    builder.add(boot, inner)
    orbit = saltus.periodic_orbit(
        builder.build(),
        section=f"{inner.name}.m.turn_on",
        transient=1.0,
        wrt=[f"{inner.name}.g.gain"],
    )
    alone = saltus.periodic_orbit(inner, section="m.turn_on", wrt=["g.gain"])
    assert not orbit.notes
    np.testing.assert_allclose(orbit.period, alone.period, atol=NEAR)
    np.testing.assert_allclose(orbit.dperiod(), alone.dperiod(), rtol=1e-7)
