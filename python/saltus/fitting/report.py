"""`result_of`: the point at which a fit ended, as a `FitResult` with its warnings."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from typing import Any

import numpy as np

from saltus.fitting.observed import EventSeries
from saltus.fitting.optimize import Ended
from saltus.fitting.problem import Point, Problem
from saltus.fitting.result import Compared, FitResult
from saltus.fitting.uncertainty import Uncertainty, uncertainty
from saltus.results import Results

__all__ = ["result_of"]


def result_of(
    problem: Problem, loss: Any, f_scale: float, absolute: bool, ended: Ended
) -> FitResult:
    """The result of a fit that ended, with its runs."""
    point, coordinates, record = ended.point, problem.coordinates, problem.record
    values = coordinates.outer(point.u)
    found = uncertainty(
        point.residuals,
        point.jacobian,
        rtol=problem.rtol,
        loss=loss,
        f_scale=f_scale,
        absolute=absolute,
    )
    slope = coordinates.slope(values)
    each = [coordinates.of_run(values, k) for k in range(len(problem.trials))]
    with np.errstate(invalid="ignore"):
        covariance = found.covariance * np.outer(slope, slope)
    free = float("inf") if absolute else len(point.residuals) - len(values)
    runs = tuple(t.show(v) for t, v in zip(problem.trials, each, strict=True))
    return FitResult(
        parameters=dict(zip(coordinates.labels, values.tolist(), strict=True)),
        covariance=covariance,
        residuals=point.residuals,
        jacobian=point.jacobian / slope,
        cost=ended.cost,
        status=ended.status,
        message=ended.message,
        warnings=(*_lacking(problem, runs), *_warnings(problem, point, found, absolute)),
        runs=runs,
        contexts=tuple(t.start(v) for t, v in zip(problem.trials, each, strict=True)),
        compared=_compared(problem, point),
        missing=sum(trial.missing for trial in problem.trials),
        evaluations=record.evaluations,
        failures=record.failures,
        first_failure=record.first_failure,
        starts=ended.starts,
        wall_time=ended.wall_time,
        _coordinates=coordinates,
        _quantile=functools.partial(_quantile, free),
        _covariance_inner=found.covariance,
    )


def _quantile(free: float, probability: float) -> float:
    """Of Student's distribution with `free` degrees of freedom, or of the normal one."""
    import scipy.special

    if free == float("inf"):
        return float(scipy.special.ndtri(probability))
    return float(scipy.special.stdtrit(max(free, 1), probability))


def _compared(problem: Problem, point: Point) -> tuple[Compared, ...]:
    """Data, model and residuals by experiment and name."""
    found, row = [], 0
    for trial in problem.trials:
        for each in trial.observed:
            residual = point.residuals[row : row + len(each.data)]
            row += len(each.data)
            found.append(
                Compared(
                    trial.bound.experiment.name,
                    each.name,
                    each.entry,
                    each.name in trial.bound.columns.events,
                    each.time,
                    each.data,
                    each.data + residual * each.sigma,
                    residual,
                )
            )
    return tuple(found)


def _lacking(problem: Problem, runs: Sequence[Results]) -> list[str]:
    """Which events of the data the runs do not have."""
    several = len(runs) > 1
    return [
        f"{trial.bound.experiment.name}: {said}" if several else said
        for trial, run in zip(problem.trials, runs, strict=True)
        for each in trial.observed
        if isinstance(each, EventSeries) and (said := each.lacking(run))
    ]


def _warnings(problem: Problem, point: Point, found: Uncertainty, absolute: bool) -> list[str]:
    """What to know before the values are used."""
    coordinates, record = problem.coordinates, problem.record
    said = []
    for group in found.undetermined:
        names = " and ".join(f"'{coordinates.labels[k]}'" for k in group)
        said.append(
            f"the data do not determine {names}; fix it in the context, or give other data"
            if len(group) == 1
            else f"the data determine a combination of {names} only; fix one of them"
        )
    if found.saddle:
        said.append("the loss has no minimum there, so there are no standard errors")
    if len(point.residuals) == len(point.u) and not absolute:
        said.append(
            "as many data as parameters: standard errors need sigma and absolute_sigma=True"
        )
    for k, label in enumerate(coordinates.labels):
        for bound in (coordinates.lower[k], coordinates.upper[k]):
            if np.isfinite(bound) and abs(point.u[k] - bound) <= 1e-6 * max(
                abs(bound), abs(point.u[k])
            ):
                said.append(f"'{label}' ended at a bound; its standard error does not count that")
    if record.failures:
        said.append(
            f"{record.failures} of {record.evaluations} evaluations failed; the first: "
            f"{record.first_failure}"
        )
    return said + _replaced(problem)


def _replaced(problem: Problem) -> list[str]:
    """Which derivatives come from differences of runs, and why."""
    record = problem.record
    if not record.differences:
        return []
    names = ", ".join(f"'{name}' ({count})" for name, count in record.differences.items())
    reasons = list(record.reasons)
    more = f", and {len(reasons) - 1} more" if len(reasons) > 1 else ""
    said = [
        f"differences of runs replace missing derivatives, by parameter (Jacobians): {names}; "
        f"{reasons[0] if reasons else 'they are nan'}{more}"
    ]
    if record.no_slope:
        lost = ", ".join(f"'{name}' ({count})" for name, count in record.no_slope.items())
        said.append(f"those runs failed too, and derivatives were taken as 0, by: {lost}")
    return said
