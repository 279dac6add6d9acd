"""`OperatingPoint`: what `trim` and `equilibria` return."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus import _core
from saltus.linearization import Linearization

__all__ = ["OperatingPoint"]


@dataclass(frozen=True, eq=False, repr=False)
class OperatingPoint:
    """The values at which rates and outputs are as they were wanted.

    Examples
    --------
    >>> import saltus
    >>> lorenz = saltus.scene("lorenz")
    >>> point = saltus.trim(lorenz.system, context=lorenz.context)
    >>> point.status, point.rank, point.stability
    ('converged', 3, 'unstable')
    """

    context: _core.Context
    """the context of the point, with the values that were found"""
    values: dict[str, float]
    """the values that were found, by the names in `free`"""
    inputs: dict[str, Any]
    """the open inputs that were free or held, by name: `linearize` takes them"""
    residuals: dict[str, float]
    """found - wanted: 'rate of angle' for the rate of a state, 'y' for an output"""
    status: str
    """'converged', 'max_nfev' (the limit of evaluations) or 'stalled' (no step made the residuals
    smaller)
    """
    message: str
    """the reason for any status but the first"""
    rank: int
    """of the derivatives of the residuals by the free values"""
    undetermined: tuple[str, ...]
    """the free values that the equations do not determine; empty at full rank"""
    at_bounds: tuple[str, ...]
    """the free values at one of their bounds"""
    crossed: tuple[str, ...]
    """the guards with an effect that lie between the start and this point: a run from the one to
    the other leaves the mode in which the point was found
    """
    notes: tuple[str, ...]
    """what limits the result, in words"""
    linearization: Linearization
    """the matrices at the point, by the free open inputs and parameters, those of the present side
    at a kink
    """
    smooth: bool
    """whether a linearisation exists there: False at a kink or at a guard, as a note says"""
    margin: float
    """[1/s] the error of the largest real part of a pole, by rounding and by the error of the point
    """
    evaluations: int

    @property
    def success(self) -> bool:
        """Whether the search has converged."""
        return self.status == "converged"

    @property
    def poles(self) -> np.ndarray:
        """The eigenvalues of A [1/s], complex, by increasing real part."""
        return self.linearization.poles()

    @property
    def stability(self) -> str:
        """'stable' or 'unstable', by the poles. 'undecided' if the search did not converge, there
        is no linearisation, or the largest real part is zero to its error (A. M. Lyapunov 1892: the
        linearisation decides only beside the imaginary axis). 'no states' without states.
        """
        if not len(self.linearization.states):
            return "no states"
        largest = float(np.max(self.poles.real))
        if not self.success or not self.smooth or abs(largest) <= self.margin:
            return "undecided"
        return "stable" if largest < 0.0 else "unstable"

    def __repr__(self) -> str:
        at = self.context.time
        lines = [f"operating point at t = {at:g} s: {self.status}, {self.stability}"]
        lines += [f"  {name} = {value:.10g}" for name, value in self.values.items()]
        largest = max(self.residuals, key=lambda name: abs(self.residuals[name]), default=None)
        if largest is not None:
            lines.append(f"  largest residual: {largest}, {self.residuals[largest]:.1e}")
        lines += [f"  pole {pole:.6g}" for pole in self.poles[:8]]
        lines += [f"  {text}" for text in (self.message, *self.notes) if text]
        return "\n".join(lines)
