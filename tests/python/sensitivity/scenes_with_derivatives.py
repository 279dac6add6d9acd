"""Blocks whose derivatives are known."""

import saltus

METHODS = ("auto", "dopri5", "dop853", "adams", "bdf", "radau", "taylor")


class Throw(saltus.LeafSystem):
    """A ball over a floor at 0."""

    def __init__(self, g, e, height, speed=0.0, name="ball"):
        super().__init__(name=name)
        self.declare_dynamic_parameter("g", g)
        self.declare_dynamic_parameter("e", e)
        self.declare_continuous_state([height, speed], ode=self.ode)
        self.declare_continuous_state_output("state")
        self.declare_zero_crossing(
            self.height, self.bounce, name="bounce", direction="positive_then_non_positive"
        )

    def ode(self, time, state, *, g, e):
        return [state.continuous_state[1], -g]

    def height(self, time, state, **parameters):
        return state.continuous_state[0]

    def bounce(self, time, state, *, g, e):
        y, v = state.continuous_state
        return state.with_continuous_state([y, -e * v])


class Room(saltus.LeafSystem):
    """A thermostat in two modes: 0 cools, 1 heats."""

    VALUES = {"low": 19.0, "high": 21.0, "outside": 10.0, "heater": 40.0}

    def __init__(self, **values):
        super().__init__(name="room")
        for name, value in (self.VALUES | values).items():
            self.declare_dynamic_parameter(name, value)
        self.declare_continuous_state([20.0], ode=self.ode)
        self.declare_default_mode(1)
        self.declare_zero_crossing(
            lambda time, state, *, high, **others: state.continuous_state[0] - high,
            name="warm",
            direction="negative_then_non_negative",
            start_mode=1,
            end_mode=0,
        )
        self.declare_zero_crossing(
            lambda time, state, *, low, **others: state.continuous_state[0] - low,
            name="cold",
            direction="positive_then_non_positive",
            start_mode=0,
            end_mode=1,
        )

    def ode(self, time, state, *, heater, outside, **others):
        source = heater * state.mode + outside * (1 - state.mode)
        return [(source - state.continuous_state[0]) / 1800.0]


class Braking(saltus.LeafSystem):
    """A block that Coulomb friction stops: mode 0 slides, mode 1 sticks."""

    def __init__(self, mu, speed):
        super().__init__(name="block")
        self.declare_dynamic_parameter("mu", mu)
        self.declare_continuous_state([speed], ode=self.ode)
        self.declare_default_mode(0)
        self.declare_zero_crossing(
            lambda time, state, mu: state.continuous_state[0],
            lambda time, state, mu: state.with_continuous_state([0.0]),
            name="stop",
            direction="positive_then_non_positive",
            start_mode=0,
            end_mode=1,
        )

    def ode(self, time, state, *, mu):
        return [-mu * 9.81 * (1 - state.mode)]
