"""A motor whose PID has limits; the file beside it in Python."""

from typing import Any

import saltus
from saltus.library import PID, Adder, Step

R, L, K, J, B = 1.0, 0.01, 0.05, 5e-4, 1e-4  # [ohm], [H], [V s], [kg m^2], [N m s]


class Motor(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="motor")
        self.declare_input_port("voltage")
        self.declare_input_port("load")
        self.declare_continuous_state(2, ode=self.ode)
        self.declare_output_port(self.speed, name="speed", requires_inputs=False)

    def ode(self, time: float, state: saltus.State, voltage: Any, load: Any) -> Any:
        i, w = state.continuous_state
        return [(voltage - R * i - K * w) / L, (K * i - B * w - load) / J]

    def speed(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[1]


def run() -> saltus.Results:
    builder = saltus.DiagramBuilder()
    builder.add(
        Step(0.0, 150.0, step_time=0.1, name="wanted"),
        Step(0.0, 0.05, step_time=2.0, name="load"),
        Adder("+-", name="error"),
        PID(0.5, 2.0, 0.005, 200.0, lower_limit=-12.0, upper_limit=12.0, name="control"),
        Motor(),
    )
    builder.connect("wanted.out", "error.in_0")
    builder.connect("motor.speed", "error.in_1")
    builder.connect("error.out", "control.in")
    builder.connect("control.out", "motor.voltage")
    builder.connect("load.out", "motor.load")
    builder.export_output("motor.speed", "speed")
    builder.export_output("control.out", "voltage")
    drive = builder.build()
    return saltus.simulate(drive, drive.create_context(), (0.0, 4.0), rtol=1e-8, atol=1e-8)


if __name__ == "__main__":
    print(run())
