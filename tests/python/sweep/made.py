"""Functions that make systems, where another process can import them."""

import os

import numpy as np
import saltus
from saltus.library import Constant, Integrator


class Ball(saltus.LeafSystem):
    """A ball of Python functions; e is an attribute: structure."""

    def __init__(self, g=9.81, e=1.0, y0=10.0):
        super().__init__(name="ball")
        self.e = e
        self.declare_dynamic_parameter("g", g)
        self.declare_continuous_state(default_value=[y0, 0.0], ode=self.ode)
        self.declare_continuous_state_output(name="state")
        self.declare_zero_crossing(
            guard=self.guard,
            reset_map=self.reset,
            direction="positive_then_non_positive",
            name="bounce",
        )

    def ode(self, time, state, **parameters):
        return np.array([state.continuous_state[1], -parameters["g"]])

    def guard(self, time, state, **parameters):
        return state.continuous_state[0]

    def reset(self, time, state, **parameters):
        y, v = state.continuous_state
        return state.with_continuous_state([abs(y), -self.e * v])


def make_ball(e=1.0, y0=10.0):
    return Ball(e=e, y0=y0)


def make_chain(n=1):
    """Integrators in a row behind a 1: the last one is t^n / n!."""
    builder = saltus.DiagramBuilder()
    one = builder.add(Constant(1.0, name="one"))
    source = one.output_ports[0]
    for i in range(n):
        integrator = builder.add(Integrator(0.0, name=f"stage_{i}"))
        builder.connect(source, integrator.input_ports[0])
        source = integrator.output_ports[0]
    builder.export_output(source, name="end")
    return builder.build()


def make_refusing(e):
    if e > 0.6:
        raise ValueError("too lively")
    return Ball(e=e)


def make_fatal(e):
    if e > 0.6:
        os._exit(3)
    return Ball(e=e)


def bounces(results):
    return len(results.events.times("bounce"))


def peak(results):
    return {"bounces": bounces(results), "state": results.context.continuous_state}
