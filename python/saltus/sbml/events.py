"""The events of a model as tapes that are read at instants."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus.errors import ModelError
from saltus.sbml.quantities import items
from saltus.sbml.running import RunningScope

__all__ = [
    "DRAWS",
    "DUE",
    "NEVER",
    "STARTED",
    "WAITING",
    "Event",
    "Program",
    "events_of",
]

DUE, STARTED, DRAWS = 0, 1, 2
"""positions in the discrete state: the time of the next execution, whether the run has started, the
number of draws. What events alone change follows, from kinds.FIRST on; then sides, truths of
triggers and the queue
"""
WAITING = 32
"""executions of one event that may wait at once"""
NEVER = 1e30
"""[s] the time of the next execution where none waits"""


@dataclass
class Event:
    """One event. A tape is None for what the model does not say."""

    name: str
    persistent: bool
    initial: bool
    early: bool
    """whether values are computed when it triggers, not when it is executed"""
    delay: Any
    priority: Any
    values: Any
    """tape of the values that it assigns"""
    targets: list[str]
    first: int = 0
    """position of its part of the queue in the discrete state"""

    @property
    def width(self) -> int:
        return 2 + len(self.targets)


@dataclass
class Program:
    """All that happens at instants."""

    events: list[Event]
    truths: Any
    """tape of the triggers"""
    differences: Any
    """tape of the differences whose sides are kept"""
    sizes_of_terms: Any
    """tape of the size of the terms of each difference, to which its rounding is relative"""
    flow: Any
    """tape of the derivatives of the states"""
    timely: np.ndarray
    """whether a difference changes with the time alone"""
    curved: bool
    """whether one is no straight line in time and states: the solver looks at the errors of states
    alone, and a step may pass its turns
    """
    equal: np.ndarray
    """whether a difference is compared by == or !="""
    places: dict[str, tuple[str, int]]
    sizes: dict[str, Any]
    """tape of the size of its compartment, for each species of which the amount is kept"""
    kept: dict[str, Any]
    """the same for species of a concentration that follows a jump of the size"""
    first_side: int
    first_truth: int
    seed: int
    discrete: int = 0
    """numbers of the discrete state"""

    @property
    def happens(self) -> bool:
        """Whether there is an instant at all."""
        return bool(self.events) or len(self.timely) > 0


def events_of(scope: RunningScope, flow: Any, seed: int) -> Program:
    """The tapes of the events of a model, whose derivatives are the tape `flow`. To be called when
    all other formulas are made.
    """
    graph, kinds = scope.graph, scope.kinds
    triggers = [_trigger(scope, each) for each in kinds.declared.events]
    scope.at_instants = True
    events = [_event(scope, each, i) for i, each in enumerate(kinds.declared.events)]
    count = len(scope.differences)
    program = Program(
        events,
        graph.tape(triggers),
        graph.tape(list(scope.differences)),
        graph.tape([scope.size_of_terms(node) for node in scope.differences]),
        flow,
        np.array([scope.only_time(node) for node in scope.differences], dtype=bool),
        any(scope.curved(node) for node in scope.differences),
        np.array([k in scope.equalities for k in range(count)], dtype=bool),
        kinds.places,
        _sizes(scope, kinds.amounts),
        _sizes(scope, _follow_jumps(scope)),
        scope.first_side,
        scope.first_side + count,
        seed,
    )
    at = program.first_truth + len(events)
    for event in events:
        event.first = at
        at += 0 if event.delay is None else WAITING * event.width
    program.discrete = at
    return program


def _trigger(scope: RunningScope, event: Any) -> int:
    tree = event.getTrigger().getMath()
    return int(scope.graph.constant(0.0)) if tree is None else scope.formula(tree)


def _event(scope: RunningScope, each: Any, i: int) -> Event:
    graph, trigger = scope.graph, each.getTrigger()
    name = each.getId() or each.getName() or f"event {i + 1}"

    def tape(part: Any) -> Any:
        tree = None if part is None else part.getMath()
        return None if tree is None else graph.tape([scope.formula(tree)])

    assigned = [a for a in items(each, "EventAssignment") if a.getMath() is not None]
    _require_assignable(scope, name, [a.getVariable() for a in assigned])
    new = each.getLevel() > 2
    return Event(
        name=name,
        persistent=trigger.getPersistent() if new else True,
        initial=trigger.getInitialValue() if new else True,
        early=each.getUseValuesFromTriggerTime(),
        delay=tape(each.getDelay()),
        priority=tape(each.getPriority()),
        values=graph.tape([scope.formula(a.getMath()) for a in assigned]),
        targets=[a.getVariable() for a in assigned],
    )


def _require_assignable(scope: RunningScope, name: str, targets: list[str]) -> None:
    for target in targets:
        if target not in scope.kinds.places:
            raise ModelError(
                f"event '{name}': it assigns '{target}', which a rule determines; "
                "an event assigns what no assignment or algebraic rule determines"
            )


def _sizes(scope: RunningScope, names: set[str]) -> dict[str, Any]:
    quantities = scope.kinds.declared.quantities
    return {
        name: scope.graph.tape([scope.value(quantities[name].compartment)])
        for name in sorted(names)
    }


def _follow_jumps(scope: RunningScope) -> set[str]:
    """Species with a rate rule for their concentration, in a compartment that events change."""
    declared = scope.kinds.declared
    jump = {each.getVariable() for event in declared.events
            for each in items(event, "EventAssignment")}  # fmt: skip
    return {
        name
        for name in declared.rates
        if declared.quantities[name].kind == "species"
        and not declared.quantities[name].substance
        and declared.quantities[name].compartment in jump
    }
