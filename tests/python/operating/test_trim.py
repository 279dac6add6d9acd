"""`saltus.trim`: operating points by closed forms, bounds, rank, guards and kinks."""

import numpy as np
import pytest
import saltus
from saltus.library import Adder, Constant, Gain, Integrator, Saturate

G = 9.81
# the search goes on to the rounding: a few roundings of values near 1, times a condition below 1e3
EXACT = {"rtol": 1e-12, "atol": 1e-12}


class Pendulum(saltus.LeafSystem):
    """angle' = rate, rate' = torque - damping rate - g sin(angle)."""

    def __init__(self, angle=0.4, rate=0.3):
        super().__init__(name="pendulum")
        self.declare_input_port(name="torque")
        self.declare_dynamic_parameter("damping", 0.6)
        self.declare_continuous_state([angle, rate], names=["angle", "rate"], ode=self.ode)

    def ode(self, time, state, torque, damping):
        angle, rate = state.continuous_state
        return [rate, torque - damping * rate - G * np.sin(angle)]


@pytest.mark.parametrize(
    ("start", "angle", "stability"), [(0.4, 0.0, "stable"), (2.8, np.pi, "unstable")]
)
def test_a_pendulum_hangs_and_stands(start, angle, stability):
    point = saltus.trim(Pendulum(start), hold={"torque": 0.0})
    assert point.status == "converged" and point.rank == 2 and not point.notes
    np.testing.assert_allclose(list(point.values.values()), [angle, 0.0], **EXACT)
    assert point.stability == stability
    # the roots of s^2 + 0.6 s + g cos(angle)
    roots = np.sort_complex(np.roots([1.0, 0.6, G * np.cos(angle)]))
    np.testing.assert_allclose(point.poles, roots, rtol=1e-12)
    np.testing.assert_allclose(point.context.continuous_state, [angle, 0.0], **EXACT)


def test_the_torque_that_holds_an_angle():
    point = saltus.trim(Pendulum(), ["torque", "rate"], hold={"angle": 1.0})
    np.testing.assert_allclose(point.values["torque"], G * np.sin(1.0), **EXACT)
    assert point.inputs == {"torque": point.values["torque"]}
    again = saltus.linearize(Pendulum(), point.context, inputs=point.inputs)
    np.testing.assert_allclose(again.xdot, 0.0, atol=1e-12)


def test_chosen_derivatives():
    # a turn at the rate 2 through the angle 0.5, without acceleration
    point = saltus.trim(
        Pendulum(), ["torque", "rate"], hold={"angle": 0.5}, derivatives={"angle": 2.0}
    )
    np.testing.assert_allclose(point.values["rate"], 2.0, **EXACT)
    np.testing.assert_allclose(point.values["torque"], 0.6 * 2.0 + G * np.sin(0.5), **EXACT)
    open_rate = saltus.trim(
        Pendulum(), ["torque"], hold={"angle": 0.5, "rate": 2.0}, derivatives=["angle"]
    )
    np.testing.assert_allclose(open_rate.values["torque"], point.values["torque"], **EXACT)


def tank(q=0.02, a=0.005):
    """h' = q - a sqrt(2 g h): the level of a tank with a hole, in units of its area."""
    return saltus.system_of(
        lambda t, h, q, a: [q - a * np.sqrt(2.0 * G * h[0])], [1.0], parameters={"q": q, "a": a}
    )


def test_the_level_of_a_tank_and_its_inverse():
    level = (0.02 / 0.005) ** 2 / (2.0 * G)  # Torricelli
    np.testing.assert_allclose(saltus.trim(tank()).values["x[0]"], level, **EXACT)
    inflow = saltus.trim(tank(), {"q": (0.0, 1.0)}, hold={"x[0]": 2.0})
    np.testing.assert_allclose(inflow.values["q"], 0.005 * np.sqrt(4.0 * G), **EXACT)


def test_steps_that_leave_the_domain_become_shorter():
    # a Newton step from h = 0.01 to a level of 5e-5 leads below 0, where the root is nan
    point = saltus.trim(tank(q=1.6e-4), {"x[0]": 0.01})
    np.testing.assert_allclose(point.values["x[0]"], (1.6e-4 / 0.005) ** 2 / (2.0 * G), rtol=1e-9)
    assert point.success


def test_hover_by_two_rotors_that_the_equations_do_not_separate():
    mass = 1.3

    class Rotors(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="rotors")
            self.declare_input_port(name="thrust")
            self.declare_continuous_state([5.0, 0.4], names=["height", "speed"], ode=self.ode)

        def ode(self, time, state, thrust):
            return [state.continuous_state[1], (thrust[0] + thrust[1]) / mass - G]

    hover = saltus.trim(Rotors(), ["thrust[0]", "speed"], hold={"thrust": [0.0, 4.0]})
    np.testing.assert_allclose(hover.values["thrust[0]"], mass * G - 4.0, **EXACT)
    assert not hover.undetermined
    both = saltus.trim(Rotors(), ["thrust[0]", "thrust[1]", "speed"], hold={"thrust": [1.0, 1.0]})
    assert both.success and both.rank == 2
    assert both.undetermined == ("thrust[0]", "thrust[1]")
    np.testing.assert_allclose(both.inputs["thrust"].sum(), mass * G, **EXACT)
    height = saltus.trim(Rotors(), hold={"thrust": [mass * G, 0.0]})
    assert height.undetermined == ("height",)


def chain():
    """y = 2 (u + bias), without a state."""
    builder = saltus.DiagramBuilder()
    adder = builder.add(Adder("++", name="sum"))
    bias = builder.add(Constant(0.25, name="bias"))
    gain = builder.add(Gain(2.0, name="gain"))
    builder.connect(bias.output(), adder.input(1))
    builder.connect(adder.output(), gain.input())
    builder.export_input(adder.input(0), "u")
    builder.export_output(gain.output(), "y")
    return builder.build()


def test_an_output_at_a_chosen_value():
    point = saltus.trim(chain(), ["u"], outputs={"y": 3.0})
    np.testing.assert_allclose(point.values["u"], 1.25, **EXACT)
    assert point.stability == "no states"
    bias = saltus.trim(chain(), ["bias.value"], hold={"u": 1.0}, outputs={"gain.out": 3.0})
    np.testing.assert_allclose(bias.values["bias.value"], 0.5, **EXACT)


def test_a_fixed_input_is_the_start():
    system = chain()
    system.input(0).fix_value(1.25)
    point = saltus.trim(system, ["u"], outputs={"y": 3.0})
    # already there: the first evaluation, those of SciPy at its end, and the check for a kink
    assert point.values["u"] == 1.25 and point.evaluations < 6


def test_what_is_infeasible_says_so():
    point = saltus.trim(Pendulum(), ["angle"], hold={"torque": 10.0, "rate": 0.0})
    assert point.status == "stalled" and not point.success
    assert "'rate of rate' is" in point.message and "expected 0" in point.message
    assert point.stability == "undecided"
    # the least of |torque - g sin(angle)|
    np.testing.assert_allclose(point.residuals["rate of rate"], 10.0 - G, rtol=1e-6)
    two = saltus.trim(chain(), ["u"], outputs={"y": 3.0, "gain.out": 4.0})
    assert not two.success


def test_a_bound_in_the_way_is_named():
    free = {"torque": (0.0, 5.0), "rate": None}
    point = saltus.trim(Pendulum(), free, hold={"angle": 1.0})
    assert not point.success and point.at_bounds == ("torque",)
    assert "with torque at a bound" in point.message
    at_limit = saltus.trim(
        Pendulum(), {"torque": (0.0, G * np.sin(1.0)), "rate": None}, hold={"angle": 1.0}
    )
    assert at_limit.success


def test_the_limit_of_evaluations():
    point = saltus.trim(Pendulum(1.4, 3.0), hold={"torque": 9.8}, max_nfev=1, tolerance=1e-15)
    assert point.status in ("converged", "max_nfev")
    hard = saltus.system_of(lambda t, x: [np.exp(x[0]) - 1e-3], [60.0])
    stopped = saltus.trim(hard, max_nfev=2)
    assert stopped.status == "max_nfev" and "larger max_nfev" in stopped.message


@pytest.mark.parametrize("scale", [1e-12, 1e12])
def test_the_unit_does_not_decide_convergence(scale):
    """x' = s (x^2 / s^2 + 1) has no root in any unit, x' = x / s - 2 has one."""
    none = saltus.system_of(lambda t, x: [scale * ((x[0] / scale) ** 2 + 1.0)], [3.0 * scale])
    assert not saltus.trim(none).success
    one = saltus.trim(saltus.system_of(lambda t, x: [x[0] / scale - 2.0], [3.0 * scale]))
    assert one.success
    np.testing.assert_allclose(one.values["x[0]"], 2.0 * scale, rtol=1e-14)


@pytest.mark.parametrize("seed", range(30))
def test_random_flows_of_many_sizes(seed):
    """x' = f(x) - f(x0): a point that is found is a root, whatever the units."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 9))
    w, size = rng.normal(size=(n, n)), 10.0 ** rng.integers(-6, 7, size=n)

    def flow(x):
        return size * (w @ np.tanh(x / size) + 3.0 * x / size)

    root = rng.normal(size=n) * size
    rest = flow(root)
    start = root + 0.3 * size * rng.normal(size=n)
    point = saltus.trim(saltus.system_of(lambda t, x: flow(x) - rest, start))
    assert list(point.values) == [f"x[{i}]" for i in range(n)]
    assert point.success
    found = np.array(list(point.values.values()))
    # some hundred roundings of terms of size 10
    np.testing.assert_allclose(flow(found) / size, rest / size, atol=1e-12)


def test_a_diagram_with_a_long_state_between_others():
    class Rod(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="rod")
            self.declare_continuous_state(np.ones(7), ode=lambda t, s: 3.0 - s.continuous_state)

    builder = saltus.DiagramBuilder()
    zero = builder.add(Constant(0.0, name="zero"))
    for block in (Integrator(0.0, name="first"), Rod(), Integrator(0.0, name="last")):
        builder.add(block)
        if block.name != "rod":
            builder.connect(zero.output(), block.input())
    point = saltus.trim(builder.build())
    np.testing.assert_allclose([point.values[f"rod.x[{i}]"] for i in range(7)], 3.0, **EXACT)
    assert point.undetermined == ("first.x[0]", "last.x[0]")


def test_a_double_root_has_no_rank():
    point = saltus.trim(saltus.system_of(lambda t, x: [(x[0] - 1.0) ** 2], [2.0]))
    # Newton halves the distance until its square is a rounding
    np.testing.assert_allclose(point.values["x[0]"], 1.0, atol=1e-7)
    assert point.undetermined == ("x[0]",) and point.stability == "undecided"


class Heater(saltus.LeafSystem):
    """T' = 30 - T in the mode 1, which `hot` leaves at 22."""

    def __init__(self, start=20.0):
        super().__init__(name="heater")
        self.declare_continuous_state([start], names=["T"], ode=self.ode)
        self.declare_default_mode(1)
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - 22.0,
            name="hot",
            direction="negative_then_non_negative",
            start_mode=1,
            end_mode=0,
        )

    def ode(self, time, state):
        return [30.0 * state.mode - state.continuous_state[0]]


def test_a_guard_on_the_way_is_named():
    point = saltus.trim(Heater())
    np.testing.assert_allclose(point.values["T"], 30.0, **EXACT)
    assert point.crossed == ("heater.hot",)
    assert "'heater.hot' has an effect and lies between the start (g = -2)" in point.notes[0]
    heated = Heater().create_context().with_continuous_state([29.0])
    assert saltus.trim(Heater(), context=heated).crossed == ()


def test_a_kink_at_the_point_is_named():
    builder = saltus.DiagramBuilder()
    limit = builder.add(Saturate(lower_limit=-1.0, upper_limit=1.0, name="limit"))
    plant = builder.add(Integrator(0.3, name="plant"))
    builder.connect(limit.output(), plant.input())
    builder.export_input(limit.input(), "u")
    builder.export_output(limit.output(), "y")
    system = builder.build()
    point = saltus.trim(
        system, {"u": 0.5}, outputs={"y": 1.0}, derivatives=["plant.x[0]"], hold=["plant.x[0]"]
    )
    assert point.success and not point.smooth
    assert any("is at its root" in note for note in point.notes)
    inside = saltus.trim(system, {"u": 0.5}, hold=["plant.x[0]"])
    assert inside.smooth
    np.testing.assert_allclose(inside.values["u"], 0.0, **EXACT)


def test_called_functions_and_the_time():
    pendulum = Pendulum(2.8)
    start = pendulum.create_context().with_time(4.0)
    point = saltus.trim(pendulum, hold={"torque": 0.0}, context=start, python="called")
    # the Jacobian has an error of 1e-10, the residual has none
    np.testing.assert_allclose(point.values["angle"], np.pi, rtol=1e-12)
    assert point.context.time == 4.0 and "differences" in point.linearization.method
