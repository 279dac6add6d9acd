"""Leaf systems whose equations, guards, reset maps and modes are numbers that a strategy draws."""

from __future__ import annotations

import numpy as np
import saltus


class Leaf(saltus.LeafSystem):
    """dx/dt = a[m] x + b[m] - x^3 + gain min(max(u, -2), 2), m the mode; `guards` and `updates` are
    lists of dicts.
    """

    def __init__(self, name, x0, a, b, gain=0.0, guards=(), updates=()):
        super().__init__(name=name)
        self.a, self.b, self.gain = np.array(a, float), np.array(b, float), gain
        self.declare_input_port("in")
        self.declare_default_mode(0)
        self.declare_continuous_state(default_value=np.array(x0, float), ode=self.ode)
        self.declare_discrete_state([0.0])
        self.declare_continuous_state_output("x")
        self.declare_discrete_state_output("z")
        self.declare_mode_output("mode")
        self.declare_output_port(self.first, "first", requires_inputs=False, shape=())
        self.declare_output_port(self.is_up, "up", requires_inputs=False, shape=(), boolean=True)
        for i, options in enumerate(guards):
            self.add_guard(f"guard{i}", **options)
        for i, options in enumerate(updates):
            self.add_update(f"update{i}", **options)

    def ode(self, time, state, u):
        x, m = state.continuous_state, state.mode
        return (
            self.a[m] @ x + self.b[m] - np.clip(x, -100, 100) ** 3 + self.gain * np.clip(u, -2, 2)
        )

    def first(self, time, state):
        return state.continuous_state[0]

    def is_up(self, time, state):
        return bool(state.continuous_state[0] > 0.25)

    def add_guard(self, name, of, level, reset=None, value=0.0, **options):
        """g = x_0 - level, x_n - level, t - level, u - level, the sum of x less level, or both of
        the first two as one guard of two numbers.
        """
        functions = {
            "first": lambda t, s, u: s.continuous_state[0] - level,
            "last": lambda t, s, u: s.continuous_state[-1] - level,
            "time": lambda t, s, u: t - level,
            "input": lambda t, s, u: u - level,
            "sum": lambda t, s, u: s.continuous_state.sum() - level,
            "pair": lambda t, s, u: s.continuous_state[[0, -1]] - level,
        }
        resets = {
            None: None,
            "set": lambda t, s, u: s.with_continuous_state(np.full_like(self.b[0], value)),
            "scale": lambda t, s, u: s.with_continuous_state(value * s.continuous_state),
            "add": lambda t, s, u: s.with_continuous_state(s.continuous_state + value),
            "keep": lambda t, s, u: s.with_continuous_state(s.continuous_state),
            "count": lambda t, s, u: s.with_discrete_state(s.discrete_state + 1.0),
            "mode": lambda t, s, u: s.with_mode(1 - s.mode),
        }
        if of == "pair":
            options["size"] = 2
        self.declare_zero_crossing(functions[of], resets[reset], name=name, **options)

    def add_update(self, name, period, offset, what):
        updates = {
            "count": lambda t, s, u: s.discrete_state + 1.0,
            "kick": lambda t, s, u: s.with_continuous_state(s.continuous_state + 0.5),
            "sample": lambda t, s, u: [u],
            "mode": lambda t, s, u: s.with_mode(1 - s.mode),
        }
        self.declare_periodic_update(updates[what], period, offset, name=name)


class Ball(saltus.LeafSystem):
    """A ball of height and speed `x0`, restitution e, over a floor that its input moves."""

    def __init__(self, name, x0=(1.0, 0.0), e=0.5, g=9.81, **options):
        super().__init__(name=name)
        self.declare_input_port("floor")
        self.declare_continuous_state(
            default_value=np.array(x0, float),
            ode=lambda t, s: [s.continuous_state[1], -g],
            requires_inputs=False,
        )
        self.declare_continuous_state_output("x")
        self.declare_output_port(
            lambda t, s: s.continuous_state[0], "y", requires_inputs=False, shape=()
        )
        self.declare_zero_crossing(
            lambda t, s, floor: s.continuous_state[0] - floor,
            lambda t, s, floor: s.with_continuous_state([floor, -e * s.continuous_state[1]]),
            name="bounce",
            direction="positive_then_non_positive",
            **options,
        )
