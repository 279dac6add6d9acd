"""What `periodic_orbit` refuses, by name, and the status of a search that does not converge."""

import numpy as np
import pytest
import saltus


def wheel():
    scene = saltus.scene("rimless-wheel")
    return scene.system, scene.context


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"section": "wheel.spok"}, "wheel.spoke"),
        ({"section": "wheel.spoke", "period": 1.0}, "expected a section or a period, found both"),
        ({"period": -1.0}, "period: expected a positive number, found -1.0"),
        ({"period": 1.0, "firings": 2}, "counts those of a section"),
        ({"section": "wheel.spoke", "firings": 0}, "firings: expected an integer of 1 or more"),
        ({"section": "wheel.spoke", "firings": True}, "firings: expected an integer of 1 or more"),
        ({"section": "wheel.spoke", "max_iterations": 0}, "max_iterations: expected an integer"),
        ({"section": "wheel.spoke", "transient": -1.0}, "transient: expected a time of 0 s"),
        ({"section": "wheel.spoke", "wrt": "e"}, "wrt: expected a list of names"),
        ({"section": "wheel.spoke", "wrt": ["x[0]"]}, "'x.0.' is a start value"),
        ({"section": "wheel.spoke", "wrt": ["slope"]}, "unknown parameter or state 'slope'"),
        ({"section": "wheel.spoke", "save_at": [1.0]}, "the option 'save_at' is set by it"),
        ({"section": "wheel.spoke", "rtoll": 1.0}, "did you mean 'rtol'"),
    ],
)
def test_an_argument_that_makes_no_sense(arguments, text):
    with pytest.raises(saltus.ModelError, match=text):
        saltus.periodic_orbit(*wheel(), **arguments)


def test_a_section_that_is_not_reached():
    with pytest.raises(saltus.SimulationError, match=r"has fired 1 of 2 times since t = 0.0 s"):
        saltus.periodic_orbit(*wheel(), "wheel.spoke", max_period=4.0)


class Turning(saltus.LeafSystem):
    """A stable circle of radius 1; `crossed` looks at x = level."""

    def __init__(self, level=0.0, reset=None, terminal=False, drive=0.0, default=0.0):
        super().__init__(name="turning")
        self.drive = drive
        self.declare_continuous_state([0.5, 0.1], ode=self.ode)
        self.declare_discrete_state([default])
        self.declare_default_mode(0)
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - level,
            reset,
            name="crossed",
            direction="negative_then_non_negative",
            terminal=terminal,
        )

    def ode(self, t, state):
        x, y = state.continuous_state
        pull = 1.0 - x * x - y * y
        return [pull * x - y + self.drive * np.sin(1.7 * t), pull * y + x]


def test_a_monitor_is_a_section():
    """r' = r (1 - r^2): a deviation of r shrinks to exp(-4 pi) in a turn."""
    orbit = saltus.periodic_orbit(Turning(), section="crossed")
    np.testing.assert_allclose(orbit.period, 2 * np.pi, atol=1e-8)
    np.testing.assert_allclose(orbit.x0, [0.0, -1.0], atol=1e-8)
    np.testing.assert_allclose(orbit.multipliers, [np.exp(-4 * np.pi)], atol=1e-8)


def test_a_section_that_ends_the_run():
    with pytest.raises((saltus.ModelError, saltus.SimulationError), match=r"terminal|ends the run"):
        saltus.periodic_orbit(Turning(terminal=True), section="crossed")


def test_a_count_that_does_not_return():
    def count(t, state):
        return state.with_discrete_state(state.discrete_state + 1.0)

    with pytest.raises(saltus.SimulationError, match=r"the discrete state 'z\[0\]' did not return"):
        saltus.periodic_orbit(Turning(reset=count), section="crossed")


def test_a_mode_that_does_not_return():
    def next_mode(t, state):
        return state.with_mode(state.mode + 1)

    with pytest.raises(saltus.SimulationError, match="the mode of 'turning' did not return"):
        saltus.periodic_orbit(Turning(reset=next_mode), section="crossed")


def test_a_side_returns_after_two_firings():
    def other_side(t, state):
        return state.with_discrete_state(-state.discrete_state)

    system = Turning(reset=other_side, default=1.0)
    with pytest.raises(saltus.SimulationError, match="did not return"):
        saltus.periodic_orbit(system, section="crossed")
    orbit = saltus.periodic_orbit(system, section="crossed", firings=2)
    np.testing.assert_allclose(orbit.period, 4 * np.pi, atol=1e-7)
    assert len(orbit.multipliers) == 1  # that of the side is none


def test_a_driven_system_needs_a_period():
    with pytest.raises(saltus.ModelError, match="the time moves the system"):
        saltus.periodic_orbit(Turning(drive=0.1), section="crossed")


def test_a_period_that_is_not_that_of_the_drive():
    system = saltus.system_of(lambda t, x: [-x[0] + np.cos(t)], [1.0])
    with pytest.raises(saltus.ModelError, match="no period of the drive"):
        saltus.periodic_orbit(system, period=5.0)


def test_a_state_that_does_not_come_back():
    falling = saltus.system_of(lambda t, x: [1.0 + x[0] ** 2 / (1 + x[0] ** 2)], [0.0])
    with pytest.raises(saltus.SimulationError, match="came close to none"):
        saltus.periodic_orbit(falling, max_period=10.0)


def test_a_guard_without_a_derivative_is_named():
    """A guard that shows a sign only says nothing about the time at which it crosses."""

    class Sign(Turning):
        def __init__(self):
            super().__init__()
            self.declare_zero_crossing(
                lambda t, s: np.sign(s.continuous_state[0] - 0.3), name="sign"
            )

    with pytest.raises(saltus.SimulationError, match=r"no derivative by 'x.0.' at the event"):
        saltus.periodic_orbit(Sign(), section="sign")


def test_a_search_that_does_not_converge_returns_what_it_has():
    orbit = saltus.periodic_orbit(*wheel(), "wheel.spoke", max_iterations=1)
    assert orbit.status == "max_iterations" and "after 1 steps" in orbit.message
    assert np.isnan(orbit.multipliers).all() and orbit.stable is None
    with pytest.raises(saltus.SimulationError, match="no orbit was found"):
        orbit.dperiod()


def test_a_step_out_of_the_domain_is_shortened():
    """The full Newton step from x = 60 leads to a start below 0, where the function raises."""

    def rate(t, x):
        if x[0] < 0.0:
            raise ValueError("below zero")
        return [1.0 - x[0] ** 0.25 + 0.1 * np.cos(2 * np.pi * t)]

    orbit = saltus.periodic_orbit(saltus.system_of(rate, [60.0]), period=1.0)
    assert orbit.status == "converged" and orbit.stable


def test_an_unknown_parameter_of_the_derivatives():
    orbit = saltus.periodic_orbit(*wheel(), "wheel.spoke")
    with pytest.raises(saltus.ModelError, match="was not among the parameters"):
        orbit.dperiod("slope")


def test_a_plot_has_the_names_of_the_states():
    axes = saltus.periodic_orbit(*wheel(), "wheel.spoke").plot("x[0]", "x[1]")
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x[0]", "x[1]")
    with pytest.raises(saltus.ModelError, match=r"there is no state 'x.2.'"):
        saltus.periodic_orbit(*wheel(), "wheel.spoke").plot("x[2]")
