"""Runs whose derivatives are known in closed form."""

import numpy as np
import saltus

G, E, Y0 = 9.81, 0.9, 10.0
T1 = np.sqrt(2 * Y0 / G)  # [s] the first impact
STATE = [  # at t = 12, after six impacts, by g, e, y0
    [4.2692770252563905, -225.42387137755526, -4.154070371383476],
    [-5.644226914561967, 369.7316543555371, 6.23501339681471],
]


class Ball(saltus.LeafSystem):
    """A ball over a floor at 0; with `stops` the run ends at the first impact."""

    def __init__(self, height=Y0, speed=0.0, stops=False, on_zeno="hold"):
        super().__init__(name="ball")
        self.declare_dynamic_parameter("g", G)
        self.declare_dynamic_parameter("e", E)
        self.declare_continuous_state(
            [height, speed], ode=lambda t, s, g, e: [s.continuous_state[1], -g]
        )
        self.declare_continuous_state_output("state")
        self.declare_zero_crossing(
            lambda t, s, g, e: s.continuous_state[0],
            lambda t, s, g, e: s.with_continuous_state(
                [s.continuous_state[0], -e * s.continuous_state[1]]
            ),
            name="bounce",
            direction="positive_then_non_positive",
            terminal=stops,
            on_zeno=on_zeno,
        )


class Decay(saltus.LeafSystem):
    """x' = -k x for each entry, + sqrt(b): no derivative by b at b = 0."""

    def __init__(self):
        super().__init__(name="decay")
        self.declare_dynamic_parameter("k", np.array([1.0, 2.0]))
        self.declare_dynamic_parameter("b", 0.0)
        self.declare_continuous_state(
            [3.0, 5.0], ode=lambda t, s, k, b: -k * s.continuous_state + np.sqrt(b)
        )
        self.declare_continuous_state_output("x")


def impacts(count):
    """d t_k by g, e, y0 from t_k = t1 (1 + 2 sum of e^j for 0 < j < k)."""
    powers = np.array([1 + 2 * sum(E**j for j in range(1, k)) for k in range(1, count + 1)])
    by_e = [2 * T1 * sum(j * E ** (j - 1) for j in range(1, k)) for k in range(1, count + 1)]
    return np.stack([-T1 / (2 * G) * powers, by_e, T1 / (2 * Y0) * powers], axis=1)
