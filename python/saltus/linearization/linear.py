"""`Linearization`: the matrices of a linear system, with names, and what follows from them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus.errors import ModelError
from saltus.results.tables import extra

__all__ = ["Linearization"]


class Linearization:
    """dx/dt = f(x0, u0) + A (x - x0) + B (u - u0), y - y0 = C (x - x0) + D (u - u0).

    The time is fixed, and everything in `frozen` is constant.

    Examples
    --------
    >>> import saltus
    >>> lorenz = saltus.scene("lorenz").system
    >>> lin = saltus.linearize(lorenz)
    >>> lin.A.shape == (len(lin.states), len(lin.states))
    True
    >>> lin.method
    'exact'
    """

    def __init__(self, core: _core.Linearization):
        self.A: np.ndarray = core.A
        """df/dx: (state, state)"""
        self.B: np.ndarray = core.B
        """df/du: (state, input)"""
        self.C: np.ndarray = core.C
        """dy/dx: (output, state)"""
        self.D: np.ndarray = core.D
        """dy/du: (output, input)"""
        self.states: tuple[str, ...] = tuple(core.states)
        self.inputs: tuple[str, ...] = tuple(core.inputs)
        self.outputs: tuple[str, ...] = tuple(core.outputs)
        self.frozen: dict[str, float] = core.frozen
        """what a run may change and the matrices take as constant: entries of discrete states,
        modes, and the truths of relations, 0 or 1
        """
        self.guards: dict[str, float] = {name: value for name, value, _ in core.guards}
        """the values of the guards that can fire in the present mode"""
        self.method: str = core.method()
        """'exact', or the called functions that were differentiated by central differences"""
        self.time: float = core.time
        """[s]"""
        self.x: np.ndarray = core.x
        self.u: np.ndarray = core.u
        self.y: np.ndarray = core.y
        self.xdot: np.ndarray = core.xdot
        """f(x0, u0): zero at an equilibrium"""

    def poles(self) -> np.ndarray:
        """The eigenvalues of A [1/s], complex, by increasing real part.

        Examples
        --------
        >>> import saltus
        >>> from saltus.library import Integrator
        >>> saltus.linearize(Integrator(0.0), inputs={"in": 0.0}).poles()
        array([0.+0.j])
        """
        return np.sort_complex(np.linalg.eigvals(self.A))

    def step(self, t: ArrayLike) -> np.ndarray:
        """The response y(t) - y0 of each output to a step of each input by 1 at t = 0.

        It is exact: the exponential of [[A, B], [0, 0]] t (C. Van Loan, IEEE Trans. Autom. Control
        23 (1978) 395). The state begins at x0, and x0 counts as an equilibrium. Needs scipy.

        Parameters
        ----------
        t : array_like
            [s] Times of 0 or more that do not decrease.

        Returns
        -------
        ndarray
            (time, output, input)

        Raises
        ------
        ModelError
            For other times, and if there is no state, input or output.

        Examples
        --------
        >>> import saltus
        >>> from saltus.library import Integrator
        >>> saltus.linearize(Integrator(0.0), inputs={"in": 0.0}).step([1.0, 3.0])[:, 0, 0]
        array([1., 3.])
        """
        self._require_all("step")
        times = np.asarray(t, dtype=float)
        if times.ndim != 1 or not np.all(np.diff(times, prepend=0.0) >= 0.0):
            raise ModelError(f"step: expected times of 0 or more that do not decrease, found {t!r}")
        from saltus.linearization.step import step

        return step((self.A, self.B, self.C, self.D), times)

    def plot(
        self,
        inputs: Sequence[str] | None = None,
        outputs: Sequence[str] | None = None,
        *,
        t_end: float | None = None,
        axes: Any = None,
    ) -> Any:
        """Draws the poles beside the responses of outputs to steps of inputs by 1. Needs matplotlib
        and scipy.

        Parameters
        ----------
        inputs, outputs : list of str, optional
            Their names; by default all.
        t_end : float, optional
            [s] By default a time that shows the slowest motion.
        axes : two matplotlib Axes, optional
            By default those of a new figure.

        Returns
        -------
        (Axes, Axes)

        Raises
        ------
        ModelError
            For an unknown name, a time that is not positive, and if there is no state, input or
            output.

        Examples
        --------
        >>> import saltus
        >>> from saltus.library import Integrator
        >>> poles, response = saltus.linearize(Integrator(0.0), inputs={"in": 0.0}).plot()
        >>> response.get_xlabel()
        'time [s]'
        """
        from saltus.linearization.step import draw

        self._require_all("plot")
        return draw(self, inputs, outputs, t_end, axes)

    def to_scipy(self) -> Any:
        """A `scipy.signal.StateSpace` in continuous time. Needs scipy.

        Raises
        ------
        ModelError
            If there is no state, input or output.

        Examples
        --------
        >>> import saltus
        >>> from saltus.library import Integrator
        >>> lin = saltus.linearize(Integrator(0.0), inputs={"in": 0.0})
        >>> lin.to_scipy().B
        array([[1.]])
        """
        self._require_all("to_scipy")
        return extra("scipy.signal", "to_scipy").StateSpace(self.A, self.B, self.C, self.D)

    def to_control(self) -> Any:
        """A `control.StateSpace` with the names of states, inputs and outputs.

        It needs python-control: `pip install 'saltus[control]'`. A dot in a name becomes "_",
        because python-control refuses dots.

        Raises
        ------
        ModelError
            If there is no state, input or output.

        Examples
        --------
        >>> from saltus.library import Integrator
        >>> lin = saltus.linearize(Integrator(0.0), inputs={"in": 0.0})
        >>> lin.to_control().poles()  # doctest: +SKIP
        array([0.+0.j])
        """
        self._require_all("to_control")
        return extra("control", "to_control").ss(
            self.A,
            self.B,
            self.C,
            self.D,
            states=_plain(self.states),
            inputs=_plain(self.inputs),
            outputs=_plain(self.outputs),
        )

    def _require_all(self, where: str) -> None:
        for names, what in (
            (self.states, "continuous state"),
            (self.inputs, "input"),
            (self.outputs, "output"),
        ):
            if not names:
                raise ModelError(
                    f"{where}: the linearisation has no {what}; expected at least one state, "
                    "input and output; name them in linearize(..., inputs=, outputs=)"
                )

    def __repr__(self) -> str:
        def line(what: str, names: tuple[str, ...]) -> str:
            return f"  {what}: {', '.join(names) or 'none'}"

        lines = [
            f"linearisation at t = {self.time:g} s, {self.method}",
            line("states", self.states),
            line("inputs", self.inputs),
            line("outputs", self.outputs),
        ]
        if self.frozen:
            lines.append(f"  frozen: {', '.join(f'{k} = {v:g}' for k, v in self.frozen.items())}")
        return "\n".join(lines)


def _plain(names: tuple[str, ...]) -> list[str]:
    """The names without dots."""
    return [name.replace(".", "_") for name in names]
