"""`Problem`: residuals and their Jacobian for the optimizer, from the runs of all experiments."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from saltus.fitting.coordinates import Coordinates
from saltus.fitting.differences import difference, step_of
from saltus.fitting.trial import Evaluation, RunFailed, Trial

__all__ = ["Point", "Problem", "Record"]


@dataclass(frozen=True)
class Point:
    """Residuals r = (model - data) / sigma and dr/du at one place u of the optimizer."""

    u: np.ndarray
    residuals: np.ndarray
    jacobian: np.ndarray

    @property
    def sum_of_squares(self) -> float:
        return float(self.residuals @ self.residuals)


@dataclass
class Record:
    """What happened during a fit."""

    evaluations: int = 0
    failures: int = 0
    first_failure: str = ""
    differences: Counter[str] = field(default_factory=Counter)
    """parameter -> Jacobians in which differences of runs replace derivatives"""
    no_slope: Counter[str] = field(default_factory=Counter)
    """parameter -> Jacobians in which even the runs of a difference failed"""
    reasons: dict[str, None] = field(default_factory=dict)
    """why there was no derivative, in the order in which it was met"""


class Problem:
    """Least squares over all experiments.

    A point is computed once: the run that gives its residuals gives its Jacobian too.
    """

    def __init__(self, trials: list[Trial], coordinates: Coordinates, rtol: float):
        self.trials, self.coordinates, self.rtol = trials, coordinates, rtol
        self.data = np.concatenate([trial.data for trial in trials])
        self.sigma = np.concatenate([trial.sigma for trial in trials])
        self.record = Record()
        self.failed: RunFailed | None = None  # the last failure
        self.best: Point | None = None
        self.seen: Callable[[Point | None], None] = lambda point: None
        self._points: list[Point] = []  # the last ones; the optimizer asks twice for each

    def residuals(self, u: np.ndarray) -> np.ndarray:
        """At `u`; infinite where a run fails, which makes the optimizer shorten its step."""
        point = self.at(u)
        return np.full(len(self.data), np.inf) if point is None else point.residuals

    def jacobian(self, u: np.ndarray) -> np.ndarray:
        point = self.at(u)
        assert point is not None  # the optimizer has its residuals
        return point.jacobian

    def at(self, u: np.ndarray) -> Point | None:
        """The point at `u`; None if a run fails."""
        for known in [*self._points, self.best]:
            if known is not None and np.array_equal(known.u, u):
                return known
        self.record.evaluations += 1
        point = self._computed(np.array(u, dtype=float))
        if point is not None:
            self._points = [*self._points[-1:], point]
            if self.best is None or point.sum_of_squares < self.best.sum_of_squares:
                self.best = point
        self.seen(point)
        return point

    def _computed(self, u: np.ndarray) -> Point | None:
        values = self.coordinates.outer(u)
        try:
            found = [
                trial.evaluate(self.coordinates.of_run(values, k))
                for k, trial in enumerate(self.trials)
            ]
        except RunFailed as error:
            self._note(error)
            return None
        model = np.concatenate([each.model for each in found])
        residuals = (model - self.data) / self.sigma
        if not np.isfinite(residuals @ residuals):
            self._note(RunFailed("the sum of the squares of the residuals overflows"))
            return None
        jacobian = self._assembled(found) / self.sigma[:, None] * self.coordinates.slope(values)
        return Point(u, residuals, self._without_gaps(u, residuals, jacobian, found))

    def _note(self, error: RunFailed) -> None:
        self.failed = error
        self.record.failures += 1
        self.record.first_failure = self.record.first_failure or str(error)

    def _assembled(self, found: list[Evaluation]) -> np.ndarray:
        """The derivatives of all runs by all parameters; zero where a run has not the parameter."""
        jacobian = np.zeros((len(self.data), len(self.coordinates.places)))
        row = 0
        for k, each in enumerate(found):
            rows = slice(row, row + len(each.model))
            jacobian[rows, self.coordinates.columns(k)] = each.derivatives
            row = rows.stop
        return jacobian

    def _without_gaps(
        self, u: np.ndarray, residuals: np.ndarray, jacobian: np.ndarray, found: list[Evaluation]
    ) -> np.ndarray:
        """The Jacobian with differences of runs in the places in which derivatives are nan."""
        missing = ~np.isfinite(jacobian)
        for column in np.flatnonzero(missing.any(axis=0)):
            label = self.coordinates.labels[column]
            self.record.differences[label] += 1
            self.record.reasons |= dict.fromkeys(r for each in found for r in each.reasons)
            slope = self._difference(u, residuals, int(column))
            if slope is None:
                self.record.no_slope[label] += 1
                slope = np.zeros(len(residuals))
            rows = missing[:, column]
            jacobian[rows, column] = slope[rows]
        return jacobian

    def _difference(self, u: np.ndarray, residuals: np.ndarray, column: int) -> np.ndarray | None:
        # A step of log p is a relative one.
        scale = 1.0 if self.coordinates.log[column] else float(u[column])
        bounds = (float(self.coordinates.lower[column]), float(self.coordinates.upper[column]))
        step = step_of(scale, self.rtol)
        return difference(self.predicted, u, residuals, column, step, bounds)

    def predicted(self, u: np.ndarray) -> np.ndarray | None:
        """The residuals at `u` by runs without derivatives; None if a run fails."""
        values = self.coordinates.outer(u)
        try:
            found = [
                trial.predict(self.coordinates.of_run(values, k))
                for k, trial in enumerate(self.trials)
            ]
        except RunFailed:
            return None
        moved: np.ndarray = (np.concatenate(found) - self.data) / self.sigma
        return moved if np.isfinite(moved).all() else None
