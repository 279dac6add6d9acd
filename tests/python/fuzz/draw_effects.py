"""Draws leaves whose callbacks read and write places outside the state, and builds them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import saltus
from hypothesis import strategies as st
from places import PLACES

EVENTS = ("update", "one shot", "reset")  # they write what they like
FLOWS = ("ode", "guard", "output")  # they write what is there: nobody says how often they run
COUNTING = {"length_of_a_list", "object_by_iteration", "object_by_a_context", "random_generator"}
"""places where a second write of one value changes something"""
OBSTACLES = ("", "branch", "count", "print")


@dataclass(frozen=True)
class Body:
    """What one callback does."""

    reads: tuple[int, ...]
    writes: tuple[int, ...]
    obstacle: str = ""
    """what makes it untraceable, besides its writes"""


@dataclass(frozen=True)
class Leaf:
    bodies: dict[str, Body] = field(default_factory=dict)
    period: float = 0.25
    time: float = 0.4
    level: float = 0.5


@dataclass(frozen=True)
class Story:
    """Leaves that share some places."""

    places: list[str]
    leaves: list[Leaf]


class World:
    """The places of a story, and what its callbacks count."""

    def __init__(self, names: list[str]):
        self.places = tuple(PLACES[name]() for name in names)
        self.counting = tuple(k for k, name in enumerate(names) if name in COUNTING)
        self.calls = 0

    def value(self, reads: tuple[int, ...]) -> float:
        return sum(np.sin(self.places[k][0]()) for k in reads)

    def write(self, writes: tuple[int, ...], value: float) -> None:
        for k in writes:
            self.places[k][1](value + 0.125 * k)

    def write_again(self, writes: tuple[int, ...]) -> None:
        """The value that is there, which changes nothing but is a write."""
        for k in writes:
            if k not in self.counting:
                read, write = self.places[k]
                write(read())


class Block(saltus.LeafSystem):
    """dx/dt = -x + what it reads, sampled and reset."""

    def __init__(self, name: str, leaf: Leaf, world: World):
        super().__init__(name=name)
        self.world, self.leaf = world, leaf
        for kind in EVENTS + FLOWS:  # an attribute each, so that readers can be told from writers
            setattr(self, f"does_{kind.replace(' ', '_')}", leaf.bodies.get(kind, Body((), ())))
        self.declare_continuous_state([0.5], ode=self.ode)
        bodies = leaf.bodies
        if "output" in bodies:
            self.declare_output_port(self.output_value, name="y", shape=())
        if "update" in bodies:
            self.declare_periodic_update(self.update, leaf.period, leaf.period)
        if "one shot" in bodies:
            self.declare_one_shot(self.one_shot, leaf.time)
        if "guard" in bodies:
            reset = self.reset if "reset" in bodies else None
            self.declare_zero_crossing(self.guard, reset, name="level", direction="rising")

    def act(self, body: Body, time: float, x: np.ndarray, at_event: bool) -> float:
        """Does what the body says; returns the sum of what it read."""
        seen = self.world.value(body.reads)
        if body.obstacle == "branch" and x[0] > 100.0:
            seen = 0.0
        if body.obstacle == "count":
            self.world.calls += 1
        if body.obstacle == "print":
            print(end="")
        if at_event:
            self.world.write(body.writes, 1.5 + np.cos(3.0 * time + seen))
        elif body.writes:
            self.world.write_again(body.writes)
        return seen

    def ode(self, time, state):
        x = state.continuous_state
        return -x + self.act(self.does_ode, time, x, False)

    def output_value(self, time, state):
        x = state.continuous_state
        return x[0] + self.act(self.does_output, time, x, False)

    def guard(self, time, state):
        x = state.continuous_state
        seen = self.act(self.does_guard, time, x, False)
        return np.sin(7.0 * time + 0.2 * x[0]) - self.leaf.level + 0.1 * seen

    def jump(self, body, time, state):
        x = state.continuous_state
        seen = self.act(body, time, x, True)
        return state.with_continuous_state(0.5 * x + 0.2 * seen)  # so the solver starts anew

    def reset(self, time, state):
        return self.jump(self.does_reset, time, state)

    def update(self, time, state):
        return self.jump(self.does_update, time, state)

    def one_shot(self, time, state):
        return self.jump(self.does_one_shot, time, state)


def build(story: Story) -> tuple[saltus.Diagram, dict[str, saltus.OutputPort]]:
    """A new world each time."""
    world = World(story.places)
    builder = saltus.DiagramBuilder()
    blocks = [Block(f"b{i}", leaf, world) for i, leaf in enumerate(story.leaves)]
    for block in blocks:
        builder.add(block)
    signals = {b.name: b.output("y") for b in blocks if "output" in b.leaf.bodies}
    return builder.build(), signals


@st.composite
def bodies(draw, count):
    which = st.lists(st.integers(0, count - 1), max_size=2, unique=True)
    reads, writes = draw(which), draw(st.one_of(st.just([]), which))
    return Body(tuple(reads), tuple(writes), draw(st.sampled_from(OBSTACLES)))


@st.composite
def stories(draw):
    names = draw(st.lists(st.sampled_from(sorted(PLACES)), min_size=1, max_size=3))
    kinds = st.lists(st.sampled_from(EVENTS + FLOWS), min_size=1, max_size=5, unique=True)
    leaves = [
        Leaf(
            {kind: draw(bodies(len(names))) for kind in draw(kinds)},
            draw(st.sampled_from([0.2, 0.25, 1.0 / 3.0])),
            draw(st.sampled_from([0.1, 0.25, 0.7])),
            draw(st.sampled_from([-0.3, 0.0, 0.5])),
        )
        for _ in range(draw(st.integers(1, 3)))
    ]
    return Story(names, leaves)
