"""The block behind `saltus.solve`: plain functions of (t, x) as the callbacks of a LeafSystem."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus._core import numbers
from saltus._wrapped import wrapping
from saltus.calling import refuse_writing
from saltus.errors import ModelError
from saltus.leaf_system import LeafSystem
from saltus.solving.guard import Guard
from saltus.solving.solution import BLOCK

__all__ = ["SolvedSystem", "arguments_of", "state_of", "times_of"]

Function = Callable[..., Any]


class SolvedSystem(LeafSystem):
    """dx/dt = f(t, x, *args) with guards; its output 'x' is the state.

    Every callback is a closure over the user's function and `args`, and does nothing but call it.
    """

    def __init__(
        self,
        f: Function,
        begin: float,
        x0: np.ndarray,
        args: tuple[Any, ...],
        guards: Sequence[Guard],
        jacobian: Function | ArrayLike | None,
        jacobian_sparsity: Any,
    ):
        super().__init__(name=BLOCK)
        self.fixed_jacobian = jacobian is not None and not callable(jacobian)
        self.declare_continuous_state(
            default_value=x0,
            ode=_checked(_flow(f, len(x0), args), f, begin, x0),
            **_derivatives(jacobian, jacobian_sparsity, len(x0), args),
        )
        self.declare_continuous_state_output(name="x")
        for number, guard in enumerate(guards):
            self._declare_guard(guard, guard.named(number), args)

    def _declare_guard(self, guard: Guard, name: str, args: tuple[Any, ...]) -> None:
        self.declare_zero_crossing(
            guard=_value(guard.guard, args),
            reset_map=None if guard.reset is None else _reset(guard.reset, name, args),
            name=name,
            direction=guard.engine_direction,
            terminal=bool(guard.terminal),
            max_count=guard.engine_count,
            zeno_tolerance=guard.zeno_tolerance,
            on_zeno=guard.on_zeno,
            at_start=guard.at_start,
        )


def _value(function: Function, args: tuple[Any, ...]) -> Function:
    return wrapping(function, lambda time, state: function(time, state.continuous_state, *args))


def _flow(f: Function, size: int, args: tuple[Any, ...]) -> Function:
    if not callable(f):
        raise ModelError(f"solve: f: expected a function f(t, x), found {f!r}")
    if not _takes_out(f, len(args)):
        return _value(f, args)

    def in_place(time: float, state: Any) -> Any:
        out = np.zeros(size)
        returned = f(time, state.continuous_state, out, *args)
        if returned is not None:
            raise ModelError(
                f"solve: f takes one argument more than (t, x{', *args' if args else ''}), so it "
                "is called as f(t, x, out), to fill out and return nothing; it returned "
                f"{returned!r}. Is a parameter missing in args=(...)?"
            )
        return out

    return wrapping(f, in_place)


def _takes_out(f: Function, extra: int) -> bool:
    """Whether f needs one argument more than t, x and `args`: one to write to."""
    try:
        parameters = inspect.signature(f).parameters.values()
    except (TypeError, ValueError):  # written in C, of unknown signature
        return False
    positional = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    needed = sum(p.kind in positional and p.default is p.empty for p in parameters)
    taken = sum(p.kind in positional for p in parameters)
    if needed > 3 + extra or (
        taken < 2 + extra and all(p.kind is not p.VAR_POSITIONAL for p in parameters)
    ):
        names = ", ".join(map(str, parameters))
        raise ModelError(
            f"solve: f takes ({names}), but it is called with t, x and {extra} arguments of args; "
            "expected f(t, x, *args), or f(t, x, out, *args)"
        )
    return needed == 3 + extra


def _checked(flow: Function, f: Function, begin: float, x0: np.ndarray) -> Function:
    """Calls f once, so that the message about a wrong shape speaks of f and not of the engine."""

    class Start:
        continuous_state = x0.copy()

    Start.continuous_state.flags.writeable = False
    try:
        returned = flow(begin, Start)
    except ValueError as error:
        refuse_writing(f"solve: {getattr(f, '__name__', 'f')}", error, error.__traceback__)
        raise
    found = np.shape(returned)
    if found != x0.shape and np.size(returned) != x0.size:
        name = getattr(f, "__name__", "f")
        raise ModelError(
            f"solve: {name}(t, x) returned shape {found}, expected {x0.shape}, one number for each "
            f"of the {x0.size} entries of x0"
        )
    return flow


@functools.lru_cache(maxsize=1024)
def _label(name: str) -> SimpleNamespace:
    """A name that a function mentions in messages only: so it is not read when it is traced, and
    functions that differ in it alone have one trace.
    """
    return SimpleNamespace(name=name)


def _reset(reset: Function, name: str, args: tuple[Any, ...]) -> Function:
    label = _label(name)

    def reset_map(time: float, state: Any) -> Any:
        after = reset(time, state.continuous_state.copy(), *args)
        if after is None:
            raise ModelError(
                f"solve: the reset of '{label.name}' returned None; return the new state"
            )
        return after

    return wrapping(reset, reset_map)


def _derivatives(jacobian: Any, sparsity: Any, size: int, args: tuple[Any, ...]) -> dict[str, Any]:
    """The Jacobian as arguments of `declare_continuous_state`. What SciPy takes: a function or a
    matrix, dense or sparse; the places of a sparse one are its sparsity.
    """
    if jacobian is None or callable(jacobian):
        function = None if jacobian is None else _value(jacobian, args)
        return {"jacobian": function, "jacobian_sparsity": sparsity}
    if hasattr(jacobian, "tocoo"):
        matrix = jacobian.tocoo(copy=True)
        matrix.sum_duplicates()
    else:
        matrix = np.array(numbers(jacobian, "solve: jacobian"))
    if matrix.shape != (size, size):
        raise ModelError(f"solve: jacobian: expected shape {(size, size)}, found {matrix.shape}")
    if not hasattr(matrix, "tocoo"):
        return {"jacobian": lambda time, state: matrix, "jacobian_sparsity": sparsity}
    if sparsity is not None:
        dense = matrix.toarray()
        return {"jacobian": lambda time, state: dense, "jacobian_sparsity": sparsity}
    values = np.array(matrix.data, dtype=float)
    return {
        "jacobian_sparsity": (matrix.row.tolist(), matrix.col.tolist()),
        "sparse_jacobian": lambda time, state: values,
    }


def state_of(x0: ArrayLike) -> np.ndarray:
    """The state at the beginning: a vector, or a number."""
    start = numbers(x0, "solve: x0")
    if start.ndim > 1:
        raise ModelError(f"solve: x0: expected shape (n,), found {start.shape}; flatten it")
    return np.array(start).reshape(-1)


def arguments_of(args: Any) -> tuple[Any, ...]:
    """The arguments as a tuple. A forgotten comma, args=(k), is an error with advice."""
    try:
        return tuple(args)
    except TypeError:
        raise ModelError(
            f"solve: args: expected a tuple, found {args!r}; for one argument write "
            f"args=({args!r},)"
        ) from None


def times_of(t_eval: ArrayLike, begin: float, end: float) -> list[float]:
    """[s] where rows are wanted."""
    try:
        times = np.array(t_eval, dtype=float)
    except (TypeError, ValueError):
        raise ModelError(f"solve: t_eval: expected times in seconds, found {t_eval!r}") from None
    if times.ndim != 1 or times.size == 0:
        raise ModelError(f"solve: t_eval: expected some times, found shape {times.shape}")
    if not (np.all(np.diff(times) > 0) and begin <= times[0] and times[-1] <= end):
        raise ModelError(
            f"solve: t_eval: expected increasing times within t_span, {begin:g} s to {end:g} s, "
            f"found {np.array2string(times, threshold=8)}"
        )
    return [float(t) for t in times]
