"""What happens at an instant, as formulas.

The engine has the queue (docs/semantics.md, 3.11 to 3.16). Around it these are the reset maps of
plain zero crossings, which happen before any execution:

- `compare`, where a difference crosses zero: the new sides, and the truths of the triggers.
- `assign`, after an execution has put its values beside the states: all of them at once, then the
  sides of what has jumped, and the truths.
- `later`, when nothing else is due: the sides after zeros that count for one moment.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from saltus.sbml.crossing import Crossing
from saltus.sbml.events import Event
from saltus.sbml.formula import Assignment, Formula
from saltus.sbml.guards import Guards, just_after
from saltus.sbml.kinds import FIRST, LATER, LOOK, RUNNING, STARTED, Kinds, assigned_by_events
from saltus.sbml.nodes import Nodes
from saltus.sbml.running import RunningScope
from saltus.sbml.walk import Replaced

__all__ = ["Instant"]

TAKEN = 2.0
"""the size of a side that was taken before its own guard fires; 1 after that"""


class Instant:
    """The reset maps of a model, and the positions of what they keep in the discrete state."""

    def __init__(self, scope: RunningScope, events: list[Event]):
        self.scope, self.events = scope, events
        self.graph, self.nodes = scope.graph, Nodes(scope.graph)
        self.kinds: Kinds = scope.kinds
        self.differences = list(scope.differences)
        self.size = scope.first_side
        self.sides = self._next(len(self.differences))
        """-1, 0 or 1 for each difference, or twice that while its own guard has not fired"""
        momentary = sorted(scope.momentary)
        self.after = dict(zip(momentary, self._next(len(momentary)), strict=True))
        """for differences that have the side 0 for one moment: not 0 at that moment"""
        self.truths = self._next(len(events))
        self.values = self._next(max((len(event.values) for event in events), default=0))
        """of the event that is executed, until they are assigned"""
        self.z = [int(self.graph.discrete_state(i)) for i in range(self.size)]
        self.crossing = Crossing(scope)

    def _next(self, count: int) -> range:
        self.size += count
        return range(self.size - count, self.size)

    def beginning(self, held: np.ndarray) -> np.ndarray:
        """The discrete state before the start. A trigger was what the model says."""
        z = np.zeros(self.size)
        z[FIRST : FIRST + len(held)] = held
        z[self.truths.start : self.truths.stop] = [event.initial for event in self.events]
        return z

    def guards(self) -> Formula:
        """The differences, their negatives, and whether the sides are to be looked at."""
        guards = Guards(self.scope, self.crossing, [self.z[place] for place in self.sides])
        return Formula(self.graph, [*guards.up(), *guards.down(), self._rises(LOOK)])

    def positive(self, place: int) -> Formula:
        """A guard that rises where an entry of the discrete state, 0 before, becomes 1 or more."""
        return self.number(self._rises(place))

    def _rises(self, place: int) -> int:
        return self.nodes("sub", self.z[place], 0.5)

    def before(self) -> Formula:
        return self.number(self.nodes("sub", 0.5, self.z[STARTED]))

    def just_after(self) -> Formula:
        """The delay of `later`: a row at an instant is that of the instant, not of its end."""
        return self.number(just_after(self.nodes))

    def number(self, node: int) -> Formula:
        return Formula(self.graph, [node], True)

    def start(self) -> Assignment:
        """The start of a run: no side is known."""
        f = self.nodes
        z = [*self.z]
        z[STARTED] = f(1.0)
        self._settle({}, z, [None] * len(self.differences))
        z[LATER] = self._rests(z)
        return Assignment(self.graph, [], z)

    def compare(self) -> Assignment:
        """A difference crossed zero, upwards for entry k < n, downwards for n + k; or entry 2 n:
        the sides are looked at because an execution is due.
        """
        f, n = self.nodes, len(self.differences)
        entry = int(self.graph.entry())
        rises = f("lt", entry, float(n))
        number = f("select", rises, entry, f("sub", entry, float(n)))
        located = f("lt", entry, 2.0 * n)
        fired = [f.all(located, f("eq", number, float(k))) for k in range(n)]
        to = f("select", rises, 1.0, -1.0)
        z, sides = [*self.z], []
        for k, flow in enumerate(self.crossing.sides(fired)):
            sides.append(self._turned(k, flow, fired[k], to, z))
        z[LOOK] = f(0.0)
        self._settle({}, z, sides)
        late = [f("ne", z[self.after[k]], 0.0) for k in self.after]
        late += [f("eq", f("abs", z[place]), TAKEN) for place in self.sides]
        z[LATER] = f.any([*late, self._rests(z)])
        return Assignment(self.graph, [], z)

    def _rests(self, z: list[int]) -> int:
        """Whether a difference is at its zero, which the new rates may make it leave. Its guard
        need not see this: it may be above zero, by a rounding of the time at which it was located.
        """
        f = self.nodes
        return f.any([f("eq", z[place], 0.0) for place in self.sides])

    def _turned(self, k: int, flow: int, fired: int, to: int, z: list[int]) -> int:
        """The side of a difference after its crossing. One whose guard fired is 0 if it came to
        zero only, and the flow does not lead beyond: a rate may stop there. That of a difference
        whose zero counts by itself is 0 first, and the one after it waits.
        """
        f = self.nodes
        side, sign = self.z[self.sides[k]], f.sign(self.z[self.sides[k]])
        rounding = f.all(
            f("eq", side, f("mul", -TAKEN, to)), f("eq", flow, f("neg", to))
        )  # its guard fires the wrong way
        own = f.all(fired, f.no(rounding))
        taken = f("select", f("eq", sign, flow), 0.0, f("mul", TAKEN, flow))
        new = f("select", own, self._reached(k, flow, to), taken)
        crossed = f.any([own, f("ne", new, 0.0)])
        strays = f("lt", f("mul", side, self.differences[k]), 0.0)
        strays = f.all(strays, f("lt", f("abs", side), TAKEN))
        other = f("select", strays, f.sign(self.differences[k]), side)
        plain = f("select", crossed, new, other)
        if k not in self.after:
            return plain
        waiting = self.z[self.after[k]]
        rested = f.all(f("eq", sign, 0.0), f("eq", waiting, 0.0))
        leaves = f.all(own, f.any([f("eq", sign, to), rested]))
        at_zero = f.all(crossed, f.no(leaves))
        z[self.after[k]] = f("select", at_zero, new, waiting)
        return f("select", at_zero, 0.0, plain)

    def _reached(self, k: int, flow: int, to: int) -> int:
        """The side of a difference whose guard fired. An event may have turned it around since."""
        f, now = self.nodes, self.differences[k]
        beyond = f.any([f("gt", f("mul", now, to), 0.0), f("eq", flow, to)])
        near = f("le", f("abs", now), self.crossing.noise[k])
        return f("select", beyond, to, f("select", near, 0.0, f.sign(now)))

    def later(self) -> Assignment:
        """Nothing else is due. Differences leave zeros that count for one moment, and those at
        which they began, to the side of the flow as it is now: an event may have stopped them. One
        whose side was taken, and that an event has turned around, has its old side from now on.
        """
        f = self.nodes
        z, sides = [*self.z], []
        for k, flow in enumerate(self.crossing.sides()):
            side = self.z[self.sides[k]]
            if k in self.after:
                i = self.after[k]
                side = f("select", f("ne", z[i], 0.0), flow, side)
                z[i] = f(0.0)
            back = f.all(f("eq", f("abs", side), TAKEN), f("lt", f("mul", side, flow), 0.0))
            if not self.scope.fires_late(k):
                back = f.any([back, f.all(f("eq", side, 0.0), f("ne", flow, 0.0))])
            sides.append(f("select", back, flow, side))
        z[LATER] = f(0.0)
        self._settle({}, z, sides)
        return Assignment(self.graph, [], z)

    def execute(self, i: int) -> Assignment:
        """Event i puts its values beside the states. They are zero otherwise, so an execution that
        writes what was computed at its trigger writes all of them.
        """
        z = [*self.z]
        z[RUNNING] = self.nodes(float(i + 1))
        for j, value in enumerate(self.events[i].values.values()):
            z[self.values[j]] = value
        return Assignment(self.graph, [], z)

    def look(self) -> Assignment:
        """An execution is due."""
        z = [*self.z]
        z[LOOK] = self.nodes(1.0)
        return Assignment(self.graph, [], z)

    def assign(self) -> Assignment:
        """All assignments of an event at once: a concentration is one in the size before, and a
        jump of the size leaves every amount as it is.
        """
        f = self.nodes
        x = [int(self.graph.continuous_state(i)) for i in range(len(self.kinds.states))]
        z = [*self.z]
        lists = {"x": x, "z": z}
        for i, event in enumerate(self.events):
            runs = f("eq", self.z[RUNNING], float(i + 1))
            for j, name in enumerate(event.values):
                value = self.z[self.values[j]]
                if name in self.kinds.amounts:
                    value = f("mul", value, self._size(name))
                kind, place = self.kinds.places[name]
                lists[kind][place] = f("select", runs, value, lists[kind][place])
        jumped = self._replaced(x, z)
        for name in sorted(self._follow_jumps()):
            kind, place = self.kinds.places[name]
            before, after = self._size(name), jumped.of(self._size(name))
            same = f("eq", before, after)
            kept = f("div", f("mul", lists[kind][place], before), after)
            lists[kind][place] = f("select", same, lists[kind][place], kept)
        for i in (RUNNING, *self.values):
            z[i] = f(0.0)
        sides: list[int | None] = [self.z[self.sides[k]] for k in range(len(self.differences))]
        self._settle(dict(enumerate(x)), z, sides)
        z[LATER] = f.any([f("ne", z[LATER], 0.0), self._rests(z)])
        return Assignment(self.graph, x if self._writes_states() else [], z)

    def _writes_states(self) -> bool:
        names = {name for event in self.events for name in event.values} | self._follow_jumps()
        return any(self.kinds.places[name][0] == "x" for name in names)

    def _size(self, species: str) -> int:
        return self.scope.value(self.kinds.declared.quantities[species].compartment)

    def _follow_jumps(self) -> set[str]:
        """Species with a rate rule for their concentration, in a compartment that events change."""
        declared = self.kinds.declared
        jump = assigned_by_events(declared)
        return {
            name
            for name in declared.rates
            if declared.quantities[name].kind == "species"
            and not declared.quantities[name].substance
            and declared.quantities[name].compartment in jump
        }

    def _replaced(self, x: list[int], z: list[int]) -> Replaced:
        """Formulas with these states in place of those before."""
        pairs = {int(self.graph.continuous_state(i)): node for i, node in enumerate(x)}
        pairs |= dict(zip(self.z, z, strict=True))
        return Replaced(self.graph, {a: b for a, b in pairs.items() if a != b})

    def _settle(self, x: dict[int, int], z: list[int], sides: Sequence[int | None]) -> None:
        """Writes the sides into z, and the truths of the triggers. A difference that has jumped has
        the side of its value: one of the states that were written, or one that reads the side of
        another. A difference reads the sides of those before it alone.
        """
        f = self.nodes
        replaced = self._replaced([x[i] for i in range(len(x))], z)
        for k, (node, side) in enumerate(zip(self.differences, sides, strict=True)):
            now = replaced.of(node)
            new = f.sign(now)
            if side is not None and now == node:
                new = side
            elif side is not None:
                jumped = f("ne", now, node)
                new = f("select", jumped, new, side)
                if k in self.after:
                    i = self.after[k]
                    z[i] = f("select", jumped, 0.0, z[i])
            z[self.sides[k]] = new
            replaced.put(self.z[self.sides[k]], new)
        for i, event in enumerate(self.events):
            z[self.truths[i]] = f("ne", replaced.of(event.trigger), 0.0)
