"""A car keeps its speed up a hill; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus
from saltus.library import PID, Adder, Step

MASS, DRAG, ROLLING, G = 1200.0, 0.4, 150.0, 9.81  # [kg], [N s^2/m^2], [N], [m/s^2]


class Car(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="car")
        self.declare_input_port("force")
        self.declare_input_port("slope")
        self.declare_continuous_state([20.0], ode=self.ode)
        self.declare_output_port(self.speed, name="speed", requires_inputs=False)

    def ode(self, time: float, state: saltus.State, force: Any, slope: Any) -> Any:
        (v,) = state.continuous_state
        return [(force - ROLLING - DRAG * v**2) / MASS - G * np.sin(slope)]

    def speed(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0]


def run() -> saltus.Results:
    builder = saltus.DiagramBuilder()
    builder.add(
        Step(20.0, 25.0, step_time=5.0, name="wanted"),
        Step(0.0, 0.06, step_time=40.0, name="hill"),
        Adder("+-", name="error"),
        PID(800.0, 40.0, initial_state=310.0, lower_limit=0.0, upper_limit=3000.0, name="control"),
        Car(),
    )
    builder.connect("wanted.out", "error.in_0")
    builder.connect("car.speed", "error.in_1")
    builder.connect("error.out", "control.in")
    builder.connect("control.out", "car.force")
    builder.connect("hill.out", "car.slope")
    builder.export_output("car.speed", "speed")
    builder.export_output("control.out", "force")
    road = builder.build()
    return saltus.simulate(road, road.create_context(), (0.0, 100.0), rtol=1e-8, atol=1e-8)


if __name__ == "__main__":
    print(run())
