"""A branch on a value is refused with its place."""

import numpy as np
import pytest
from sources import line_of
from tracing_cases import reason, traced


def branch_if(time, state):
    _, v = state.continuous_state
    if v > 0:
        return np.array([v, -1.0])
    return np.array([v, 1.0])


def branch_while(time, state):
    n = 0
    while state.continuous_state[0] > n:
        n += 1
    return n


def branch_ternary(time, state):
    return 1.0 if time < 3.0 else 2.0


def branch_and(time, state):
    return state.continuous_state[0] > 0 and time > 1.0


def branch_chained(time, state):
    return 0.0 < state.continuous_state[0] < 1.0


def branch_not(time, state):
    return not state.continuous_state[0] > 0


def branch_mode(time, state):
    if state.mode == 1:
        return 1.0
    return 2.0


def branch_array(time, state):
    if (state.continuous_state[:1] > 0).any():
        return 1.0
    return 2.0


def branch_sorted(time, state):
    return sorted(state.continuous_state)[0]


def branch_match(time, state):
    match state.mode:
        case 0:
            return 1.0
        case _:
            return 2.0


BRANCHES = {
    branch_if: "if v > 0:",
    branch_while: "while state",
    branch_ternary: "return",
    branch_and: "return",
    branch_chained: "return",
    branch_not: "return",
    branch_mode: "if state.mode",
    branch_array: "if (state",
    branch_sorted: "return",
    branch_match: "case 0",
}


@pytest.mark.parametrize("function", BRANCHES)
def test_a_branch_on_a_value(function):
    place = line_of(function, BRANCHES[function])
    if function in (branch_mode, branch_match):
        expected = f"branches on the mode at {place}; use np.where(state.mode == ..., ..., ...)"
    else:
        expected = (
            f"branches on a value at {place}; use np.where, np.minimum, `&` and `|`, or modes "
            "with zero crossings"
        )
    assert reason(function) == expected


def test_a_branch_on_what_is_fixed_is_none():
    flag = True

    def function(time, state):
        if flag and len(state.continuous_state) == 2 and np.array([1.0])[0] > 0:
            return time
        return print("never")

    outcome = traced(function)
    assert outcome.dependencies.changed() is None
    flag = False
    assert outcome.dependencies.changed() == "flag was True, is False"
    assert "uses print" in reason(function)
