"""`Guard`: an event of `saltus.solve`."""

from __future__ import annotations

import numbers
import operator
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from numpy.typing import ArrayLike

from saltus._core import known_names
from saltus._declarations import SHORT
from saltus.errors import ModelError

__all__ = ["Guard", "functions_of", "guards_of"]

DIRECTIONS = SHORT | {
    "crosses_zero": "crosses_zero",
    "positive_then_non_positive": "positive_then_non_positive",
    "negative_then_non_negative": "negative_then_non_negative",
    "edge_detection": "edge_detection",
    "none": "none",
}


@dataclass(frozen=True)
class Guard:
    """An event where ``guard(t, x, *args)`` becomes zero.

    Parameters
    ----------
    guard : callable
        A smooth number g(t, x, *args), in any unit; or a truth, positive where it is true.
    reset : callable, optional
        r(t, x, *args) returns the state after the event from `x`, a copy of that before it.
        Without it, and if it is not terminal, the event is only logged.
    direction : {'both', 'falling', 'rising'} or number
        'falling' means from above zero to zero, along the run. The engine's own names
        ('positive_then_non_positive', ...) and numbers with SciPy's signs are understood too.
    name : str, optional
        Its name in the event log and in messages; by default the function's, or 'event_0', ...
    terminal : bool or int, optional
        Whether it ends the run, after its reset; with a number n, when it happens the n-th time.
    max_count : int
        The same n, for ``terminal=True``.
    zeno_tolerance : float, optional
        [s] Overrides the option for this guard; 0 switches the monitor off.
    on_zeno : {'hold', 'stop', 'error'}
        The state after the time where events accumulate; see
        `LeafSystem.declare_zero_crossing`.
    at_start : {'auto', 'ignore', 'fire', 'error'}
        The effect of a guard that is zero at the beginning; see `LeafSystem.declare_zero_crossing`.
    start_mode, end_mode : int, optional
        The mode in which it can fire (by default all modes), and the mode after it. Functions
        with an argument `mode` get the present one.
    delay : number or callable, optional
        [s], >= 0, along the run: the event is queued, and its effect comes this much later. A
        function d(t, x, *args) is called where the guard fires.
    priority : number or callable, optional
        Of the effects that are due at one time that of the highest priority is first; see
        `LeafSystem.declare_zero_crossing`.
    persistent, initial_value, use_values_from_trigger_time : bool, optional
        Of a queued event: whether it has its effect though the guard went back, what the guard was
        before the beginning, and when the reset is computed; see the same.

    Raises
    ------
    ModelError
        If the direction is unknown, the guard or the reset cannot be called, or the delay or the
        priority is no number.

    Examples
    --------
    >>> import saltus
    >>> floor = saltus.Guard(lambda t, x: x[0], lambda t, x: [0, -0.5 * x[1]], "falling")
    >>> fall = lambda t, x: [x[1], -9.81]
    >>> saltus.solve(fall, (0, 10), [1.0, 0.0], events=floor).y[:, -1].tolist()
    [0.0, 0.0]
    """

    guard: Callable[..., ArrayLike]
    reset: Callable[..., ArrayLike] | None = None
    direction: str | float = "both"
    name: str | None = None
    terminal: bool | int | None = False
    max_count: int = 1
    zeno_tolerance: float | None = None
    on_zeno: str = "hold"
    at_start: str = "auto"
    start_mode: int | None = None
    end_mode: int | None = None
    delay: float | Callable[..., ArrayLike] | None = None
    priority: float | Callable[..., ArrayLike] | None = None
    persistent: bool | None = None
    initial_value: bool | None = None
    use_values_from_trigger_time: bool | None = None

    def __post_init__(self) -> None:
        for what, function in (("guard", self.guard), ("reset", self.reset)):
            if function is not None and not callable(function):
                raise ModelError(f"Guard: {what}: expected a function, found {function!r}")
        if self.guard is None:
            raise ModelError("Guard: guard: expected a function, found None")
        for what, value in (("delay", self.delay), ("priority", self.priority)):
            if not (value is None or callable(value) or _is_number(value)):
                raise ModelError(f"Guard: {what}: expected a number or a function, found {value!r}")
        _ = self.engine_direction, self.engine_count  # refuse impossible arguments here, not later

    @property
    def engine_direction(self) -> str:
        """The name the engine has for the direction."""
        if isinstance(self.direction, str):
            if self.direction not in DIRECTIONS:
                known = known_names(self.direction, list(DIRECTIONS))
                raise ModelError(f"Guard: unknown direction '{self.direction}'{known}")
            return DIRECTIONS[self.direction]
        try:
            sign = float(self.direction)
        except (TypeError, ValueError):
            raise ModelError(
                "Guard: direction: expected 'both', 'falling', 'rising' or a number with that "
                f"sign, found {self.direction!r}"
            ) from None
        return DIRECTIONS["rising" if sign > 0 else "falling" if sign < 0 else "both"]

    @property
    def engine_count(self) -> int:
        """At which firing it ends the run, if it is terminal."""
        try:
            number = 0 if self.terminal is None else operator.index(self.terminal)
        except TypeError:
            raise ModelError(
                f"Guard: terminal: expected True, False or a count, found {self.terminal!r}"
            ) from None
        if number < 0:
            raise ModelError(f"Guard: terminal: expected a count above 0, found {number}")
        if number > 1 and self.max_count not in (1, number):
            raise ModelError(f"Guard: terminal={number} and max_count={self.max_count}; say one")
        return max(number, self.max_count)

    def named(self, number: int) -> str:
        """Its name as event `number` of a list.

        Examples
        --------
        >>> saltus.Guard(lambda t, x: x[0]).named(2)
        'event_2'
        """
        own = getattr(self.guard, "__name__", "<lambda>")
        return self.name or (f"event_{number}" if own.startswith("<") else own)


def functions_of(guards: Sequence[Guard]) -> list[Callable[..., Any] | None]:
    """The functions of several guards; None where one has none."""
    return [
        each if callable(each) else None
        for guard in guards
        for each in (guard.guard, guard.reset, guard.delay, guard.priority)
    ]


def _is_number(value: Any) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, bool)


def guards_of(events: Any) -> list[Guard]:
    """The guards of the argument `events`, one or several, with different names."""
    single = isinstance(events, Guard) or callable(events)
    try:
        guards = [_as_guard(e) for e in ([events] if single else events)]
    except TypeError:
        guards = [_as_guard(events)]
    names = [guard.named(i) for i, guard in enumerate(guards)]
    for i, guard in enumerate(guards):  # functions made in a loop have the same name
        if guard.name is None and names.count(names[i]) > 1:
            guards[i] = replace(guard, name=f"event_{i}")
    return guards


def _as_guard(event: Any) -> Guard:
    """A guard, or a plain function with the attributes `terminal` and `direction` of SciPy."""
    if isinstance(event, Guard):
        return event
    if not callable(event):
        raise ModelError(
            f"events: expected Guard(...) or a function g(t, x), or a list of them, found {event!r}"
        )
    return Guard(
        event,
        direction=getattr(event, "direction", "both"),
        terminal=_terminal_of(event),
    )


def _terminal_of(event: Callable[..., Any]) -> Any:
    terminal = getattr(event, "terminal", None)
    try:
        if terminal is None or operator.index(terminal) >= 0:
            return terminal
    except TypeError:
        pass
    name = getattr(event, "__name__", repr(event))
    raise ModelError(
        f"events: The `terminal` attribute of '{name}': expected None, True, False or a count, "
        f"found {terminal!r}"
    )
