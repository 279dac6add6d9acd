"""`check_derivatives`: declared derivatives against central differences."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from saltus import _core
from saltus._engine import core_context

if TYPE_CHECKING:
    from saltus.system import System

__all__ = ["WrongDerivative", "check_derivatives"]


class WrongDerivative(NamedTuple):
    """A declared derivative that differs from a central difference.

    Examples
    --------
    >>> import saltus
    >>> wrong = saltus.WrongDerivative("the derivative of block 'tank'", "k", 0, 1.0, -1.0)
    >>> wrong.declared - wrong.difference
    2.0
    """

    function: str
    """such as "the derivative of block 'ball'\""""
    by: str
    """'x[0]', 'g', 'input 0[2]' or 'time'"""
    row: int
    """of the numbers of the function; those of a reset map are x+, then z+"""
    declared: float
    """what the block says"""
    difference: float
    """nan where no difference was found"""


def check_derivatives(
    system: System, context: _core.Context | None = None, tolerance: float = 1e-6
) -> tuple[WrongDerivative, ...]:
    """The declared derivatives and Jacobians of all blocks that are wrong at one state.

    Each is compared with a central difference (docs/derivatives.md) at the values of the context,
    in its mode. It is right if it differs by at most `tolerance` times the largest entry of its
    row, or the size of the number itself.

    Parameters
    ----------
    system : System
        A block or a diagram.
    context : Context, optional
        By default ``system.create_context()``. A zero in it may hide an error: choose other values.
    tolerance : float
        [of the largest entry of a row]

    Returns
    -------
    tuple of WrongDerivative
        Empty if all are right there.

    Raises
    ------
    ModelError
        For a context of another system, and for derivatives of another shape than expected.
    SimulationError
        For a declared derivative that is not finite.

    Examples
    --------
    >>> import saltus
    >>> tank = saltus.LeafSystem(name="tank")
    >>> tank.declare_dynamic_parameter("k", 2.0)
    >>> tank.declare_continuous_state(
    ...     [3.0],
    ...     ode=lambda t, s, k: -k * s.continuous_state,
    ...     derivatives=lambda t, s, k: {"continuous_state": -k, "k": s.continuous_state},
    ... )
    >>> [(wrong.by, wrong.declared) for wrong in saltus.check_derivatives(tank)]
    [('k', 3.0)]
    """
    at = core_context(system.create_context() if context is None else context)
    found = _core.check_derivatives(system, at, tolerance)
    return tuple(WrongDerivative(*one) for one in found)
