"""Blocks declared by a function, where a test needs them."""

import saltus


class Block(saltus.LeafSystem):
    """`Block(lambda self: self.declare_...)`"""

    def __init__(self, declare, name="block"):
        super().__init__(name=name)
        declare(self)


def ramp(rate=1.0, start=0.0):
    """dx/dt = rate, with an output 'x', and whatever else is declared."""

    def declare(self):
        self.declare_continuous_state([start], ode=lambda t, s, *u, **p: [rate])
        self.declare_continuous_state_output("x")

    return declare


def crossing(guard, reset=None, start=0.0, rate=1.0, **options):
    """A ramp with one zero crossing, 'cross'; z counts what `reset` = "count" is told to."""

    def declare(self):
        ramp(rate, start)(self)
        self.declare_discrete_state([0.0])
        resets = {"count": lambda t, s: s.with_discrete_state(s.discrete_state + 1.0)}
        self.declare_zero_crossing(guard, resets.get(reset, reset), name="cross", **options)

    return Block(declare)


def x(t, s, *u):
    return s.continuous_state[0]


class Ball(saltus.LeafSystem):
    """Height and speed over the floor 0; with `floor` over the one its input gives."""

    def __init__(self, e=0.5, y=0.0, v=0.0, g=9.81, floor=False, name="ball", **options):
        super().__init__(name=name)
        if floor:
            self.declare_input_port("floor")
        self.declare_continuous_state(
            [y, v], ode=lambda t, s: [s.continuous_state[1], -g], requires_inputs=False
        )
        self.declare_continuous_state_output("x")

        def height(t, s, floor=0.0):
            return s.continuous_state[0] - floor

        def bounce(t, s, floor=0.0):
            return s.with_continuous_state([floor, -e * s.continuous_state[1]])

        self.declare_zero_crossing(
            height, bounce, name="bounce", direction="positive_then_non_positive", **options
        )


def go(system, end, begin=0.0, context=None, **options):
    return saltus.simulate(
        system,
        context or system.create_context(begin),
        (begin, end),
        recorded_signals={port.name: port for port in system.output_ports},
        **options,
    )


def kinds(results):
    return [(e.kind, e.name) for e in results.events]
