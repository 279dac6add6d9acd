"""Parts of scenes that read nothing of each other."""

import saltus
from saltus.library import Gain, Integrator, Sine, ZeroOrderHold


class Ball(saltus.LeafSystem):
    def __init__(self, name, height, e=0.8):
        super().__init__(name=name)
        self.declare_continuous_state(
            [height, 0.0], ode=lambda t, s: [s.continuous_state[1], -9.81]
        )
        self.declare_continuous_state_output("state")
        self.declare_zero_crossing(
            guard=lambda t, s: s.continuous_state[0],
            reset_map=lambda t, s: s.with_continuous_state([0.0, -e * s.continuous_state[1]]),
            direction="positive_then_non_positive",
            name="bounce",
        )


class Room(saltus.LeafSystem):
    def __init__(self, name, heat, start):
        super().__init__(name=name)
        self.declare_continuous_state(
            [start], ode=lambda t, s: [(heat if s.mode == 1 else 10.0) - s.continuous_state[0]]
        )
        self.declare_continuous_state_output("temperature")
        self.declare_default_mode(1)
        for limit, before, after in ((19.0, 0, 1), (21.0, 1, 0)):
            self.declare_zero_crossing(
                guard=lambda t, s, limit=limit: s.continuous_state[0] - limit,
                start_mode=before,
                end_mode=after,
                name=f"limit{after}",
            )


def add_ball(builder, name, height, e):
    builder.export_output(builder.add(Ball(name, height, e)).output("state"), name)


def add_room(builder, name, heat, start):
    builder.export_output(builder.add(Room(name, heat, start)).output("temperature"), name)


def add_sampled(builder, name, period, frequency):
    sine = builder.add(Sine(frequency=frequency, name=f"{name}_sine"))
    hold = builder.add(ZeroOrderHold(period, name=f"{name}_hold"))
    total = builder.add(Integrator(0.0, name=name))
    builder.connect(sine.output(), hold.input())
    builder.connect(hold.output(), total.input())
    builder.export_output(total.output(), name)


def add_pair(builder, name, x, y):
    """An oscillator of two blocks that read each other."""
    first = builder.add(Integrator(x, name=name))
    second = builder.add(Integrator(y, name=f"{name}_rate"))
    turn = builder.add(Gain(-4.0, name=f"{name}_turn"))
    builder.connect(second.output(), first.input())
    builder.connect(first.output(), turn.input())
    builder.connect(turn.output(), second.input())
    builder.export_output(first.output(), name)
