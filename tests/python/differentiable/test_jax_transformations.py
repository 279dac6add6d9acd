"""The transformations of JAX agree with each other, and a derivative costs one run."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import saltus
from saltus.differentiable import run as run_module
from saltus.errors import ModelError
from scenes_to_differentiate import Y0, Ball, E, G

jax = pytest.importorskip("jax")
jnp = jax.numpy
jax.config.update("jax_enable_x64", True)

P = jnp.array([G, E, Y0])
SEVERAL = jnp.stack([P, 0.999 * P, 1.001 * P])


@pytest.fixture(scope="module")
def f():
    return saltus.jax_function(Ball(), ["g", "e", "x[0]"], (0.0, 12.0), events={"bounce": 6})


@pytest.fixture
def runs(monkeypatch):
    """The names of the derivatives of each run that is made."""
    made = []
    simulate = run_module.simulate

    def counted(system, context, span, options):
        made.append(options.sensitivity)
        return simulate(system, context, span, options)

    monkeypatch.setattr(run_module, "simulate", counted)
    return made


def equal(found, expected):
    jax.tree.map(lambda a, b: np.testing.assert_array_equal(a, b), found, expected)


def near(found, expected):
    """Sums in another order: 3 products of some 1e3, each to 1e-16."""
    jax.tree.map(lambda a, b: np.testing.assert_allclose(a, b, rtol=0, atol=1e-11), found, expected)


def height(f):
    return lambda p: f(p).continuous_state[0]


def test_jit_has_the_bits_of_the_direct_call(f):
    equal(jax.jit(f)(P), f(P))
    equal(jax.jit(jax.jacfwd(f))(P), jax.jacfwd(f)(P))
    equal(jax.jit(jax.jacrev(f))(P), jax.jacrev(f)(P))


def test_vmap_is_one_run_after_the_other(f):
    stack = lambda *rows: jnp.stack(rows)  # noqa: E731
    equal(jax.vmap(f)(SEVERAL), jax.tree.map(stack, *[f(p) for p in SEVERAL]))
    grad = jax.grad(height(f))
    equal(jax.vmap(grad)(SEVERAL), jnp.stack([grad(p) for p in SEVERAL]))
    near(jax.jit(jax.vmap(grad))(SEVERAL), jax.vmap(grad)(SEVERAL))


def test_forward_and_reverse_are_transposed(f):
    forward, reverse = jax.jacfwd(f)(P), jax.jacrev(f)(P)
    near(forward, reverse)
    tangent = jnp.array([1.0, -2.0, 0.5])
    near(jax.jvp(f, (P,), (tangent,))[1], jax.tree.map(lambda s: s @ tangent, forward))
    near(jax.vjp(height(f), P)[1](2.0)[0], 2.0 * forward.continuous_state[0])


def test_a_derivative_of_any_kind_is_one_run(f, runs):
    names = ("g", "e", "x[0]")
    for derivative in (jax.grad(height(f)), jax.jacfwd(f), jax.jacrev(f)):
        runs.clear()
        jax.block_until_ready(derivative(P))
        assert runs == [names]
    runs.clear()
    f(P)
    assert runs == [()]


def test_a_dict_and_an_array_are_one_thing(f):
    given = {"x[0]": Y0, "e": E, "g": G}
    equal(f(given), f(P))
    grad = jax.grad(height(f))(given)
    equal([grad[name] for name in ("g", "e", "x[0]")], list(jax.grad(height(f))(P)))


def test_whole_numbers_and_lists_are_parameters_too(f):
    equal(f([10, 0.5, 10]), f(jnp.array([10.0, 0.5, 10.0])))
    equal(f(np.array([G, E, Y0])), f(P))


def test_within_a_loop_of_jax(f):
    """The sum of the last impacts of three balls, by `lax.scan`."""

    def total(p):
        return jax.lax.scan(lambda s, q: (s + f(q * p).events["bounce"][5], None), 0.0, SEVERAL)[0]

    ones = jnp.ones(3)
    slopes = [jax.grad(lambda p: f(p).events["bounce"][5])(q) * q for q in SEVERAL]
    np.testing.assert_allclose(jax.jit(jax.grad(total))(ones), sum(slopes), rtol=1e-14)


def test_threads_share_a_function(f):
    grad = jax.grad(height(f))
    points = [P * (1 - 1e-3 * i) for i in range(12)]
    with ThreadPoolExecutor(4) as pool:
        equal(list(pool.map(grad, points)), [grad(p) for p in points])
    compiled = jax.jit(grad)
    alone = [compiled(p) for p in points]
    with ThreadPoolExecutor(4) as pool:
        equal(list(pool.map(compiled, points)), alone)


@pytest.mark.parametrize("wrap", [lambda g: g, jax.jit], ids=["direct", "jit"])
@pytest.mark.parametrize("twice", ["hessian", "forward"])
def test_second_derivatives_are_refused(f, wrap, twice):
    second = jax.hessian(height(f)) if twice == "hessian" else jax.jacfwd(jax.jacfwd(height(f)))
    with pytest.raises(ModelError, match="jax_function: second derivatives of a run are not comp"):
        wrap(second)(P)
