"""A neuron that fires: Izhikevich's model; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus

A, B, C, D, PEAK = 0.02, 0.2, -65.0, 8.0, 30.0


class Neuron(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="neuron")
        self.declare_continuous_state([C, B * C], ode=self.ode)
        self.declare_discrete_state([0.0])
        self.declare_zero_crossing(self.peak, self.reset, name="spike", direction="rising")
        self.declare_time_event(self.nothing, times=[50.0], name="current")
        self.declare_output_port(lambda time, state: state.continuous_state[0], name="v")
        self.declare_output_port(lambda time, state: state.discrete_state[0], name="spikes")

    def ode(self, time: float, state: saltus.State) -> Any:
        v, u = state.continuous_state
        current = np.where(time < 50, 0.0, 10.0)
        return [0.04 * v**2 + 5 * v + 140 - u + current, A * (B * v - u)]

    def peak(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0] - PEAK

    def reset(self, time: float, state: saltus.State) -> saltus.State:
        _, u = state.continuous_state
        return state.with_continuous_state([C, u + D]).with_discrete_state(
            [state.discrete_state[0] + 1]
        )

    def nothing(self, time: float, state: saltus.State) -> saltus.State:
        return state.with_discrete_state([state.discrete_state[0]])


def run() -> saltus.Results:
    neuron = Neuron()
    return saltus.simulate(
        neuron, neuron.create_context(), (0.0, 500.0),
        rtol=1e-8, atol=1e-10, recorded_signals=["v", "spikes"],
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
