"""The events of a model as nodes of an expression graph."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from saltus.errors import ModelError
from saltus.sbml.nodes import Nodes
from saltus.sbml.quantities import items
from saltus.sbml.running import RunningScope

__all__ = ["ASSIGNED", "CROSSED", "END", "HIGHEST", "START", "Event", "events_of"]

START, CROSSED, ASSIGNED, END = OWN = (
    "start of the run",
    "comparison crossed",
    "values assigned",
    "end of the instant",
)
"""names of what happens beside the events; an id has no spaces"""
HIGHEST = 1e300
"""a priority before those of all events"""
LARGEST, LOWEST = 1e299, -1e299
"""the limits of a priority; the lowest is that of an event without one, so that the end of the
instant comes after all events
"""


@dataclass
class Event:
    """One event. A node is None for what the model does not say."""

    name: str
    persistent: bool
    initial: bool
    early: bool
    """whether values are computed when it triggers, not when it is executed"""
    trigger: int
    delay: int | None
    priority: int
    values: dict[str, int]
    """the values that it assigns, by id"""


def events_of(scope: RunningScope) -> list[Event]:
    """To be called when all other formulas are made."""
    declared = scope.kinds.declared
    triggers = [_trigger(scope, each) for each in declared.events]
    scope.at_instants = True
    names = set(OWN)
    events = []
    for i, each in enumerate(declared.events):
        name = _new(each.getId() or each.getName() or f"event {i + 1}", names)
        events.append(_event(scope, each, name, triggers[i]))
    return events


def _new(name: str, known: set[str]) -> str:
    """The name, with a number if it is known already."""
    found, k = name, 2
    while found in known:
        found, k = f"{name} ({k})", k + 1
    known.add(found)
    return found


def _trigger(scope: RunningScope, event: Any) -> int:
    tree = event.getTrigger().getMath()
    return int(scope.graph.constant(0.0)) if tree is None else scope.formula(tree)


def _event(scope: RunningScope, each: Any, name: str, trigger: int) -> Event:
    def node(part: Any) -> int | None:
        tree = None if part is None else part.getMath()
        return None if tree is None else scope.formula(tree)

    says, new = each.getTrigger(), each.getLevel() > 2
    assigned = [a for a in items(each, "EventAssignment") if a.getMath() is not None]
    for target in (a.getVariable() for a in assigned):
        if target not in scope.kinds.places:
            raise ModelError(
                f"event '{name}': it assigns '{target}', which a rule determines; "
                "an event assigns what no assignment or algebraic rule determines"
            )
    delay = node(each.getDelay())
    return Event(
        name=name,
        persistent=says.getPersistent() if new else True,
        initial=says.getInitialValue() if new else True,
        early=each.getUseValuesFromTriggerTime(),
        trigger=trigger,
        delay=None if delay is not None and scope.graph.value(delay) == 0.0 else delay,
        priority=_priority(Nodes(scope.graph), node(each.getPriority())),
        values={a.getVariable(): scope.formula(a.getMath()) for a in assigned},
    )


def _priority(f: Nodes, given: int | None) -> int:
    """A priority that is not a number counts as none."""
    if given is None:
        return f(LOWEST)
    limited = f("maximum", f("minimum", given, LARGEST), LOWEST)
    return f("select", f("eq", given, given), limited, LOWEST)
