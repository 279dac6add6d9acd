"""A state machine: named states, and transitions between them with actions."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from saltus._core import known_names
from saltus._porting import refusing
from saltus.errors import BlockParameterError
from saltus.leaf_system import LeafSystem
from saltus.library.by_name import FIRST, Named, Truth, Words
from saltus.library.transitions import (
    Action,
    Condition,
    Transition,
    after_actions,
    due,
    events_of,
    order,
    reader,
    still_due,
)

__all__ = ["StateMachine", "Transition"]


class StateMachine(LeafSystem):
    """One of several named states is active; transitions lead from one to another.

    All functions take by name what they read, in any order: inputs, variables and parameters,
    `time` [s], `since` [s], the time since the active state was entered, and `state`, its position.
    An action returns new values of variables by name. At a transition the action of exit of the
    source, that of the transition, and that of entry of the target run in this order, each after
    the one before. The action of entry of the first state runs at the start.

    A state that is entered may be left at once: the next transition is then taken at the same time.
    If this comes to no end, the run ends with the error of `max_passes`, which names the
    transitions. Guards and triggers that are made of comparisons, and a time `after`, are located
    as smoothly as any guard. Those that cannot be traced are located by bisection, and missed
    where they are true for less than the distance of two looks at a step. The event log has a
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
        `after` is not above 0. In a run, for a guard that returns a number.

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

    __slots__ = ("_actions", "_arrows", "_first", "_states", "_words")

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
        events = events_of(transitions)
        self._triggered = {each.source for each in transitions if each.trigger is not None}
        before: dict[str, list[Condition]] = {state: [] for state in self._states}
        returns: set[str] = set()  # the states with a transition to themselves so far
        for taken, event in sorted(zip(transitions, events, strict=True), key=order):
            condition = self._condition_of(taken, f"transition '{event}'")
            first, again = tuple(before[taken.source]), taken.source in returns
            self._declare_transition(taken, event, condition, first, again)
            if taken.source == taken.target:
                returns.add(taken.source)
            elif condition.trigger is None:
                before[taken.source].append(condition)
        place = self._states.index
        self._arrows = tuple(  # for the picture
            (event, place(taken.source), place(taken.target))
            for taken, event in zip(transitions, events, strict=True)
        )
        self._declared_quantities.modes = self._states
        self._declared_quantities.mode = (self.output_names.index("state"),)

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
        known, read = reader(self._words, self._first, [function])
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
        known, read = reader(words, first, [act])

        def enter(*values: Any, **parameters: Any) -> Any:
            z = after_actions(words, known(*values, **parameters), [], act, first)
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

    def _condition_of(self, each: Transition, where: str) -> Condition:
        self._at(each.source, where), self._at(each.target, where)
        self._require_condition(each, where)
        guard = each.guard and Truth(self._words, f"guard of {where}", each.guard)
        return Condition(guard, self._named(f"trigger of {where}", each.trigger), each.after)

    def _declare_transition(
        self,
        each: Transition,
        event: str,
        condition: Condition,
        first: tuple[Condition, ...],
        again: bool,
    ) -> None:
        """Declares a transition that is taken only if none of `first` is due. With `again`, a
        transition from the source to itself may have been taken before it in the same pass.
        """
        where, words = f"transition '{event}'", self._words
        source, target = self._at(each.source, where), self._at(each.target, where)
        guard, trigger = condition.guard, condition.trigger
        leave = [self._actions["exit"].get(each.source)]
        leave.append(self._named(f"action of {where}", each.action))
        enter = self._actions["entry"].get(each.target)
        known, read = reader(
            words, self._first, [guard, trigger, *leave, enter, *(other.guard for other in first)]
        )

        def take(*values: Any, **parameters: Any) -> Any:
            now, state = known(*values, **parameters), values[1]
            taken = state.mode == source  # a transition of a higher priority may have left it
            if trigger is not None and guard is not None:
                taken = np.logical_and(taken, guard(now))
            if trigger is None and again:
                taken = np.logical_and(taken, still_due(condition, now))
            z = after_actions(words, now, leave, enter, target)
            changed = [np.where(taken, *pair) for pair in zip(z, state.discrete_state, strict=True)]
            mode = np.where(taken, target, state.mode)
            return state.with_discrete_state(changed).with_mode(mode)

        def fires(*values: Any, **parameters: Any) -> Any:
            now = known(*values, **parameters)
            if trigger is not None:
                return trigger(now)
            return due(values[1].mode == source, condition, first, now)

        # Within rounding of a zero, a truth would be lost where a chain comes back to it at once.
        fires.__dict__["jumps"] = trigger is None and guard is not None
        edge = {"start_mode": source, "at_start": "ignore"}
        take.__dict__["yields"] = trigger is not None and again
        take.__dict__["follows_updates"] = trigger is None and each.source in self._triggered
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
