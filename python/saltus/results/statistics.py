"""The counts of a run."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Statistics"]


@dataclass(frozen=True)
class Statistics:
    """Counts, summed over the whole run.

    Examples
    --------
    >>> import saltus
    >>> solution = saltus.solve(lambda t, x: -x, (0, 1), [1.0])
    >>> solution.statistics.steps == solution.stats.steps > 0
    True
    """

    method: str
    """the method that was used; with 'auto' when and why it changed, with 'adams' and 'bdf' a note
    where errors may add up beside a fast oscillation"""
    stretches: list[tuple[str, float, float, int]]
    """the method of each stretch, as (method, begin [s], end [s], steps); only 'auto' has more than
    one
    """
    steps: int
    """accepted minor steps, which are those of the solver"""
    rejected: int
    """steps that were tried and not accepted"""
    restarts: int
    """the number of times the method had to begin anew"""
    right_hand_side_calls: int
    guard_calls: int
    """calls of all guards at once"""
    jacobian_calls: int
    linear_setups: int
    linear_solver: str
    """the linear solver of a stiff method, the size, and the reason; empty without a stiff method
    """
    instants: int
    """the start, the end, time events and events of guards with an effect, those of one time
    counted as one; the option `max_major_steps` bounds this number
    """
    events: int
    """resets, updates and mode changes"""
    events_by_name: dict[str, int]
    """how often each event happened: ``{"ball.bounce": 6}``"""
    wall_time: float
    """[s]"""
