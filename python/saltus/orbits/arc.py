"""`Arc`: one run from a start to its return, with its derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from saltus import _core
from saltus.errors import SimulationError
from saltus.orbits.states import States
from saltus.results import Results

__all__ = ["Arc", "derivatives_of", "refuse_gap"]


@dataclass(frozen=True)
class Arc:
    """From the start s to its return P(s), for n states (continuous ones, then discrete ones) and p
    parameters.
    """

    start: np.ndarray
    """(n,) s"""
    end: np.ndarray
    """(n,) P(s)"""
    period: float
    """[s] the time of the return"""
    monodromy: np.ndarray
    """(n, n) the derivatives of the end by the start, at a fixed time"""
    by_start: np.ndarray
    """(n, n) those of P(s), at the moving time of the return"""
    by_parameters: np.ndarray
    """(n, p) those of P(s) by parameters"""
    period_by_start: np.ndarray
    """(n,) those of the period"""
    period_by_parameters: np.ndarray
    """(p,)"""
    flow_start: np.ndarray
    """(n,) f at the start"""
    flow_end: np.ndarray
    """(n,) f at the end"""
    begin: _core.Context
    final: _core.Context
    parameters: tuple[str, ...]
    results: Results

    def unreturned(self, states: States, labels: np.ndarray) -> str:
        """The first mode or label that has another value at the end, in words; empty if all are as
        they were.
        """
        for block, old, new in zip(states.blocks, self.begin.modes, self.final.modes, strict=True):
            if old != new:
                return f"the mode of '{block}' did not return: it went from {old} to {new}"
        for i in np.flatnonzero(labels):
            if self.start[i] != self.end[i]:
                return (
                    f"the discrete state '{states.names[i]}' did not return: it went from "
                    f"{self.start[i]:g} to {self.end[i]:g}"
                )
        return ""


def derivatives_of(results: Results) -> np.ndarray:
    """(n, names) of the final context at a fixed time: continuous states, then discrete ones."""
    found = results.sensitivities
    return np.vstack([found.continuous_state, found.discrete_state])


def refuse_gap(where: str, results: Results, names: Sequence[str], values: np.ndarray) -> None:
    """Raises SimulationError if a derivative by one of the names is nan, with its event and time.

    `values` has these names along its last axis.
    """
    lost = np.flatnonzero(~np.isfinite(values.reshape(-1, len(names))).all(axis=0))
    if not lost.size:
        return
    name = names[lost[0]]
    gaps = [gap for gap in results.sensitivity_gaps if gap.parameter == name]
    at = gaps[0].time if gaps else results.context.time
    event = f" at the event '{gaps[0].event}'" if gaps and gaps[0].event else ""
    reason = gaps[0].reason if gaps else "the derivative is not finite"
    raise SimulationError(
        f"{where}: t = {at} s: there is no derivative by '{name}'{event}: {reason}; start "
        "elsewhere, or see docs/derivatives.md for what has none",
        at,
        results=results,
    )
