"""A pendulum on a cart, held upright by a sampling controller; the file beside it in Python."""

from typing import Any

import numpy as np
import saltus

CART, BOB, LENGTH, G = 1.0, 0.1, 0.5, 9.81  # [kg], [kg], [m], [m/s^2]
GAIN = [-2.72, -4.95, -41.6, -9.38]  # of the discrete LQR


class Cart(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="cart")
        self.declare_input_port("force")
        self.declare_continuous_state([0.0, 0.0, 0.2, 0.0], ode=self.ode)
        self.declare_continuous_state_output("state")

    def ode(self, time: float, state: saltus.State, force: Any) -> Any:
        _, v, th, w = state.continuous_state
        push = force + BOB * LENGTH * w**2 * np.sin(th)
        inertia = LENGTH * (CART + BOB * np.sin(th) ** 2)
        bend = ((CART + BOB) * G * np.sin(th) - np.cos(th) * push) / inertia
        return [v, (push - BOB * LENGTH * bend * np.cos(th)) / (CART + BOB), w, bend]


class Control(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="control")
        self.declare_input_port("x", shape=4)
        self.declare_discrete_state([0.0])
        self.declare_periodic_update(self.sample, period=0.02, name="sample")
        self.declare_output_port(self.force, name="force", requires_inputs=False)

    def sample(self, time: float, state: saltus.State, x: Any) -> saltus.State:
        feedback = GAIN[0] * x[0] + GAIN[1] * x[1] + GAIN[2] * x[2] + GAIN[3] * x[3]
        return state.with_discrete_state([-feedback])

    def force(self, time: float, state: saltus.State) -> Any:
        return state.discrete_state[0]


def run() -> saltus.Results:
    builder = saltus.DiagramBuilder()
    builder.add(Cart(), Control())
    builder.connect("cart.state", "control.x")
    builder.connect("control.force", "cart.force")
    builder.export_output("cart.state", "state")
    builder.export_output("control.force", "force")
    loop = builder.build()
    return saltus.simulate(loop, loop.create_context(), (0.0, 6.0), rtol=1e-9, atol=1e-11)


if __name__ == "__main__":
    print(run())
