"""A state machine: named states, and transitions between them with actions."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus._core import known_names
from saltus._porting import refusing
from saltus.errors import BlockParameterError
from saltus.leaf_system import LeafSystem
from saltus.library.by_name import FIRST, Named, Words, inputs_of_all

__all__ = ["StateMachine", "Transition"]

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
class _Condition:
    """When a transition is taken."""

    guard: Named | None
    trigger: Named | None
    after: float | None

    def holds(self, now: dict[str, Any]) -> Any:
        """The truth of a condition without a trigger."""
        if self.after is None:
            return None if self.guard is None else self.guard(now)
        due = now["since"] >= self.after
        return due if self.guard is None else np.logical_and(due, self.guard(now))


class StateMachine(LeafSystem):
    """One of several named states is active; transitions lead from one to another.

    All functions take by name what they read, in any order: inputs, variables and parameters,
    `time` [s], `since` [s], the time since the active state was entered, and `state`, its position.
    An action returns new values of variables by name. At a transition the action of exit of the
    source, that of the transition, and that of entry of the target run in this order, each after
    the one before. The action of entry of the first state runs at the start.

    A state that is entered may be left at once: the next transition is then taken at the same time.
    If this comes to no end, the run ends with the error of `max_passes`, which names the
    transitions. The times of guards are located by bisection, where the truth changes; a truth that
    is true for less than the distance of two looks at a step may be missed. A trigger that is one
    comparison, and a time `after`, are located as smoothly as any guard. The event log has a
    trigger also where a transition of a higher priority was taken, or the `guard` beside it was
    false. Before the first state is entered, the mode of the block is the number of states.

    Outputs, all held: `state`, the position of the active state, 0 for the first; one for each
    variable; and those of `outputs`.

    Parameters
    ----------
    states
        Their names. The first is active at the start, unless `initial` is given.
    transitions
        `Transition`s.
    inputs
        The names of the inputs.
    variables
        Name -> number at the start. Only actions change them.
    entry, exit
        State -> action when it is entered, or left.
    outputs
        Name -> {state: number}, 0 in a state that is not named; or name -> a function.
    parameters
        Name -> number, parameters of the context.
    initial
        The state that is active at the start.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    BlockParameterError
        If there is no state, a name is unknown or used twice, a transition has no condition, or
        `after` is not above 0.

    Examples
    --------
    A door that opens on a call, and closes 3 s later; it counts its visitors:

    >>> from saltus.library import Pulse, StateMachine, Transition
    >>> door = StateMachine(
    ...     ["closed", "open"],
    ...     [
    ...         Transition("closed", "open", trigger=lambda call: call > 0.5),
    ...         Transition("open", "closed", after=3.0),
    ...     ],
    ...     inputs=["call"],
    ...     variables={"visits": 0.0},
    ...     entry={"open": lambda visits: {"visits": visits + 1}},
    ... )
    >>> state, visits = saltus.response(door, Pulse(period=5.0, phase_delay=1.0), t=[0.5, 2, 5, 7])
    >>> state, visits
    (array([0., 1., 0., 1.]), array([0., 1., 1., 2.]))
    """

    __slots__ = ("_actions", "_first", "_states", "_words")

    @refusing
    def __init__(
        self,
        states: Sequence[str],
        transitions: Sequence[Transition],
        *,
        inputs: Sequence[str] = (),
        variables: Mapping[str, float] | None = None,
        entry: Mapping[str, Action] | None = None,
        exit: Mapping[str, Action] | None = None,
        outputs: Mapping[str, Mapping[str, float] | Callable[..., Any]] | None = None,
        parameters: Mapping[str, float] | None = None,
        initial: str | None = None,
        name: str | None = None,
    ):
        super().__init__(name)
        variables, parameters = dict(variables or {}), dict(parameters or {})
        self._states = tuple(states)
        self._words = Words(
            self.name, len(self._states), tuple(inputs), tuple(variables), tuple(parameters)
        )
        self._require_names()
        self._first = 0 if initial is None else self._at(initial, "initial")
        self._actions = {
            what: {state: self._named(f"{what} of '{state}'", f) for state, f in given.items()}
            for what, given in (("entry", entry or {}), ("exit", exit or {}))
        }
        for what, actions in self._actions.items():
            for state in actions:
                self._at(state, what)
        self.declare_default_mode(len(self._states))  # no state is entered before a run
        self.declare_discrete_state([0.0, *variables.values()])
        for parameter, value in parameters.items():
            self.declare_dynamic_parameter(parameter, value)
        for each in self._words.inputs:
            self.declare_input_port(each, shape=())
        self._declare_outputs(dict(outputs or {}))
        self._declare_start(self._first)
        events = _events_of(transitions)
        before: dict[str, list[_Condition]] = {state: [] for state in self._states}
        for each, event in sorted(zip(transitions, events, strict=True), key=_order):
            condition = self._condition_of(each, f"transition '{event}'")
            self._declare_transition(each, event, condition, tuple(before[each.source]))
            if condition.trigger is None and each.source != each.target:
                before[each.source].append(condition)

    @property
    def states(self) -> tuple[str, ...]:
        """The names of the states, in the order of their positions."""
        return self._states

    def _fail(self, what: str) -> BlockParameterError:
        return BlockParameterError(f"block '{self.name}': {what}")

    def _named(self, what: str, function: Callable[..., Any] | None) -> Named | None:
        return None if function is None else Named(self._words, what, function)

    def _require_names(self) -> None:
        if not self._states:
            raise self._fail("expected one state or more, found none")
        for what, names in (("state", self._states), ("name", self._words.all())):
            for name in names:
                if names.count(name) > 1:
                    raise self._fail(f"the {what} '{name}' is there twice")

    def _at(self, state: str, where: str) -> int:
        """The position of a state."""
        if state not in self._states:
            known = known_names(str(state), list(self._states))
            raise self._fail(f"{where}: there is no state '{state}'{known}")
        return self._states.index(state)

    def _declare_outputs(self, outputs: dict[str, Any]) -> None:
        self._declare_output("state", lambda state: state)
        for k, variable in enumerate(self._words.variables, FIRST):
            self.declare_output_port(
                lambda time, state, k=k, **_: state.discrete_state[k],
                name=variable,
                requires_inputs=False,
                shape=(),
                reads=["discrete_state"],
            )
        for name, given in outputs.items():
            self._declare_output(name, given if callable(given) else self._table(name, given))

    def _table(self, output: str, given: Mapping[str, float]) -> Callable[..., Any]:
        """The function of an output that has one number in each state."""
        levels = np.zeros(len(self._states))
        for state, level in given.items():
            levels[self._at(state, f"output '{output}'")] = level
        return lambda state: levels[state]

    def _declare_output(self, name: str, given: Callable[..., Any]) -> None:
        function = Named(self._words, f"output '{name}'", given)
        known, read = _reader(self._words, self._first, [function])
        self.declare_output_port(
            lambda *values, **parameters: function(known(*values, **parameters)),
            name=name,
            requires_inputs=read,
            shape=(),
            reads=function.reads(),
        )

    def _declare_start(self, first: int) -> None:
        """Enters the first state, when a run starts for the first time."""
        words, act = self._words, self._actions["entry"].get(self._states[first])
        known, read = _reader(words, first, [act])

        def enter(*values: Any, **parameters: Any) -> Any:
            z = _after(words, known(*values, **parameters), [], act, first)
            return values[1].with_discrete_state(z)

        self.declare_zero_crossing(
            lambda *_, **__: 1.0,
            enter,
            name="start",
            direction="rising",
            start_mode=len(self._states),
            end_mode=first,
            at_start="fire",
            zeno_tolerance=0.0,
            requires_inputs=read,
        )

    def _condition_of(self, each: Transition, where: str) -> _Condition:
        self._at(each.source, where), self._at(each.target, where)
        self._require_condition(each, where)
        guard = self._named(f"guard of {where}", each.guard)
        return _Condition(guard, self._named(f"trigger of {where}", each.trigger), each.after)

    def _declare_transition(
        self, each: Transition, event: str, condition: _Condition, first: tuple[_Condition, ...]
    ) -> None:
        """A transition, which waits behind those that come first."""
        where, words = f"transition '{event}'", self._words
        source, target = self._at(each.source, where), self._at(each.target, where)
        guard, trigger = condition.guard, condition.trigger
        leave = [self._actions["exit"].get(each.source)]
        leave.append(self._named(f"action of {where}", each.action))
        enter = self._actions["entry"].get(each.target)
        known, read = _reader(
            words, self._first, [guard, trigger, *leave, enter, *(other.guard for other in first)]
        )

        def take(*values: Any, **parameters: Any) -> Any:
            now, state = known(*values, **parameters), values[1]
            taken = state.mode == source  # a transition of a higher priority may have left it
            if trigger is not None and guard is not None:
                taken = np.logical_and(taken, guard(now))
            z = _after(words, now, leave, enter, target)
            changed = [np.where(taken, *pair) for pair in zip(z, state.discrete_state, strict=True)]
            mode = np.where(taken, target, state.mode)
            return state.with_discrete_state(changed).with_mode(mode)

        def fires(*values: Any, **parameters: Any) -> Any:
            now = known(*values, **parameters)
            if trigger is not None:
                return trigger(now)
            return _due(values[1].mode == source, condition, first, now)

        edge = {"start_mode": source, "at_start": "ignore"}
        self.declare_zero_crossing(
            fires,
            take,
            name=event,
            direction="rising",
            zeno_tolerance=0.0,
            requires_inputs=read,
            **(edge if trigger is not None else {"at_start": "fire"}),
        )

    def _require_condition(self, each: Transition, where: str) -> None:
        if each.guard is None and each.trigger is None and each.after is None:
            raise self._fail(f"{where}: expected a guard, a trigger or a time 'after'")
        if each.trigger is not None and each.after is not None:
            raise self._fail(f"{where}: expected a trigger or a time 'after', found both")
        if each.after is not None and not 0.0 < each.after < math.inf:
            raise self._fail(f"{where}: after = {each.after} s; expected a time above 0")


def _reader(
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


def _due(
    active: Any, condition: _Condition, first: Sequence[_Condition], now: dict[str, Any]
) -> Any:
    """The guard of a transition that is taken where a condition holds: above zero where it does.

    It is below zero in all other states, so that the pass that enters the state carries it across
    zero if the condition holds. A guard of that mode alone would wait then, if it has fired at the
    same time before, and the transition would be lost. It is below zero, too, where a transition
    that comes first is taken.
    """
    for other in first:
        active = np.logical_and(active, np.logical_not(other.holds(now)))
    if condition.guard is None:
        return np.where(active, now["since"] - condition.after, -1.0)
    return np.where(np.logical_and(active, condition.holds(now)), 1.0, -1.0)


def _after(
    words: Words,
    known: dict[str, Any],
    leave: Sequence[Named | None],
    enter: Named | None,
    target: int,
) -> list[Any]:
    """The discrete state after the actions, each of which sees what the one before left."""
    for act in leave:
        known = known | _changes(words, known, act)
    known = known | {"since": 0.0, "state": target}
    known = known | _changes(words, known, enter)
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


def _order(pair: tuple[Transition, str]) -> float:
    return -pair[0].priority


def _events_of(transitions: Sequence[Transition]) -> list[str]:
    """The names of the events; a second transition between two states gets a number."""
    events: list[str] = []
    for each in transitions:
        name = each.name or f"{each.source}_to_{each.target}"
        others = sum(other.partition(" ")[0] == name for other in events) if not each.name else 0
        events.append(f"{name} {others + 1}" if others else name)
    return events
