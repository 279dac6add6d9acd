"""A buck converter with a sampled controller; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus

ON, OFF, IDLE = 0, 1, 2
SOURCE, WANTED = 24.0, 12.0  # [V]
L, C, R = 1e-3, 1e-4, 10.0  # [H], [F], [ohm]
PERIOD, KP, KI = 1e-4, 0.005, 5.0  # [s], [1/V], [1/(V s)]


class Converter(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="converter")
        self.declare_continuous_state(2, ode=self.ode)
        self.declare_discrete_state([0.0, 0.5, 0.5])
        self.declare_default_mode(ON)
        self.declare_output_port(lambda time, state: state.continuous_state[1], name="voltage")
        self.declare_output_port(lambda time, state: state.continuous_state[0], name="current")
        self.declare_output_port(lambda time, state: state.discrete_state[2], name="duty")
        self.declare_zero_crossing(
            self.lasts, name="opens", direction="rising", start_mode=ON, end_mode=OFF
        )
        self.declare_zero_crossing(
            self.current, self.block, name="blocks", direction="falling",
            start_mode=OFF, end_mode=IDLE,
        )  # fmt: skip
        self.declare_periodic_update(self.sample, period=PERIOD, name="period")

    def ode(self, time: float, state: saltus.State) -> Any:
        i, v = state.continuous_state
        driven = (np.where(state.mode == ON, SOURCE, 0.0) - v) / L
        return [np.where(state.mode == IDLE, 0.0, driven), (i - v / R) / C]

    def lasts(self, time: float, state: saltus.State) -> Any:
        begin, _, duty = state.discrete_state
        return time - begin - duty * PERIOD

    def current(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0]

    def block(self, time: float, state: saltus.State) -> saltus.State:
        return state.with_continuous_state([0.0, state.continuous_state[1]])

    def sample(self, time: float, state: saltus.State) -> saltus.State:
        error = WANTED - state.continuous_state[1]
        integral = state.discrete_state[1]
        duty = np.clip(integral + KP * error, 0.05, 0.95)
        return state.with_discrete_state([time, integral + KI * PERIOD * error, duty]).with_mode(ON)


def run() -> saltus.Results:
    converter = Converter()
    return saltus.simulate(
        converter, converter.create_context(), (0.0, 0.03),
        rtol=1e-8, atol=1e-10, recorded_signals=["voltage", "current", "duty"],
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
