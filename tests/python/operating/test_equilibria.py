"""`saltus.equilibria`: all points of a box, each once."""

import numpy as np
import saltus
from test_trim import Pendulum


def test_the_three_points_of_a_cubic():
    # x' = x - x^3: poles 1 - 3 x^2
    cubic = saltus.system_of(lambda t, x: [x[0] - x[0] ** 3], [0.5])
    found = saltus.equilibria(cubic, {"x[0]": (-3.0, 2.0)}, count=16)
    values = [point.values["x[0]"] for point in found]
    np.testing.assert_allclose(values, [-1.0, 0.0, 1.0], atol=1e-12)
    assert [point.stability for point in found] == ["stable", "unstable", "stable"]
    np.testing.assert_allclose([p.poles[0].real for p in found], [-2.0, 1.0, -2.0], rtol=1e-12)


def test_only_points_in_the_box():
    # the angles -pi, 0 and pi; those further out are not looked for
    box = {"angle": (-4.0, 5.0), "rate": (-1.0, 1.0)}
    found = saltus.equilibria(Pendulum(), box, hold={"torque": 0.0}, seed=3)
    angles = [point.values["angle"] for point in found]
    np.testing.assert_allclose(angles, [-np.pi, 0.0, np.pi], atol=1e-9)
    assert found.starts == 32


def test_starts_by_a_list():
    starts = [
        {"angle": 0.2, "rate": 0.0},
        {"angle": 3.0, "rate": 0.0},
        {"angle": -0.1, "rate": 0.0},
    ]
    found = saltus.equilibria(Pendulum(), starts, hold={"torque": 0.0})
    assert len(found) == 2 and found.starts == 3 and not found.failures


def lift(speed, alpha):
    """A lift curve that stalls: c (alpha - k alpha^3)."""
    return speed**2 * (alpha - 4.0 * alpha**3)


def test_an_aircraft_flies_level_at_two_angles():
    # alpha - 4 alpha^3 = w / v^2 has two positive roots below the stall
    class Glider(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="glider")
            self.declare_dynamic_parameter("alpha", 0.1)
            self.declare_continuous_state([0.0], names=["climb"], ode=self.ode)

        def ode(self, time, state, alpha):
            return [lift(10.0, alpha) - 15.0 - state.continuous_state[0]]

    found = saltus.equilibria(Glider(), {"alpha": (0.0, 0.6)}, hold={"climb": 0.0})
    roots = np.sort(np.roots([-4.0, 0.0, 1.0, -0.15]).real)[1:]
    np.testing.assert_allclose([p.values["alpha"] for p in found], roots, rtol=1e-12)


def test_no_equilibrium_is_an_empty_sequence_with_reasons():
    found = saltus.equilibria(
        Pendulum(), {"angle": (-4.0, 4.0), "rate": (-1.0, 1.0)}, hold={"torque": 10.0}, count=4
    )
    assert len(found) == 0 and len(found.failures) == 4
    assert "'rate of rate'" in found.failures[0]


def test_a_start_beyond_the_domain_does_not_end_it():
    root = saltus.system_of(lambda t, x: [np.sqrt(x[0]) - 1.0], [1.0])
    found = saltus.equilibria(root, {"x[0]": (-3.0, 3.0)}, count=8)
    assert len(found) == 1 and any("nan" in text for text in found.failures)
