"""The operating point at the end of a search, with what limits it."""

from __future__ import annotations

import numpy as np

from saltus.errors import ModelError
from saltus.linearization import Linearization
from saltus.operating.judge import beside, crossed_guards, margin_of, undetermined
from saltus.operating.point import OperatingPoint
from saltus.operating.problem import Problem
from saltus.operating.search import Found
from saltus.operating.setting import Setting

__all__ = ["outcome"]

CLOSE = 1e-6
"""[of the unit of a value] the distance from a bound at which it is said to be there"""


def outcome(
    problem: Problem, found: Found, bounds: tuple[np.ndarray, np.ndarray]
) -> OperatingPoint:
    """The result of a search."""
    end, names = found.point, [place.name for place in problem.places]
    setting = problem.setting.put(problem.places, end.values)
    other = beside(problem, end, found.scales, bounds[1])
    rank, lost = undetermined(end, other, found.scales)
    at_bounds = [names[k] for k in _at_bounds(end.values, bounds, found.scales.unknowns)]
    crossed = crossed_guards(found.first, end)
    kink = _kink(problem, setting)
    notes = [
        f"the guard '{name}' has an effect and lies between the start (g = {before:g}) and this "
        f"point (g = {after:g}): a run that comes here leaves the mode"
        for name, before, after in crossed
    ]
    undecided = [names[k] for k in lost]
    if undecided:
        notes.append(f"the equations do not determine {', '.join(undecided)} (rank {rank})")
    return OperatingPoint(
        context=setting.context,
        values=dict(zip(names, end.values.tolist(), strict=True)),
        inputs=setting.inputs,
        residuals={t.name: float(r) for t, r in zip(problem.targets, end.residual, strict=True)},
        status=found.status,
        message="" if found.status == "converged" else _reason(problem, found, at_bounds),
        rank=rank,
        undetermined=tuple(undecided),
        at_bounds=tuple(at_bounds),
        crossed=tuple(name for name, _, _ in crossed),
        notes=(*notes, *([kink] if kink else [])),
        linearization=Linearization(end.matrices),
        smooth=not kink,
        margin=margin_of(end, other),
        evaluations=problem.evaluations,
    )


def _at_bounds(
    values: np.ndarray, bounds: tuple[np.ndarray, np.ndarray], units: np.ndarray
) -> np.ndarray:
    """The numbers of the values at a bound, which `least_squares` only comes close to."""
    near = np.minimum(np.abs(values - bounds[0]), np.abs(bounds[1] - values)) <= CLOSE * units
    return np.flatnonzero(near)


def _kink(problem: Problem, setting: Setting) -> str:
    """Why there is no linearisation at the point; empty if there is one."""
    try:
        problem.reader.at(setting, one_sided=False)
    except ModelError as error:
        return str(error).removeprefix("linearize: ")
    return ""


def _reason(problem: Problem, found: Found, at_bounds: list[str]) -> str:
    """Which equation does not hold, and what to do."""
    scaled = np.abs(found.point.residual) / found.scales.rows
    worst = int(np.argmax(scaled))
    target, time = problem.targets[worst], found.point.matrices.time
    wanted, value = target.value, target.value + found.point.residual[worst]
    text = f"t = {time} s: '{target.name}' is {value:.6g}, expected {wanted:.6g}"
    if found.status == "max_nfev":
        return f"{text}; the limit of evaluations was reached: give a larger max_nfev"
    held = f" with {', '.join(at_bounds)} at a bound" if at_bounds else ""
    failed = f"; an evaluation failed: {problem.failed}" if problem.failed else ""
    return (
        f"{text}; no step makes the residuals smaller{held}: free more values, widen bounds, or "
        f"begin elsewhere{failed}"
    )
