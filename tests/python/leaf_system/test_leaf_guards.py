"""The guards and reset maps of a Python block."""

import numpy as np
import pytest
import saltus
from declared import Block
from saltus.library import Step
from systems import Ball, run


def test_modes_choose_among_guards():
    """A thermostat: heat until 21, cool until 19. Both legs are straight lines, so every switch is
    known.
    """

    def declare(self):
        self.declare_continuous_state(
            default_value=[20.0], ode=lambda t, s: [2.0 if s.mode == 1 else -1.0]
        )
        self.declare_default_mode(1)
        self.declare_mode_output("mode")
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - 21.0,
            name="hot",
            start_mode=1,
            end_mode=0,
            direction="negative_then_non_negative",
        )
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - 19.0,
            name="cold",
            start_mode=0,
            end_mode=1,
            direction="positive_then_non_positive",
        )

    results = run(Block(declare), (0.0, 7.0))
    np.testing.assert_allclose(results.events.times("hot"), [0.5, 3.5, 6.5], rtol=0, atol=1e-11)
    np.testing.assert_allclose(results.events.times("cold"), [2.5, 5.5], rtol=0, atol=1e-11)
    assert results.context.mode == 0
    assert set(results.outputs["mode"]) == {0.0, 1.0}


def test_reset_map_may_set_the_mode():
    def declare(self):
        self.declare_continuous_state(1, ode=lambda t, s: [1.0])
        self.declare_default_mode(0)
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - 1.0, lambda t, s: s.with_mode(s.mode + 5)
        )

    system = Block(declare)
    assert saltus.simulate(system, system.create_context(), (0.0, 2.0)).context.mode == 5


def test_terminal_event_ends_the_run_after_its_reset():
    ball = Ball(terminal=True)
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    results = run(ball, (0.0, 100.0), context, rtol=1e-10, atol=1e-12)
    t1 = np.sqrt(20.0 / 9.81)
    assert results.status == "terminal"
    assert results.context.time == pytest.approx(t1, abs=1e-11)
    assert results.context.continuous_state[1] == pytest.approx(0.9 * 9.81 * t1, abs=1e-9)
    assert results.events[-1].kind == "terminal"


def test_a_monitor_changes_no_bit():
    def oscillator(monitored):
        def declare(self):
            self.declare_continuous_state(
                default_value=[1.0, 0.0],
                ode=lambda t, s: [s.continuous_state[1], -s.continuous_state[0]],
            )
            self.declare_continuous_state_output("x")
            if monitored:
                self.declare_zero_crossing(lambda t, s: s.continuous_state[0], name="zero")

        return run(Block(declare), (0.0, 10.0), rtol=1e-9, atol=1e-12)

    plain, watched = oscillator(False), oscillator(True)
    assert np.array_equal(plain.outputs["x"], watched.outputs["x"])
    zeros = (np.arange(3) + 0.5) * np.pi
    # the error of the state, some 1e-9 a step over a hundred steps, at unit speed
    np.testing.assert_allclose(watched.events.times("zero"), zeros, rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    "direction",
    ["crosses_zero", "positive_then_non_positive", "negative_then_non_negative", "none"],
)
def test_directions(direction):
    def declare(self):
        self.declare_continuous_state(1, ode=lambda t, s: [1.0])
        self.declare_zero_crossing(
            lambda t, s: np.sin(t), lambda t, s: s, name="wave", direction=direction
        )

    system = Block(declare)
    found = saltus.simulate(
        system, system.create_context(), (0.5, 10.0), max_minor_step_size=0.5
    ).events.times("wave")
    expected = {
        "crosses_zero": [1, 2, 3],
        "positive_then_non_positive": [1, 3],
        "negative_then_non_negative": [2],
        "none": [],
    }
    np.testing.assert_allclose(found, np.pi * np.array(expected[direction]), rtol=0, atol=1e-12)


def test_step_input_reaches_a_guard():
    """A guard with an input: the floor of a ball is another block's output."""

    def declare(self):
        self.declare_input_port("floor")
        self.declare_continuous_state(default_value=[1.0], ode=lambda t, s, floor: [-1.0])
        self.declare_zero_crossing(
            lambda t, s, floor: s.continuous_state[0] - floor,
            lambda t, s, floor: s.with_continuous_state([floor + 1.0]),
            name="hit",
            direction="positive_then_non_positive",
        )

    builder = saltus.DiagramBuilder()
    block, floor = builder.add(Block(declare), Step(start_value=0.0, end_value=-1.0, step_time=1.5))
    builder.connect(floor.output(), block.input())
    diagram = builder.build()
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 3.5))
    # falls from 1 to 0 in 1 s; half way down again the floor drops by 1: 1.5 s more
    np.testing.assert_allclose(results.events.times("hit"), [1.0, 3.0], rtol=0, atol=1e-12)


@pytest.mark.parametrize("result", [None, "x", object(), {}, [1.0, "x"], 1j])
def test_a_reset_map_gives_a_state(result):
    def declare(self):
        self.declare_continuous_state(1, ode=lambda t, s: [1.0])
        self.declare_zero_crossing(lambda t, s: t - 0.5, lambda t, s: result, name="half")

    system = Block(declare)
    with pytest.raises(
        saltus.ModelError,
        match=r"reset map of 'half' returned .*, expected a state: `return state.with_",
    ):
        saltus.simulate(system, system.create_context(), (0.0, 1.0))
