"""Called truths: the looks at them follow the signals that they read."""

import numpy as np
import pytest
import saltus
from saltus.library import (
    Clock,
    FunctionBlock,
    Integrator,
    Sine,
    StateMachine,
    Transition,
    TriggeredSubsystem,
)

END = 100.0


def crossings(level, frequency=1.0):
    """The times until END at which sin(w t) is the level."""
    first = np.arcsin(level)
    turns = 2.0 * np.pi * np.arange(-1, 1 + END * frequency / 6.0)
    times = np.sort(np.concatenate([turns + first, turns + np.pi - first])) / frequency
    return times[(times > 0.0) & (times < END)]


class Truth(saltus.LeafSystem):
    """Logs when its input crosses a level, by a function that returns a truth."""

    def __init__(self, level, counts):
        super().__init__(name="truth")
        self.declare_input_port("u")
        self.declare_discrete_state([0.0])
        self.declare_zero_crossing(
            lambda t, s, u: u > level,
            reset_map=(lambda t, s, u: s.with_discrete_state(s.discrete_state + 1.0))
            if counts
            else None,
            name="hit",
        )


def diagram(*blocks):
    builder = saltus.DiagramBuilder()
    builder.add(*blocks)
    for source, target in zip(blocks, blocks[1:], strict=False):
        builder.connect(source.output(), target.input())
    return builder.build()


@pytest.mark.parametrize("counts", [True, False])
@pytest.mark.parametrize("level", [0.3, -0.9])
def test_every_change_of_a_called_truth_is_found(level, counts):
    results = saltus.simulate(diagram(Sine(), Truth(level, counts)), (0.0, END), python="called")
    times = crossings(level)
    # The angle has some roundings of t, and the slope is sqrt(1 - level^2).
    assert results.events.times("truth.hit") == pytest.approx(times, abs=1e-12)


@pytest.mark.parametrize("python", ["called", "traced"])
def test_a_truth_of_a_signal_that_is_constant_in_pieces(python):
    """floor(5 u) > 0.3 where u >= 0.2."""
    stairs = FunctionBlock(lambda u: np.floor(5.0 * u), name="stairs")
    levels = Truth(0.3, False)
    results = saltus.simulate(diagram(Sine(), stairs, levels), (0.0, END), python=python)
    assert results.events.times("truth.hit") == pytest.approx(crossings(0.2), abs=1e-12)


def test_a_machine_whose_conditions_are_called():
    ways = [
        Transition("low", "high", guard=lambda u: u > 0.3),
        Transition("high", "low", guard=lambda u: u < 0.3),
    ]
    machine = StateMachine(["low", "high"], ways, inputs=["u"])
    results = saltus.simulate(diagram(Sine(), machine), (0.0, END), python="called")
    found = [event.time for event in results.events if event.name != "start"]
    assert found == pytest.approx(crossings(0.3), abs=1e-12)


def test_the_time_during_which_a_called_function_is_true():
    above = FunctionBlock(lambda u: u > 0.3, name="above")
    rate = FunctionBlock(lambda truth: float(truth), name="rate")
    results = saltus.simulate(
        diagram(Sine(), above, rate, Integrator(0.0)), (0.0, END), python="called"
    )
    times = crossings(0.3)  # true from an even one to the next
    expected = np.sum(times[1::2] - times[::2])
    assert results.context.continuous_state[0] == pytest.approx(expected, abs=1e-11)


STEPPED = {
    "branch": lambda u: 1.0 if u > 0.3 else -1.0,
    "where": lambda u: np.where(u > 0.3, 1.0, -1.0),
    "sign": lambda u: np.sign(u - 0.3),
    "floor": lambda u: np.floor(u + 0.7) - 0.5,
    "clip": lambda u: np.clip(u - 0.3, -1e-3, 1e-3),
}


@pytest.mark.parametrize("python", ["called", "traced"])
@pytest.mark.parametrize("name", STEPPED)
def test_a_block_whose_input_is_constant_in_pieces(name, python):
    """The guard of a trigger is a formula, so it is the input that says nothing."""
    stepped = FunctionBlock(STEPPED[name], name="stepped")
    trigger = TriggeredSubsystem(Clock(), name="triggered")
    results = saltus.simulate(diagram(Sine(), stepped, trigger), (0.0, END), python=python)
    times = results.events.times("triggered.trigger.positive")
    assert times == pytest.approx(crossings(0.3), abs=1e-12)


class Wave(saltus.LeafSystem):
    """x = cos t, with a guard that is a function of x."""

    def __init__(self, guard):
        super().__init__(name="wave")
        self.declare_continuous_state(
            default_value=[1.0, 0.0],
            ode=lambda t, s: [s.continuous_state[1], -s.continuous_state[0]],
        )
        self.declare_zero_crossing(lambda t, s: guard(s.continuous_state[0]), name="hit")


OF_OWN_STATE = {
    "truth": lambda x: x > 0.9,
    "branch": lambda x: 1.0 if x > 0.9 else -1.0,
    "where": lambda x: np.where(x > 0.9, 1.0, -1.0),
    "sign": lambda x: np.sign(x - 0.9),
    "floor": lambda x: np.floor(x + 0.1) - 0.5,
    "difference": lambda x: x - 0.9,
}


@pytest.mark.parametrize("python", ["called", "traced"])
@pytest.mark.parametrize("method", ["dopri5", "dop853", "radau", "bdf", "adams", "auto"])
@pytest.mark.parametrize("name", OF_OWN_STATE)
def test_a_function_of_the_own_state_that_is_constant_in_pieces(name, method, python):
    """x is above the level for a seventh of each period."""
    results = saltus.simulate(
        Wave(OF_OWN_STATE[name]), (0.0, END), ode_solver_method=method, rtol=1e-6, python=python
    )
    stay = np.arccos(0.9)
    turns = 2.0 * np.pi * np.arange(16)
    times = np.sort(np.concatenate([turns + stay, turns[1:] - stay]))
    # The angle is off by about rtol a radian, and the slope at the level is 0.44.
    assert results.events.times("wave.hit") == pytest.approx(times[times < END], abs=1e-2)
