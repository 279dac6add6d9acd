"""Leaky integrate-and-fire cells: v' = -v / tau + current, threshold 1, reset to 0."""

import math

import saltus

TAU = 0.02  # [s]


class Cell(saltus.LeafSystem):
    """Each delivery adds its weight to v."""

    def __init__(self, name, current, v=0.0, tau=TAU):
        super().__init__(name=name)
        self.declare_dynamic_parameter("current", current)
        self.declare_dynamic_parameter("tau", tau)
        self.declare_continuous_state([v], ode=self.ode)
        self.declare_continuous_state_output("v")
        self.declare_zero_crossing(self.below, self.reset, name="fire", direction="rising")
        self.declare_event_input(self.receive, name="synapse")

    def ode(self, time, state, current, tau):
        return current - state.continuous_state / tau

    def below(self, time, state, current, tau):
        return state.continuous_state[0] - 1.0

    def reset(self, time, state, current, tau):
        return [0.0]

    def receive(self, time, state, weight, current, tau):
        return state.continuous_state + weight


class Beats(saltus.LeafSystem):
    def __init__(self, *times, name="beats"):
        super().__init__(name=name)
        self.declare_time_event(times=times, name="beat")


class Digits(saltus.LeafSystem):
    """z shows the order of the deliveries: each makes 10 z + weight of it."""

    def __init__(self, name="digits"):
        super().__init__(name=name)
        self.declare_discrete_state([0.0])
        self.declare_discrete_state_output("z")
        self.declare_event_input(self.append, name="digit")

    def append(self, time, state, weight):
        return 10.0 * state.discrete_state + weight


def period(current, tau=TAU):
    """[s] from v = 0 to the threshold."""
    return tau * math.log(current * tau / (current * tau - 1.0))


def wired(*blocks, wires):
    """A diagram; `wires` are the arguments of connect_event."""
    builder = saltus.DiagramBuilder()
    for block in blocks:
        builder.add(block)
    for wire in wires:
        builder.connect_event(*wire)
    return builder.build()
