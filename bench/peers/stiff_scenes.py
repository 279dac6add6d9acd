"""Stiff scenes in NumPy, for programs that take f and its Jacobian. A state is a column of n
numbers, or n rows of many columns. Equations and parameters are those of include/saltus/models.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from stiff_more import e5, pollu, pollu_start, ring


@dataclass
class StiffScene:
    """y' = f(t, y) from `start` at t = 0 to the last of `times`. The error of a component is
    |y - answer| / (scale + |answer|); a run has the tolerances rtol and scale * rtol.
    """

    f: Callable
    start: np.ndarray
    times: list
    scale: float

    def jacobian(self, t, y):
        """By a complex step, which has no error of its own: all columns in one call of f."""
        h = 1e-100
        return self.f(t, y[:, None] + 1j * h * np.eye(len(y))).imag / h


def vdpol(mu):
    def f(t, y):
        return np.array([y[1], ((1.0 - y[0] * y[0]) * y[1] - y[0]) * mu**2])

    return StiffScene(f, np.array([2.0, 0.0]), [0.5, 1.0, 1.5, 2.0], 1e-2)


def robertson(t, y):
    decay, back, on = 0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] * y[1]
    return np.array([back - decay, decay - back - on, on])


def hires(t, y):
    bound = 280.0 * y[5] * y[7] - 1.81 * y[6]
    return np.array([
        -1.71 * y[0] + 0.43 * y[1] + 8.32 * y[2] + 0.0007,
        1.71 * y[0] - 8.75 * y[1],
        -10.03 * y[2] + 0.43 * y[3] + 0.035 * y[4],
        8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3],
        -1.745 * y[4] + 0.43 * (y[5] + y[6]),
        -280.0 * y[5] * y[7] + 0.69 * y[3] + 1.71 * y[4] - 0.43 * y[5] + 0.69 * y[6],
        bound, -bound,
    ])  # fmt: skip


def oregonator(t, y):
    return np.array([
        77.27 * (y[1] + y[0] * (1.0 - 8.375e-6 * y[0] - y[1])),
        (y[2] - (1.0 + y[0]) * y[1]) / 77.27,
        0.161 * (y[0] - y[2]),
    ])  # fmt: skip


def b5(t, y):
    return np.array([
        -10.0 * y[0] + 100.0 * y[1], -100.0 * y[0] - 10.0 * y[1],
        -4.0 * y[2], -y[3], -0.5 * y[4], -0.1 * y[5],
    ])  # fmt: skip


def beam(t, y):
    """n = 40 rods."""
    n, theta, rate = 40, y[:40], y[40:]
    force = 1.5 * np.sin(t) ** 2 if t < np.pi else 0.0
    apart = theta[1:] - theta[:-1]
    sine, cosine = np.sin(apart), np.cos(apart)
    before, after = (
        np.concatenate([-theta[:1], theta[:-1]]),
        np.concatenate([theta[1:], theta[-1:]]),
    )
    v = n**4 * (before - 2.0 * theta + after) + n**2 * force * (np.cos(theta) + np.sin(theta))

    def turned(x):  # D x
        out = np.zeros_like(x)
        out[1:] -= sine * x[:-1]
        out[:-1] += sine * x[1:]
        return out

    diagonal, k = np.array([1.0] + [2.0] * (n - 2) + [3.0]), np.arange(n - 1)
    c = np.zeros((*y.shape[1:], n, n), y.dtype)
    c[..., np.arange(n), np.arange(n)] = diagonal
    c[..., k, k + 1] = c[..., k + 1, k] = -np.moveaxis(cosine, 0, -1)
    of_v = np.einsum("...ij,j...->i...", c, v)
    w = np.linalg.solve(c, np.moveaxis(turned(v) + rate * rate, 0, -1)[..., None])[..., 0]
    return np.concatenate([rate, of_v + turned(np.moveaxis(w, -1, 0))])


def cusp(t, y):
    """32 cells, epsilon = 1e-4."""
    cell = y.reshape(32, 3, *y.shape[1:])
    x, a, b = cell[:, 0], cell[:, 1], cell[:, 2]
    u = (x - 0.7) * (x - 1.3)
    v = u / (u + 0.1)
    own = np.stack([
        -1e4 * (x**3 + a * x + b),
        b + 0.07 * v,
        (1.0 - a * a) * b - a - 0.4 * x + 0.035 * v,
    ], axis=1)  # fmt: skip
    spread = np.roll(cell, 1, axis=0) - 2.0 * cell + np.roll(cell, -1, axis=0)
    return (own + 32**2 / 144.0 * spread).reshape(y.shape)


def cusp_start():
    angle = 2.0 * np.pi * np.arange(1, 33) / 32
    return np.stack([np.zeros(32), -2.0 * np.cos(angle), 2.0 * np.sin(angle)], axis=1).ravel()


def laplacian():
    """Five points on 8 by 5, x first, a distance 2 / 9 apart; zero outside."""
    second = [np.eye(n, k=1) + np.eye(n, k=-1) - 2.0 * np.eye(n) for n in (8, 5)]
    return (np.kron(np.eye(5), second[0]) + np.kron(second[1], np.eye(8))) * 4.5**2


STIFFNESS = 100.0 * laplacian() @ laplacian()
LOADED = np.array([j in (1, 3) for j in range(5) for i in range(8)])
PLACE = np.array([(i + 1) * 2.0 / 9.0 for j in range(5) for i in range(8)])


def plate(t, y):
    u, rate = y[:40], y[40:]
    wheels = np.exp(-5.0 * (t - PLACE - 2.0) ** 2) + np.exp(-5.0 * (t - PLACE - 5.0) ** 2)
    load = (200.0 * LOADED * wheels).reshape(40, *[1] * (y.ndim - 1))
    return np.concatenate([rate, load - 1000.0 * rate - STIFFNESS @ u])


SCENES = {
    "vdpol": vdpol(1e3),
    "vdpol-1e6": vdpol(1e6),
    "robertson": StiffScene(
        robertson, np.array([1.0, 0.0, 0.0]), [0.4 * 10.0**k for k in range(12)], 1e-8
    ),
    "hires": StiffScene(
        hires, np.array([1.0, 0, 0, 0, 0, 0, 0, 0.0057]), [5, 20, 80, 200, 300, 321.8122], 1e-4
    ),
    "orego": StiffScene(oregonator, np.array([1.0, 2.0, 3.0]), [60, 120, 180, 240, 300, 360], 1e-2),
    "pollu": StiffScene(pollu, pollu_start(), [1.0, 5.0, 15.0, 30.0, 60.0], 1e-10),
    "e5": StiffScene(
        e5, np.array([1.76e-3, 0.0, 0.0, 0.0]), [10.0**k for k in range(-4, 14)], 1e-17
    ),
    "ring-modulator": StiffScene(ring, np.zeros(15), [2.5e-4, 5e-4, 7.5e-4, 1e-3], 1e-2),
    "b5": StiffScene(b5, np.ones(6), [0.1, 1.0, 5.0, 20.0], 1.0),
    "beam": StiffScene(beam, np.zeros(80), [1.0, 2.0, 3.0, 4.0, 5.0], 1.0),
    "cusp": StiffScene(cusp, cusp_start(), [0.25, 0.5, 0.75, 1.1], 1.0),
    "plate": StiffScene(plate, np.zeros(80), [1.75, 3.5, 5.25, 7.0], 1e-3),
}
