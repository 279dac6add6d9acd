"""Derivatives by steps, to compare Jacobians with."""

import numpy as np
from tracing_cases import State


class ComplexState(State):
    def __init__(self, x):
        super().__init__(np.real(x))
        self.continuous_state = x


def complex_step(f, t, x, *arguments):
    """d f / d x to rounding: Im f(x + i h e) / h; Squire & Trapp, SIAM Review 40 (1998), 110."""
    h = 1e-30
    moved = (ComplexState(x + 1j * h * e) for e in np.eye(len(x)))
    return np.array([np.imag(np.ravel(f(t, state, *arguments))) / h for state in moved]).T


def central_difference(f, t, x, *arguments):
    """d f / d x with steps of the cube root of eps, relative to the size of each state."""
    columns = []
    for i, e in enumerate(np.eye(len(x))):
        h = np.cbrt(np.finfo(float).eps) * max(abs(x[i]), 1e-3)
        ahead, behind = (np.ravel(f(t, State(x + s * h * e), *arguments)) for s in (1, -1))
        columns.append((ahead - behind) / (2 * h))
    return np.array(columns).T
