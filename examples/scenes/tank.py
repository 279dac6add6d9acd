"""A tank that a pump fills between two levels; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus

FILLING, WAITING = 0, 1
AREA, INFLOW, OUTLET, G = 2.0, 0.3, 0.05, 9.81  # [m^2], [m^3/s], [m^2], [m/s^2]
LOW, HIGH = 0.5, 1.0  # [m]


class Tank(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="tank")
        self.declare_continuous_state([0.75], ode=self.ode)
        self.declare_default_mode(FILLING)
        self.declare_zero_crossing(
            self.full, name="full", direction="rising", start_mode=FILLING, end_mode=WAITING
        )
        self.declare_zero_crossing(
            self.empty, name="empty", direction="falling", start_mode=WAITING, end_mode=FILLING
        )
        self.declare_output_port(lambda time, state: state.continuous_state[0], name="level")
        self.declare_output_port(self.outflow, name="outflow")

    def outflow(self, time: float, state: saltus.State) -> Any:
        return OUTLET * np.sqrt(2 * G * state.continuous_state[0])

    def ode(self, time: float, state: saltus.State) -> Any:
        pumped = np.where(state.mode == FILLING, INFLOW, 0.0)
        return [(pumped - self.outflow(time, state)) / AREA]

    def full(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0] - HIGH

    def empty(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0] - LOW


def run() -> saltus.Results:
    tank = Tank()
    return saltus.simulate(
        tank, tank.create_context(), (0.0, 100.0),
        rtol=1e-9, atol=1e-11, recorded_signals=["level", "outflow"],
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
