"""`PeriodMap`: what `period_map` returns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.results.tables import extra

__all__ = ["PeriodMap"]

MARGIN = 1e-4
"""the distance from the unit circle that has no sign: a double multiplier has an error of the
square root of that of the derivatives, near 1e-9
"""
CLOSED = 1e-6
"""[of the size of a state] a point that returns to itself within this is a fixed point"""


@dataclass(frozen=True, eq=False, repr=False)
class PeriodMap:
    """x[k+1] = x1 + Phi (x[k] - x0) + Gamma (u[k] - u0), y[k] = y + C (x[k] - x0) + D (u[k] - u0).

    Examples
    --------
    >>> lag = saltus.system_of(lambda t, x, u: [u - x[0]], [2.0], parameters={"u": 2.0})
    >>> found = saltus.period_map(lag, 0.5, inputs=["u"])
    >>> found.Phi.round(6), found.Gamma.round(6), found.stability
    (array([[0.606531]]), array([[0.393469]]), 'stable')
    """

    Phi: np.ndarray
    """dx[k+1]/dx[k]: (state, state)"""
    Gamma: np.ndarray
    """dx[k+1]/du: (state, input)"""
    C: np.ndarray
    """dy/dx: (output, state)"""
    D: np.ndarray
    """dy/du: (output, input)"""
    states: tuple[str, ...]
    """continuous states, then discrete ones that are numbers; one that keeps the time of an event
    is relative to the time, 'm.z[0] - t'
    """
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    x0: np.ndarray
    """(state,) at the start, after the instant there"""
    x1: np.ndarray
    """(state,) after one period"""
    y: np.ndarray
    """(output,) at the start"""
    frozen: dict[str, float]
    """the discrete states that are labels: whole numbers on which nothing depends smoothly, and
    those that nothing reads or writes
    """
    period: float
    """[s]"""
    context: _core.Context
    """the values at the start"""
    size: np.ndarray
    """(state,) the size of each state in the period"""

    @property
    def is_fixed_point(self) -> bool:
        """Whether the start returns to itself."""
        return bool(np.all(np.abs(self.x1 - self.x0) <= CLOSED * self.size))

    def multipliers(self) -> np.ndarray:
        """The eigenvalues of Phi, complex, the largest first.

        Examples
        --------
        >>> lag = saltus.system_of(lambda t, x: [-x[0]], [2.0])
        >>> saltus.period_map(lag, 0.5).multipliers().round(6)
        array([0.606531+0.j])
        """
        values = np.linalg.eigvals(self.Phi).astype(complex)
        return np.asarray(values[np.argsort(-np.abs(values), kind="stable")])

    @property
    def stability(self) -> str:
        """'stable' or 'unstable': all multipliers are inside the unit circle, or one is outside;
        'undecided' if the largest is so close to the circle that its error decides.
        """
        largest = float(np.max(np.abs(self.multipliers())))
        if abs(largest - 1.0) <= MARGIN:
            return "undecided"
        return "stable" if largest < 1.0 else "unstable"

    def to_scipy(self) -> Any:
        """A `scipy.signal.StateSpace` in discrete time, with dt = period. Needs scipy.

        Raises
        ------
        ModelError
            If there is no input.

        Examples
        --------
        >>> lag = saltus.system_of(lambda t, x, u: [u - x[0]], [2.0], parameters={"u": 2.0})
        >>> saltus.period_map(lag, 0.5, inputs=["u"]).to_scipy().dt
        0.5
        """
        if not self.inputs:
            raise ModelError(
                "to_scipy: the map has no input; expected one or more: name them in "
                "period_map(..., inputs=[...])"
            )
        signal = extra("scipy.signal", "to_scipy")
        return signal.StateSpace(self.Phi, self.Gamma, self.C, self.D, dt=self.period)

    def __repr__(self) -> str:
        def line(what: str, names: tuple[str, ...]) -> str:
            return f"  {what}: {', '.join(names) or 'none'}"

        point = "a fixed point" if self.is_fixed_point else "a moving state"
        lines = [
            f"map over {self.period:g} s from t = {self.context.time:g} s, at {point}, "
            f"{self.stability}",
            line("states", self.states),
            line("inputs", self.inputs),
            line("outputs", self.outputs),
        ]
        lines += [f"  multiplier {m:.6g}, |.| = {abs(m):.6g}" for m in self.multipliers()[:8]]
        if self.frozen:
            lines.append(f"  frozen: {', '.join(f'{k} = {v:g}' for k, v in self.frozen.items())}")
        return "\n".join(lines)
