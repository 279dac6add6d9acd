"""Random programs: what traces gives what it gives when called, at ties and at zeros too."""

import math
from collections import Counter

import numpy as np
import pytest
from random_programs import source
from saltus.tracing import Traced, trace
from tracing_cases import State, evaluate, signature

GRID = np.array([-2.0, -1.5, -1.0, -0.5, -0.3, 0.0, 0.3, 0.5, 1.0, 1.5, 2.0, 3.0])
COUNT = 300


def made(seed):
    space = {"np": np, "math": math, "W": np.array([1.0, -2.0, 0.5])}
    exec(source(seed), space)
    return space["f"]


def outcome_of(f):
    return trace(signature(f, x=[0.3, -0.8, 1.2], parameters={"k": 0.7}, input_shapes=[(3,)]))


@pytest.mark.parametrize("block", range(10))
def test_values(block):
    for seed in range(block * COUNT // 10, (block + 1) * COUNT // 10):
        f = made(seed)
        outcome = outcome_of(f)
        if isinstance(outcome, Traced):
            for called, taped in pairs(f, outcome, np.random.default_rng(seed)):
                # a few operations on numbers of order one; sums of terms of both signs
                room = 1e-13 * (1.0 + np.abs(called))
                same = np.isclose(called, taped, rtol=0.0, atol=0.0, equal_nan=True)
                assert (same | (np.abs(called - taped) <= room)).all(), source(seed)
        else:
            assert "check failed" not in outcome.reason, source(seed)


def pairs(f, outcome, rng):
    """What f gives and what its tape gives, at ten points where f does not raise."""
    for _ in range(10):
        x, u = rng.choice(GRID, 3), rng.choice(GRID, 3)
        t, k, n = float(rng.choice(GRID)), float(rng.choice(GRID)), int(rng.integers(0, 4))
        try:
            with np.errstate(all="ignore"):
                called = np.asarray(f(t, State(x, mode=n), u, k), dtype=float)
        except (ArithmeticError, ValueError, TypeError):
            continue
        taped = evaluate(outcome, x, time=t, mode=n, p=[k], u=[u])
        assert taped.shape == called.shape
        yield called, taped


def test_most_of_them_trace():
    kinds = Counter(type(outcome_of(made(seed))).__name__ for seed in range(100))
    assert kinds["Traced"] > 60
