"""`jax_function` against closed forms: what it returns, and its derivatives in both directions."""

import numpy as np
import pytest
import saltus
from scenes_to_differentiate import STATE, Ball, impacts

jax = pytest.importorskip("jax")
jnp = jax.numpy
jax.config.update("jax_enable_x64", True)

TIGHT = {"rtol": 1e-10, "atol": 1e-12}
WRT = ["g", "e", "x[0]"]
P = jnp.array([9.81, 0.9, 10.0])


@pytest.fixture(scope="module")
def throw():
    ball = Ball()
    return saltus.jax_function(
        ball,
        WRT,
        (0.0, 12.0),
        recorded_signals={"state": ball.output("state")},
        save_at=[1.0, 12.0],
        events={"bounce": 6},
        **TIGHT,
    )


def close(found, expected):
    """To ten relative tolerances of the run, of the largest entry: errors of it enter them all."""
    expected = np.asarray(expected)
    bound = 10 * TIGHT["rtol"] * max(1.0, np.abs(expected).max())
    np.testing.assert_allclose(np.asarray(found), expected, rtol=0, atol=bound)


@pytest.mark.parametrize("jacobian", [jax.jacfwd, jax.jacrev])
def test_impacts_and_the_state_after_six_of_them(throw, jacobian):
    slopes = jacobian(throw)(P)
    close(slopes.events["bounce"], impacts(6))
    close(slopes.continuous_state, STATE)
    close(slopes.outputs["state"][1], STATE)
    close(slopes.outputs["state"][0], [[-0.5, 0, 1], [-1, 0, 0]])  # y0 - g t²/2 and -g t at t = 1
    assert not slopes.end_time.any()
