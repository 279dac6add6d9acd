"""Systems of a user, for the command line."""

import saltus
from saltus.library import Constant, Integrator


class Ball(saltus.LeafSystem):
    def __init__(self, e=0.5, y0=10.0):
        super().__init__(name="ball")
        self.e = e
        self.declare_dynamic_parameter("g", 9.81)
        self.declare_continuous_state(default_value=[y0, 0.0], ode=self.ode)
        self.declare_continuous_state_output("state")
        self.declare_zero_crossing(
            self.height, self.bounce, name="bounce", direction="positive_then_non_positive"
        )

    def ode(self, time, state, *, g):
        return [state.continuous_state[1], -g]

    def height(self, time, state, *, g):
        return state.continuous_state[0]

    def bounce(self, time, state, *, g):
        y, v = state.continuous_state
        return state.with_continuous_state([abs(y), -self.e * v])


class Fuse(saltus.LeafSystem):
    """x' = 1, until x passes the limit."""

    def __init__(self, limit):
        super().__init__(name="fuse")
        self.limit = limit
        self.declare_continuous_state(default_value=[0.0], ode=self.ode)
        self.declare_continuous_state_output("x")

    def ode(self, time, state):
        if state.continuous_state[0] > self.limit:
            raise RuntimeError("the fuse blew")
        return [1.0]


class Endless(saltus.LeafSystem):
    """Counts seconds, and says when it has begun."""

    def __init__(self):
        super().__init__(name="endless")
        self.declare_discrete_state([0.0])
        self.declare_discrete_state_output("n")
        self.declare_periodic_update(self.update, 1.0)

    def update(self, time, state):
        if time == 2.0:
            print("begun", flush=True)
        return state.discrete_state + 1.0


def make_ramp():
    builder = saltus.DiagramBuilder()
    one, ramp = builder.add(Constant(1.0, name="one"), Integrator(0.0, name="ramp"))
    builder.connect(one.output(), ramp.input("in"))
    builder.export_output(ramp.output(), name="ramp")
    return builder.build()


ramp = make_ramp()
scene = saltus.scene("kepler")
number = 3


def make_wrong():
    raise LookupError("nothing here")
