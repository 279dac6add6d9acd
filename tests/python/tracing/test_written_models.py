"""Models as people write them trace, and their Jacobians are right."""

import numpy as np
import pytest
from steps import central_difference, complex_step
from tracing_cases import EPS, State, evaluate, traced
from written_models import MODELS


@pytest.mark.parametrize("name", MODELS)
def test_model(name):
    f, start, analytic = MODELS[name]
    x = np.array(start, dtype=float)
    outcome = traced(f, x=x)
    called = np.ravel(f(0.7, State(x)))
    taped = np.ravel(evaluate(outcome, x, time=0.7))
    # terms may cancel: the size of a term is that of the Jacobian times the state
    exact = (complex_step if analytic else central_difference)(f, 0.7, x)
    size = np.abs(exact) @ np.abs(x) + np.abs(called)
    assert (np.abs(taped - called) <= 100 * EPS * size).all()

    rows, columns, values = outcome.tape.jacobian()
    dense = np.zeros_like(exact)
    dense[rows, columns] = values(0.7, x, [], 0, 0, [], [])
    scale = np.abs(exact).max(axis=1, keepdims=True)
    # the steps' own error: rounding, or the cube root of eps squared (1e-10) times third
    # derivatives, which for these models and steps are below 1e3 times the first
    room = 1e-13 if analytic else 1e-7
    assert (np.abs(dense - exact) <= room * scale).all()


def test_sparsity_is_that_of_the_equations():
    f, start, _ = MODELS["upwind"]
    rows, columns, _ = traced(f, x=start).tape.jacobian()
    n = len(start)
    expected = {(i, i) for i in range(n)} | {(i, i - 1) for i in range(1, n)}
    assert set(zip(rows, columns, strict=True)) == expected
