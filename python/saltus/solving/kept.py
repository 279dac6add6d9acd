"""Systems of `solve` that are kept, with traces and plans, for the next equal call.

A system refers to the functions it was made of, and these may refer to it. So one of the functions
keeps it, as an attribute, where the garbage collector sees the circle: they are freed together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from types import FunctionType
from typing import Any

import numpy as np

from saltus.callbacks import Callbacks
from saltus.solving.form import Form
from saltus.solving.guard import Guard, functions_of
from saltus.solving.solved_system import SolvedSystem

__all__ = ["Call", "call_of", "find", "keep"]

SYSTEMS = "__saltus_systems__"
MOST = 4  # systems that a function keeps
LARGEST = 1000  # entries of an array in `args`: a system keeps it alive
PLAIN = (bool, int, str, type(None))
REDIRECTED = {"__wrapped__", "__signature__"}
"""attributes that change the arguments which a function shows"""


@dataclass(frozen=True)
class Call:
    """The arguments of which a call of `solve` makes its system."""

    owner: FunctionType
    """the function that keeps it"""
    key: tuple[Any, ...]
    """equal for calls that make the same; it has the identities of functions, which the system
    keeps alive
    """


@dataclass(frozen=True)
class Kept:
    """A system, and the data that tell whether it is still right."""

    key: tuple[Any, ...]
    system: SolvedSystem
    callbacks: Callbacks
    version: int


class Systems(list[Kept]):
    """The systems that a function keeps. A copy of the function has none."""

    def __init__(self, owner: int = 0):
        super().__init__()
        self.owner = owner  # functools.wraps gives a function the attributes of another function

    def __reduce__(self) -> tuple[Any, ...]:
        return Systems, ()


EMPTY = Systems()


def call_of(
    f: Any,
    begin: float,
    x0: np.ndarray,
    args: tuple[Any, ...],
    guards: Sequence[Guard],
    jacobian: Any,
    form: Form,
    others: tuple[Any, ...],
) -> Call | None:
    """The key of a call. None if its system is not kept: for methods and other callable objects, a
    matrix as the Jacobian, and objects or long arrays in `args`.
    """
    functions = [each for each in (f, jacobian, *functions_of(guards)) if each is not None]
    for function in functions:
        if type(function) is not FunctionType or not REDIRECTED.isdisjoint(vars(function)):
            return None
    values = [_exact(value) for guard in guards for value in _settings(guard)]
    values += [_exact(value) for value in args]
    if None in values:
        return None
    start = (begin.hex(), x0.dtype.str, x0.tobytes(), len(args), len(guards))
    places = tuple(map(id, (f, jacobian, *functions_of(guards))))
    return Call(_owner_of(functions), (places, start, tuple(values), id(form), others))


def _settings(guard: Guard) -> tuple[Any, ...]:
    """All values of a guard but its functions. A guard without a name has that of its function."""
    name = guard.name or guard.guard.__name__
    contact = (guard.zeno_tolerance, guard.on_zeno, guard.at_start)
    modes = (guard.start_mode, guard.end_mode)
    counts = (guard.terminal, guard.max_count)
    return (guard.direction, name, guard.name, *counts, *contact, *modes, *_queue(guard))


def _queue(guard: Guard) -> tuple[Any, ...]:
    """Those of the queue. A function is known by its identity."""
    numbers = (None if callable(each) else each for each in (guard.delay, guard.priority))
    return (*numbers, guard.persistent, guard.initial_value, guard.use_values_from_trigger_time)


def _exact(value: Any) -> Any:
    """A value's part of a key: equal only if all bits of the values are equal, which 0.0 and -0.0,
    or 1 and True, are not. None for a value that may change without being seen.
    """
    kind = type(value)
    if kind in PLAIN:
        return (kind, value)
    if kind is float or isinstance(value, np.floating):
        return (kind, value.tobytes() if kind is not float else value.hex())
    if kind is np.ndarray and value.size <= LARGEST and value.dtype != object:
        return (kind, id(value))  # its entries are watched
    return None


def _owner_of(functions: Sequence[FunctionType]) -> FunctionType:
    """The function that holds objects itself, if there is one: it lives no longer than they do."""
    return next((f for f in functions if _holds(f)), functions[0])


def _holds(f: FunctionType) -> bool:
    values = (*(f.__defaults__ or ()), *(f.__kwdefaults__ or {}).values())
    return bool(f.__closure__) or any(type(value) not in (*PLAIN, float) for value in values)


def find(call: Call) -> SolvedSystem | None:
    """The kept system, if nothing it was made from has changed."""
    systems: Systems = vars(call.owner).get(SYSTEMS, EMPTY)
    kept = next((one for one in systems if one.key == call.key), None)
    if kept is None or getattr(kept.system, "_callbacks", None) is not kept.callbacks:
        return None  # it has declared more
    if kept.callbacks.traces.stale or kept.callbacks.refresh() != kept.version:
        return None
    if not kept.callbacks.all_traced:
        kept.system.check()  # a called function may raise this time
    return kept.system


def keep(call: Call, system: SolvedSystem) -> None:
    """Remember a system that is ready to run, for `find`."""
    callbacks = getattr(system, "_callbacks", None)
    if not isinstance(callbacks, Callbacks):
        return  # all functions are called
    systems = vars(call.owner).get(SYSTEMS)
    if systems is None or systems.owner != id(call.owner):
        systems = Systems(id(call.owner))
        setattr(call.owner, SYSTEMS, systems)
    others = [one for one in systems if one.key != call.key]
    systems[:] = [Kept(call.key, system, callbacks, callbacks.version), *others[: MOST - 1]]
