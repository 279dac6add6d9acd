"""A water heater that looks at its temperature every minute; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus
from saltus.library import Pulse

MASS, POWER, LOSS, HEAT = 150.0, 3.0, 2.5e-3, 1.163e-3  # [kg], [kW], [kW/K], [kWh/(kg K)]
ROOM, COLD, LOW, HIGH = 20.0, 12.0, 55.0, 60.0  # [C]


class Heater(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="heater")
        self.declare_input_port("draw")
        self.declare_continuous_state([58.0, 0.0], ode=self.ode)
        self.declare_discrete_state([0.0])
        self.declare_periodic_update(self.look, period=1 / 60, name="look")
        for name, callback in (("water", self.water), ("on", self.on), ("energy", self.energy)):
            self.declare_output_port(callback, name=name, requires_inputs=False)

    def ode(self, time: float, state: saltus.State, draw: Any) -> Any:
        water = state.continuous_state[0]
        heat = state.discrete_state[0] * POWER
        drawn = draw * HEAT * (water - COLD)
        return [(heat - LOSS * (water - ROOM) - drawn) / (MASS * HEAT), heat]

    def look(self, time: float, state: saltus.State, draw: Any) -> saltus.State:
        water = state.continuous_state[0]
        kept = np.where(water > HIGH, 0.0, state.discrete_state[0])
        return state.with_discrete_state([np.where(water < LOW, 1.0, kept)])

    def water(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0]

    def on(self, time: float, state: saltus.State) -> Any:
        return state.discrete_state[0]

    def energy(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[1]


def run() -> saltus.Results:
    builder = saltus.DiagramBuilder()
    builder.add(
        Pulse(60.0, period=12.0, pulse_width=0.0625, phase_delay=6.5, name="draw"), Heater()
    )
    builder.connect("draw.out", "heater.draw")
    for name in ("water", "on", "energy"):
        builder.export_output(f"heater.{name}", name)
    day = builder.build()
    return saltus.simulate(day, day.create_context(), (0.0, 24.0), rtol=1e-8, atol=1e-8)


if __name__ == "__main__":
    print(run())
