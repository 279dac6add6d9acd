"""Two hundred random functions: values to a few roundings, Jacobians against complex steps."""

import math

import numpy as np
import pytest
from random_expressions import source
from steps import complex_step
from tracing_cases import EPS, State, evaluate, traced

POINTS = np.array([[0.3, -0.8, 1.2], [-1.1, 0.4, 0.05], [0.9, 1.3, -0.6]])
WORLD = {
    "np": np,
    "math": math,
    "C": np.array([0.5, -1.25]),
    "M": np.array([[0.0, 1.0, 0.5], [-2.0, 0.0, 0.0], [0.25, 0.0, -1.0]]),
    "helper": lambda a, b: a * b + np.cos(a - b),
}


def made(seed):
    space = WORLD.copy()
    exec(source(seed), space)
    return space["f"]


def spread(f, t, x, k, rng):
    """How much f moves when its arguments move in their last digits: what rounding can do.

    The expressions are at most 60 operations deep and wide; each adds half a unit in the last
    place of an intermediate result, as a change of the arguments by as much would.
    """
    base = np.ravel(f(t, State(x), k))
    moves = []
    for _ in range(8):
        x1 = x * (1.0 + 4 * EPS * rng.uniform(-1, 1, x.size))
        moved = f(t * (1 + 4 * EPS * rng.uniform(-1, 1)), State(x1), k * (1 + 4 * EPS))
        moves.append(np.abs(np.ravel(moved) - base))
    return np.max(moves, axis=0) + EPS * (1.0 + np.abs(base))


@pytest.mark.parametrize("seed", range(200))
def test_values_and_jacobian(seed):
    f = made(seed)
    outcome = traced(f, x=POINTS[0], parameters={"k": 0.7})
    rows, columns, values = outcome.tape.jacobian()
    rng = np.random.default_rng(seed)
    for x in POINTS:
        for t in (0.2, 6.5):
            called = np.ravel(f(t, State(x), 0.7))
            taped = np.ravel(evaluate(outcome, x, time=t, p=[0.7]))
            room = 60 * spread(f, t, x, 0.7, rng)
            assert (np.abs(called - taped) <= room).all(), (called, taped)

            exact = complex_step(f, t, x, 0.7)
            dense = np.zeros_like(exact)
            dense[rows, columns] = values(t, x, [], 0, 0, [0.7], [])
            # Derivatives of a function whose values are good to `room`: the same relative
            # accuracy of every term, so of the largest of them, which no row of these exceeds
            # a hundredfold.
            size = np.abs(exact).max(axis=1, keepdims=True) + 1.0
            assert (np.abs(dense - exact) <= 100 * 60 * EPS * size).all(), (dense, exact)


def test_they_are_different_and_not_trivial():
    sources = {source(seed) for seed in range(200)}
    assert len(sources) == 200
    sizes = [traced(made(seed), x=POINTS[0], parameters={"k": 0.7}).tape.size for seed in range(9)]
    assert min(sizes) >= 2
