"""The packaging check runs this in an environment that holds the wheel and numpy, nothing else."""

import numpy as np
import saltus


class Ball(saltus.LeafSystem):
    def __init__(self):
        super().__init__(name="ball")
        self.declare_continuous_state(2, ode=self.ode)
        self.declare_continuous_state_output(name="ball:y")

    def ode(self, time, state, **params):
        y, v = state.continuous_state
        return np.array([v, -9.81])


ball = Ball()
context = ball.create_context().with_continuous_state(np.array([10.0, 0.0]))
results = saltus.simulate(ball, context, (0.0, 1.0), recorded_signals={"y": ball.output_ports[0]})
height = results.outputs["y"][-1, 0]
assert abs(height - (10.0 - 0.5 * 9.81)) < 1e-3, height
print(f"saltus {saltus.__version__}: {height} m after 1 s")
