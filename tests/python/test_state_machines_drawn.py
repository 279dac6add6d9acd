"""State machines drawn at random, against the same rules on a fine grid of times.

``python test_state_machines_drawn.py COUNT [SEED]`` tries COUNT machines.
"""

from __future__ import annotations

import math
import random
import sys
from dataclasses import dataclass

import numpy as np
import pytest
import saltus
from saltus.library import Sine, StateMachine, Transition

END, STEP = 8.0, 1e-3
APART = 5.0 * STEP
"""[s] from a transition, within which the grid says nothing"""
METHODS = ("auto", "dopri5", "dop853", "radau", "bdf", "adams")


def comparison(draw):
    level, above = draw.uniform(-0.9, 0.9), draw.random() < 0.5
    return (lambda u: u > level) if above else (lambda u: u < level)


def drawn_transition(draw, source, states):
    target = draw.choice([state for state in states if state != source])
    parts = draw.choice(("guard", "trigger", "after", "after guard", "trigger guard")).split()
    values = {
        part: draw.uniform(0.1, 1.5) if part == "after" else comparison(draw) for part in parts
    }
    return Transition(source, target, priority=draw.randint(0, 2), **values)


@dataclass
class OnGrid:
    """A state machine that looks at its input at each time of the grid."""

    states: list[str]
    transitions: list[Transition]

    def times_and_states(self, signal):
        """(time, new state) of all transitions; None for a chain that does not end."""
        state, entered, found, before = self.states[0], 0.0, [], {}
        ways = sorted(self.transitions, key=lambda way: -way.priority)
        for t in np.arange(0.0, END, STEP):
            u = signal(t)
            now = {id(way): bool(way.trigger(u)) for way in ways if way.trigger}
            edges = {key for key, true in now.items() if true and not before.get(key, True)}
            before, instant = now, t
            for _ in range(20):
                way = self.taken(ways, state, t - entered, u, edges)
                if way is None:
                    break
                if way.after and entered + way.after > t - STEP:
                    instant = entered + way.after  # exact: the errors of the grid would add up
                state, entered, edges = way.target, instant, set()
                found.append((t, state))
            else:
                return None
        return found

    @staticmethod
    def taken(ways, state, since, u, edges):
        for way in ways:
            if way.source != state or (way.guard and not way.guard(u)):
                continue
            if id(way) in edges if way.trigger else since >= (way.after or 0.0) - 1e-12:
                return way
        return None


def try_machine(seed):
    """Whether a machine was tried; AssertionError where its states are not those of the grid."""
    draw = random.Random(seed)
    states = [f"s{k}" for k in range(draw.randint(2, 4))]
    ways = [drawn_transition(draw, s, states) for s in states for _ in range(draw.randint(1, 2))]
    frequency, phase = draw.uniform(0.7, 3.0), draw.uniform(0.0, 6.28)
    expected = OnGrid(states, ways).times_and_states(lambda t: math.sin(frequency * t + phase))
    if expected is None:
        return False
    machine, source = (
        StateMachine(states, ways, inputs=["u"]),
        Sine(frequency=frequency, phase=phase),
    )
    builder = saltus.DiagramBuilder()
    builder.add(machine, source)
    builder.connect(source.output(), machine.input())
    times = np.linspace(0.01, END - 0.01, 400)
    results = saltus.simulate(
        builder.build(), (0.0, END), ode_solver_method=draw.choice(METHODS), save_at=times,
        save_steps=False, recorded_signals={"state": machine.output("state")},
    )  # fmt: skip
    found = results.outputs["state"].ravel()[np.searchsorted(results.time, times, "right") - 1]
    changes = [t for t, _ in expected]
    at = [states[0], *(state for _, state in expected)]
    for t, state in zip(times, found, strict=True):
        k = np.searchsorted(changes, t, "right")
        if all(abs(t - change) > APART for change in changes[max(0, k - 1) : k + 1]):
            assert states[int(state)] == at[k], (seed, t, ways, expected, results.events)
    return True


@pytest.mark.parametrize("seed", range(15))
def test_a_machine_has_the_states_of_the_grid(seed):
    try_machine(f"0 {seed}")


if __name__ == "__main__":
    count, seed = int(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else "1"
    print(sum(try_machine(f"{seed} {k}") for k in range(count)), "machines agree")
