"""Systems to fit, and their closed forms."""

import math

import numpy as np
import saltus


class Throw(saltus.LeafSystem):
    """A ball over a floor at 0."""

    def __init__(self, g=9.81, e=0.8, height=1.0, speed=0.0):
        super().__init__(name="ball")
        self.declare_dynamic_parameter("g", g)
        self.declare_dynamic_parameter("e", e)
        self.declare_continuous_state([height, speed], ode=self.ode, names=["height", "velocity"])
        self.declare_continuous_state_output("state")
        self.declare_zero_crossing(
            self.floor, self.bounce, name="bounce", direction="positive_then_non_positive"
        )

    def ode(self, time, state, *, g, e):
        return [state.continuous_state[1], -g]

    def floor(self, time, state, **parameters):
        return state.continuous_state[0]

    def bounce(self, time, state, *, g, e):
        y, v = state.continuous_state
        return state.with_continuous_state([y, -e * v])


class Decay(saltus.LeafSystem):
    """x' = -k x; y = a b x, so that only the product of a and b can be seen; c is not used."""

    def __init__(self, k=1.0):
        super().__init__(name="decay")
        for name, value in {"k": k, "a": 1.0, "b": 1.0, "c": 1.0}.items():
            self.declare_dynamic_parameter(name, value)
        self.fixed = 3.0
        self.declare_continuous_state([1.0], ode=self.ode)
        self.declare_output_port(self.seen, name="y")

    def ode(self, time, state, *, k, **others):
        return [-k * state.continuous_state[0]]

    def seen(self, time, state, *, a, b, **others):
        return a * b * state.continuous_state[0]


def impacts(count, g=9.81, e=0.8, height=1.0):
    """[s] t_k = t1 (1 + 2 sum of e^j for 0 < j < k), t1 = sqrt(2 height / g)."""
    first = math.sqrt(2 * height / g)
    return np.array([first * (1 + 2 * sum(e**j for j in range(1, k))) for k in range(1, count + 1)])


def heights(times, g=9.81, e=0.8, height=1.0):
    """[m] Of the ball, by its parabolas."""
    hits = impacts(60, g, e, height)
    found = []
    for t in times:
        k = int(np.searchsorted(hits, t, side="right"))
        if k == 0:
            found.append(height - g * t**2 / 2)
        else:
            s, v = t - hits[k - 1], math.sqrt(2 * g * height) * e**k
            found.append(v * s - g * s**2 / 2)
    return np.array(found)
