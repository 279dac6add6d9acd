"""A phase-locked loop follows a step of the frequency; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus
from saltus.library import Step

FREE, KP, KI = 100.0, 40.0, 400.0  # [rad/s], [rad/s], [rad/s^2]


class Loop(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="loop")
        self.declare_input_port("frequency")
        self.declare_continuous_state([1.0, 0.0, 0.0], ode=self.ode)
        self.declare_discrete_state([0.0])
        self.declare_output_port(self.error, name="error", requires_inputs=False)
        self.declare_output_port(self.rate, name="rate", requires_inputs=False)
        self.declare_output_port(self.cycles, name="cycles", requires_inputs=False)
        self.declare_zero_crossing(
            lambda time, state: state.continuous_state[0] - 2 * np.pi, self.their_turn,
            name="their_turn", direction="rising", requires_inputs=False,
        )  # fmt: skip
        self.declare_zero_crossing(
            lambda time, state: state.continuous_state[1] - 2 * np.pi, self.our_turn,
            name="our_turn", direction="rising", requires_inputs=False,
        )  # fmt: skip

    def error(self, time: float, state: saltus.State) -> Any:
        theirs, ours, _ = state.continuous_state
        return np.sin(theirs - ours)

    def rate(self, time: float, state: saltus.State) -> Any:
        return FREE + KP * self.error(time, state) + state.continuous_state[2]

    def cycles(self, time: float, state: saltus.State) -> Any:
        return state.discrete_state[0]

    def ode(self, time: float, state: saltus.State, frequency: Any) -> Any:
        return [frequency, self.rate(time, state), KI * self.error(time, state)]

    def their_turn(self, time: float, state: saltus.State) -> saltus.State:
        theirs, ours, held = state.continuous_state
        return state.with_continuous_state([theirs - 2 * np.pi, ours, held])

    def our_turn(self, time: float, state: saltus.State) -> saltus.State:
        theirs, ours, held = state.continuous_state
        return state.with_continuous_state([theirs, ours - 2 * np.pi, held]).with_discrete_state(
            [state.discrete_state[0] + 1]
        )


def run() -> saltus.Results:
    builder = saltus.DiagramBuilder()
    builder.add(Step(100.0, 110.0, step_time=1.0, name="frequency"), Loop())
    builder.connect("frequency.out", "loop.frequency")
    for name in ("error", "rate", "cycles"):
        builder.export_output(f"loop.{name}", name)
    radio = builder.build()
    return saltus.simulate(radio, radio.create_context(), (0.0, 3.0), rtol=1e-9, atol=1e-11)


if __name__ == "__main__":
    print(run())
