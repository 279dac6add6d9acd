"""The block behind `saltus.solve`: plain functions of (t, x) as the callbacks of a LeafSystem."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus._wrapped import wrapping
from saltus.errors import ModelError
from saltus.leaf_system import LeafSystem
from saltus.solving.flow import checked, flow_of, one_column
from saltus.solving.form import Form, Names, chosen, require_numbers
from saltus.solving.guard import Guard, functions_of
from saltus.solving.jacobian import derivatives_of
from saltus.solving.named import NONE, Named, require_time_first
from saltus.solving.solution import BLOCK

__all__ = ["SolvedSystem"]

Function = Callable[..., Any]


class SolvedSystem(LeafSystem):
    """dx/dt = f(t, x, *args) with guards; its output 'x' is the state, in the engine's form.

    Every callback is a closure over the user's function and `args`, and does nothing but call it.
    """

    check: Callable[[], Function]
    """calls f once, and checks what it returns: `checked`"""

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
        functions = [f, jacobian, *functions_of(guards)]
        require_time_first(functions)
        named.require_use(functions, len(args))
        super().__init__(name=BLOCK)
        self._form = form
        self._named = named
        for name, value in named.parameters.items():
            self.declare_dynamic_parameter(name, value)
        if named.mode is not None:
            self.declare_default_mode(named.mode)
        names = named.of(f)
        flow = flow_of(one_column(f) if vectorized else f, form, x0, args, names)
        self.check = functools.partial(checked, flow, f, begin, x0, form, named)
        self.declare_continuous_state(
            default_value=form.flat(x0),
            ode=self._owned(f, self.check()),
            **derivatives_of(jacobian, jacobian_sparsity, len(x0), form, args, named.of(jacobian)),
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
