"""Averages over the pieces of a run: exponents, standard errors, the dimension."""

from __future__ import annotations

import numpy as np

__all__ = ["dimension_of", "running", "standard_errors"]

BATCHES = (8, 16, 32)
"""the numbers of batches whose largest standard error is taken: longer batches are less dependent
on each other, more of them are known better
"""


def running(durations: np.ndarray, logs: np.ndarray) -> np.ndarray:
    """(pieces, directions) [1/s] the mean growth rates from the first piece to each one."""
    return np.asarray(np.cumsum(logs, axis=0) / np.cumsum(durations)[:, None])


def standard_errors(durations: np.ndarray, logs: np.ndarray) -> np.ndarray:
    """(directions,) [1/s] of the means, by batches: the time is divided into B parts, and the
    variance of the mean is that of the B means divided by B - 1 (G. Fishman, Monte Carlo, Springer
    1996, section 6.3). 0 for a direction of which nothing is left, inf with too few pieces.
    """
    batches = [_by_batches(durations, logs, count) for count in BATCHES]
    return np.asarray(np.max(batches, axis=0))


def _by_batches(durations: np.ndarray, logs: np.ndarray, count: int) -> np.ndarray:
    middle = np.cumsum(durations) - 0.5 * durations
    batch = np.minimum((count * middle / np.sum(durations)).astype(int), count - 1)
    times = np.bincount(batch, weights=durations, minlength=count)
    if np.any(times == 0.0):
        return np.full(logs.shape[1], np.inf)
    lost = np.isneginf(logs).any(axis=0)
    kept = np.where(lost, 0.0, logs)
    sums = np.array([np.bincount(batch, weights=column, minlength=count) for column in kept.T])
    means, whole = sums / times, np.sum(kept, axis=0) / np.sum(durations)
    variance = (means - whole[:, None]) ** 2 @ times / np.sum(times) / (count - 1)
    return np.asarray(np.sqrt(variance))


def dimension_of(exponents: np.ndarray, errors: np.ndarray) -> float:
    """The Kaplan-Yorke dimension k + (l_1 + ... + l_k) / |l_(k+1)| of the exponents from the
    largest on, with the largest k whose sum is not negative (J. Kaplan, J. Yorke, Lecture Notes in
    Mathematics 730 (1979) 204). An exponent within two standard errors of zero counts as zero.
    """
    values = np.where(np.abs(exponents) <= 2.0 * errors, 0.0, exponents)
    sums = np.cumsum(values)
    k = int(np.sum(np.cumprod(sums >= 0.0)))
    if k == 0 or k == len(values):
        return float(k)
    return float(k + sums[k - 1] / abs(values[k]))
