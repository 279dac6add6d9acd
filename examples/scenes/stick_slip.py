"""A block on a belt that sticks and slips; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus

STICKS, SLIPS = 0, 1
M, K, BELT = 1.0, 4.0, 0.5  # [kg], [N/m], [m/s]
STATIC, KINETIC = 2.0, 1.0  # [N]


class Block(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="block")
        self.declare_continuous_state([0.0, BELT], ode=self.ode)
        self.declare_default_mode(STICKS)
        self.declare_zero_crossing(
            self.excess, name="breaks", direction="rising", start_mode=STICKS, end_mode=SLIPS
        )
        self.declare_zero_crossing(
            self.slower, self.stick, name="catches", direction="rising",
            start_mode=SLIPS, end_mode=STICKS,
        )  # fmt: skip
        self.declare_output_port(lambda time, state: state.continuous_state[0], name="x")
        self.declare_output_port(lambda time, state: state.continuous_state[1], name="v")
        self.declare_output_port(lambda time, state: state.mode == STICKS, name="sticks")

    def ode(self, time: float, state: saltus.State) -> Any:
        x, v = state.continuous_state
        force = np.where(state.mode == SLIPS, KINETIC - K * x, 0.0)
        return [v, force / M]

    def excess(self, time: float, state: saltus.State) -> Any:
        return K * state.continuous_state[0] - STATIC

    def slower(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[1] - BELT

    def stick(self, time: float, state: saltus.State) -> saltus.State:
        return state.with_continuous_state([state.continuous_state[0], BELT])


def run() -> saltus.Results:
    block = Block()
    return saltus.simulate(
        block, block.create_context(), (0.0, 20.0),
        rtol=1e-9, atol=1e-11, recorded_signals=["x", "v", "sticks"],
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
