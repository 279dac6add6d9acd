"""A ball as a block of its own: first elastic, then losing a tenth of its speed at each bounce."""

import matplotlib.pyplot as plt
import numpy as np
import saltus
from saltus.simulation import SimulatorOptions


class Ball(saltus.LeafSystem):
    def __init__(self, *args, gravity=9.81, restitution=1.0, **kwargs):
        super().__init__(*args, name="ball", **kwargs)
        self.restitution = restitution
        self.declare_continuous_state(2, ode=self.fly)
        self.declare_continuous_state_output(name="ball:state")
        self.declare_dynamic_parameter("gravity", gravity)
        self.declare_zero_crossing(
            guard=self.height,
            reset_map=self.bounce,
            name="bounce",
            direction="positive_then_non_positive",
        )

    def fly(self, time, state, **params):
        return np.array([state.continuous_state[1], -params["gravity"]])

    def height(self, time, state, **params):
        return state.continuous_state[0]

    def bounce(self, time, state, **params):
        height, velocity = state.continuous_state
        return state.with_continuous_state(np.array([np.abs(height), -self.restitution * velocity]))


def run(restitution, end, steps):
    ball = Ball(gravity=9.81, restitution=restitution)
    context = ball.create_context().with_continuous_state(np.array([10.0, 0.0]))
    options = SimulatorOptions(
        max_major_steps=steps, atol=1e-12, rtol=1e-10, max_minor_step_size=1e-3
    )
    return saltus.simulate(
        ball, context, (0.0, end), options=options, recorded_signals={"y": ball.output_ports[0]}
    )


def draw(results):
    figure, axes = plt.subplots(1, 1, figsize=(8, 2))
    axes.plot(results.time, results.outputs["y"][:, 0])
    plt.close(figure)


scene1 = run(1.0, 6 * np.sqrt(2 * 10.0 / 9.81), 100)
draw(scene1)
scene2 = run(0.9, 12.0, 200)
draw(scene2)
