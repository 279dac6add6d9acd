"""f of `solve` as the callback of a block, and its first call, which checks what it returns."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np

from saltus.calling import refuse_writing
from saltus.errors import ModelError
from saltus.solving.form import Form, Names, chosen, require_numbers
from saltus.solving.named import Named

__all__ = ["checked", "flow_of", "one_column"]

Function = Callable[..., Any]


def one_column(f: Function) -> Function:
    """f(t, x) of one state from SciPy's f(t, x) of k states, the columns of x."""
    if not callable(f):
        return f  # which is refused

    def column(t: Any, x: Any, *args: Any, **named: Any) -> Any:
        found = f(t, x[:, None], *args, **named)
        require_numbers("f", found)
        return np.reshape(found, -1)

    return column


def flow_of(
    f: Function, form: Form, x0: np.ndarray, args: tuple[Any, ...], names: Names
) -> Function:
    """dx/ds of the engine's state as a callback."""
    if not callable(f):
        raise ModelError(f"solve: f: expected a function f(t, x), found {f!r}")
    if not _takes_out(f, len(args), names):
        return form.flow(f, args, names)
    size, kind = len(x0), complex if form.is_complex else float

    def in_place(time: float, state: Any, /, **given: Any) -> Any:
        out = np.zeros(size, kind)
        named = chosen(names, state, given)
        returned = f(form.time(time), form.state(state.continuous_state), out, *args, **named)
        if returned is not None:
            raise ModelError(
                f"solve: f takes one argument more than (t, x{', *args' if args else ''}), so it "
                "is called as f(t, x, out), to fill out and return nothing; it returned "
                f"{returned!r}. Is a parameter missing in "
                "args=(...) or parameters={...}?"
            )
        return form.rate(out)

    return in_place


def _takes_out(f: Function, extra: int, names: Names) -> bool:
    """Whether f needs one argument more than t, x, `args` and those it gets by name: the array to
    write to.
    """
    try:
        parameters = [
            each
            for name, each in inspect.signature(f).parameters.items()
            if name not in (names or ())
        ]
    except (TypeError, ValueError):  # written in C, of unknown signature
        return False
    positional = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    needed = sum(p.kind in positional and p.default is p.empty for p in parameters)
    taken = sum(p.kind in positional for p in parameters)
    if needed > 3 + extra or (
        taken < 2 + extra and all(p.kind is not p.VAR_POSITIONAL for p in parameters)
    ):
        arguments = ", ".join(map(str, parameters))
        raise ModelError(
            f"solve: f takes ({arguments}), but it is called with t, x and {extra} arguments of "
            "args; expected f(t, x, *args), or f(t, x, out, *args)"
        )
    return needed == 3 + extra


def checked(
    flow: Function, f: Function, begin: float, x0: np.ndarray, form: Form, named: Named
) -> Function:
    """Calls f once, so that the message about a wrong shape speaks of f and not of the engine."""
    state = form.flat(x0).copy()
    state.flags.writeable = False
    try:
        at = SimpleNamespace(continuous_state=state, mode=named.mode)
        returned = flow(form.time(begin), at, **named.parameters)
    except ValueError as error:
        refuse_writing(f"solve: {getattr(f, '__name__', 'f')}", error, error.__traceback__)
        raise
    entries = f"{x0.size} number{'s' * (x0.size != 1)}"
    require_numbers(f"{getattr(f, '__name__', 'f')}(t, x)", returned, entries)
    if np.iscomplexobj(returned) and not form.is_complex:
        raise ModelError(
            "solve: f returned complex numbers for a real x0; make x0 complex, such as "
            "np.array(x0, dtype=complex)"
        )
    found = (np.size(returned) // 2,) if form.is_complex else np.shape(returned)
    if found != x0.shape and math.prod(found) != x0.size:
        name = getattr(f, "__name__", "f")
        raise ModelError(
            f"solve: {name}(t, x) returned shape {found}, expected {x0.shape}, one number for each "
            f"of the {x0.size} entries of x0"
        )
    return flow
