"""A source, up to three blocks without memory in a row, and a guard: as many events as dense sampling says.

`python chains.py [COUNT [FIRST]]` tries COUNT chains.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import saltus
from saltus.library import (
    DeadZone,
    FunctionBlock,
    Gain,
    HitCrossing,
    Integrator,
    Offset,
    Saturate,
    Sine,
    SourceBlock,
)

END = 40.0  # [s]
SAMPLES = 400_001
METHODS = ("auto", "dop853", "radau", "bdf")
LAW = Callable[[np.ndarray], np.ndarray]


class Count(saltus.LeafSystem):
    """A guard whose reset map counts."""

    def __init__(self, guard):
        super().__init__(name="guard")
        self.declare_input_port("u")
        self.declare_discrete_state([0.0])
        self.declare_zero_crossing(
            guard,
            reset_map=lambda t, s, u: s.with_discrete_state(s.discrete_state + 1.0),
            name="hit",
        )


@dataclass
class Chain:
    """Blocks in a row with the law of each, and how to run them."""

    blocks: list
    laws: list[LAW]  # of time, then of the output before
    period: float  # [s] of the fastest part of the source
    python: str
    method: str
    moves: bool  # whether there is a state, so that the method has steps of its own

    def value(self, t):
        for law in self.laws:
            t = law(t)
        return t

    def run(self):
        builder = saltus.DiagramBuilder()
        builder.add(*self.blocks)
        for source, target in zip(self.blocks, self.blocks[1:], strict=False):
            builder.connect(source.output(), target.input(0))
        if self.moves:
            state = builder.add(Integrator(name="x"))
            builder.connect(self.blocks[0].output(), state.input())
        return saltus.simulate(
            builder.build(), (0.0, END), python=self.python, ode_solver_method=self.method
        )

    def __str__(self):
        names = " -> ".join(type(block).__name__ for block in self.blocks)
        return f"{names} ({self.python}, {self.method}{', a state' if self.moves else ''})"


def draw_source(rng):
    w, phase = rng.uniform(0.3, 6.0), rng.uniform(0.0, 6.0)
    kind = rng.integers(3)
    if kind == 0:
        a, b = rng.uniform(0.5, 2.0), rng.uniform(-0.5, 0.5)
        block = Sine(amplitude=a, frequency=w, phase=phase, bias=b, name="source")
        return block, lambda t: a * np.sin(w * t + phase) + b, 2 * np.pi / w
    if kind == 1:
        block = Sine(frequency=w, phase=phase, name="source")
        return block, lambda t: np.sin(w * t + phase), 2 * np.pi / w

    def two(t):
        return np.sin(w * t + phase) + 0.3 * np.cos(2 * w * t)

    return SourceBlock(two, name="source"), two, np.pi / w


def draw_block(rng, name):
    """Kinks, steps, slopes with a step, and a function that is nearly constant."""
    c, q = rng.uniform(-0.6, 0.6), rng.uniform(0.2, 0.7)
    gain = rng.uniform(0.5, 3.0) * rng.choice([-1, 1])
    lower = -abs(c) - 0.05
    functions = [
        lambda u: np.where(u > c, 1.0, -1.0),
        lambda u: np.floor(u / q) * q,
        lambda u: u**3 - c,
        lambda u: np.where(u > c, 1.0, 0.0) + 0.1 * u,
        lambda u: np.tanh(20.0 * (u - c)),
    ]
    choices = [
        (Gain(gain, name=name), lambda u: gain * u),
        (Offset(c, name=name), lambda u: u + c),
        (
            Saturate(lower_limit=lower, upper_limit=0.4, name=name),
            lambda u: np.clip(u, lower, 0.4),
        ),
        (DeadZone(0.2, name=name), lambda u: np.where(abs(u) < 0.2, 0.0, u)),
        *((FunctionBlock(f, name=name), f) for f in functions),
    ]
    return choices[rng.integers(len(choices))]


def draw_guard(rng):
    c = rng.uniform(-0.5, 0.5)
    choices = [
        (Count(lambda t, s, u: u - c), lambda y: y - c),
        (Count(lambda t, s, u: u > c), lambda y: np.where(y > c, 1.0, -1.0)),
        (
            Count(lambda t, s, u: np.where(u > c, 1.0, -1.0)),
            lambda y: np.where(y > c, 1.0, -1.0),
        ),
        (Count(lambda t, s, u: np.floor(3.0 * u) - c), lambda y: np.floor(3.0 * y) - c),
        (HitCrossing(c, name="guard"), lambda y: y - c),
    ]
    return choices[rng.integers(len(choices))]


def draw_chain(seed):
    rng = np.random.default_rng(seed)
    source, law, period = draw_source(rng)
    drawn = [(source, law)]
    drawn += [draw_block(rng, f"b{i}") for i in range(rng.integers(4))]
    drawn.append(draw_guard(rng))
    blocks, laws = zip(*drawn, strict=True)
    return Chain(
        list(blocks),
        list(laws),
        period,
        python=str(rng.choice(["called", "traced"])),
        method=str(rng.choice(METHODS)),
        moves=bool(rng.integers(2)),
    )


def crossings(chain):
    """[s] Where the guard changes its sign; None where the law of crossings does not say it.

    That is so where it rests on zero, and where two crossings are nearer than a twelfth of a
    period: a guard is shown by twelve looks in its period (docs/events.md).
    """
    t = np.linspace(0.0, END, SAMPLES)
    side = np.sign(chain.value(t))
    if np.mean(side == 0.0) > 1e-3:
        return None
    known = np.flatnonzero(side)
    before = known[np.flatnonzero(np.diff(side[known]))]
    low, high = t[before], t[np.minimum(before + 2, SAMPLES - 1)]
    for _ in range(60):  # bisection down to neighbouring numbers
        middle = 0.5 * (low + high)
        stays = np.sign(chain.value(middle)) == side[before]
        low, high = np.where(stays, middle, low), np.where(stays, high, middle)
    gaps = np.diff(np.concatenate([[0.0], high, [END]]))
    return None if len(high) and gaps.min() < chain.period / 12.0 else high


def wrong(seed):
    """What is wrong with the events of a chain, as text; None where nothing is."""
    chain = draw_chain(seed)
    expected = crossings(chain)
    if expected is None:
        return None
    found = np.unique(
        [e.time for e in chain.run().events if e.block == "guard" and 0.0 < e.time < END]
    )
    found = found[np.diff(found, prepend=-1.0) > 1e-12]  # a jump may fire twice within its rounding
    # The slope of a guard at a crossing may be 1e-3 of that of the source, so the roundings of the
    # source, 1e-15, become 1e-12 [s]; the steps of multistep methods end within 1e-9 [s].
    if len(found) == len(expected) and np.all(np.abs(found - expected) < 1e-7):
        return None
    return f"seed {seed}, {chain}: {len(expected)} crossings, {len(found)} events"


if __name__ == "__main__":
    count, first = (int(a) for a in [*sys.argv[1:], *("200", "0")[len(sys.argv) - 1 :]])
    found = [text for seed in range(first, first + count) if (text := wrong(seed))]
    print(*found, f"{len(found)} of {count} chains are wrong", sep="\n")
    sys.exit(bool(found))
