"""Complex states: real and imaginary parts of numbers, each within the tolerances."""

import numpy as np
import pytest
import saltus
from saltus import Guard, solve

METHODS = ("auto", "dopri5", "dop853", "adams", "bdf", "radau")
CLOSE = {"rtol": 1e-9, "atol": 1e-11}
RATES = np.array([-0.5 + 3.0j, 2.0j])


def turn(t, x):
    return RATES * x


def at(t):
    return np.array([1.0, 1.0j])[:, None] * np.exp(np.outer(RATES, np.atleast_1d(t)))


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("span", [(0.0, 2.0), (0.0, -2.0)])
def test_a_complex_state(method, span):
    run = solve(turn, span, [1.0, 1.0j], method=method, dense_output=True, **CLOSE)
    assert run.y.dtype == complex and run.y.shape == (2, len(run.t))
    # a hundred steps of one tolerance each, at sizes up to e
    np.testing.assert_allclose(run.y, at(run.t), atol=300 * 1e-9)
    asked = np.linspace(*span, 5)
    np.testing.assert_allclose(run.sol(asked), at(asked), atol=300 * 1e-9)
    assert run.sol(span[1]).shape == (2,)


@pytest.mark.parametrize("method", METHODS)
def test_it_has_the_bits_of_its_parts(method):
    def parts(t, x):
        z = RATES * x.view(complex)
        return z.view(float)

    start = np.array([1.0, 1.0j])
    whole = solve(turn, (0, 2), start, method=method)
    real = solve(parts, (0, 2), start.view(float), method=method, python="called")
    assert np.array_equal(whole.t, real.t)
    assert np.array_equal(whole.y.T.copy().view(float), real.y.T)


@pytest.mark.parametrize("kind", ["none", "function", "matrix", "sparse"])
def test_jacobians_are_complex(kind):
    sparse = pytest.importorskip("scipy.sparse")
    matrix = np.diag(1e4 * RATES - 1e4)
    jacobian = {
        "none": None,
        "function": lambda t, x: matrix,
        "matrix": matrix,
        "sparse": sparse.csc_matrix(matrix),
    }[kind]
    run = solve(
        lambda t, x: matrix @ (x - np.exp(1j * t)),
        (0, 2),
        [1.0 + 0.0j, 1.0],
        method="bdf",
        jacobian=jacobian,
        jacobian_sparsity=np.eye(2),
    )
    # lags by 1 / |rate|, below 1e-4
    np.testing.assert_allclose(run.y[:, -1], np.exp(2j), atol=1e-3)
    assert run.stats.steps < 500
    assert (run.njev == 0) == (kind in ("matrix", "sparse"))


def test_guards_and_resets():
    """x = exp(i t) crosses the imaginary axis at pi/2, where it is set back to 1."""
    back = Guard(lambda t, x: x[0].real, lambda t, x: [1.0 + 0.0j], "falling", name="back")
    run = solve(lambda t, x: 1j * x, (0, 4), [1.0 + 0.0j], events=back, **CLOSE)
    np.testing.assert_allclose(run.t_events[0], [np.pi / 2, np.pi], atol=1e-7)
    np.testing.assert_allclose(run.y_events[0], [[1j], [1j]], atol=1e-7)
    assert run.events[0].after.tolist() == [1.0 + 0.0j]


def test_tolerances_of_each_number():
    run = solve(turn, (0, 2), [1.0, 1.0j], rtol=1e-9, atol=[1e-11, 1e-11])
    once = solve(turn, (0, 2), [1.0, 1.0j], rtol=1e-9, atol=1e-11)
    assert np.array_equal(run.y, once.y)


def test_f_may_fill_its_output():
    def fills(t, x, out):
        out[:] = RATES * x

    start = [1.0, 1.0j]
    assert np.array_equal(solve(fills, (0, 1), start).y, solve(turn, (0, 1), start).y)


def test_it_can_be_saved_and_pickled(tmp_path):
    import pickle

    run = solve(turn, (0, 1), [1.0, 1.0j])
    run.save(tmp_path / "turn.npz")
    for copy in (saltus.load_results(tmp_path / "turn.npz"), pickle.loads(pickle.dumps(run))):
        assert np.array_equal(copy.y, run.y) and copy.y.dtype == complex


def test_a_real_state_takes_no_complex_derivative():
    with pytest.raises(saltus.ModelError, match="complex numbers for a real x0; make x0 complex"):
        solve(lambda t, x: 1j * x, (0, 1), [1.0])
    with pytest.raises(saltus.ModelError, match="jacobian: expected real numbers, as in x0"):
        solve(lambda t, x: -x, (0, 1), [1.0], jacobian=[[1j]])
