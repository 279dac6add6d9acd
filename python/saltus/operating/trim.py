"""`trim`: a state at which rates and outputs have chosen values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from saltus import _core
from saltus.operating.point import OperatingPoint
from saltus.operating.question import question_of
from saltus.system import System

__all__ = ["trim"]


def trim(
    system: System,
    free: Sequence[str] | Mapping[str, Any] | None = None,
    *,
    hold: Sequence[str] | Mapping[str, Any] = (),
    derivatives: Sequence[str] | Mapping[str, float | None] = (),
    outputs: Mapping[str, Any] | None = None,
    context: _core.Context | None = None,
    tolerance: float = 1e-9,
    max_nfev: int | None = None,
    python: str = "traced",
) -> OperatingPoint:
    """Finds an operating point: 0 = f(x, u, p), or chosen derivatives and outputs.

    It solves f_i(v) = r_i for the rates and h_k(v) = y_k for the outputs, with the free values v
    within their bounds and everything else fixed, by `scipy.optimize.least_squares` (method 'trf':
    Branch, Coleman and Li, SIAM J. Sci. Comput. 21, 1999) and a few Newton steps. The Jacobian has
    the rows of A, B, C and D, as `linearize` computes them. Time, modes and discrete states stay.

    Parameters
    ----------
    system : System
        A block or a diagram.
    free : list of str, or dict, optional
        What may change: continuous states, open inputs and dynamic parameters, by the names of
        `sweep` and `linearize`; an entry of a vector is "u[1]". In a dict with a start value,
        bounds ``(lower, upper)``, a `Free` with both, or None. A start that is not given is that of
        the context, 0 of an open input, if it lies within the bounds, or else their middle. By
        default all continuous states that `hold` does not name.
    hold : dict of str to value, or list of str
        Values of states, parameters and open inputs that stay fixed; None, or a list, takes those
        of the context. An open input that is not free needs a value here or by ``fix_value``.
    derivatives : dict of str to float or None
        Wanted rates of states, where they are not 0 [unit of the state per s]; None, or a list,
        leaves a rate open.
    outputs : dict of str to value, optional
        Wanted values of output ports, by path; "y[1]" is an entry of a vector.
    context : Context, optional
        The other values; by default those of ``system.create_context()``.
    tolerance : float
        Converged means |r| <= tolerance |J| |v| for each residual r, with its derivatives J and the
        sizes |v| of the free values. The search goes on to the rounding.
    max_nfev : int, optional
        Evaluations of `least_squares` at most; by default 100 for each free value.
    python : str
        "traced" or "called", as the option of `simulate`.

    Returns
    -------
    OperatingPoint
        Also if the search does not converge; `status` says so, `message` why.

    Raises
    ------
    ModelError
        For an unknown name (the nearest one is named), a name that is free twice or free and held,
        an open input without a value, a value that is not finite at the start, a system without
        anything to solve for, a block that is at rest or keeps a history.
    ImportError
        If SciPy is not installed.

    Examples
    --------
    The level of a tank with a hole, q = a sqrt(2 g h):

    >>> import numpy as np
    >>> tank = saltus.system_of(
    ...     lambda t, h, q, a: [q - a * np.sqrt(2 * 9.81 * h[0])], [1.0],
    ...     parameters={"q": 0.02, "a": 0.005},
    ... )
    >>> point = saltus.trim(tank)
    >>> round(point.values["x[0]"], 6), round(0.02**2 / 0.005**2 / (2 * 9.81), 6)
    (0.815494, 0.815494)
    """
    question = question_of(
        "trim", system, free, hold, derivatives, outputs, context, python, tolerance, max_nfev
    )
    return question.answer(question.start)
