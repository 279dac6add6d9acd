"""Transitions of a state machine: when they are taken, and what their actions change."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus._core import known_names
from saltus.errors import BlockParameterError
from saltus.library.by_name import Named, Words, inputs_of_all

__all__ = [
    "Action",
    "Condition",
    "Transition",
    "after_actions",
    "due",
    "events_of",
    "order",
    "reader",
    "still_due",
]

Action = Callable[..., Mapping[str, Any]]


@dataclass(frozen=True)
class Transition:
    """A transition of a `StateMachine` from the state `source` to the state `target`.

    It has a `guard`, a `trigger` or a time `after`, and is taken

    - with a `guard`, a function that returns a truth, as soon as that is true, also where it is
      true when `source` is entered;
    - with a `trigger`, a function that returns a truth, each time that *becomes* true while
      `source` is active; if there is a `guard` too, it has to be true at that time;
    - with `after` [s], that time after `source` was entered; if there is a `guard` too, as soon as
      it is true from then on.

    Of the transitions from one state that could be taken at one time, that with the highest
    `priority` is taken; of equal ones the first in the list. `action` returns the new values of
    variables, such as `{"count": count + 1}`, in between the actions of exit and entry. `name` is
    that of the event, by default "source_to_target". A transition from a state to itself leaves and
    enters it; its guard is then taken anew only after it was false.

    Examples
    --------
    >>> from saltus.library import StateMachine, Transition
    >>> blink = [Transition("on", "off", after=0.5), Transition("off", "on", after=1.0)]
    >>> saltus.response(StateMachine(["on", "off"], blink), t=[0.25, 0.75, 1.75])
    array([0., 1., 0.])
    """

    source: str
    target: str
    guard: Callable[..., Any] | None = None
    trigger: Callable[..., Any] | None = None
    after: float | None = None
    action: Action | None = None
    priority: float = 0.0
    name: str | None = None


@dataclass(frozen=True)
class Condition:
    """When a transition is taken."""

    guard: Named | None
    trigger: Named | None
    after: float | None

    def holds(self, now: dict[str, Any]) -> Any:
        """The truth of a condition without a trigger."""
        if self.after is None:
            return None if self.guard is None else self.guard(now)
        late = now["since"] >= self.after
        return late if self.guard is None else np.logical_and(late, self.guard(now))


def reader(
    words: Words, first: int, functions: Sequence[Named | None]
) -> tuple[Callable[..., dict[str, Any]], list[int]]:
    """Name -> value for some functions, from the arguments of a callback; the inputs it has.

    The state before the start counts as the first one.
    """
    read, count = inputs_of_all(words, functions), words.states
    positions = np.array([*range(count), first])

    def known(time: Any, state: Any, *inputs: Any, **parameters: Any) -> dict[str, Any]:
        values = words.values(time, state, read, inputs, parameters)
        return values | {"state": positions[state.mode]}

    return known, read


def due(active: Any, condition: Condition, first: Sequence[Condition], now: dict[str, Any]) -> Any:
    """The guard of a transition that is taken where a condition holds: true, or not below zero.

    It is false in all other states, so that the pass that enters the state carries it across
    zero if the condition holds. A guard of that mode alone would wait then, if it has fired at the
    same time before, and the transition would be lost. It is false, too, where a transition that
    comes first is taken.
    """
    for other in first:
        active = np.logical_and(active, np.logical_not(other.holds(now)))
    if condition.after is None:
        return np.logical_and(active, condition.holds(now))
    late = now["since"] - condition.after
    if condition.guard is None:
        return np.where(active, late, -1.0)
    if isinstance(late, float):  # called: the time in place of a truth says how near that is
        return np.where(np.logical_and(active, condition.guard(now)), late, -1.0)
    return np.logical_and(active, condition.holds(now))


def still_due(condition: Condition, now: dict[str, Any]) -> Any:
    """Whether a transition without a trigger that has fired is due still, where one of its source to
    itself may have been taken before it: the time since the source was entered is 0 then.
    """
    if condition.after is not None:
        return now["since"] >= 0.5 * condition.after
    return condition.holds(now)


def after_actions(
    words: Words,
    known: dict[str, Any],
    leave: Sequence[Named | None],
    enter: Named | None,
    target: int,
) -> list[Any]:
    """The discrete state after the actions, each of which sees what the one before left."""
    for act in leave:
        known = {**known, **_changes(words, known, act)}
    known = known | {"since": 0.0, "state": target}
    known = {**known, **_changes(words, known, enter)}
    return [known["time"], *(known[name] for name in words.variables)]


def _changes(words: Words, known: dict[str, Any], act: Named | None) -> Mapping[str, Any]:
    """What an action returns."""
    changes = {} if act is None else act(known)
    for name in changes:
        if act is not None and name not in words.variables:
            found = known_names(str(name), list(words.variables))
            raise BlockParameterError(
                f"block '{words.block}': {act.what}: there is no variable '{name}'{found}"
            )
    return changes


def order(pair: tuple[Transition, str]) -> float:
    return -pair[0].priority


def events_of(transitions: Sequence[Transition]) -> list[str]:
    """The names of the events; a second transition between two states gets a number."""
    events: list[str] = []
    for each in transitions:
        if not isinstance(each, Transition):
            raise BlockParameterError(
                "StateMachine: transitions: expected Transition('closed', 'open', trigger=...), "
                f"found {each!r}"
            )
        name = each.name or f"{each.source}_to_{each.target}"
        others = sum(other.partition(" ")[0] == name for other in events) if not each.name else 0
        events.append(f"{name} {others + 1}" if others else name)
    return events
