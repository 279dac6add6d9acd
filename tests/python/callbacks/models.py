"""Blocks whose callbacks trace, and helpers."""

import numpy as np
import saltus


class Pendulum(saltus.LeafSystem):
    """A damped pendulum that loses speed at the lowest point; angle [rad], rate [rad/s]."""

    def __init__(self, damping=0.1, keep=0.9):
        super().__init__(name="pendulum")
        self.damping = damping
        self.keep = keep
        self.declare_dynamic_parameter("length", 1.0)
        self.declare_continuous_state(default_value=[1.0, 0.0], ode=self.ode)
        self.declare_output_port(self.energy, name="energy")
        self.declare_zero_crossing(lambda t, s, **p: s.continuous_state[0], self.lose, name="low")

    def ode(self, time, state, *, length):
        angle, rate = state.continuous_state
        return np.array([rate, -9.81 / length * np.sin(angle) - self.damping * rate])

    def energy(self, time, state, *, length):
        angle, rate = state.continuous_state
        return 0.5 * (length * rate) ** 2 - 9.81 * length * np.cos(angle)

    def lose(self, time, state, *, length):
        angle, rate = state.continuous_state
        return state.with_continuous_state([angle, self.keep * rate])


def ways(system):
    """How each callback runs, by its name."""
    return {f"{r.block}: {r.callback}": r.runs for r in system.explain()}


def end(system, t_end=1.0, **options):
    """The continuous state at the end of a run."""
    results = saltus.simulate(system, system.create_context(), (0.0, t_end), **options)
    return np.array(results.context.continuous_state)


def leaf(ode, x0=(1.0,), **declared):
    """A block with that ode."""
    block = saltus.LeafSystem(name="block")
    for name, value in declared.items():
        block.declare_dynamic_parameter(name, value)
    block.declare_continuous_state(default_value=list(x0), ode=ode)
    return block
