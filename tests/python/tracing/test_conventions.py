"""How functions are called, and what they return."""

import math

import numpy as np
from tracing_cases import assert_agrees, evaluate, traced


def test_parameters_inputs_and_keywords():
    def function(time, state, force, wind, *, g, drag):
        _, v = state.continuous_state
        return np.array([v + wind[1], force - g - drag @ wind])

    def by_dictionary(time, state, force, wind, **params):
        return function(time, state, force, wind, **params)

    for f in (function, by_dictionary):
        outcome = traced(f, parameters={"g": 9.81, "drag": [0.5, 0.25]}, input_shapes=[(), (2,)])
        found = evaluate(outcome, [1.0, 2.0], p=[9.0, 0.5, 0.25], u=[[3.0], [0.125, 4.0]])
        np.testing.assert_array_equal(found, [6.0, 3.0 - 9.0 - 0.0625 - 1.0])


def test_only_some_inputs_are_passed():
    def f(time, state, second):
        return second * 2.0

    outcome = traced(f, input_shapes=[(), (), ()], inputs=[1])
    assert evaluate(outcome, [0.0, 0.0], u=[[1.0], [5.0], [9.0]]) == 10.0
    assert [outcome.tape.reads_input(k) for k in range(3)] == [False, True, False]


def test_conventions():
    outcome = traced(lambda u: u[0] * u[1][1], convention="inputs", input_shapes=[(), (2,)])
    assert evaluate(outcome, [], u=[[3.0], [0.0, 4.0]]) == 12.0
    outcome = traced(lambda u: u.sum(), convention="input", input_shapes=[(3,)])
    assert evaluate(outcome, [], u=[[3.0, 1.0, 4.0]]) == 8.0
    outcome = traced(lambda t, x: [x[1], -x[0]], convention="vector")
    np.testing.assert_array_equal(evaluate(outcome, [1.0, 2.0]), [2.0, -1.0])


def test_the_in_place_form():
    def fill(time, state, out, k):
        y, v = state.continuous_state
        out[:] = v, -k * y

    outcome = traced(fill, out=True, result_size=2, parameters={"k": 4.0})
    np.testing.assert_array_equal(evaluate(outcome, [1.0, 2.0], p=[4.0]), [2.0, -4.0])


def test_a_reset_map_says_what_it_wrote():
    def bounce(time, state):
        y, v = state.continuous_state
        return state.with_continuous_state([abs(y), -0.9 * v]).with_mode(state.mode + 1)

    outcome = traced(bounce, kind="reset")
    assert (outcome.wrote_x, outcome.wrote_z, outcome.wrote_mode) == (True, False, True)
    np.testing.assert_allclose(evaluate(outcome, [-1e-9, -2.0], mode=3), [1e-9, 1.8, 4.0])

    outcome = traced(lambda t, s: s, kind="reset")
    assert not (outcome.wrote_x or outcome.wrote_z or outcome.wrote_mode)
    assert outcome.tape.size == 0


def test_a_reset_map_reads_its_entry_and_what_it_has_written():
    def kick(time, state):
        changed = state.with_discrete_state(state.discrete_state + 1)
        x = changed.continuous_state + changed.discrete_state[0] + state.entry
        return changed.with_continuous_state(x).with_mode(np.where(x[0] > 0, 1, 2))

    outcome = traced(kick, kind="reset", discrete_shape=(1,))
    found = evaluate(outcome, [1.0, -9.0], z=[5.0], entry=2)
    np.testing.assert_array_equal(found, [9.0, -1.0, 6.0, 1.0])


def test_an_update_may_return_the_discrete_state_alone():
    outcome = traced(lambda t, s: s.discrete_state * 2, kind="update", discrete_shape=(2,))
    assert (outcome.wrote_x, outcome.wrote_z, outcome.wrote_mode) == (False, True, False)
    np.testing.assert_array_equal(evaluate(outcome, [0.0, 0.0], z=[1.0, 2.0]), [2.0, 4.0])


def test_a_matrix_is_row_by_row():
    outcome = traced(lambda t, s: [[0.0, 1.0], [-s.continuous_state[0], 0.0]], kind="matrix")
    np.testing.assert_array_equal(evaluate(outcome, [3.0, 0.0]), [[0.0, 1.0], [-3.0, 0.0]])


def test_a_python_pole_is_infinite_or_nan():
    outcome = traced(lambda t, s: 1.0 / t + math.sqrt(s.continuous_state[0] + 2.0))
    assert not np.isfinite(evaluate(outcome, [-3.0, 0.0], time=0.0))


def test_a_matrix_keeps_its_sparsity():
    n = 12
    heat = np.diag(np.full(n, -2.0)) + np.diag(np.ones(n - 1), 1) + np.diag(np.ones(n - 1), -1)
    outcome = assert_agrees(lambda t, s: heat @ s.continuous_state, x=1.7 ** np.arange(n))
    rows, columns, _ = outcome.tape.jacobian()
    assert sorted(zip(rows, columns, strict=True)) == sorted(
        zip(*(places.tolist() for places in heat.nonzero()), strict=True)
    )
