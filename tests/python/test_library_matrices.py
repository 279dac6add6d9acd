"""Matrices as signals: NumPy is the law, and what does not fit is refused by name."""

import numpy as np
import pytest
import saltus
from saltus.library import (
    Constant,
    Integrator,
    MatrixInversion,
    MatrixMultiplication,
    MatrixTransposition,
)


def random(*shape):
    return np.random.default_rng(sum(shape)).integers(-9, 10, shape).astype(float)


@pytest.mark.parametrize(("m", "k", "n"), [(1, 1, 1), (2, 3, 4), (4, 1, 3), (1, 5, 1), (6, 6, 2)])
def test_products_are_those_of_numpy(m, k, n):
    a, b = random(m, k), random(k, n)
    found = saltus.response(MatrixMultiplication((m, k), (k, n)), a.ravel(), b.ravel())
    np.testing.assert_array_equal(found, a @ b)  # whole numbers: exact
    turned = saltus.response(MatrixTransposition((m, k)), a.ravel())
    np.testing.assert_array_equal(turned, a.T)


@pytest.mark.parametrize("n", [1, 2, 5])
def test_inverses_are_those_of_numpy(n):
    a = random(n, n) + 20.0 * np.eye(n)  # its diagonal outweighs its rows
    found = saltus.response(MatrixInversion(n), a.ravel())
    np.testing.assert_allclose(found, np.linalg.inv(a), rtol=0, atol=1e-15 * np.linalg.cond(a))


def rotation():
    """X' = A X from the identity, with A that turns at 1 rad/s: X(t) is the rotation by t."""
    builder = saltus.DiagramBuilder()
    a = builder.add(Constant([0.0, -1.0, 1.0, 0.0], name="a"))  # the entries, row by row
    product = builder.add(MatrixMultiplication((2, 2), (2, 2), name="product"))
    x = builder.add(Integrator([[1.0, 0.0], [0.0, 1.0]], name="x"))
    builder.connect(a.output(), product.input(0))
    builder.connect(x.output(), product.input(1))
    builder.connect(product.output(), x.input(0))
    return builder.build()


@pytest.mark.parametrize("method", ["dopri5", "bdf", "taylor"])
def test_a_differential_equation_of_matrices(method):
    results = saltus.simulate(
        rotation(), (0.0, 1.0), ode_solver_method=method, rtol=1e-9, atol=1e-11
    )
    c, s = np.cos(1.0), np.sin(1.0)
    # bdf: some 100 steps, each within its tolerance, in a flow that only turns
    np.testing.assert_allclose(results.context.continuous_state, [c, -s, s, c], atol=1e-7)


def test_the_product_has_exact_derivatives():
    found = saltus.linearize(rotation())
    np.testing.assert_array_equal(found.A, np.kron([[0.0, -1.0], [1.0, 0.0]], np.eye(2)))
    assert found.method == "exact"


def test_a_matrix_that_loses_its_inverse_ends_the_run():
    builder = saltus.DiagramBuilder()
    speed = builder.add(Constant(0.0, name="speed"))
    x = builder.add(Integrator(0.0, name="x"))
    inverse = builder.add(MatrixInversion(1, name="inverse"))
    builder.connect(speed.output(), x.input(0))
    builder.connect(x.output(), inverse.input())
    builder.export_output(inverse.output())
    with pytest.raises(saltus.SimulationError, match=r"t = 0.* s: .*'inverse' has no inverse"):
        saltus.simulate(builder.build(), (0.0, 1.0))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: MatrixMultiplication((2, 3), (2, 3)), "as many columns of left as rows of right"),
        (lambda: MatrixMultiplication(2, (2, 3)), r"left_shape: expected \(rows, columns\)"),
        (lambda: MatrixMultiplication((2, 3), (3, 0)), "columns of right_shape: .* above 0"),
        (lambda: MatrixTransposition((2.5, 2)), "rows of shape: expected a whole number"),
        (lambda: MatrixTransposition("23"), "found '23'"),
        (lambda: MatrixInversion(0), "rows: expected a whole number above 0"),
        (lambda: MatrixInversion(True), "found True"),
        (
            lambda: saltus.response(MatrixInversion(2), [1.0, 2.0, 3.0]),
            r"expected shape \(2, 2\), found shape \(3,\)",
        ),
    ],
)
def test_what_does_not_fit_is_refused(make, words):
    with pytest.raises(saltus.ModelError, match=words):
        make()
