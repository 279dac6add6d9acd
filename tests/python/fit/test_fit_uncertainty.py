"""Covariance and confidence: closed forms, Monte Carlo, and what the data do not determine."""

import numpy as np
import pytest
import saltus
from fit_scenes import Decay, Throw, heights

T = np.linspace(0.02, 1.2, 60)
NOISE = 0.005  # [m]
TRUTH = {"g": 9.81, "e": 0.8}
RUNS = 200


def noisy(seed):
    return heights(T) + NOISE * np.random.default_rng(seed).standard_normal(len(T))


def fitted(seed, **options):
    data = {"time": T, "height": noisy(seed)}
    return saltus.fit(Throw(), data, {"g": 9.0, "e": (0.1, 1.0)}, **options)


def test_the_confidence_of_noisy_heights_has_the_truth():
    found = fitted(1)
    assert found.success
    for name, (low, high) in found.confidence(0.99).items():
        assert low < TRUTH[name] < high
        wide = found.confidence(0.999)[name]
        assert wide[0] < low and high < wide[1]


def test_the_covariance_is_that_of_many_fits():
    """Of N fits the sample variance has the relative standard deviation sqrt(2 / (N - 1)), and the
    correlation (1 - c²) / sqrt(N - 1); four of them are allowed. The model is linear over the
    spread of the fits to 1e-2, which is less.
    """
    many = np.array([fitted(seed).values for seed in range(RUNS)])
    one = fitted(0, sigma=NOISE, absolute_sigma=True)
    sample, given = np.cov(many.T), one.covariance
    assert np.diag(given) == pytest.approx(np.diag(sample), rel=4 * np.sqrt(2 / (RUNS - 1)))
    c = one.correlation[0, 1]
    assert np.corrcoef(many.T)[0, 1] == pytest.approx(c, abs=4 * (1 - c**2) / np.sqrt(RUNS - 1))
    assert abs(c) <= 1.0 and np.diag(one.correlation) == pytest.approx([1.0, 1.0])


def test_the_interval_covers_the_truth_as_often_as_it_says():
    """Binomial: 95 % of N, with a standard deviation of sqrt(0.95 0.05 / N); four are allowed."""
    inside = [
        low < TRUTH["e"] < high for low, high in (fitted(s).confidence()["e"] for s in range(RUNS))
    ]
    assert np.mean(inside) == pytest.approx(0.95, abs=4 * np.sqrt(0.95 * 0.05 / RUNS))


def test_the_scale_of_sigma_does_not_matter_unless_it_is_absolute():
    plain, scaled = fitted(2), fitted(2, sigma=7.0)
    assert scaled.covariance == pytest.approx(plain.covariance, rel=1e-6)
    known = fitted(2, sigma=NOISE, absolute_sigma=True)
    assert known.standard_errors != pytest.approx(plain.standard_errors, rel=1e-3)


def test_the_mean_by_another_loss_has_the_variance_of_huber():
    """Huber's location of y = x(0): n sum of psi² over (sum of psi')², n / (n - 1) for small n."""
    draw = np.random.default_rng(5).standard_normal(40)
    y = np.where(np.arange(40) % 8, draw, 10 * draw)
    data = {"time": np.zeros(40), "y": y}
    found = saltus.fit(Decay(), data, {"x[0]": 1.0}, loss="huber", f_scale=1.5, ftol=1e-14)
    r = found.parameters["x[0]"] - y
    assert np.clip(r, -1.5, 1.5).sum() == pytest.approx(0.0, abs=1e-5)
    variance = (np.clip(r, -1.5, 1.5) ** 2).sum() / (abs(r) < 1.5).sum() ** 2 * 40 / 39
    assert found.covariance[0, 0] == pytest.approx(variance, rel=1e-9)


def test_a_product_is_all_that_is_determined():
    t = np.linspace(0.0, 2.0, 11)
    data = {"time": t, "y": 6.0 * np.exp(-0.5 * t) + 1e-3 * np.cos(40 * t)}
    found = saltus.fit(Decay(), data, ["k", "a", "b"])
    assert found.parameters["a"] * found.parameters["b"] == pytest.approx(6.0, rel=1e-3)
    errors = found.standard_errors
    assert np.isinf([errors["a"], errors["b"]]).all() and 0.0 < errors["k"] < 0.01
    assert "determine a combination of 'a' and 'b' only" in found.warnings[0]
    assert "not determined" in repr(found)
    alone = saltus.fit(Decay(), data, ["k", "a"])
    assert errors["k"] == pytest.approx(alone.standard_errors["k"], rel=0.1)  # 8 / 9 of the freedom


def test_a_parameter_without_effect():
    t = np.linspace(0.0, 2.0, 11)
    found = saltus.fit(Decay(), {"time": t, "y": np.exp(-0.5 * t)}, ["k", "c"])
    assert found.standard_errors["c"] == np.inf
    assert found.parameters["c"] == 1.0
    assert "the data do not determine 'c'" in found.warnings[0]
    assert np.isfinite(found.standard_errors["k"])


def test_as_many_data_as_parameters():
    data = {"time": [1.0], "y": [np.exp(-0.5)]}
    found = saltus.fit(Decay(), data, ["k"])
    assert found.parameters["k"] == pytest.approx(0.5, rel=1e-7)
    assert found.standard_errors["k"] == np.inf and "absolute_sigma" in found.warnings[0]
    known = saltus.fit(Decay(), data, ["k"], sigma=0.01, absolute_sigma=True)
    assert known.standard_errors["k"] == pytest.approx(0.01 / np.exp(-0.5), rel=1e-6)


def test_a_fit_that_ends_at_a_bound_says_so():
    data = {"time": T, "height": heights(T)}
    found = saltus.fit(Throw(), data, {"e": saltus.Free(0.5, 0.1, 0.7)})
    assert found.parameters["e"] == pytest.approx(0.7)
    assert found.warnings == ("'e' ended at a bound; its standard error does not count that",)
