"""A quarter of a car over a bump; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus
from saltus.library import Pulse

INWARDS, OUTWARDS = 0, 1
BODY, WHEEL = 300.0, 40.0  # [kg]
SPRING, TYRE = 15000.0, 150000.0  # [N/m]
SOFT, HARD = 600.0, 1800.0  # [N s/m]


class Car(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="car")
        self.declare_input_port("road")
        self.declare_continuous_state(4, ode=self.ode)
        self.declare_default_mode(INWARDS)
        self.declare_zero_crossing(
            self.speed, name="turns_out", direction="falling",
            start_mode=INWARDS, end_mode=OUTWARDS, requires_inputs=False,
        )  # fmt: skip
        self.declare_zero_crossing(
            self.speed, name="turns_in", direction="rising",
            start_mode=OUTWARDS, end_mode=INWARDS, requires_inputs=False,
        )  # fmt: skip
        for i, name in ((0, "body"), (2, "wheel")):
            self.declare_output_port(
                lambda time, state, i=i: state.continuous_state[i], name=name,
                requires_inputs=False,
            )  # fmt: skip

    def speed(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[3] - state.continuous_state[1]

    def ode(self, time: float, state: saltus.State, road: Any) -> Any:
        body_x, body_v, wheel_x, wheel_v = state.continuous_state
        damping = np.where(state.mode == INWARDS, SOFT, HARD)
        strut = SPRING * (wheel_x - body_x) + damping * (wheel_v - body_v)
        return [body_v, strut / BODY, wheel_v, (TYRE * (road - wheel_x) - strut) / WHEEL]


def run() -> saltus.Results:
    builder = saltus.DiagramBuilder()
    builder.add(Pulse(0.08, period=10.0, pulse_width=0.02, phase_delay=0.5, name="road"), Car())
    builder.connect("road.out", "car.road")
    builder.export_output("car.body", "body")
    builder.export_output("car.wheel", "wheel")
    ride = builder.build()
    return saltus.simulate(ride, ride.create_context(), (0.0, 5.0), rtol=1e-8, atol=1e-10)


if __name__ == "__main__":
    print(run())
