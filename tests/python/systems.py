"""Small blocks that several tests use."""

import numpy as np
import saltus


class Ball(saltus.LeafSystem):
    """Height and velocity over a floor at 0."""

    def __init__(self, g=9.81, e=0.9, name="ball", **crossing):
        super().__init__(name=name)
        self.e = e
        self.declare_continuous_state(2, ode=self.ode)
        self.declare_continuous_state_output("state")
        self.declare_dynamic_parameter("g", g)
        self.declare_zero_crossing(
            self.height,
            self.bounce,
            name="bounce",
            direction="positive_then_non_positive",
            **crossing,
        )

    def ode(self, time, state, *, g):
        return [state.continuous_state[1], -g]

    def height(self, time, state, *, g):
        return state.continuous_state[0]

    def bounce(self, time, state, *, g):
        y, v = state.continuous_state
        return state.with_continuous_state([abs(y), -self.e * v])


class Decay(saltus.LeafSystem):
    """dx/dt = -x; `hook(time, state)` is called from the ode, the guard or the reset map."""

    def __init__(self, hook, where="ode"):
        super().__init__(name="decay")
        self.hook = hook
        self.where = where
        self.declare_continuous_state(default_value=[1.0], ode=self.ode)
        self.declare_continuous_state_output("x")
        self.declare_zero_crossing(
            self.guard, self.reset, name="half", direction="positive_then_non_positive"
        )

    def at(self, place, time, state):
        if self.where == place:
            self.hook(time, state)

    def ode(self, time, state):
        self.at("ode", time, state)
        return -state.continuous_state

    def guard(self, time, state):
        self.at("guard", time, state)
        return state.continuous_state[0] - 0.5

    def reset(self, time, state):
        self.at("reset", time, state)
        return state.with_continuous_state([1.0])


def run(system, span, context=None, **options):
    """Simulates from the default context and records every output."""
    recorded = {port.name: port for port in system.output_ports}
    context = system.create_context() if context is None else context
    return saltus.simulate(system, context, span, recorded_signals=recorded, **options)


def flow(function, x0, span, **options):
    """x at the end of dx/dt = function(t, x)."""

    class Flow(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="flow")
            self.declare_continuous_state(
                default_value=x0, ode=lambda t, s: function(t, s.continuous_state)
            )

    system = Flow()
    return np.array(
        saltus.simulate(system, system.create_context(), span, **options).context.continuous_state
    )
