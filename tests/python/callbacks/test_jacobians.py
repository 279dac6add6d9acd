"""Jacobians of tapes against differences, on the models of the tests."""

import numpy as np
import pytest
from saltus import tracing
from systems import Ball, Decay

from models import Pendulum, leaf

RNG = np.random.default_rng(5)
MATRIX = RNG.normal(size=(4, 4))


def brusselator(t, s):
    u, v = s.continuous_state[:4], s.continuous_state[4:]
    around = np.concatenate([[1.0], u, [1.0]]), np.concatenate([[3.0], v, [3.0]])
    du, dv = (a[:-2] - 2.0 * a[1:-1] + a[2:] for a in around)
    return np.concatenate([1.0 + u**2 * v - 4.0 * u + du, 3.0 * u - u**2 * v + dv])


def robertson(t, s):
    x, y, z = s.continuous_state
    return [-0.04 * x + 1e4 * y * z, 0.04 * x - 1e4 * y * z - 3e7 * y**2, 3e7 * y**2]


MODELS = {
    "pendulum": Pendulum(),
    "ball": Ball(),
    "linear": leaf(lambda t, s: MATRIX @ s.continuous_state, np.ones(4)),
    "brusselator": leaf(brusselator, np.linspace(0.5, 2.0, 8)),
    "robertson": leaf(robertson, [1.0, 1e-5, 0.1]),
    "decay": leaf(lambda t, s: -s.continuous_state),
    "kepler": leaf(
        lambda t, s: np.append(
            s.continuous_state[2:],
            -s.continuous_state[:2] / np.linalg.norm(s.continuous_state[:2]) ** 3,
        ),
        [1.0, 0.1, 0.2, 0.9],
    ),
    "van der pol": leaf(
        lambda t, s, *, mu: [
            s.continuous_state[1],
            mu * (1.0 - s.continuous_state[0] ** 2) * s.continuous_state[1] - s.continuous_state[0],
        ],
        [2.0, 0.3],
        mu=7.0,
    ),
}


def ode_tape(system):
    """The tape of the ode, its start values and parameters."""
    from saltus.callbacks import traced_callbacks

    callbacks = traced_callbacks(system)
    (block,) = callbacks.traces.blocks()
    (k,) = [i for i, f in enumerate(block["functions"]) if f["role"] == "ode"]
    outcome = callbacks.outcomes[0][k]
    assert isinstance(outcome, tracing.Traced), outcome.reason
    values = [np.ravel(v) for v in block["parameters"].values()]
    return outcome.tape, block["x"], np.concatenate([*values, np.empty(0)])


@pytest.mark.parametrize("name", MODELS)
def test_agrees_with_differences(name):
    tape, start, p = ode_tape(MODELS[name])
    rows, columns, values = tape.jacobian()
    for _ in range(5):
        x = np.array(start) + 0.05 * np.abs(start) * RNG.normal(size=start.size)
        found = np.zeros((start.size, start.size))
        found[rows, columns] = values(0.0, x, np.empty(0), 0, 0, p, [])
        expected, noise = differences(lambda x: tape(0.0, x, np.empty(0), 0, 0, p, []), x)
        assert np.all(np.abs(found - expected) <= noise)


def differences(f, x):
    """Central differences, and what they are good for: rounding of f over the step, and the third
    derivative, which twice the step shows.
    """
    columns, doubts = [], []
    for j in range(x.size):
        h = 6e-6 * max(1e-3, abs(x[j]))
        at = {k: f(x + k * h * np.eye(x.size)[j]) for k in (-2, -1, 1, 2)}
        near, far = (at[1] - at[-1]) / (2 * h), (at[2] - at[-2]) / (4 * h)
        columns.append(near)
        size = max(np.max(np.abs(value)) for value in at.values())
        doubts.append(np.abs(near - far) + 1e-15 * (1.0 + size) * (1.0 + 20.0) / h)
    return np.array(columns).T, np.array(doubts).T


def test_decay_of_the_tests_is_called():
    """Its hook may do anything."""
    assert Decay(lambda t, s: print(t)).explain()[0].runs == "called"
