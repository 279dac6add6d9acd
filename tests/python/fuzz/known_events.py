"""Scenes drawn at random whose events are known by a line of arithmetic: jumps, wraps, toggles.

``python known_events.py COUNT [SEED]`` tries COUNT scenes.
"""

from __future__ import annotations

import math
import random
import sys
from collections import Counter
from typing import Any

import saltus

METHODS = ("auto", "dopri5", "dop853", "adams", "bdf", "radau", "taylor")
APART = 1e-6
"""[of a period] an end that is closer to an event says nothing: the event is on either side"""


def ramp(name: str, start: list[float], rates: list[float]) -> saltus.LeafSystem:
    leaf = saltus.LeafSystem(name=name)
    leaf.declare_continuous_state(start, ode=lambda t, s: rates)
    return leaf


def teeth(begin: float, back: float, level: float, rate: float, end: float) -> int | None:
    """How often x' = rate from `begin` reaches `level`, if it goes back to `back` there."""
    first, period = (level - begin) / rate, (level - back) / rate
    rounds = (end - first) / period
    if abs(rounds - round(rounds)) < APART or abs(end - first) < APART * period:
        return None
    return 0 if end < first else 1 + math.floor(rounds)


def jump(draw: random.Random) -> tuple[saltus.LeafSystem, float, dict[str, int]] | None:
    """A sawtooth whose guard takes two values, or many."""
    level, rate = draw.uniform(-2, 2), 10 ** draw.uniform(-2, 2)
    back = level - 10 ** draw.uniform(-2, 1)
    begin, end = back - draw.random(), (level - back) / rate * draw.uniform(0.1, 12)
    count = teeth(begin, back, level, rate, end)
    if count is None:
        return None
    above, sign = 10 ** draw.uniform(-9, 9), draw.choice((1, -1))
    below = draw.choice((0.0, 10 ** draw.uniform(-9, 9)))
    stair = draw.random() < 0.3

    def guard(t: float, s: Any) -> float:
        x = s.continuous_state[0]
        if stair:
            return float(sign * (0.5 - math.floor((x - level) / (level - back))) - sign)
        return sign * (above if x < level else -below)

    leaf = ramp("saw", [begin], [rate])
    leaf.declare_zero_crossing(
        guard,
        lambda t, s: s.with_continuous_state([back]),
        name="jump",
        direction=draw.choice(("falling" if sign > 0 else "rising", "crosses_zero")),
    )
    return leaf, end, {"jump": count}


def wrap(draw: random.Random) -> tuple[saltus.LeafSystem, float, dict[str, int]] | None:
    """A box that a point leaves at one side and enters at the other, in one or two dimensions."""
    expected, end = {}, draw.uniform(0.1, 12)
    low, high, start, rates = [], [], [], []
    for i in range(draw.randint(1, 2)):
        low.append(draw.choice((0.0, -math.pi, draw.uniform(-5, 5), 1e5)))
        high.append(low[i] + draw.choice((1.0, 2 * math.pi, draw.uniform(0.1, 3))))
        start.append(low[i] + draw.uniform(0.05, 0.95) * (high[i] - low[i]))
        rates.append(draw.choice((1, -1)) * draw.uniform(0.1, 2))
        ahead = high[i] if rates[i] > 0 else low[i]
        behind = low[i] if rates[i] > 0 else high[i]
        size = abs(rates[i])
        count = teeth(
            0.0, abs(start[i] - ahead) - (high[i] - low[i]), abs(start[i] - ahead), size, end
        )
        if count is None or behind == ahead:
            return None
        expected[f"up{i}"], expected[f"down{i}"] = (count, 0) if rates[i] > 0 else (0, count)
    leaf = ramp("box", start, rates)
    for i in range(len(start)):
        for name, at, by, way in (
            (f"up{i}", high[i], low[i] - high[i], "rising"),
            (f"down{i}", low[i], high[i] - low[i], "falling"),
        ):
            leaf.declare_zero_crossing(
                lambda t, s, i=i, at=at: s.continuous_state[i] - at,
                lambda t, s, i=i, by=by: s.with_continuous_state(
                    [x + by if k == i else x for k, x in enumerate(s.continuous_state)]
                ),
                name=name,
                direction=way,
            )
    return leaf, end, expected


def cells(draw: random.Random) -> tuple[saltus.LeafSystem, float, dict[str, int]] | None:
    """The index of the cell that a point is in, as discrete state."""
    width, rate = draw.uniform(0.1, 3), draw.choice((1, -1)) * draw.uniform(0.1, 2)
    start, end = draw.uniform(0.05, 0.95) * width, draw.uniform(0.1, 12)
    way = (start + rate * end) / width
    if abs(way - round(way)) < APART:
        return None
    leaf = ramp("grid", [start], [rate])
    leaf.declare_discrete_state([0.0])
    for name, edge, by, direction in (("up", 1, 1, "rising"), ("down", 0, -1, "falling")):
        leaf.declare_zero_crossing(
            lambda t, s, edge=edge: s.continuous_state[0] - width * (s.discrete_state[0] + edge),
            lambda t, s, by=by: s.with_discrete_state(s.discrete_state + by),
            name=name,
            direction=direction,
        )
    last = math.floor(way)
    return leaf, end, {"up": max(last, 0), "down": max(-last, 0)}


def toggle(draw: random.Random) -> tuple[saltus.LeafSystem, float, dict[str, int]] | None:
    """A point between two walls, whose direction is a discrete state that the walls turn."""
    low, width, rate = draw.uniform(-3, 3), draw.uniform(0.1, 3), draw.uniform(0.1, 2)
    part, end = draw.uniform(0.05, 0.95), draw.uniform(0.1, 20)
    way = part + rate * end / width  # in widths, unfolded: a turn at each whole number
    if abs(way - round(way)) < APART:
        return None
    leaf = saltus.LeafSystem(name="walls")
    leaf.declare_continuous_state(
        [low + part * width], ode=lambda t, s: [rate * s.discrete_state[0]]
    )
    leaf.declare_discrete_state([1.0])
    for name, at, direction in (("high", low + width, "rising"), ("low", low, "falling")):
        leaf.declare_zero_crossing(
            lambda t, s, at=at: s.continuous_state[0] - at,
            lambda t, s: s.with_discrete_state(-s.discrete_state),
            name=name,
            direction=direction,
        )
    turns = math.floor(way)
    return leaf, end, {"high": (turns + 1) // 2, "low": turns // 2}


KINDS = {"jump": jump, "wrap": wrap, "cells": cells, "toggle": toggle}


def try_scenes(count: int, seed: int = 0) -> Counter[str]:
    """Runs `count` scenes; AssertionError where events are missing or too many."""
    ran: Counter[str] = Counter()
    for i in range(count):
        draw = random.Random(f"{seed} {i}")
        kind = list(KINDS)[i % len(KINDS)]
        drawn = KINDS[kind](draw)
        if drawn is None:
            continue
        leaf, end, expected = drawn
        method = draw.choice(METHODS)
        results = saltus.simulate(
            leaf,
            (0, end),
            ode_solver_method=method,
            # a series needs expressions
            python="traced" if method == "taylor" else draw.choice(("traced", "called")),
            throw=False,
        )
        found = {name: len(results.events.times(name)) for name in expected}
        where = f"scene {i} of seed {seed}: {kind}, {method}, {results.status} {results.message}"
        assert results.status == "reached_end" and found == expected, (where, found, expected)
        ran[kind] += 1
    return ran


if __name__ == "__main__":
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    print(dict(try_scenes(number, int(sys.argv[2]) if len(sys.argv) > 2 else 0)))
