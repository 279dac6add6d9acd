"""A thermostat with two thresholds: four periods; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus

HEATING, OFF = 0, 1
OUTSIDE, POWER, TAU = 5.0, 30.0, 1.0  # [C], [K], [h]
LOW, HIGH = 19.0, 21.0  # [C]


class Thermostat(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="thermostat")
        self.declare_continuous_state([20.0], ode=self.ode)
        self.declare_default_mode(HEATING)
        self.declare_zero_crossing(self.warm, name="warm", start_mode=HEATING, end_mode=OFF)
        self.declare_zero_crossing(self.cold, name="cold", start_mode=OFF, end_mode=HEATING)
        self.declare_output_port(lambda time, state: state.continuous_state[0], name="room")
        self.declare_output_port(lambda time, state: state.mode == HEATING, name="heating")

    def ode(self, time: float, state: saltus.State) -> Any:
        warmed = np.where(state.mode == HEATING, POWER, 0.0)
        return [(OUTSIDE + warmed - state.continuous_state[0]) / TAU]

    def warm(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0] - HIGH

    def cold(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0] - LOW


def run() -> saltus.Results:
    room = Thermostat()
    return saltus.simulate(
        room, room.create_context(), (0.0, 1.2),
        rtol=1e-9, atol=1e-11, recorded_signals=["room", "heating"],
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
