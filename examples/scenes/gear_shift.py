"""A car shifts through four gears; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus

MASS, RADIUS, AXLE, DRAG = 1200.0, 0.3, 3.8, 0.45  # [kg], [m], 1, [N s^2/m^2]
RATIOS = [3.6, 2.1, 1.4, 1.0]
SHIFT = 550.0  # [rad/s]


class Car(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="car")
        self.declare_continuous_state([2.0], ode=self.ode)
        self.declare_default_mode(0)
        for gear, name in enumerate(("to_second", "to_third", "to_fourth")):
            self.declare_zero_crossing(
                lambda time, state: self.engine(time, state) - SHIFT, name=name,
                direction="rising", start_mode=gear, end_mode=gear + 1,
            )  # fmt: skip
        self.declare_zero_crossing(
            lambda time, state: state.continuous_state[0] - 100 / 3.6, name="hundred",
            direction="rising",
        )  # fmt: skip
        self.declare_output_port(lambda time, state: state.continuous_state[0], name="speed")
        self.declare_output_port(self.engine, name="engine")
        self.declare_output_port(lambda time, state: state.mode + 1, name="gear")

    def gear(self, state: saltus.State) -> Any:
        upper = np.where(state.mode == 2, RATIOS[2], RATIOS[3])
        return AXLE * np.where(
            state.mode == 0, RATIOS[0], np.where(state.mode == 1, RATIOS[1], upper)
        )

    def engine(self, time: float, state: saltus.State) -> Any:
        return self.gear(state) * state.continuous_state[0] / RADIUS

    def ode(self, time: float, state: saltus.State) -> Any:
        torque = 180 * (1 - ((self.engine(time, state) - 350) / 700) ** 2)
        drag = DRAG * state.continuous_state[0] ** 2
        return [(torque * self.gear(state) / RADIUS - drag) / MASS]


def run() -> saltus.Results:
    car = Car()
    return saltus.simulate(
        car, car.create_context(), (0.0, 30.0),
        rtol=1e-9, atol=1e-9, recorded_signals=["speed", "engine", "gear"],
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
