"""The block behind `saltus.solve`: plain functions of (t, x) as the callbacks of a LeafSystem."""

from __future__ import annotations

import functools
import inspect
import math
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
from saltus.solving.form import PLAIN, Form, Names, chosen, require_numbers
from saltus.solving.guard import Guard, functions_of
from saltus.solving.named import NONE, Named
from saltus.solving.solution import BLOCK

__all__ = ["SolvedSystem", "arguments_of", "state_of", "times_of"]

Function = Callable[..., Any]


class SolvedSystem(LeafSystem):
    """dx/dt = f(t, x, *args) with guards; its output 'x' is the state, in the engine's form.

    Every callback is a closure over the user's function and `args`, and does nothing but call it.
    """

    check: Callable[[], Function]
    """whether to call f once, see `_checked`"""

    def __init__(
        self,
        f: Function,
        begin: float,
        x0: np.ndarray,
        args: tuple[Any, ...],
        guards: Sequence[Guard],
        jacobian: Function | ArrayLike | None,
        jacobian_sparsity: Any,
        vectorized: bool,
        form: Form,
        named: Named = NONE,
    ):
        named.require_use([f, jacobian, *functions_of(guards)], len(args))
        super().__init__(name=BLOCK)
        self._form = form
        self._named = named
        for name, value in named.parameters.items():
            self.declare_dynamic_parameter(name, value)
        if named.mode is not None:
            self.declare_default_mode(named.mode)
        names = named.of(f)
        flow = _flow(_one_column(f) if vectorized else f, form, x0, args, names)
        self.check = functools.partial(_checked, flow, f, begin, x0, form, named)
        self.declare_continuous_state(
            default_value=form.flat(x0),
            ode=self._owned(f, self.check()),
            **_derivatives(jacobian, jacobian_sparsity, len(x0), form, args, named.of(jacobian)),
        )
        self.declare_continuous_state_output(name="x")
        for number, guard in enumerate(guards):
            self._declare_guard(guard, guard.named(number), args)

    def _declare_guard(self, guard: Guard, name: str, args: tuple[Any, ...]) -> None:
        value = self._form.value(guard.guard, args, self._named.of(guard.guard))
        self.declare_zero_crossing(
            guard=self._owned(guard.guard, value),
            reset_map=self._reset_of(guard.reset, name, args),
            name=name,
            direction=guard.engine_direction,
            terminal=bool(guard.terminal),
            max_count=guard.engine_count,
            zeno_tolerance=guard.zeno_tolerance,
            on_zeno=guard.on_zeno,
            at_start=guard.at_start,
            start_mode=guard.start_mode,
            end_mode=guard.end_mode,
            delay=self._number_of(guard.delay, args),
            priority=self._number_of(guard.priority, args),
            persistent=guard.persistent,
            initial_value=guard.initial_value,
            use_values_from_trigger_time=guard.use_values_from_trigger_time,
        )

    def _number_of(self, given: Any, args: tuple[Any, ...]) -> Any:
        """A number, or a function of (t, x) as a callback."""
        if not callable(given):
            return given
        return self._owned(given, self._form.value(given, args, self._named.of(given)))

    def _reset_of(self, reset: Function | None, name: str, args: tuple[Any, ...]) -> Any:
        if reset is None:
            return None
        return self._owned(reset, _reset(reset, name, self._form, args, self._named.of(reset)))

    def _owned(self, owner: Function, function: Function) -> Function:
        """Traces are kept with the user's function unless it gets values by name."""
        return function if self._named else wrapping(owner, function)


def _one_column(f: Function) -> Function:
    """f(t, x) of one state from SciPy's f(t, x) of k states, the columns of x."""
    if not callable(f):
        return f  # which is refused

    def column(t: Any, x: Any, *args: Any, **named: Any) -> Any:
        found = f(t, x[:, None], *args, **named)
        require_numbers("f", found)
        return np.reshape(found, -1)

    return column


def _flow(f: Function, form: Form, x0: np.ndarray, args: tuple[Any, ...], names: Names) -> Function:
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


def _checked(
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


@functools.lru_cache(maxsize=1024)
def _label(name: str) -> SimpleNamespace:
    """A name that a function uses in messages only. It is not read when the function is traced, so
    functions that differ in it alone share a trace.
    """
    return SimpleNamespace(name=name)


def _reset(reset: Function, name: str, form: Form, args: tuple[Any, ...], names: Names) -> Function:
    label = _label(name)

    def reset_map(time: float, state: Any, /, **given: Any) -> Any:
        before = form.state(state.continuous_state.copy())
        after = reset(form.time(time), before, *args, **chosen(names, state, given))
        if after is None:
            raise ModelError(
                f"solve: the reset of '{label.name}' returned None; return the new state"
            )
        if not form.is_complex:
            return after
        require_numbers("the reset", after)
        return form.flat(after)

    return reset_map


def _derivatives(
    jacobian: Any,
    sparsity: Any,
    size: int,
    form: Form,
    args: tuple[Any, ...],
    names: Names,
) -> dict[str, Any]:
    """The Jacobian as arguments of `declare_continuous_state`. It takes what SciPy takes: a
    function or a matrix, dense or sparse. The entries of a sparse matrix are the sparsity.
    """
    places = form.places(sparsity)
    if jacobian is None:
        return {"jacobian": None, "jacobian_sparsity": places}
    if callable(jacobian):
        function = form.matrix(jacobian, args, size, names)
        function = function if names is not None else wrapping(jacobian, function)
        return {"jacobian": function, "jacobian_sparsity": places}
    sparse = hasattr(jacobian, "tocoo")
    given: Any = jacobian if sparse else _dense(jacobian)
    kind = given.dtype.kind
    if kind == "c" and not form.is_complex:
        raise ModelError("solve: jacobian: expected real numbers, as in x0, found complex ones")
    if given.shape != (size, size):
        raise ModelError(f"solve: jacobian: expected shape {(size, size)}, found {given.shape}")
    if sparse and sparsity is None and form == PLAIN:
        matrix = given.tocoo(copy=True)
        matrix.sum_duplicates()
        values = np.array(matrix.data, dtype=float)
        return {
            "jacobian_sparsity": (matrix.row.tolist(), matrix.col.tolist()),
            "sparse_jacobian": lambda time, state, /, **given: values,
        }
    dense = np.array(given.toarray() if sparse else given)
    dense = dense.astype(complex if form.is_complex else float)
    function = form.matrix(lambda t, x: dense, (), size)
    return {"jacobian": function, "jacobian_sparsity": places}


def _dense(jacobian: ArrayLike) -> np.ndarray:
    given = np.asarray(jacobian)
    return given if given.dtype.kind == "c" else np.array(numbers(jacobian, "solve: jacobian"))


def state_of(x0: ArrayLike) -> np.ndarray:
    """The state at the beginning: a vector, or a number; complex if one of its numbers is."""
    if isinstance(x0, (list, tuple)) and {float, int}.issuperset(map(type, x0)):
        start = np.array(x0, dtype=float)  # plain numbers, quickly
    else:
        start = np.array(x0) if _is_complex(x0) else np.array(numbers(x0, "solve: x0"))
    if start.ndim > 1:
        raise ModelError(f"solve: x0: expected shape (n,), found {start.shape}; flatten it")
    start = start.reshape(-1)
    if np.isfinite(start).all():
        return start
    for i in np.flatnonzero(~np.isfinite(start))[:1]:
        raise ModelError(
            f"solve: x0: entry {i} is {start[i]}; give a finite value. All components of the "
            "initial state `y0` must be finite."
        )
    return start


def _is_complex(x0: ArrayLike) -> bool:
    try:
        return np.array(x0).dtype.kind == "c"
    except ValueError:  # a ragged list, which is refused
        return False


def arguments_of(args: Any) -> tuple[Any, ...]:
    """The arguments as a tuple. A forgotten comma, args=(k), is an error with advice."""
    try:
        return () if args is None else tuple(args)
    except TypeError:
        raise _WrongKind(
            f"solve: args: expected a tuple, found {args!r}; for one argument write "
            f"args=({args!r},). Supplied 'args' cannot be unpacked."
        ) from None


class _WrongKind(ModelError, TypeError):
    """An error of the caller that Python, and SciPy, call a TypeError."""


def times_of(t_eval: ArrayLike, begin: float, end: float, form: Form) -> list[float]:
    """[s] The times of the wanted rows, as the engine counts time."""
    try:
        times = np.array(t_eval, dtype=float)
    except (TypeError, ValueError):
        raise ModelError(f"solve: t_eval: expected times in seconds, found {t_eval!r}") from None
    if times.ndim != 1 or times.size == 0:
        raise ModelError(f"solve: t_eval: expected some times, found shape {times.shape}")
    forward = form.time(times)
    within = form.time(begin) <= forward[0] and forward[-1] <= form.time(end)
    if not (within and np.all(np.diff(forward) > 0)):
        raise ModelError(
            f"solve: t_eval: expected {'decreasing' if form.backward else 'increasing'} times "
            f"within t_span, {begin:g} s to {end:g} s, found {np.array2string(times, threshold=8)}"
        )
    return [float(s) for s in forward]
