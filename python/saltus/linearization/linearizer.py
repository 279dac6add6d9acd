"""`linearize`: the derivatives of a system at a context."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from saltus import _core
from saltus._engine import core_context, ports_of
from saltus._signals import signals_in
from saltus.callbacks import Callbacks
from saltus.errors import InputNotConnectedError, ModelError
from saltus.linearization.linear import Linearization
from saltus.system import OutputPort, System

__all__ = ["linearize", "linearizer_of"]


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
