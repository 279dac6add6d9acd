"""Van der Pol's oscillator, stiff between its jumps; the file beside it in Python."""

from typing import Any

import saltus

MU = 1000.0


class VanDerPol(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="van_der_pol")
        self.declare_continuous_state([2.0, 0.0], ode=self.ode)
        self.declare_zero_crossing(self.x, name="jump")
        self.declare_output_port(self.x, name="x")

    def ode(self, time: float, state: saltus.State) -> Any:
        x, v = state.continuous_state
        return [v, MU * (1 - x**2) * v - x]

    def x(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0]


def run() -> saltus.Results:
    oscillator = VanDerPol()
    return saltus.simulate(
        oscillator, oscillator.create_context(), (0.0, 3 * MU),
        rtol=1e-8, atol=1e-10, recorded_signals=["x"],
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
