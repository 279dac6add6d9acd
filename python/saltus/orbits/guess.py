"""`guess_period`: a first guess of the period of a smooth autonomous system."""

from __future__ import annotations

import numpy as np

from saltus import _core
from saltus.errors import SimulationError
from saltus.orbits.runs import Runs

__all__ = ["guess_period"]

LOOKS = 4000
"""values of a span that are looked at; its returns are at least some of them apart"""
NEAR = 0.1
"""a return to within this part of the size of the motion is one"""
FIRST = 4.0**-8
GROWTH = 4.0


def guess_period(runs: Runs, context: _core.Context, longest: float) -> tuple[_core.Context, float]:
    """A state and the time after which the run from it comes close to it again.

    Each span is looked at for the first time at which the state crosses the plane through its begin
    across the flow, in the direction of the flow and near the begin. The next span begins at the
    end of this one and is longer, so that a transient dies out.
    """
    begin, span = context.time, FIRST * longest
    while True:
        span = min(span, begin + longest - context.time)
        results = runs.plain(context, context.time + span, dense_output=True)
        times = np.linspace(context.time, context.time + span, LOOKS)
        found = _first_return(runs, context, times, results(times).continuous_state)
        if found is not None:
            return context, found
        context = results.context
        if context.time >= begin + longest * (1.0 - 1e-9):
            break
        span *= GROWTH
    raise SimulationError(
        f"{runs.where}: t = {context.time} s: the state came close to none of those that it had "
        f"before; expected a return within {longest} s: give a larger max_period, a start nearer "
        "to the orbit, a section, or the period of a driven system",
        context.time,
        results=results,
    )


def _first_return(
    runs: Runs, context: _core.Context, times: np.ndarray, states: np.ndarray
) -> float | None:
    flow = runs.flow(context)[: states.shape[1]]
    size = np.ptp(states, axis=0)
    used = (size > 1e-12 * np.abs(states).max(axis=0)) & (size > 0.0)
    if not used.any() or not flow[used].any():
        return None
    way = (states[:, used] - states[0, used]) / size[used]
    height = way @ (flow[used] / size[used])
    apart = np.linalg.norm(way, axis=1)
    left = int(np.argmax(apart > NEAR))  # the first look that is away from the begin
    crossed = (height[:-1] < 0.0) & (height[1:] >= 0.0) & (apart[1:] < NEAR)
    crossed[: left or len(crossed)] = False
    if not crossed.any():
        return None
    i = int(np.argmax(crossed))
    part = height[i] / (height[i] - height[i + 1])
    return float(times[i] + part * (times[i + 1] - times[i]) - times[0])
