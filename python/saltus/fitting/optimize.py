"""`Optimizer`: `least_squares` from one start after the other."""

from __future__ import annotations

import functools
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from saltus.errors import ModelError, SimulationError
from saltus.fitting.jumps import meets_jump
from saltus.fitting.problem import Point, Problem
from saltus.fitting.progress import FitProgress, Shown
from saltus.fitting.result import FitResult, Start
from saltus.fitting.trial import Stopped
from saltus.fitting.uncertainty import slopes_of

__all__ = ["Ended", "Optimizer"]


class _Flat(Exception):
    """The gradient of the cost is exactly zero at these numbers of the optimizer."""

    def __init__(self, w: np.ndarray):
        super().__init__()
        self.w = w


class Ended(NamedTuple):
    """How the best start ended."""

    point: Point
    cost: float
    status: str
    message: str
    starts: tuple[Start, ...]
    wall_time: float


class Optimizer:
    """Runs of `scipy.optimize.least_squares` on one problem."""

    def __init__(
        self,
        problem: Problem,
        least_squares: Callable[..., Any],
        settings: dict[str, Any],
        shown: Shown,
        interrupt: Callable[[], bool] | None = None,
    ):
        self.problem, self.least_squares, self.settings = problem, least_squares, settings
        self.shown, self.interrupt = shown, interrupt
        self._ended: list[tuple[Start, Point | None]] = []
        self._begun = time.perf_counter()
        self._count = 1

    def run(self, starts: list[np.ndarray], result: Callable[[Ended], FitResult]) -> FitResult:
        """The best of all starts. After Ctrl-C the exception has the best point so far."""
        self._count = len(starts)
        self.problem.seen = self._seen
        try:
            for u in starts:
                self._ended.append(self._from(u))
            self.shown(self._now, last=True)
        except Stopped as error:
            return self._interrupted(str(error), result, error)
        except KeyboardInterrupt as error:
            error.results = self._interrupted("Ctrl-C", result, error)  # type: ignore[attr-defined]
            error.args = ("the fit was interrupted; its attribute results has the best values",)
            raise
        finally:
            self.problem.seen = lambda point: None
        best = self._best()
        if best is None:
            raise self._failure()
        start, point = best
        assert point is not None
        return result(self._as_ended(point, start.cost, start.status, start.message))

    def _seen(self, point: Point | None) -> None:
        """After each evaluation."""
        self.shown(self._now)
        if self.interrupt is not None and self.interrupt():
            raise Stopped("the option interrupt has ended the fit")

    def _from(self, u: np.ndarray) -> tuple[Start, Point | None]:
        """One start; without a point if its first run fails."""
        problem, before = self.problem, self.problem.record.evaluations
        if problem.at(u) is None:
            assert problem.failed is not None
            return self._start(u, u, np.inf, "failed", str(problem.failed), before), None
        found, end = self._minimized(u)
        point = problem.at(end)
        assert point is not None  # the optimizer was there
        status, message = self._status(found, point)
        return self._start(u, end, float(found.cost), status, message, before), point

    def _minimized(self, u: np.ndarray) -> tuple[Any, np.ndarray]:
        """The outcome of `least_squares`, and where it ended.

        It gets numbers near 1, because its xtol compares the step with the length of all of them:
        beside a parameter of 1e6 one of 1e-3 would never have to be found. Where the gradient is
        zero its trust region has no size, and its next step is nan: it is stopped there.
        """
        problem, places = self.problem, self.problem.coordinates
        scale = places.scale(u)

        def back(w: np.ndarray) -> np.ndarray:
            inside: np.ndarray = np.clip(w * scale, places.lower, places.upper)
            return inside

        def slopes(w: np.ndarray) -> np.ndarray:
            jacobian = problem.jacobian(back(w))
            if self._is_flat(jacobian, problem.residuals(back(w))):
                raise _Flat(w.copy())
            scaled: np.ndarray = jacobian * scale
            return scaled

        call = functools.partial(
            self.least_squares,
            lambda w: problem.residuals(back(w)),
            bounds=(places.lower / scale, places.upper / scale),
            x_scale="jac",
        )
        try:
            found = call(u / scale, jac=slopes, **self.settings)
        except _Flat as end:  # with one evaluation it takes no step
            jacobian = problem.jacobian(back(end.w)) * scale
            found = call(end.w, jac=lambda w: jacobian, **self.settings | {"max_nfev": 1})
        except (ValueError, TypeError) as error:  # a setting that makes no sense
            raise ModelError(f"fit: {error}") from error
        return found, back(found.x)

    def _is_flat(self, jacobian: np.ndarray, residuals: np.ndarray) -> bool:
        """Whether the gradient of the cost, with its loss, is exactly zero."""
        z = (residuals / self.settings["f_scale"]) ** 2
        weights = slopes_of(self.settings["loss"], z)[0]
        return not (jacobian.T @ (weights * residuals)).any()

    def _status(self, found: Any, point: Point) -> tuple[str, str]:
        """How `least_squares` ended, and why."""
        if not point.jacobian.any():
            return "stalled", (
                "no residual depends on a parameter there, so no step lowers the cost: the "
                "warnings say what is missing; give other start values, or other data"
            )
        if self._is_flat(point.jacobian, point.residuals):
            return "converged", "the gradient of the cost is zero"
        if found.status == 0:
            return "max_nfev", f"{found.nfev} evaluations were not enough; give max_nfev, or starts"
        if found.status == 3 and self._meets_jump(point):
            return "stalled", (
                "no shorter step lowers the cost, and its gradient is not zero: the cost jumps "
                "there, as where a sequence of events changes, or runs fail; give starts=..., or "
                "other data"
            )
        return "converged", str(found.message)

    def _meets_jump(self, point: Point) -> bool:
        """Whether the fit has ended at a jump of its cost."""
        problem, bounds = self.problem, self.problem.coordinates
        noise = problem.rtol * float(np.linalg.norm(problem.data / problem.sigma))
        limits = (bounds.lower, bounds.upper)
        return meets_jump(
            problem.predicted, point.u, point.residuals, point.jacobian, limits, noise
        )

    def _start(
        self, u: np.ndarray, end: np.ndarray, cost: float, status: str, message: str, before: int
    ) -> Start:
        evaluations = self.problem.record.evaluations - before
        return Start(self._named(u), self._named(end), cost, status, message, evaluations)

    def _named(self, u: np.ndarray) -> dict[str, float]:
        coordinates = self.problem.coordinates
        return dict(zip(coordinates.labels, coordinates.outer(u).tolist(), strict=True))

    def _best(self) -> tuple[Start, Point | None] | None:
        """The start with the least cost, a converged one if there is any."""
        found = [each for each in self._ended if each[1] is not None]
        return min(found, key=_rank, default=None)

    def _as_ended(self, point: Point, cost: float, status: str, message: str) -> Ended:
        starts = tuple(start for start, _ in self._ended)
        return Ended(point, cost, status, message, starts, time.perf_counter() - self._begun)

    def _interrupted(
        self, message: str, result: Callable[[Ended], FitResult], error: BaseException
    ) -> FitResult:
        """What there is. Raises `error` if that is nothing."""
        point = self.problem.best
        if point is None:
            raise error
        return result(self._as_ended(point, point.sum_of_squares / 2, "interrupted", message))

    def _failure(self) -> SimulationError:
        """The error if no start has given residuals."""
        failed = self.problem.failed
        assert failed is not None
        which = "the start values" if self._count == 1 else f"each of {self._count} starts"
        error = SimulationError(
            f"fit: the run with {which} failed: {self.problem.record.first_failure}; give other "
            "start values or bounds",
            float("nan") if failed.results is None else failed.results.context.time,
            "" if failed.results is None else failed.results.block,
            failed.results,
        )
        error.__cause__ = failed.__cause__
        return error

    def _now(self) -> FitProgress:
        record, best = self.problem.record, self.problem.best
        return FitProgress(
            record.evaluations,
            np.inf if best is None else best.sum_of_squares,
            {} if best is None else self._named(best.u),
            record.failures,
            min(len(self._ended), self._count - 1),
            self._count,
            time.perf_counter() - self._begun,
        )


def _rank(each: tuple[Start, Point | None]) -> tuple[bool, float]:
    """Converged starts before all others, then the least cost."""
    return each[0].status != "converged", each[0].cost
