"""Two tanks in a row, of one class; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus
from saltus.library import Step


class Tank(saltus.LeafSystem):
    def __init__(
        self, name: str, area: float = 1.0, outlet: float = 0.1, start: float = 1.0
    ) -> None:
        super().__init__(name=name)
        self.area, self.outlet = area, outlet  # [m^2], [m^2.5/s]
        self.declare_input_port("inflow")
        self.declare_continuous_state([start], ode=self.ode)
        self.declare_output_port(self.level, name="level", requires_inputs=False)
        self.declare_output_port(self.outflow, name="outflow", requires_inputs=False)

    def ode(self, time: float, state: saltus.State, inflow: Any) -> Any:
        return [(inflow - self.outflow(time, state)) / self.area]

    def level(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0]

    def outflow(self, time: float, state: saltus.State) -> Any:
        return self.outlet * np.sqrt(state.continuous_state[0])


def run() -> saltus.Results:
    builder = saltus.DiagramBuilder()
    builder.add(
        Step(0.1, 0.15, step_time=20.0, name="tap"),
        Tank("upper", start=0.5),
        Tank("lower", area=2.0, outlet=0.08),
    )
    builder.connect("tap.out", "upper.inflow")
    builder.connect("upper.outflow", "lower.inflow")
    builder.export_output("upper.level", "upper")
    builder.export_output("lower.level", "lower")
    tanks = builder.build()
    return saltus.simulate(tanks, tanks.create_context(), (0.0, 1000.0), rtol=1e-9, atol=1e-11)


if __name__ == "__main__":
    print(run())
