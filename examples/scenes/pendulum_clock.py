"""A pendulum clock with an escapement; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus

G, LENGTH, DAMPING, KICK = 9.81, 0.994, 0.02, 0.002  # [m/s^2], [m], [1/s], [rad/s]


class Clock(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="clock")
        self.declare_continuous_state([0.06, 0.0], ode=self.ode)
        self.declare_discrete_state([0.0])
        self.declare_zero_crossing(self.angle, self.escape, name="tick")
        self.declare_output_port(self.angle, name="angle")
        self.declare_output_port(lambda time, state: state.discrete_state[0], name="ticks")

    def ode(self, time: float, state: saltus.State) -> Any:
        angle, speed = state.continuous_state
        return [speed, -G / LENGTH * np.sin(angle) - DAMPING * speed]

    def angle(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0]

    def escape(self, time: float, state: saltus.State) -> saltus.State:
        angle, speed = state.continuous_state
        return state.with_continuous_state(
            [angle, speed + KICK * np.sign(speed)]
        ).with_discrete_state([state.discrete_state[0] + 1])


def run() -> saltus.Results:
    clock = Clock()
    return saltus.simulate(
        clock, clock.create_context(), (0.0, 100.0),
        rtol=1e-9, atol=1e-11, recorded_signals=["angle", "ticks"],
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
