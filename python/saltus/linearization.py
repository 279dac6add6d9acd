"""`linearize`: the linear system close to a context, with names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus._engine import core_context, ports_of
from saltus._signals import signals_in
from saltus.callbacks import Callbacks
from saltus.errors import InputNotConnectedError, ModelError
from saltus.results.tables import extra
from saltus.system import OutputPort, System

__all__ = ["Linearization", "linearize", "linearizer_of"]


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
        from saltus._step import step

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
        from saltus._step import draw

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


def linearize(
    system: System,
    context: _core.Context | None = None,
    *,
    inputs: Sequence[str] | Mapping[str, Any] = (),
    outputs: Mapping[str, OutputPort | str] | Sequence[str] | None = None,
    one_sided: bool = False,
    python: str = "traced",
) -> Linearization:
    """The matrices of dx/dt = f(x, u), y = h(x, u) at the values of a context.

    A = df/dx, B = df/du, C = dh/dx and D = dh/du, at a fixed time. Discrete states, modes, the
    truths of relations and sampled signals are constant.

    Derivatives are exact where functions are traced or formulas, by the chain rule over their
    expressions (A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed., SIAM 2008). A called
    function has central differences, with an error of about 1e-10 of the derivative.

    Parameters
    ----------
    system : System
        A block or a diagram.
    context : Context, optional
        The state x0; by default that of ``system.create_context()``.
    inputs : list of str, or dict of str to a value or None, optional
        Open inputs of the system by the names of their ports, and dynamic parameters by the names
        that `sensitivity` takes, "throttle.value". A vector is an input for each entry. An open
        input needs a value, here or by ``fix_value``; None keeps that of the context.
    outputs : list of str, or dict of str to OutputPort or str, optional
        Ports, or paths such as "car.engine.torque"; by default all outputs of the system.
    one_sided : bool
        At a kink: True takes the derivatives of the present side, False refuses.
    python : str
        "traced" or "called", as the option of `simulate`.

    Returns
    -------
    Linearization

    Raises
    ------
    ModelError
        If a name is unknown or an open input has no value, and where no linearisation exists: a
        guard with an effect is at zero, a relation is at its root and its sides differ, a block is
        at rest or keeps a history, a function has a kink, or a derivative is not finite.

    Examples
    --------
    >>> import saltus
    >>> class Pendulum(saltus.LeafSystem):
    ...     def __init__(self):
    ...         super().__init__(name="pendulum")
    ...         self.declare_input_port(name="torque")
    ...         self.declare_continuous_state([0.0, 0.0], names=["angle", "rate"], ode=self.ode)
    ...     def ode(self, t, s, torque):
    ...         angle, rate = s.continuous_state
    ...         return [rate, torque - 4.0 * np.sin(angle)]
    >>> import numpy as np
    >>> lin = saltus.linearize(Pendulum(), inputs={"torque": 0.0}, outputs=["angle"])
    >>> float(lin.A[1, 0])
    -4.0
    >>> lin.poles().imag
    array([-2.,  2.])
    """
    if not isinstance(system, System):
        raise ModelError(f"linearize: expected a system, found {system!r}")
    named = _named(inputs)
    own = {port.name: port for port in system.output_ports}
    signals = ports_of(own if outputs is None else signals_in(system, outputs))
    at = core_context(system.create_context() if context is None else context)
    try:
        return Linearization(linearizer_of(system, named, signals, bool(one_sided), python).at(at))
    except InputNotConnectedError as error:
        open_ones = [name for name in system.input_names if name not in dict(named)]
        if not open_ones:
            raise
        given = ", ".join(f"'{name}': 0.0" for name in open_ones)
        said = f"{str(error).partition(';')[0]}; linearize(..., inputs={{{given}}}) gives a value"
        raise InputNotConnectedError(said) from None


def _named(inputs: Any) -> list[tuple[str, Any]]:
    if isinstance(inputs, Mapping):
        named = list(inputs.items())
    elif isinstance(inputs, Sequence) and not isinstance(inputs, str):
        named = [(name, None) for name in inputs]
    else:
        named = [(None, None)]  # refused below
    for name, _ in named:
        if not isinstance(name, str):
            raise ModelError(
                "linearize: inputs: expected a list of names, or a dict of names with values, "
                f"found {inputs!r}"
            )
    return named


def linearizer_of(
    system: System,
    inputs: list[tuple[str, Any]],
    outputs: list[tuple[str, System, int]],
    one_sided: bool,
    python: str,
) -> _core.Linearizer:
    """Traces the functions anew: an input that is given a value may have another shape."""
    if python not in ("traced", "called"):
        hint = _core.known_names(str(python), ["traced", "called"])
        raise ModelError(f"option python: unknown '{python}'{hint}")
    if python == "called":
        return _core.Linearizer(system, inputs, outputs, one_sided, None)
    callbacks = Callbacks(system)
    made = _core.Linearizer(system, inputs, outputs, one_sided, callbacks)
    if callbacks.settle():
        made = _core.Linearizer(system, inputs, outputs, one_sided, callbacks)
    return made
