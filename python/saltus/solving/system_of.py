"""`system_of`: the system that `solve` runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from numpy.typing import ArrayLike

from saltus.errors import ModelError
from saltus.leaf_system import LeafSystem
from saltus.solving.arguments import arguments_of, state_of
from saltus.solving.form import form_of
from saltus.solving.guard import Guard, functions_of, guards_of
from saltus.solving.named import named_of
from saltus.solving.solved_system import SolvedSystem

__all__ = ["system_of"]


def system_of(
    f: Callable[..., ArrayLike | None],
    x0: ArrayLike,
    *,
    parameters: Mapping[str, Any] | None = None,
    events: Guard | Callable[..., Any] | Sequence[Guard | Callable[..., Any]] | None = None,
    args: Sequence[Any] | None = (),
    mode: int | None = None,
    jacobian: Callable[..., ArrayLike] | ArrayLike | None = None,
    jacobian_sparsity: Any = None,
    t0: float = 0.0,
) -> LeafSystem:
    """The block that `solve` makes of dx/dt = f(t, x), for `sweep`, `Simulator` and diagrams.

    Its state x starts at `x0`, its output 'x' is the state, its parameters are those of
    `parameters`; the other arguments are those of `solve`. `f` is called once, at `t0` [s].

    Raises
    ------
    ModelError
        If the input is bad, as for `solve`, or `x0` is complex, because a block has real states.

    Examples
    --------
    >>> import saltus
    >>> decay = saltus.system_of(lambda t, x, k: [-k * x[0]], [1.0], parameters={"k": 1.0})
    >>> runs = saltus.sweep(decay, {"k": [0.0, 1.0]}, (0, 1), as_dict=True)
    >>> runs["continuous_state"].round(3).tolist()
    [[1.0], [0.368]]
    """
    start = state_of(x0)
    if start.dtype.kind == "c":
        raise ModelError("system_of: x0: expected real numbers, found complex ones; use solve")
    guards = [] if events is None else guards_of(events)
    given = arguments_of(args)
    functions = [f, jacobian, *functions_of(guards)]
    named = named_of(parameters, mode, guards, functions, len(given))
    form = form_of(False, False)
    return SolvedSystem(
        f, t0, start, given, guards, jacobian, jacobian_sparsity, False, form, named
    )
