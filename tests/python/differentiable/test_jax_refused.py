"""What `jax_function` refuses when it is called, and where a run has no values or derivatives."""

import numpy as np
import pytest
import saltus
from saltus.errors import ModelError, SimulationError
from scenes_to_differentiate import STATE, Y0, Ball, Decay, E, G, impacts

jax = pytest.importorskip("jax")
jnp = jax.numpy
jax.config.update("jax_enable_x64", True)

WRT = ["g", "e", "x[0]"]
P = jnp.array([G, E, Y0])


def function(ball=None, wrt=WRT, span=(0.0, 12.0), **arguments):
    return saltus.jax_function(ball or Ball(), wrt, span, **arguments)


@pytest.fixture(scope="module")
def f():
    return function(events={"bounce": 6})


@pytest.mark.parametrize(
    "p, message",
    [
        ([G, E], r"p: expected the shape \(3,\), found \(2,\); the parameters are g, e, x\[0\]"),
        (G, r"p: expected the shape \(3,\), found \(\)"),
        (jnp.ones((2, 3)), r"p: expected the shape \(3,\), found \(2, 3\)"),
        (np.ones(3, "float32"), "p: expected float64, found float32; make it with dtype="),
        ({"g": G, "x[0]": Y0}, "the dict has no value of 'e', which wrt names"),
        ({"g": G, "e": E, "x[0]": Y0, "f": 1.0}, "wrt has no name 'f'; did you mean"),
        ({"g": [G], "e": E, "x[0]": Y0}, r"g: expected the shape \(\), found \(1,\)"),
        ({"g": 1j, "e": E, "x[0]": Y0}, "g: expected float64, found complex128"),
        ({"g": True, "e": E, "x[0]": Y0}, "g: expected float64, found bool"),
        ({"g": "much", "e": E, "x[0]": Y0}, "g: expected numbers of float64, found 'much'"),
        (None, "p: expected numbers of float64, found None"),
        ([np.nan, E, Y0], "'g' is nan; give a finite value"),
    ],
)
def test_parameters_that_are_wrong(f, p, message):
    with pytest.raises(ModelError, match=message):
        f(p)


def test_wrong_shapes_are_found_while_jit_traces(f):
    with pytest.raises(ModelError, match=r"expected the shape \(3,\), found \(2,\)"):
        jax.jit(f)(P[:2])


def test_single_precision_is_refused(f):
    with jax.enable_x64(False):
        for refused in (lambda: f([G, E, Y0]), lambda: jax.jit(f)([G, E, Y0]), function):
            with pytest.raises(
                ModelError, match=r"call jax.config.update\('jax_enable_x64', True\)"
            ):
                refused()


FEWER = (
    r"jax_function: expected 6 events 'bounce', found 1, with g = 9.81, e = 0.9, x\[0\] = 100; the "
    "run ended at t = 12.0 s with the status 'reached_end'; ask for fewer"
)


def test_fewer_events_than_asked_for(f):
    high = P.at[2].set(100.0)
    with pytest.raises(SimulationError, match=FEWER) as caught:
        f(high)
    assert caught.value.time == 12.0 and len(caught.value.results.events) == 1
    for wrapped in (
        jax.jit(f),
        lambda p: jax.vmap(f)(p[None]),
        jax.jit(jax.grad(lambda p: f(p).end_time)),
    ):
        with pytest.raises(jax.errors.JaxRuntimeError, match=FEWER):
            jax.block_until_ready(wrapped(high))


def test_a_run_that_ends_before_a_row():
    f = function(Ball(stops=True), recorded_signals=["state"], save_at=[1.0, 2.0])
    with pytest.raises(SimulationError, match=r"at each of 2 times, found 1, .* 'terminal'"):
        f(P)


def test_an_exception_of_the_run_comes_out():
    f = function(Ball(on_zeno="error"), span=(0.0, 40.0))
    with pytest.raises(SimulationError, match="a Zeno point") as caught:
        f(P)
    assert caught.value.results.status == "failed"
    with pytest.raises(jax.errors.JaxRuntimeError, match="a Zeno point"):
        jax.block_until_ready(jax.jit(f)(P))


def first_impact():
    return saltus.simulate(Ball(), (0.0, 3.0)).events.times("bounce")[0]


@pytest.mark.parametrize("rows", [True, False], ids=["row", "end"])
def test_an_event_that_moves_across_a_returned_value(rows):
    """Before the impact dv/dg is -t, after it e t + ...: a value there has no derivative."""
    time = float(first_impact())
    given = {"save_at": [time], "recorded_signals": ["state"]} if rows else {}
    f = function(wrt=["e", "x[0]"], span=(0.0, 3.0 if rows else time), **given)
    value = "state" if rows else "continuous_state"
    message = (
        rf"t = 1.42784\d* s: '{value}' has no derivative by .* from the event 'ball.bounce' on: "
    )
    for derivative in (jax.jacfwd(f), jax.jacrev(f)):
        with pytest.raises(SimulationError, match=message) as caught:
            derivative(P[1:])
    assert caught.value.block == "ball" and caught.value.time == pytest.approx(time)
    f(P[1:])  # the values themselves are there


def test_gaps_as_nan_leave_the_other_values():
    time = float(first_impact())
    f = function(
        save_at=[time, 12.0], recorded_signals=["state"], gaps="nan", rtol=1e-10, atol=1e-12
    )
    row = jax.jacrev(lambda p: f(p).outputs["state"][0])(P)
    assert np.isnan(row[:, [0, 2]]).all()  # g and y0 move the first impact
    end = jax.jacrev(lambda p: f(p).continuous_state)(P)
    np.testing.assert_allclose(end, STATE, rtol=1e-9, atol=1e-7)


def test_a_derivative_that_is_not_finite():
    f = function(Decay(), wrt=["k", "b"], span=(0.0, 1.0))
    given = {"k": jnp.array([1.0, 2.0]), "b": 0.0}
    message = "'continuous_state' has no derivative by 'b': the derivative is not finite; leave"
    with pytest.raises(SimulationError, match=message):
        jax.jacrev(f)(given)
    with pytest.raises(jax.errors.JaxRuntimeError, match=message):
        jax.block_until_ready(jax.jit(jax.jacrev(f))(given))
    f = function(Decay(), wrt=["k", "b"], span=(0.0, 1.0), gaps="nan", rtol=1e-9)
    slopes = jax.jacrev(f)(given).continuous_state
    assert np.isnan(slopes["b"]).all()
    expected = -np.diag([3.0 * np.exp(-1.0), 5.0 * np.exp(-2.0)])  # of x0 exp(-k) at t = 1
    np.testing.assert_allclose(slopes["k"], expected, rtol=0, atol=1e-8)


def test_a_run_that_ends_at_a_zeno_point():
    f = function(Ball(on_zeno="stop"), span=(0.0, 40.0))
    with pytest.raises(SimulationError, match="the run ended where events accumulate"):
        jax.jacrev(f)(P)
    f = function(Ball(on_zeno="stop"), span=(0.0, 40.0), events={"bounce": 3}, gaps="nan")
    assert np.isnan(jax.grad(lambda p: f(p).end_time)(P)).all()
    slope = jax.grad(lambda p: f(p).events["bounce"][2])(P)  # no sum with nan
    np.testing.assert_allclose(slope, impacts(3)[2], rtol=1e-5)
