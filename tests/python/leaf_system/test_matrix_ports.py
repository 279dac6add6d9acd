"""Ports of matrices in Python: what a callback gets and may return, and what is refused."""

import numpy as np
import pytest
import saltus
from saltus.library import Constant

M = np.arange(6.0).reshape(2, 3)


def block(function, *shapes, **output):
    leaf = saltus.LeafSystem(name="leaf")
    for shape in shapes:
        leaf.declare_input_port(shape=shape)
    leaf.declare_output_port(function, name="y", **output)
    return leaf


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize("shape", [None, (2, 3)])
def test_a_callback_gets_and_returns_matrices(python, shape):
    seen = []

    def gram(time, state, u):
        seen.append(np.shape(u))
        return u @ u.T

    found = saltus.response(block(gram, shape), M, python=python)
    np.testing.assert_array_equal(found, M @ M.T)
    assert (2, 3) in seen


@pytest.mark.parametrize("python", ["traced", "called"])
def test_a_state_of_two_dimensions_is_shown_as_it_is(python):
    leaf = saltus.LeafSystem(name="leaf")
    leaf.declare_continuous_state(default_value=M, ode=lambda t, s: -s.continuous_state)
    leaf.declare_continuous_state_output("x")
    leaf.declare_output_port(lambda t, s: s.continuous_state.T, name="turned")
    results = saltus.simulate(
        leaf, (0.0, 1.0), python=python, rtol=1e-8, atol=1e-10,
        recorded_signals={"x": leaf.output("x"), "turned": leaf.output("turned")},
    )  # fmt: skip
    # some 20 steps within 1e-8 of entries up to 5
    np.testing.assert_allclose(results["x"][-1], np.exp(-1.0) * M, rtol=0, atol=1e-6)
    np.testing.assert_array_equal(results["turned"], np.swapaxes(results["x"], 1, 2))


@pytest.mark.parametrize("python", ["traced", "called"])
def test_an_array_to_fill_has_the_declared_shape(python):
    def fill(time, state, u, out):
        assert out.shape == (3, 2)
        out[:] = u.T

    found = saltus.response(block(fill, (2, 3), shape=(3, 2)), M, python=python)
    np.testing.assert_array_equal(found, M.T)


@pytest.mark.parametrize("result", [M, M.tolist(), M.ravel(), list(M)])
def test_a_declared_matrix_may_be_returned_as_lists_or_row_by_row(result):
    np.testing.assert_array_equal(saltus.response(block(lambda t, s: result, shape=(2, 3))), M)


def test_a_matrix_of_one_entry_stays_a_matrix_and_fits_a_number():
    shapes = []

    def look(time, state, u):
        shapes.append(np.shape(u))
        return 2.0 * u

    assert saltus.response(block(look, None), [[3.0]], python="called").tolist() == [[6.0]]
    assert shapes[-1] == (1, 1)
    assert saltus.response(block(look, ()), [[3.0]], python="called") == 6.0
    assert shapes[-1] == ()


def test_a_sampled_output_is_a_matrix():
    leaf = block(lambda t, s: (t + 1.0) * M, shape=(2, 3), period=0.5, default_value=None)
    np.testing.assert_array_equal(saltus.response(leaf, t=[0.0, 0.7]), [M, 1.5 * M])


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: block(lambda t, s, u: u, (2, 3, 4)), r"input 'in_0': .* 3 dimensions"),
        (lambda: block(lambda t, s: M, shape=(1, 2, 3)), r"output 'y': .* 3 dimensions"),
        (lambda: block(lambda t, s: M, shape=(0, 3)), "at least one row and one column"),
        (
            lambda: saltus.response(block(lambda t, s: M.reshape(1, 2, 3))),
            "output 'y': expected a number, a vector or a matrix, found an array of 3 dimensions",
        ),
        (
            lambda: saltus.response(block(lambda t, s: M.T, shape=(2, 3))),
            r"output 'y' returned an array of shape \(3, 2\), expected \(2, 3\)",
        ),
        (
            lambda: saltus.response(block(lambda t, s: M[:, :2], shape=(2, 3))),
            r"output 'y' returned an array of shape \(2, 2\), expected \(2, 3\)",
        ),
        (
            lambda: saltus.response(block(lambda t, s: [[1.0], [2.0, 3.0]], shape=(2, 3))),
            "a list of entries of different lengths, expected 6 numbers",
        ),
        (
            lambda: saltus.response(block(lambda t, s, u: u, (3, 2)), M),
            r"input 'in_0' of block 'leaf': expected shape \(3, 2\), found shape \(2, 3\) from",
        ),
        (
            lambda: saltus.response(block(lambda t, s, u: u, 6), M),
            r"expected shape \(6,\), found shape \(2, 3\) .*; a Multiplexer of one input gives",
        ),
        (
            lambda: saltus.response(block(lambda t, s, u: u, (2, 3)), M.ravel()),
            r"expected shape \(2, 3\), found shape \(6,\) from output",
        ),
        (lambda: Constant([[1.0, np.nan]], name="c"), "block 'c': .*finite"),
        (lambda: Constant([[1.0], [2.0, 3.0]], name="c"), "a list of entries of different lengths"),
        (lambda: Constant(np.zeros((2, 0)), name="c"), "at least one row and one column"),
    ],
)
def test_what_does_not_fit_is_refused(make, words):
    with pytest.raises(saltus.ModelError, match=words):
        make()
