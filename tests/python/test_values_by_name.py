"""`create_context(values=...)`: start values, parameters and modes by their names."""

import numpy as np
import pytest
import saltus
from saltus.library import Constant, Integrator


class Ball(saltus.LeafSystem):
    """d(height)/dt = velocity, d(velocity)/dt = -g."""

    def __init__(self):
        super().__init__(name="ball")
        self.declare_dynamic_parameter("g", 10.0)
        self.declare_continuous_state(
            [1.0, 0.0], ode=lambda t, s, *, g: [s.continuous_state[1], -g],
            names=["height", "velocity"],
        )  # fmt: skip
        self.declare_default_mode(0)


def world():
    builder = saltus.DiagramBuilder()
    builder.add(Ball(), Integrator([1.0, 2.0], name="i"), Constant([1.0, 1.0], name="c"))
    builder.connect("c.out", "i.in")
    return builder.build("world")


@pytest.mark.parametrize(
    ("values", "states"),
    [
        ({"ball.height": 5.0}, [5.0, 0.0, 1.0, 2.0]),
        ({"i.x": [3.0, 4.0], "ball.velocity": -1}, [1.0, -1.0, 3.0, 4.0]),
        ({"i.x[1]": np.float32(7.0)}, [1.0, 0.0, 1.0, 7.0]),
        ({}, [1.0, 0.0, 1.0, 2.0]),
    ],
)
def test_start_values_by_path(values, states):
    context = world().create_context(values=values)
    np.testing.assert_array_equal(context.continuous_state, states)


def test_parameters_and_modes_too_and_the_system_stays():
    system = world()
    context = system.create_context(2.0, {"ball.g": 1.6, "c.value": [3.0, 4.0], "ball.mode": 2})
    assert context.time == 2.0 and context.parameters["ball.g"] == 1.6
    np.testing.assert_array_equal(context.parameters["c.value"], [3.0, 4.0])
    assert context[system["ball"]].mode == 2
    assert system.create_context().parameters["ball.g"] == 10.0


def test_a_run_starts_there():
    """height = h - g t^2 / 2 is a polynomial of degree 2, exact but for roundings of 5 m."""
    ball = Ball()
    context = ball.create_context(values={"height": 5.0, "g": 2.0})
    end = saltus.simulate(ball, context, (0.0, 2.0))["height"][-1]
    assert end == pytest.approx(5.0 - 2.0 * 4.0 / 2, abs=1e-12)


def test_names_are_those_of_a_sweep():
    system, names = world(), ("ball.height", "i.x[0]", "ball.g")
    for name in names:
        context = system.create_context(values={name: 3.0})
        row = saltus.sweep(system, {name: [3.0]}, (0.0, 1.0), as_dict=True)
        end = saltus.simulate(system, context, (0.0, 1.0)).context.continuous_state
        np.testing.assert_array_equal(row["continuous_state"][0], end)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"ball.hight": 1.0}, "did you mean 'ball.height'"),
        ({"i.x": [1.0]}, "expected 2 values, found 1"),
        ({"ball.height": "high"}, "'ball.height': expected numbers, found 'high'"),
        ({"ball.height": np.nan}, "finite"),
        ({"i.x": [1j, 2.0]}, "'i.x': expected numbers, found"),
        ({"i.x": np.array([1j, 2.0])}, "'i.x': expected numbers, found"),
        ({"ball.mode": "on"}, "expected numbers, found 'on'; a mode is given by its number"),
        ({3: 1.0}, "expected names, found 3"),
        ([("ball.height", 1.0)], "expected a dict of names with values"),
    ],
)
def test_what_is_not_there_is_refused(values, words):
    with pytest.raises(saltus.ModelError, match=words):
        world().create_context(values=values)


def test_values_in_the_place_of_the_time_are_refused():
    with pytest.raises(saltus.ModelError, match=r"give it as values=\{...\}"):
        world().create_context({"ball.height": 1.0})
