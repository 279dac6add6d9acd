"""What happens at an instant: triggers, the queue of executions, assignments.

The rules are those of SBML level 3 version 2, section 4.11: an event is triggered where its trigger
becomes true; its delay is evaluated then; of the executions that are due the one of highest
priority, evaluated anew each time, comes first, and its assignments may trigger or cancel others.
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus.errors import SimulationError
from saltus.sbml.crossing import SAME_TIME, crossing
from saltus.sbml.events import DRAWS, DUE, NEVER, STARTED, WAITING, Event, Program
from saltus.sbml.formula import evaluated

__all__ = ["Instant"]

TAKEN = 2.0
"""the size of a side that was taken before its own guard fires; 1 after that"""
MOST_EXECUTIONS = 10_000


@dataclass
class Waiting:
    """An execution of an event that waits."""

    event: int
    due: float
    values: np.ndarray | None
    """None: computed at the execution"""


class Instant:
    """One instant; `x` and `z` become the states after it."""

    def __init__(self, program: Program, time: float, x: Any, z: Any, p: np.ndarray):
        self.program, self.time, self.p = program, time, p
        self.x, self.z = np.array(x, dtype=float), np.array(z, dtype=float)
        self.near = SAME_TIME * max(1.0, abs(time))
        n = len(program.timely)
        self.sides = self.z[program.first_side : program.first_side + n]
        self.truths = self.z[program.first_truth : program.first_truth + len(program.events)]
        self.queue: list[Waiting] = []

    def start(self) -> None:
        """The start of a run: no side is known, and a trigger was what its model says."""
        self.z[STARTED] = 1.0
        self.differences = self._differences(self.time)
        self._take_sides(np.ones(len(self.sides), dtype=bool))
        self._settle()
        self.truths[:] = [event.initial for event in self.program.events]
        self._run()

    def crossed(self, entry: int) -> None:
        """A difference crossed zero, upwards for entry k < n, downwards for n + k; or an execution
        is due, for 2 n.
        """
        self.differences = self._differences(self.time)
        self._cross(*self._turned(entry))
        self._run()
        self._return()

    def _turned(self, entry: int) -> tuple[np.ndarray, np.ndarray]:
        """The new sides at this instant, 0 where there is none, and whether one that was taken
        before is confirmed now.
        """
        n = len(self.sides)
        k, sign = (entry % n, 1.0 if entry < n else -1.0) if entry < 2 * n else (None, 0.0)
        flow = self._crossing(k)
        new = np.where(np.sign(self.sides) == flow, 0.0, TAKEN * flow)
        again = np.zeros(n, dtype=bool)
        rounding = k is not None and self.sides[k] == -TAKEN * sign == TAKEN * flow[k]
        if k is not None and not rounding:
            again[k] = self.sides[k] == TAKEN * sign
            new[k] = sign
        return new, again

    def _crossing(self, fired: int | None = None) -> np.ndarray:
        """The sides to which the flow takes differences at this instant, 0 for the others."""
        if not len(self.sides):
            return np.zeros(0)
        return crossing(self.program, self.time, self.x, self.z, self.p, self.differences, fired)

    def _cross(self, new: np.ndarray, again: np.ndarray) -> None:
        """New sides. Those of equalities are zero first, but not `again`."""
        crossed = new != 0.0
        equal = crossed & self.program.equal & ~again
        if equal.any():
            self.sides[equal] = 0.0
            self.sides[crossed & ~equal] = new[crossed & ~equal]
            self._settle()
            self._run()
        self.sides[crossed] = new[crossed]
        late = (np.abs(self.sides) < TAKEN) & ~crossed
        self._take_sides(late & (self.sides * self.differences < 0.0))
        self._settle()

    def _return(self) -> None:
        """A difference whose side was taken, and that an event has turned around, has its old side
        from now on.
        """
        if not (np.abs(self.sides) == TAKEN).any():
            return
        now = self._crossing()
        turned = (np.abs(self.sides) == TAKEN) & (self.sides * now < 0.0)
        if turned.any():
            self.sides[turned] = np.sign(now[turned])
            self._settle()
            self._run()

    def _evaluated(self, tape: Any) -> np.ndarray:
        found: np.ndarray = evaluated(tape, self.time, self.x, self.z, self.p)
        return found

    def _differences(self, time: float) -> np.ndarray:
        found: np.ndarray = evaluated(self.program.differences, time, self.x, self.z, self.p)
        return found

    def _take_sides(self, which: np.ndarray) -> None:
        """The sides of some differences, by their values."""
        self.sides[which] = np.sign(self.differences[which])

    def _settle(self) -> None:
        """The sides of differences that have jumped, until none does any more: one may read the
        side of another.
        """
        for _ in range(len(self.sides) + 1):
            now = self._differences(self.time)
            jumped = now != self.differences
            self.differences = now
            if not jumped.any():
                return
            self._take_sides(jumped)

    def _run(self) -> None:
        """Until nothing is due any more."""
        self.queue = self._stored()
        executed: set[int] = set()
        for _ in range(MOST_EXECUTIONS):
            self._trigger()
            due = [one for one in self.queue if one.due <= self.time + self.near]
            if not due:
                self._store()
                return
            first = self._first(due)
            executed.add(first.event)
            self._execute(first)
        names = [self.program.events[i].name for i in sorted(executed)]
        raise SimulationError(
            f"t = {self.time:g}: the events {', '.join(names)} trigger each other without end, "
            f"{MOST_EXECUTIONS} times; give one a delay, or a trigger that stays false"
        )

    def _trigger(self) -> None:
        truths = self._evaluated(self.program.truths) != 0.0
        for i in np.flatnonzero(truths != (self.truths != 0.0)):
            event = self.program.events[i]
            if truths[i]:
                self._schedule(int(i), event)
            elif not event.persistent:
                self.queue = [one for one in self.queue if one.event != i]
        self.truths[:] = truths

    def _schedule(self, i: int, event: Event) -> None:
        delay = 0.0 if event.delay is None else float(self._evaluated(event.delay)[0])
        if not delay >= 0.0:
            raise SimulationError(
                f"t = {self.time:g}: event '{event.name}': expected a delay that is not negative, "
                f"found {delay:g}"
            )
        values = self._evaluated(event.values) if event.early else None
        self.queue.append(Waiting(i, self.time + delay, values))

    def _first(self, due: list[Waiting]) -> Waiting:
        """The one of highest priority; among equals one at random."""
        ranks = [self._priority(one) for one in due]
        best = [one for one, rank in zip(due, ranks, strict=True) if rank == max(ranks)]
        if len(best) == 1:
            return best[0]
        self.z[DRAWS] += 1.0
        return random.Random(self.program.seed * 1_000_003 + int(self.z[DRAWS])).choice(best)

    def _priority(self, one: Waiting) -> float:
        tape = self.program.events[one.event].priority
        rank = -math.inf if tape is None else float(self._evaluated(tape)[0])
        return -math.inf if math.isnan(rank) else rank

    def _execute(self, one: Waiting) -> None:
        """All assignments at once: a concentration is one in the size before, and a jump of the
        size leaves every amount as it is.
        """
        self.queue.remove(one)
        event = self.program.events[one.event]
        values = self._evaluated(event.values) if one.values is None else one.values
        sizes = self.program.sizes
        before = {name: self._size(sizes[name]) for name in event.targets if name in sizes}
        kept = {name: self._size(tape) for name, tape in self.program.kept.items()}
        for target, value in zip(event.targets, values, strict=True):
            self._put(target, value * before.get(target, 1.0))
        for name, size in kept.items():
            memory, i = self.program.places[name]
            self._put(name, getattr(self, memory)[i] * size / self._size(self.program.kept[name]))
        self._jumped(event)

    def _size(self, tape: Any) -> float:
        return float(self._evaluated(tape)[0])

    def _put(self, name: str, value: float) -> None:
        memory, i = self.program.places[name]
        getattr(self, memory)[i] = value

    def _jumped(self, event: Event) -> None:
        """The sides of the differences that an assignment has changed."""
        if not np.isfinite(self.x).all():
            raise SimulationError(
                f"t = {self.time:g}: event '{event.name}': it assigns a value that is not finite"
            )
        self._settle()

    def _stored(self) -> list[Waiting]:
        found = []
        for i, event in enumerate(self.program.events):
            if event.delay is None:
                continue
            for row in self._rows(event):
                if row[0] > 0.0:
                    values = row[2:].copy() if event.early else None
                    found.append(Waiting(i, float(row[1]), values))
        return found

    def _rows(self, event: Event) -> np.ndarray:
        part = self.z[event.first : event.first + WAITING * event.width]
        return part.reshape(WAITING, event.width)

    def _store(self) -> None:
        """The queue into the discrete state: 1 for a place that is taken, due time, values."""
        self.z[DUE] = min((one.due for one in self.queue), default=NEVER)
        for i, event in enumerate(self.program.events):
            own = [one for one in self.queue if one.event == i]
            if event.delay is None:
                continue
            if len(own) > WAITING:
                raise SimulationError(
                    f"t = {self.time:g}: event '{event.name}': more than {WAITING} executions "
                    "wait; expected a delay that is shorter against the time between its triggers"
                )
            rows = self._rows(event)
            rows[:] = 0.0
            for row, one in zip(rows, own, strict=False):
                row[:2] = 1.0, one.due
                if one.values is not None:
                    row[2:] = one.values
