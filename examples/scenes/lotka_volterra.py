"""Predators and prey, and a hunt whenever the prey is too many; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus

A, B, C, D = 1.1, 0.4, 0.1, 0.4  # [1/year]


class Animals(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="animals")
        self.declare_continuous_state([10.0, 5.0], ode=self.growth)
        self.declare_zero_crossing(self.too_many, self.hunt, name="hunt", direction="rising")
        self.declare_output_port(lambda time, state: state.continuous_state[0], name="prey")
        self.declare_output_port(lambda time, state: state.continuous_state[1], name="predators")
        self.declare_output_port(self.invariant, name="invariant")

    def growth(self, time: float, state: saltus.State) -> Any:
        prey, predators = state.continuous_state
        return [A * prey - B * prey * predators, C * prey * predators - D * predators]

    def too_many(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[0] - 12.0

    def hunt(self, time: float, state: saltus.State) -> saltus.State:
        prey, predators = state.continuous_state
        return state.with_continuous_state([0.7 * prey, predators])

    def invariant(self, time: float, state: saltus.State) -> Any:
        prey, predators = state.continuous_state
        return C * prey - D * np.log(prey) + B * predators - A * np.log(predators)


def run() -> saltus.Results:
    animals = Animals()
    ports = {port.name: port for port in animals.output_ports}
    return saltus.simulate(
        animals, animals.create_context(), (0.0, 60.0),
        rtol=1e-9, atol=1e-11, recorded_signals=ports,
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
