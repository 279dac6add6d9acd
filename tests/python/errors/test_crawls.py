"""A solution that slides along a jump of its derivative: the run ends and names the jump."""

import numpy as np
import pytest
import saltus

METHODS = ("auto", "dopri5", "dop853", "adams", "bdf", "radau")
SIGNS = {
    "np.sign": lambda x: np.sign(x),
    "a conditional": lambda x: 1.0 if x > 0.0 else -1.0,
    "np.where": lambda x: np.where(x > 0.0, 1.0, -1.0),
}


class Block(saltus.LeafSystem):
    """v' = 0.5 - sign(v) from v = 1: a block that is pushed, with dry friction, stops at 2 s. From
    then on the velocity crosses the jump in both directions.
    """

    def __init__(self, sign):
        super().__init__(name="block")
        self.declare_continuous_state(
            [0.0, 1.0],
            ode=lambda t, s: [s.continuous_state[1], 0.5 - sign(s.continuous_state[1])],
        )


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize("name", SIGNS)
@pytest.mark.parametrize("method", METHODS)
def test_a_slide_along_a_jump_ends_as_chattering(name, method, python):
    found = saltus.simulate(
        Block(SIGNS[name]), (0.0, 10.0), ode_solver_method=method, python=python, throw=False
    )
    assert found.status == "chattering"
    assert abs(found.context.time - 2.0) < 0.1
    assert "block 'block' jumps from" in found.message
    assert found.statistics.right_hand_side_calls < 100_000
