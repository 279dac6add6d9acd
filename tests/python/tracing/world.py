"""What the expressions of the tests are made of, and how they become functions."""

# The expressions are text: ruff does not see what they use.
import math  # noqa: F401
import operator  # noqa: F401
from collections import namedtuple
from functools import reduce  # noqa: F401
from math import atan2, hypot  # noqa: F401
from types import SimpleNamespace

import numpy as np
from numpy import array, cos  # noqa: F401

MATRIX = np.array([[0.0, 1.0], [-4.0, -0.5]])
Pair = namedtuple("Pair", "a b")
STACK = np.arange(12.0).reshape(3, 2, 2)
GAINS = [2.0, 5.0]
PAIR = (2, 3)
NAMED = {0: 1.0, 1: np.array([2.0, 4.0])}
MATRICES = [np.eye(2), np.ones((2, 2))]
TABLE = {"k": 2.0, "gains": [1.0, 3.0]}
SPRING = SimpleNamespace(k=4.0, c=np.array([0.1, 0.2]))


def helper(a, b):
    return np.sin(a) * abs(b)


def recursive(n, a):
    return a if n == 0 else a * recursive(n - 1, a)


def over_state(expression):
    """A function of (time, state) from the source of an expression in x, t and mode."""
    source = (
        "def f(time, state):\n"
        "    x, t, mode = state.continuous_state, time, state.mode\n"
        f"    return {expression}\n"
    )
    exec(source, globals(), made := {})
    return made["f"]
