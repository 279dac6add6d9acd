"""Section 1: contexts are values; hybrid time is (t, j)."""

import numpy as np
import saltus
from saltus.library import Gain
from systems import Ball, run


def test_1_1_a_context_holds_time_states_mode_and_parameters():
    class Full(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="full")
            self.declare_continuous_state([1.0, 2.0])
            self.declare_discrete_state([3.0])
            self.declare_default_mode(4)
            self.declare_dynamic_parameter("p", 5.0)

    context = Full().create_context(0.5)
    assert context.time == 0.5
    assert context.continuous_state.tolist() == [1.0, 2.0]
    assert context.discrete_state.tolist() == [3.0]
    assert context.mode == 4
    assert context.parameters == {"p": 5.0}


def test_1_1_with_gives_a_new_context_and_leaves_the_old_and_the_system():
    gain = Gain(2.0, name="gain")
    old = gain.create_context()
    new = old.with_parameter("gain", 3.0).with_time(1.0)
    assert (old.time, old.parameters["gain"]) == (0.0, 2.0)
    assert (new.time, new.parameters["gain"]) == (1.0, 3.0)
    assert gain.create_context() == old


def test_1_1_a_run_changes_neither_its_context_nor_its_system():
    ball = Ball()
    context = ball.create_context().with_continuous_state([1.0, 0.0])
    run(ball, (0.0, 2.0), context)
    assert context.continuous_state.tolist() == [1.0, 0.0]
    assert ball.create_context().continuous_state.tolist() == [0.0, 0.0]


def test_1_2_time_never_decreases_and_equal_times_are_told_apart_by_the_jump():
    ball = Ball()
    results = run(ball, (0.0, 3.0), ball.create_context().with_continuous_state([1.0, 0.0]))
    t, j = results.time, results.jump
    assert np.all(np.diff(t) >= 0.0)
    assert np.all(np.diff(j)[np.diff(t) == 0.0] == 1)
    assert j[-1] == results.statistics.events == len(results.events)
