"""Assignments, loops, views, imports: what a function does line by line."""

import numpy as np
from tracing_cases import assert_agrees
from world import MATRIX


def test_one_element_arrays_broadcast():
    outcome = assert_agrees(lambda t, s: s.continuous_state * s.continuous_state[0], x=[0.7])
    assert outcome.shape == (1,)
    assert assert_agrees(lambda t, s: s.continuous_state[0], x=[0.7]).shape == ()
    assert assert_agrees(lambda t, s: s.continuous_state * 2.0, x=0.7).shape == ()


def test_a_matrix_state():
    assert_agrees(lambda t, s: s.continuous_state.T @ MATRIX, x=[[0.5, 0.25], [1.5, 2.0]])
    assert_agrees(lambda t, s: s.continuous_state[1] - s.continuous_state[:, 0], x=MATRIX + 0.1)


def test_item_assignment():
    def chain(time, state):
        x = state.continuous_state
        dx = np.zeros_like(x)
        dx[0] = -x[0]
        dx[1:-1] = x[:-2] - 2 * x[1:-1] + x[2:]
        dx[-1] += x[0]
        dx[[0, 1]] *= 2
        return dx

    assert_agrees(chain, x=np.linspace(0.1, 1.0, 6))


def test_views_share_entries():
    def function(time, state):
        matrix = np.empty((2, 2))
        row = matrix[0]
        row[:] = state.continuous_state
        matrix.T[1] = 3.0
        flat = np.reshape(matrix, -1)
        flat[2] = time
        copied = matrix.copy()
        copied[0, 0] = 99.0
        return matrix

    assert_agrees(function)


def test_in_place_operators_keep_the_type_of_the_array():
    def function(time, state):
        counts = np.zeros(2, dtype=int)
        counts[0] = 3.9 * state.continuous_state[0]  # numpy cuts it off
        y = state.continuous_state[0]
        y += 1.0  # a number: the state stays as it is
        return np.array([counts[0], y, state.continuous_state[0]])

    assert_agrees(function)


def test_loops_inner_functions_and_unpacking():
    def function(time, state):
        y, v = state.continuous_state
        (a, *rest) = np.array([y, v, time])
        total = 0.0

        def grow(by):
            nonlocal total
            total = total + by * by

        for i in range(3):
            if i % 2 == 0:
                grow(y * i)
        while i > 0:
            i -= 1
            total *= 1.5
        return [total, a, sum(rest)]

    assert_agrees(function)


def test_imports_inside_the_function():
    def function(time, state):
        import math

        import numpy
        from numpy.linalg import norm

        return numpy.array([math.sin(time), norm(state.continuous_state)])

    assert_agrees(function)


def test_errstate_and_with():
    def function(time, state):
        with np.errstate(all="ignore"):
            return state.continuous_state / 3.0

    assert_agrees(function)


def test_setting_where_a_mask_is_true():
    def function(time, state):
        x = state.continuous_state
        y = x * 2.0
        y[x > 0] = 1.0
        y[y < -0.5] = time
        return y

    assert_agrees(function)
