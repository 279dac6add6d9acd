"""A brake that releases the wheel before it locks; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus

BRAKES, RELEASES = 0, 1
M, J, R, G = 450.0, 1.1, 0.32, 9.81  # [kg], [kg m^2], [m], [m/s^2]
MOST, LAG = 3000.0, 0.05  # [N m], [s]
LOCKS, GRIPS = 0.2, 0.1  # slip


class Brake(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="brake")
        self.declare_continuous_state([30.0, 30.0 / R, 0.0, 0.0], ode=self.ode)
        self.declare_default_mode(BRAKES)
        self.declare_zero_crossing(
            lambda time, state: self.slip(time, state) - LOCKS, name="lock",
            direction="rising", start_mode=BRAKES, end_mode=RELEASES,
        )  # fmt: skip
        self.declare_zero_crossing(
            lambda time, state: self.slip(time, state) - GRIPS, name="grip",
            direction="falling", start_mode=RELEASES, end_mode=BRAKES,
        )  # fmt: skip
        self.declare_zero_crossing(
            lambda time, state: state.continuous_state[0] - 1, name="stops",
            direction="falling", terminal=True,
        )  # fmt: skip
        self.declare_output_port(lambda time, state: state.continuous_state[0], name="speed")
        self.declare_output_port(self.slip, name="slip")
        self.declare_output_port(lambda time, state: state.continuous_state[3], name="way")

    def slip(self, time: float, state: saltus.State) -> Any:
        v, w, _, _ = state.continuous_state
        return 1 - R * w / v

    def ode(self, time: float, state: saltus.State) -> Any:
        v, _, torque, _ = state.continuous_state
        grip = 0.9 * np.sin(1.5 * np.arctan(12 * self.slip(time, state))) * M * G
        wanted = np.where(state.mode == BRAKES, MOST, 0.0)
        return [-grip / M, (R * grip - torque) / J, (wanted - torque) / LAG, v]


def run() -> saltus.Results:
    brake = Brake()
    return saltus.simulate(
        brake, brake.create_context(), (0.0, 20.0),
        rtol=1e-8, atol=1e-8, recorded_signals=["speed", "slip", "way"],
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
