"""A block with every kind of callback, each of which can be made to fail."""

import numpy as np
import saltus

METHODS = ["dopri5", "adams", "bdf", "radau", "auto"]
CALLBACKS = ["ode", "guard", "reset", "update", "output"]


def calm(where, time):
    """No trouble."""
    return 0.0


def after(time, place, act):
    """Trouble in one callback, at the first call later than `time`."""
    return lambda where, t: act() if where == place and t > time else 0.0


def say(error):
    raise error


class Everything(saltus.LeafSystem):
    """dx/dt = -x from 1, back to 1 at 1/2; z counts every 0.25 s; y = x. The number that
    `trouble(where, time)` gives is added to what a callback returns.
    """

    def __init__(self, trouble=calm):
        super().__init__(name="all")
        self.trouble = trouble
        self.declare_continuous_state(default_value=[1.0], ode=self.ode, jacobian=self.jacobian)
        self.declare_discrete_state([0.0])
        self.declare_output_port(self.output_y, "y", shape=())
        self.declare_zero_crossing(
            self.guard, self.reset, name="half", direction="positive_then_non_positive"
        )
        self.declare_periodic_update(self.update, 0.25, name="tick")

    def ode(self, time, state):
        return -state.continuous_state + self.trouble("ode", time)

    def jacobian(self, time, state):
        return [[-1.0 + self.trouble("jacobian", time)]]

    def output_y(self, time, state):
        return state.continuous_state[0] + self.trouble("output", time)

    def guard(self, time, state):
        return state.continuous_state[0] - 0.5 + self.trouble("guard", time)

    def reset(self, time, state):
        return state.with_continuous_state([1.0 + self.trouble("reset", time)])

    def update(self, time, state):
        return state.discrete_state + 1.0 + self.trouble("update", time)


def go(system, end=2.0, method="dopri5", **options):
    """A block that raises is called, so all are: a traced one has another Jacobian, and other
    steps.
    """
    options.setdefault("python", "called")
    return saltus.simulate(
        system,
        system.create_context(),
        (0.0, end),
        recorded_signals={port.name: port for port in system.output_ports},
        ode_solver_method=method,
        **options,
    )


def check_kept(results, method="dopri5"):
    """Up to where it stood, a failed run has what a good one has: rows, events, a context."""
    good = go(Everything(), method=method)
    t = results.context.time
    assert results.status == "failed"
    assert 0.5 <= results.time[-1] <= t < 0.8
    assert np.all(np.isfinite(results.context.continuous_state))
    n = np.sum(good.time < 0.5)  # the last steps may be shorter than those of the good run
    assert np.array_equal(results.time[:n], good.time[:n])
    assert np.array_equal(results.outputs["y"][:n], good.outputs["y"][:n])
    early = (results.time < np.log(2.0) - 1e-4) & (results.time < t)
    np.testing.assert_allclose(
        results.outputs["y"][early], np.exp(-results.time[early]), atol=1e-4, rtol=0
    )
    assert results.outputs["y"].shape == results.time.shape == results.jump.shape
    seen = [(e.time, e.jump, e.name) for e in results.events]
    assert seen == [(e.time, e.jump, e.name) for e in good.events][: len(seen)]
    assert [e[2] for e in seen].count("tick") == 1 + int(t / 0.25) - (t == 0.75)
    assert results.context.discrete_state == [e[2] for e in seen].count("tick")


def check_works(system, method="dopri5"):
    """The same system, with the trouble over, runs as one that never failed."""
    system.trouble = calm
    again, good = go(system, method=method), go(Everything(), method=method)
    assert again.status == "reached_end"
    assert np.array_equal(again.time, good.time)
    assert np.array_equal(again.outputs["y"], good.outputs["y"])
    assert again.context == good.context
