"""`PeriodicOrbit`: what `periodic_orbit` returns."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, overload

import numpy as np

from saltus import _core
from saltus._core import known_names
from saltus.errors import ModelError, SimulationError
from saltus.orbits.pictures import draw_orbit
from saltus.results import Results

__all__ = ["PeriodicOrbit"]

MARGIN = 1e-4
"""the distance from the unit circle that has no sign: a double multiplier, as of a conservative
system, has an error of the square root of that of the derivatives, near 1e-9
"""


@dataclass(frozen=True, eq=False)
class PeriodicOrbit:
    """A state that returns to itself, the time that this takes, and its stability.

    Examples
    --------
    >>> import saltus
    >>> wheel = saltus.scene("rimless-wheel")
    >>> orbit = saltus.periodic_orbit(wheel.system, wheel.context, "wheel.spoke")
    >>> orbit.status, orbit.stable, orbit.multipliers.round(6)
    ('converged', True, array([0.5+0.j]))
    """

    context: _core.Context
    """the values at the start of the orbit: just after the firing of the section"""
    x0: np.ndarray
    """(n,) its continuous states, in the order of the context"""
    names: tuple[str, ...]
    """(n,) their names, 'x[0]' or 'ball.x[0]'"""
    period: float
    """[s]"""
    multipliers: np.ndarray
    """(m,) the Floquet multipliers, complex, the largest first: the eigenvalues of the derivative
    of the return, through all events. Of an autonomous system the trivial one, 1 along the flow, is
    left out. nan if the search did not converge
    """
    trivial: float
    """the trivial multiplier as it was computed, for comparison with 1; nan for a driven system"""
    monodromy: np.ndarray
    """(k, k) the derivatives of the state after one period by the state at the start, at a fixed
    time. The states are the continuous ones, then the discrete ones that are numbers
    """
    return_map: np.ndarray
    """(k, k) those at the moving time of the return to the section, for which the flow is a null
    vector; `monodromy` if there is no section
    """
    residual: float
    """the largest entry of |P(x) - x|"""
    status: str
    """'converged', 'max_iterations' or 'stalled'"""
    message: str
    """the reason for any status but the first"""
    iterations: int
    """Newton steps"""
    notes: tuple[str, ...]
    """what a check found that limits the result"""
    results: Results
    """one period from `context`, with dense output. The firing that ends it may come a
    rounding later
    """
    parameters: tuple[str, ...]
    """the names given as `wrt`; a vector has a name for each entry"""
    _by: Any = field(repr=False)

    @property
    def stable(self) -> bool | None:
        """Whether all multipliers are inside the unit circle. None if the search did not converge,
        or if the largest is so close to the circle that its error decides.
        """
        if self.status != "converged":
            return None
        largest = float(np.max(np.abs(self.multipliers), initial=0.0))
        return None if abs(largest - 1.0) <= MARGIN else largest < 1.0

    @overload
    def dperiod(self, wrt: str) -> float: ...
    @overload
    def dperiod(self, wrt: None = None) -> np.ndarray: ...
    def dperiod(self, wrt: str | None = None) -> float | np.ndarray:
        """The derivative of the period by a parameter, or by all of `wrt`.

        By the implicit function theorem: the orbit of P(x, p) = x moves by (1 - P_x)^-1 P_p. For a
        driven system it is 0: its period is given.

        Parameters
        ----------
        wrt : str, optional
            One of `parameters`.

        Returns
        -------
        float or ndarray
            [s per unit of the parameter] A number, or without a name (parameters,).

        Raises
        ------
        ModelError
            For a name that was not in `wrt`, and a parameter that changes the period of a drive.
        SimulationError
            If there is no orbit, or one that is not isolated, or where a derivative does not exist.

        Examples
        --------
        >>> import saltus
        >>> oscillator = saltus.system_of(
        ...     lambda t, x, w: [x[1] + x[0] * (1 - x[0]**2 - (x[1] / w) ** 2), -(w**2) * x[0]],
        ...     [1.0, 0.0], parameters={"w": 2.0},
        ... )
        >>> orbit = saltus.periodic_orbit(oscillator, max_period=100.0, wrt=["w"])
        >>> bool(orbit.dperiod("w") < 0)  # it turns faster
        True
        """
        found = self._derivative(1, wrt)
        return found if wrt is None else float(found)

    def dx0(self, wrt: str | None = None) -> np.ndarray:
        """The derivative of `x0` by a parameter, or by all of `wrt`.

        Of an orbit without a section x0 may be any of its points; it moves across the flow.

        Parameters
        ----------
        wrt : str, optional
            One of `parameters`.

        Returns
        -------
        ndarray
            (n,) or, without a name, (n, parameters).

        Raises
        ------
        ModelError, SimulationError
            As `dperiod` does.

        Examples
        --------
        >>> import saltus
        >>> cooler = saltus.system_of(lambda t, x, k: [k - x[0]], [1.0], parameters={"k": 3.0})
        >>> saltus.periodic_orbit(cooler, period=2.0, wrt=["k"]).dx0("k").round(6)
        array([1.])
        """
        return self._derivative(0, wrt)

    def _derivative(self, which: int, wrt: str | None) -> np.ndarray:
        if self.status != "converged":
            raise SimulationError(
                f"periodic_orbit: no orbit was found (status '{self.status}': {self.message}), so "
                "it has no derivative",
                self.context.time,
            )
        if wrt is not None and wrt not in self.parameters:
            hint = known_names(str(wrt), list(self.parameters))
            raise ModelError(f"{wrt!r} was not among the parameters of wrt=[...]{hint}")
        found: np.ndarray = self._by()[which]
        return found if wrt is None else np.asarray(found[..., self.parameters.index(wrt)])

    def plot(self, x: str | int = 0, y: str | int = 1, ax: Any = None, **style: Any) -> Any:
        """Draws the orbit in the plane of two states, or over time if there is one state. Needs
        matplotlib.

        A jump is a dashed line, the start a filled marker.

        Parameters
        ----------
        x, y : str or int
            Two states, by name or number.
        ax : matplotlib Axes, optional
            The axes to draw into; by default those of a new figure.
        **style
            Passed on to matplotlib's `plot`, such as ``color="k"``.

        Returns
        -------
        Axes

        Raises
        ------
        ModelError
            If there is no such state.

        Examples
        --------
        >>> import saltus
        >>> wheel = saltus.scene("rimless-wheel")
        >>> axes = saltus.periodic_orbit(wheel.system, wheel.context, "wheel.spoke").plot()
        >>> axes.get_xlabel()
        'x[0]'
        """
        return draw_orbit(self.results, self.names, (x, y), ax, style)

    def __repr__(self) -> str:
        kind = {True: "stable", False: "unstable", None: "stability undecided"}[self.stable]
        lines = [f"periodic orbit: {self.status} after {self.iterations} Newton steps, {kind}"]
        lines += [f"  period {self.period} s, residual {self.residual:.1e}"]
        lines += [f"  {name} = {value}" for name, value in zip(self.names, self.x0, strict=True)]
        lines += [f"  multiplier {m:.6g}, |.| = {abs(m):.6g}" for m in self.multipliers[:8]]
        lines += [f"  {text}" for text in (self.message, *self.notes) if text]
        return "\n".join(lines)
