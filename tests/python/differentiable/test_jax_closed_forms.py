"""`jax_function` against closed forms: what it returns, and its derivatives in both directions."""

import numpy as np
import pytest
import saltus
from scenes_to_differentiate import STATE, Y0, Ball, Decay, E, G, impacts

jax = pytest.importorskip("jax")
jnp = jax.numpy
jax.config.update("jax_enable_x64", True)

TIGHT = {"rtol": 1e-10, "atol": 1e-12}
WRT = ["g", "e", "x[0]"]
P = jnp.array([G, E, Y0])
DIRECTIONS = pytest.mark.parametrize("jacobian", [jax.jacfwd, jax.jacrev])


def close(found, expected):
    """To ten relative tolerances of the largest entry, since the columns share their errors."""
    expected = np.asarray(expected)
    bound = 10 * TIGHT["rtol"] * max(1.0, np.abs(expected).max())
    np.testing.assert_allclose(np.asarray(found), expected, rtol=0, atol=bound)


@DIRECTIONS
def test_impacts_and_the_state_after_six_of_them(jacobian):
    f = saltus.jax_function(
        Ball(),
        WRT,
        (0.0, 12.0),
        recorded_signals=["state"],
        save_at=[1.0, 12.0],
        events={"bounce": 6},
        **TIGHT,
    )
    slopes = jacobian(f)(P)
    close(slopes.events["bounce"], impacts(6))
    close(slopes.continuous_state, STATE)
    close(slopes.outputs["state"][1], STATE)
    close(slopes.outputs["state"][0], [[-0.5, 0, 1], [-1, 0, 0]])  # y0 - g t²/2 and -g t at t = 1
    assert not slopes.end_time.any()


@DIRECTIONS
def test_where_a_guard_ends_the_run_the_derivatives_of_the_end_are_total(jacobian):
    """Thrown up with v0 = 3, the ball meets the floor with c = sqrt(v0² + 2 g y0), at (v0 + c) / g,
    and leaves it with e c at the height 0, whatever the parameters are.
    """
    up = 3.0
    f = saltus.jax_function(Ball(speed=up, stops=True), WRT, (0.0, 12.0), **TIGHT)
    speed = np.sqrt(up**2 + 2 * G * Y0)
    close(f(P).end_time, (up + speed) / G)
    slopes = jacobian(f)(P)
    close(slopes.end_time, [Y0 / (speed * G) - (up + speed) / G**2, 0, 1 / speed])
    close(slopes.continuous_state, [[0, 0, 0], [E * Y0 / speed, speed, E * G / speed]])


@DIRECTIONS
def test_a_ball_at_rest_after_infinitely_many_impacts_does_not_move(jacobian):
    f = saltus.jax_function(Ball(), WRT, (0.0, 40.0), **TIGHT)
    close(jacobian(f)(P).continuous_state, np.zeros((2, 3)))


@DIRECTIONS
def test_a_vector_is_an_array_under_its_name(jacobian):
    """x' = -k x: dx/dk = -t x, dx/dx0 = exp(-k t)."""
    times = np.array([0.0, 0.5, 1.0])
    f = saltus.jax_function(
        Decay(), ["k", "x[1]"], (0.0, 1.0), recorded_signals=["x"], save_at=times, **TIGHT
    )
    k, start = np.array([1.0, 2.0]), np.array([3.0, 4.0])
    given = {"x[1]": start[1], "k": jnp.array(k)}  # the order of a dict does not matter
    factor = np.exp(-np.outer(times, k))
    close(f(given).outputs["x"], factor * start)
    slopes = jacobian(f)(given).outputs["x"]
    close(slopes["k"], -times[:, None, None] * (factor * start)[:, :, None] * np.eye(2))
    close(slopes["x[1]"], np.stack([np.zeros(3), factor[:, 1]], axis=1))


def test_the_values_are_those_of_simulate_to_the_bit():
    ball = Ball()
    f = saltus.jax_function(ball, ["e"], (0.0, 12.0), events={"bounce": 6}, **TIGHT)
    context = ball.create_context().with_parameter("e", 0.8)
    run = saltus.simulate(ball, context, (0.0, 12.0), **TIGHT)
    for values in (f(jnp.array([0.8])), jax.jvp(f, (jnp.array([0.8]),), (jnp.ones(1),))[0]):
        assert (values.continuous_state == run.context.continuous_state).all()
        assert (values.events["bounce"] == run.events.times("bounce")[:6]).all()
        assert values.end_time == 12.0


def test_gradient_descent_finds_the_start_of_a_ball():
    """y(T) and t_2 of a ball determine g and y0; Newton's iteration needs a right Jacobian to
    square its error. From 1 % off: 1e-2, 1e-4, 1e-8, and 1e-9 is what rtol allows.
    """
    f = saltus.jax_function(Ball(), ["g", "x[0]"], (0.0, 3.0), events={"bounce": 1}, **TIGHT)

    def values(p):
        found = f(p)
        return jnp.stack([found.continuous_state[0], found.events["bounce"][0]])

    wanted, p = values(jnp.array([G, Y0])), jnp.array([1.01 * G, 0.99 * Y0])
    for _ in range(4):
        p = p - jnp.linalg.solve(jax.jacrev(values)(p), values(p) - wanted)
    np.testing.assert_allclose(p, [G, Y0], rtol=1e-8)
