"""What `lyapunov` refuses, by name, and pieces that end at events."""

import numpy as np
import pytest
import saltus


def ball():
    scene = saltus.scene("bouncing-ball")
    return scene.system, scene.context


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"time": -1.0}, "time: expected a positive number, found -1.0"),
        ({"time": np.inf}, "time: expected a positive number, found inf"),
        ({"time": 1.0, "transient": -1.0}, "transient: expected a time of 0 s"),
        ({"time": 1.0, "every": 0.0}, "every: expected a positive number"),
        ({"time": 1.0, "tolerance": 0.0}, "tolerance: expected a positive number"),
        ({"time": 1.0, "count": 3}, "count: expected an integer from 1 to 2"),
        ({"time": 1.0, "count": True}, "count: expected an integer from 1 to 2"),
        ({"time": 1.0, "sensitivity": ["e"]}, "the option 'sensitivity' is set by it"),
        ({"time": 1.0, "rtoll": 1.0}, "did you mean 'rtol'"),
    ],
)
def test_an_argument_that_makes_no_sense(arguments, text):
    with pytest.raises(saltus.ModelError, match=text):
        saltus.lyapunov(*ball(), **arguments)


def test_no_states():
    class Empty(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="empty")
            self.declare_output_port(lambda t, s: t, name="y")

    with pytest.raises(saltus.ModelError, match="'empty' has no states"):
        saltus.lyapunov(Empty(), time=1.0)


def test_a_ball_that_comes_to_rest():
    with pytest.raises(saltus.SimulationError, match=r"came to rest after 'ball.bounce'"):
        saltus.lyapunov(*ball(), time=60.0)


def test_balls_on_islands_that_come_to_rest():
    class Ball(saltus.LeafSystem):
        def __init__(self, name):
            super().__init__(name=name)
            self.declare_continuous_state(
                [1.0, 0.0], ode=lambda t, s: [s.continuous_state[1], -9.81]
            )
            self.declare_zero_crossing(
                lambda t, s: s.continuous_state[0],
                lambda t, s: s.with_continuous_state([0.0, -0.5 * s.continuous_state[1]]),
                name="hit",
                direction="positive_then_non_positive",
            )

    builder = saltus.DiagramBuilder()
    builder.add(Ball("a"), Ball("b"))
    with pytest.raises(saltus.SimulationError, match=r"'state 0 of island 0'.* came to rest"):
        saltus.lyapunov(builder.build(), time=20.0, islands=True)


def test_a_start_at_rest():
    with pytest.raises(saltus.ModelError, match=r"t = 40.0 s: 'x\[0\]', 'x\[1\]' is at rest"):
        saltus.lyapunov(*ball(), time=10.0, transient=40.0)


class Pulled(saltus.LeafSystem):
    """x'' = -x, and a guard at x = level."""

    def __init__(self, level, reset=None, terminal=False):
        super().__init__(name="pulled")
        self.declare_continuous_state(
            [1.0, 0.0], ode=lambda t, s: [s.continuous_state[1], -s.continuous_state[0]]
        )
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - level, reset, name="edge", terminal=terminal
        )


class Twins(saltus.LeafSystem):
    """Two states that fall to 0 together, each with a guard of its own."""

    def __init__(self):
        super().__init__(name="twins")
        self.declare_continuous_state([1.0, 1.0], ode=lambda t, s: [-1.0, -1.0])
        for i in (0, 1):
            self.declare_zero_crossing(
                lambda t, s, i=i: s.continuous_state[i],
                lambda t, s: s.with_continuous_state([1.0, 1.0]),
                name=f"floor{i}",
                direction="positive_then_non_positive",
            )


def test_a_gap_has_its_event_time_and_reason():
    with pytest.raises(saltus.SimulationError) as caught:
        saltus.lyapunov(Twins(), time=1.7)
    text = str(caught.value)
    assert "there is no derivative by 'x[0]' at the event 'twins.floor" in text
    assert "another event happens at the same time" in text
    np.testing.assert_allclose(caught.value.time, 1.0, rtol=1e-12)


def test_a_run_that_ends_early():
    with pytest.raises(saltus.SimulationError, match=r"ended by the event 'pulled.edge'"):
        saltus.lyapunov(Pulled(0.5, terminal=True), time=10.0)


class Saw(saltus.LeafSystem):
    """x' = 1, and x -> 0 at 1: the events come with each second, and move with the start."""

    def __init__(self):
        super().__init__(name="saw")
        self.declare_continuous_state([0.0], ode=lambda t, s: [1.0])
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - 1.0,
            lambda t, s: s.with_continuous_state([0.0]),
            name="tooth",
        )


def test_pieces_that_end_at_an_event_that_moves_end_elsewhere():
    found = saltus.lyapunov(Saw(), time=20.0, every=0.5)
    # dx is carried over each tooth as it is
    np.testing.assert_allclose(found.exponents, [0.0], atol=1e-8)
    # rounding is no exponent; the rest of the run up to the tooth at 20 s is below 1e-9 of it
    assert found.converged
    np.testing.assert_allclose(found.times[-1], 20.0, rtol=2e-9)


class Dropped(saltus.LeafSystem):
    """A ball that comes to rest on a floor, until a clock throws it up each 2 s."""

    def __init__(self):
        super().__init__(name="ball")
        self.declare_continuous_state([0.3, 0.0], ode=lambda t, s: [s.continuous_state[1], -9.81])
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0],
            lambda t, s: s.with_continuous_state([0.0, -0.5 * s.continuous_state[1]]),
            name="bounce",
            direction="positive_then_non_positive",
        )
        self.declare_periodic_update(
            lambda t, s: s.with_continuous_state([0.0, 3.0]), period=2.0, offset=2.0
        )


def test_rest_within_the_run_forgets_all():
    found = saltus.lyapunov(Dropped(), time=41.0)
    assert np.all(np.isneginf(found.exponents)) and found.converged
