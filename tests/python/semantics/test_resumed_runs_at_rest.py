"""Semantics 5.6: a block at rest continues in a resumed run as in the unbroken one, wherever it is cut."""

import numpy as np
import pytest
import saltus
from saltus.library import DataSource

METHODS = ["dopri5", "dop853", "radau", "bdf", "adams", "auto"]


def pressed_block(restitution):
    """x' = v, v' = u, a wall at x = 0.5; u is 1 to 2 s, 0 to 3 s, then -1."""
    body = saltus.LeafSystem(name="body")
    body.declare_input_port("u")
    body.declare_continuous_state(
        [0.0, 0.0], ode=lambda t, s, u: np.array([s.continuous_state[1], u])
    )
    body.declare_zero_crossing(
        lambda t, s, u: 0.5 - s.continuous_state[0],
        reset_map=lambda t, s, u: s.with_continuous_state(
            np.array([0.5, -restitution * s.continuous_state[1]])
        ),
        name="wall",
        direction="falling",
    )
    builder = saltus.DiagramBuilder()
    force = DataSource([0.0, 2.0, 3.0], [1.0, 0.0, -1.0], interpolation="zero_order_hold")
    builder.add(body, force)
    builder.connect(force.output(), body.input(0))
    return builder.build()


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("restitution", [0.0, 0.1])
def test_a_block_without_a_force_is_let_go_where_the_run_was_cut_there(method, restitution):
    """At rest from 1.3 s at the latest; from 3 s on x = 0.5 - (t - 3)^2 / 2, so x(4) = 0."""
    system = pressed_block(restitution)
    for cuts in [(), (1.5,), (2.5,), (2.2, 2.7), (2.0,), (3.0,), (2.999999999,)]:
        context, begin = system.create_context(), 0.0
        for end in (*cuts, 4.0):
            results = saltus.simulate(system, context, (begin, end), ode_solver_method=method)
            context, begin = results.context, end
        # the force is exact, and a quadratic is integrated to a few roundings; the event of the
        # force is exact too. Multistep methods begin with small steps of their tolerance, 1e-6.
        assert context.continuous_state[0] == pytest.approx(0.0, abs=1e-4), cuts
