"""A drive with play in its gear; the file beside it in Python."""

from typing import Any

import saltus
from saltus.library import PID, Adder, Backlash, Step

GAIN, TAU, WIDTH = 1.0, 0.5, 0.2  # [rad/(V s)], [s], [rad]


class Motor(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="motor")
        self.declare_input_port("voltage")
        self.declare_continuous_state(2, ode=self.ode)
        self.declare_output_port(self.angle, name="angle", requires_inputs=False)
        self.declare_output_port(self.speed, name="speed", requires_inputs=False)

    def ode(self, time: float, state: saltus.State, voltage: Any) -> Any:
        _, speed = state.continuous_state
        return [speed, (GAIN * voltage - speed) / TAU]

    def angle(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0]

    def speed(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[1]


def run() -> saltus.Results:
    builder = saltus.DiagramBuilder()
    builder.add(
        Step(0.0, 1.0, step_time=1.0, name="wanted"),
        Adder("+-", name="error"),
        PID(2.0, 0.5, name="control"),
        Motor(),
        Backlash(WIDTH, name="play"),
    )
    builder.connect("wanted.out", "error.in_0")
    builder.connect("play.out", "error.in_1")
    builder.connect("error.out", "control.in")
    builder.connect("control.out", "motor.voltage")
    builder.connect("motor.angle", "play.in")
    builder.connect("motor.speed", "play.in_rate")
    builder.export_output("motor.angle", "motor")
    builder.export_output("play.out", "load")
    drive = builder.build()
    return saltus.simulate(drive, drive.create_context(), (0.0, 60.0), rtol=1e-9, atol=1e-11)


if __name__ == "__main__":
    print(run())
