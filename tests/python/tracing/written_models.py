"""Models as people write them, f(t, state), with a state to look at and whether complex steps work.

They are nowhere near a kink at the states given.
"""

import math
from dataclasses import dataclass, field

import numpy as np


def pendulum(t, state, g=9.81, length=1.5):
    angle, speed = state.continuous_state
    return np.array([speed, -g / length * np.sin(angle)])


def van_der_pol(t, state):
    x, y = state.continuous_state
    return [y, 1000.0 * (1 - x**2) * y - x]


def lorenz(t, state, sigma=10.0, rho=28.0, beta=8 / 3):
    x, y, z = state.continuous_state
    dxdt = sigma * (y - x)
    dydt = x * (rho - z) - y
    dzdt = x * y - beta * z
    return dxdt, dydt, dzdt


STOICHIOMETRY = np.array([[-1.0, 1.0, 0.0], [1.0, -1.0, -1.0], [0.0, 0.0, 1.0]])


def robertson(t, state):
    a, b, c = state.continuous_state
    rates = np.array([0.04 * a, 1e4 * b * c, 3e7 * b**2])
    return STOICHIOMETRY @ rates


def brusselator(t, state):
    n = len(state.continuous_state) // 2
    u, v = state.continuous_state[:n], state.continuous_state[n:]
    u_wide = np.concatenate([[1.0], u, [1.0]])
    v_wide = np.concatenate([[3.0], v, [3.0]])
    spread = 0.02 * (n + 1) ** 2
    du = 1.0 + u**2 * v - 4.0 * u + spread * (u_wide[:-2] - 2 * u + u_wide[2:])
    dv = 3.0 * u - u**2 * v + spread * (v_wide[:-2] - 2 * v + v_wide[2:])
    return np.concatenate([du, dv])


def upwind(t, state):
    x = state.continuous_state
    dx = np.zeros_like(x)
    dx[0] = np.sin(t) - x[0]
    for i in range(1, len(x)):
        dx[i] = x[i - 1] - x[i] * x[i]
    return dx


MASSES = np.array([3.0, 4.0, 5.0])


def three_bodies(t, state):
    places = state.continuous_state[:6].reshape(3, 2)
    speeds = state.continuous_state[6:].reshape(3, 2)
    pulls = np.zeros((3, 2))
    for i in range(3):
        for j in range(3):
            if i == j:
                continue
            apart = places[j] - places[i]
            pulls[i] += MASSES[j] * apart / np.sum(apart**2) ** 1.5
    return np.concatenate([speeds, pulls]).ravel()


def double_pendulum(t, state):
    a, b, da, db = state.continuous_state
    coupling = np.cos(a - b)
    mass = np.array([[2.0, coupling], [coupling, 1.0]])
    force = np.array(
        [
            -np.sin(a - b) * db**2 - 2 * 9.81 * np.sin(a),
            np.sin(a - b) * da**2 - 9.81 * np.sin(b),
        ]
    )
    return np.concatenate([[da, db], np.linalg.solve(mass, force)])


def quadrotor(t, state):
    phi, theta, psi, p, q, r = state.continuous_state
    turn = np.array(
        [
            [1, np.sin(phi) * np.tan(theta), np.cos(phi) * np.tan(theta)],
            [0, np.cos(phi), -np.sin(phi)],
            [0, np.sin(phi) / np.cos(theta), np.cos(phi) / np.cos(theta)],
        ]
    )
    inertia = np.diag([0.01, 0.02, 0.03])
    spin = np.array([p, q, r])
    torque = -0.1 * spin - np.cross(spin, inertia @ spin)
    return np.hstack((turn @ spin, np.linalg.inv(inertia) @ torque + 0.0 * psi))


def axon(t, state):
    v, m, h, n = state.continuous_state

    def gate(level, opening, closing):
        return opening * (1.0 - level) - closing * level

    current = 120.0 * m**3 * h * (v - 50.0) + 36.0 * n**4 * (v + 77.0) + 0.3 * (v + 54.4)
    return np.array(
        [
            10.0 - current,
            gate(m, 0.1 * (v + 40.0) / (1.0 - np.exp(-(v + 40.0) / 10.0)), 4 * np.exp(-v / 18.0)),
            gate(h, 0.07 * np.exp(-v / 20.0), 1.0 / (1.0 + np.exp(-(v + 35.0) / 10.0))),
            gate(n, 0.125 * np.exp(-v / 80.0), 0.1),
        ]
    )


def projectile(t, state):
    _, _, vx, vy = state.continuous_state
    speed = np.hypot(vx, vy)
    return [vx, vy, -0.05 * speed * vx, -9.81 - 0.05 * speed * vy]


def hertz_contact(t, state):
    y, v = state.continuous_state
    depth = np.maximum(0.0, -y)
    return np.array([v, -9.81 + 1e4 * depth**1.5 * (1.0 - 0.1 * v)])


def stick_slip(t, state):
    x, v = state.continuous_state
    slip = v - 0.5
    friction = (1.0 + 0.5 * np.exp(-np.abs(slip))) * np.tanh(50.0 * slip)
    return [v, -x - friction * np.where(slip > 0, 1.2, 1.0)]


SPEEDS, TORQUES = [0.0, 100.0, 200.0, 400.0], [50.0, 80.0, 90.0, 20.0]


def engine(t, state):
    (speed,) = state.continuous_state
    return np.array([np.interp(speed, SPEEDS, TORQUES) - 1e-3 * speed * abs(speed)])


@dataclass
class Tyre:
    stiffness: float = 10.0
    shape: float = 1.9
    loads: list = field(default_factory=lambda: [3.0, 4.0])

    def force(self, slip, load):
        return load * math.sin(self.shape * math.atan(self.stiffness * slip))

    def __call__(self, t, state):
        slips = state.continuous_state
        return [self.force(slip, load) for slip, load in zip(slips, self.loads, strict=True)]


# function, state, whether it is analytic
MODELS = {
    "pendulum": (pendulum, [0.4, -1.0], True),
    "van_der_pol": (van_der_pol, [2.0, -0.6], True),
    "lorenz": (lorenz, [1.0, 1.2, 20.0], True),
    "robertson": (robertson, [0.8, 2e-5, 0.2], True),
    "brusselator": (brusselator, np.linspace(1.0, 3.0, 12), True),
    "upwind": (upwind, np.linspace(0.3, 1.0, 9), True),
    "three_bodies": (three_bodies, [1, 3, -2, -1, 1, -1, 0.1, 0.3, 0.2, 0.5, 0.4, 0.3], False),
    "double_pendulum": (double_pendulum, [0.5, -0.7, 1.0, 2.0], True),
    "quadrotor": (quadrotor, [0.1, 0.2, 0.3, 1.0, -2.0, 0.5], True),
    "axon": (axon, [-60.0, 0.1, 0.6, 0.3], True),
    "projectile": (projectile, [0.0, 1.0, 30.0, 40.0], False),
    "hertz_contact": (hertz_contact, [-0.01, -2.0], False),
    "stick_slip": (stick_slip, [0.4, 0.7], False),
    "engine": (engine, [150.0], False),
    "tyre": (Tyre(), [0.05, -0.02], False),
}
