"""`LyapunovSpectrum`: what `lyapunov` returns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus import _core
from saltus.exponents.averages import dimension_of
from saltus.exponents.pictures import draw_history

__all__ = ["LyapunovSpectrum"]


@dataclass(frozen=True, eq=False, repr=False)
class LyapunovSpectrum:
    """The mean rates at which neighbouring states move apart, in n directions.

    Examples
    --------
    >>> import saltus
    >>> lag = saltus.system_of(lambda t, x: [-2.0 * x[0], -3.0 * x[1]], [1.0, 1.0])
    >>> found = saltus.lyapunov(lag, time=20.0)
    >>> found.exponents.round(3), found.converged, found.dimension
    (array([-2., -3.]), True, 0.0)
    """

    exponents: np.ndarray
    """(k,) [1/s] the largest first; -inf where an event leaves nothing of a direction"""
    errors: np.ndarray
    """(k,) [1/s] their standard errors, by batches of the time; inf with too few pieces"""
    converged: bool
    """whether each error is at most `tolerance` times the size of its exponent. One that may be
    zero (within two errors) has the smallest other one as its size; if all may be zero, 1 over the
    time
    """
    message: str
    """which exponent has not converged, and what to do; empty if all have"""
    begin: float
    """[s] the time from which the averages count"""
    times: np.ndarray
    """(pieces,) [s] the ends of the pieces that count"""
    history: np.ndarray
    """(pieces, k) [1/s] the averages up to these times"""
    states: tuple[str, ...]
    """(n,) continuous states, then discrete ones that are numbers"""
    frozen: dict[str, float]
    """the discrete states that are labels, whole numbers on which nothing depends smoothly, and
    their values at the end
    """
    context: _core.Context
    """the values at the end, from which a longer run can go on"""

    @property
    def sum(self) -> float:
        """[1/s] The mean rate at which a volume of states grows: of a smooth flow the mean of its
        divergence, plus ln |det S| for each jump S in that time. Of the first k directions only, if
        `count` was given.
        """
        return float(np.sum(self.exponents))

    @property
    def dimension(self) -> float:
        """The Kaplan-Yorke dimension of the attractor, k + (l_1 + ... + l_k) / |l_(k+1)|, with the
        largest k for which the sum is not negative. An exponent within two standard errors of zero
        counts as zero. A lower bound, if `count` was given and the sum of all is not negative.
        """
        return dimension_of(self.exponents, self.errors)

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draws the averages over time, and bands of two standard errors. Needs matplotlib.

        Exponents of -inf are left out.

        Parameters
        ----------
        ax : matplotlib Axes, optional
            The axes to draw into; by default those of a new figure.
        **style
            Passed on to matplotlib's `plot`, such as ``linewidth=2``.

        Returns
        -------
        Axes

        Examples
        --------
        >>> import saltus
        >>> lag = saltus.system_of(lambda t, x: [-2.0 * x[0]], [1.0])
        >>> saltus.lyapunov(lag, time=20.0).plot().get_ylabel()
        'exponents [1/s]'
        """
        return draw_history(self.times, self.history, self.errors, ax, style)

    def __repr__(self) -> str:
        kind = "converged" if self.converged else "not converged"
        lines = [f"Lyapunov exponents to t = {self.context.time:g} s: {kind}"]
        pairs = list(zip(self.exponents, self.errors, strict=True))
        lines += [f"  {value:.6g} +- {error:.1e} 1/s" for value, error in pairs[:8]]
        lines += [f"  ... and {len(pairs) - 8} more"] if len(pairs) > 8 else []
        lines += [f"  sum {self.sum:.8g} 1/s, dimension {self.dimension:.4g}"]
        return "\n".join(lines + ([f"  {self.message}"] if self.message else []))
