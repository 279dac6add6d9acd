"""`Named`: the values that the functions of `solve` get by name, the parameters and the mode."""

from __future__ import annotations

import inspect
import operator
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from saltus._core import known_names, numbers
from saltus.errors import ModelError
from saltus.solving.form import Names
from saltus.solving.guard import Guard

__all__ = ["NONE", "Named", "named_of", "require_time_first"]

PLACED = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)


class Named:
    """Parameters by name, and the mode in which the run begins, if there are modes."""

    def __init__(self, parameters: Mapping[str, np.ndarray], mode: int | None):
        self.parameters = parameters
        self.mode = mode
        self._known = {*parameters, *([] if mode is None else ["mode"])}

    def __bool__(self) -> bool:
        return bool(self._known)

    def of(self, function: Any) -> Names:
        """The names that a function has arguments for; None if there are no names at all."""
        if not self._known:
            return None
        try:
            arguments = inspect.signature(function).parameters
        except (TypeError, ValueError):  # no function, or one of unknown signature
            return ()
        takes_all = any(each.kind is each.VAR_KEYWORD for each in arguments.values())
        return tuple(sorted(self._known if takes_all else self._known & set(arguments)))

    def require_use(self, functions: Sequence[Any], extra: int) -> None:
        """Raises ModelError for a parameter that no function takes, or that has the place of t, x
        or one of the `extra` arguments in `args`.
        """
        for function in functions:
            for name in _positional(function)[: 2 + extra]:
                if name in (self.of(function) or ()):
                    raise ModelError(
                        f"solve: '{name}' is one of the first {2 + extra} arguments of "
                        f"{getattr(function, '__name__', 'a function')}, which are t, x and those "
                        "of args; expected an argument after them, such as "
                        f"f(t, x, {'*args, ' if extra else ''}{name})"
                    )
        taken = {name for function in functions for name in self.of(function) or ()}
        for name in self.parameters:
            if name in taken:
                continue
            arguments = [
                argument for function in functions for argument in _positional(function)[2:]
            ]
            raise ModelError(
                f"solve: parameters: no function has an argument '{name}'"
                f"{known_names(name, arguments)}; expected f(t, x, {name})"
            )


NONE = Named({}, None)


def named_of(
    parameters: Mapping[str, Any] | None,
    mode: int | None,
    guards: Sequence[Guard],
    functions: Sequence[Any],
    extra: int,
) -> Named:
    """The named values from the arguments of `solve`. Guards with a mode, and functions with an
    argument `mode` after t, x and the `extra` arguments in `args`, make a run with modes, by
    default from mode 0.
    """
    if parameters is not None and not isinstance(parameters, Mapping):
        raise ModelError(
            f"solve: parameters: expected a dict of names and numbers, found {parameters!r}"
        )
    found = {
        _name_of(name): np.array(numbers(value, f"solve: parameter '{name}'"))
        for name, value in (parameters or {}).items()
    }
    if mode is None:
        moded = any(each.start_mode is not None or each.end_mode is not None for each in guards)
        moded = moded or any("mode" in _positional(each)[2 + extra :] for each in functions)
        return Named(found, 0 if moded else None) if found or moded else NONE
    try:
        return Named(found, operator.index(mode))
    except TypeError:
        raise ModelError(f"solve: mode: expected a whole number, found {mode!r}") from None


def _name_of(name: Any) -> str:
    if not isinstance(name, str) or not name.isidentifier() or name == "mode":
        raise ModelError(
            f"solve: parameters: expected the name of an argument other than 'mode', found {name!r}"
        )
    return name


def _positional(function: Any, *, follow_wrapped: bool = True) -> list[str]:
    """The names of a function's arguments that have a place."""
    try:
        found = inspect.signature(function, follow_wrapped=follow_wrapped)
        arguments = found.parameters.values()
    except (TypeError, ValueError):  # no function, or one of unknown signature
        return []
    return [each.name for each in arguments if each.kind in PLACED]


def require_time_first(functions: Sequence[Any]) -> None:
    """ModelError for a function whose arguments are called (x, t), as in `scipy.integrate.odeint`:
    it would get the time as its state.
    """
    for function in functions:
        # a wrapper of f(x, t) may exchange the arguments: only its own names count
        first = _positional(function, follow_wrapped=False)[:2]
        if len(first) == 2 and first[1] in ("t", "time") and first[0] in ("x", "y", "u", "state"):
            name = getattr(function, "__name__", "f")
            raise ModelError(
                f"solve: {name}({first[0]}, {first[1]}): expected the time first, and then the "
                f"state: write ({first[1]}, {first[0]}), as in scipy.integrate.solve_ivp"
            )
