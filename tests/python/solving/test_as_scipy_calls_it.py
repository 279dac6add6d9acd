"""Arguments and functions in the forms that SciPy takes."""

import functools

import numpy as np
import pytest
import saltus
from saltus import solve


def columns(t, x):
    """f of k states, the columns of x."""
    return np.vstack([x[1], -x[0]])


@pytest.mark.parametrize("method", ["auto", "dopri5", "bdf"])
def test_vectorized(method):
    one = solve(lambda t, x: [x[1], -x[0]], (0, 2), [0.0, 1.0], method=method)
    many = solve(columns, (0, 2), [0.0, 1.0], method=method, vectorized=True)
    assert np.array_equal(one.t, many.t)
    assert np.array_equal(one.y, many.y)


def test_vectorized_sees_a_column_and_the_arguments():
    shapes = set()

    def seen(t, x, rate):
        shapes.add(np.shape(x))
        return -rate * x

    run = solve(seen, (0, 1), [1.0, 2.0], vectorized=True, args=(2.0,), python="called")
    assert shapes == {(2, 1)}
    np.testing.assert_allclose(run.y[:, -1], np.exp(-2.0) * np.array([1, 2]), rtol=1e-5)


@pytest.mark.parametrize(
    ("theirs", "ours"), [("RK23", "dopri5"), ("LSODA", "auto"), ("Radau", "radau")]
)
def test_methods_of_scipy_that_another_runs(theirs, ours):
    runs = [solve(lambda t, x: -x, (0, 1), [1.0], method=method) for method in (theirs, ours)]
    assert np.array_equal(runs[0].y, runs[1].y)


@pytest.mark.parametrize("terminal", [None, False, 0])
def test_terminal_is_nothing(terminal):
    def zero(t, x):
        return x[0] - 0.5

    zero.terminal = terminal
    run = solve(lambda t, x: -x, (0, 2), [1.0], events=zero)
    assert run.status == "reached_end" and len(run.t_events[0]) == 1


@pytest.mark.parametrize("terminal", [-1, 3.5, "yes"])
def test_terminal_is_wrong(terminal):
    def zero(t, x):
        return x[0] - 0.5

    zero.terminal = terminal
    with pytest.raises(saltus.ModelError, match="The `terminal` attribute of 'zero': expected"):
        solve(lambda t, x: -x, (0, 2), [1.0], events=zero)


def test_args_none_and_args_that_are_none():
    assert solve(lambda t, x: -x, (0, 1), [1.0], args=None).success
    with pytest.raises(TypeError, match="Supplied 'args' cannot be unpacked"):
        solve(lambda t, x, k: -k * x, (0, 1), [1.0], args=3.0)


def test_an_initial_state_that_is_not_finite():
    with pytest.raises(ValueError, match="All components of the initial state `y0` must be finite"):
        solve(lambda t, x: -x, (0, 1), [1.0, np.nan])


@pytest.mark.parametrize("form", [lambda m: m, lambda m: m[0, 0]])
def test_a_jacobian_of_one_state_may_be_a_number(form):
    matrix = np.array([[-1e3]])
    run = solve(
        lambda t, x: -1e3 * (x - t), (0, 1), [0.0], method="bdf", jacobian=lambda t, x: form(matrix)
    )
    assert run.y[0, -1] == pytest.approx(1.0, abs=2e-3)  # it lags by 1e-3 s


def test_sparse_jacobians():
    sparse = pytest.importorskip("scipy.sparse")
    matrix = np.diag([-1e3, -2e3])
    ends = [
        solve(lambda t, x: matrix @ x, (0, 1), [1.0, 1.0], method="bdf", jacobian=jacobian).y[:, -1]
        for jacobian in (
            matrix,
            sparse.csc_matrix(matrix),
            sparse.coo_array(matrix),
            lambda t, x: sparse.csr_matrix(matrix),
        )
    ]
    for end in ends[1:]:
        assert np.array_equal(end, ends[0])


def test_no_state_and_no_length():
    empty = solve(lambda t, x: np.zeros(0), (0, 10), np.zeros(0), dense_output=True)
    assert empty.sol(10).shape == (0,) and empty.sol([1, 2, 3]).shape == (0, 3)
    still = solve(lambda t, x: -x, (4, 4), [2.0, 3.0], dense_output=True)
    assert still.sol(4).tolist() == [2.0, 3.0]
    assert still.sol([4, 5, 6]).tolist() == [[2.0] * 3, [3.0] * 3]


class Decay:
    def rate(self, x, t):
        return -x

    def __call__(self, x, t):
        return -x


@pytest.mark.parametrize("f", [lambda x, t: -x, Decay().rate, Decay()])
def test_the_order_of_odeint_is_refused(f):
    with pytest.raises(saltus.ModelError, match="expected the time first"):
        solve(f, (0.0, 1.0), [1.0])


def test_a_wrapper_that_exchanges_the_arguments_is_taken():
    def decay(x, t):
        return -x

    @functools.wraps(decay)
    def exchanged(t, x):
        return decay(x, t)

    # 1e-6: a hundred times rtol, for the growth of the error over the steps
    assert solve(exchanged, (0.0, 1.0), [1.0], rtol=1e-8, atol=1e-10).y[0, -1] == pytest.approx(
        np.exp(-1.0), rel=1e-6
    )
