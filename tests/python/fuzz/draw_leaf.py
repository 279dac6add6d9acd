"""Random leaf systems: numbers for what stands in leaves.py."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

# few and round, so that zeros, ties and equal times are drawn often
NUMBERS = st.sampled_from([0.0, 1.0, -1.0, 0.5, -0.5, 2.0, -2.0, 0.1, 1 / 3, 3.0])
POSITIVE = st.sampled_from([1.0, 0.5, 0.25, 2.0, 0.1, 1 / 3, 0.7])
ZENO = st.sampled_from([1e-6, 1e-2, 1e-4, 1e-3, 1e-6, 0.0])
DIRECTIONS = st.sampled_from(
    ["positive_then_non_positive", "negative_then_non_negative", "crosses_zero", "none"]
)


def options_of(**options: st.SearchStrategy) -> st.SearchStrategy:
    """A dict with some of the keys."""
    return st.fixed_dictionaries({}, optional=options)


@st.composite
def several(draw: Any, one: st.SearchStrategy, most: int) -> list[Any]:
    """A list, long ones as often as short ones."""
    n = draw(st.integers(1, most))
    return draw(st.lists(one, min_size=n, max_size=n))


GUARD = st.fixed_dictionaries(
    {
        "of": st.sampled_from(["first", "last", "sum", "input", "time", "pair"]),
        "level": NUMBERS,
        "reset": st.sampled_from([None, "set", "scale", "add", "keep", "count", "mode"]),
        "value": NUMBERS,
        "direction": DIRECTIONS,
    },
    optional={
        "start_mode": st.integers(0, 1),
        "end_mode": st.integers(0, 1),
        "terminal": st.booleans(),
        "zeno_tolerance": ZENO,
        "at_start": st.sampled_from(["auto", "ignore", "fire"]),
        "on_zeno": st.sampled_from(["hold", "stop", 0, 1]),
    },
)
UPDATE = st.fixed_dictionaries(
    {
        "period": st.sampled_from([0.5, 0.25, 0.1, 1 / 3]),
        "offset": st.sampled_from([0.0, 0.1, 0.5]),
        "what": st.sampled_from(["count", "kick", "sample", "mode"]),
    }
)


@st.composite
def leaf(draw: Any) -> dict[str, Any]:
    n = draw(st.integers(1, 2))
    vector = st.lists(NUMBERS, min_size=n, max_size=n)
    matrix = st.lists(vector, min_size=n, max_size=n)
    return {
        "x0": draw(vector),
        "a": draw(st.lists(matrix, min_size=2, max_size=2)),
        "b": draw(st.lists(vector, min_size=2, max_size=2)),
        "gain": draw(NUMBERS),
        "guards": draw(several(GUARD, 3)),
        "updates": draw(st.lists(UPDATE, max_size=1)),
    }


BALL = st.fixed_dictionaries(
    {"e": st.sampled_from([0.0, 0.5, 0.9, 1.0])},
    optional={
        "x0": st.sampled_from([(1.0, 0.0), (0.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.5, 0.0)]),
        "zeno_tolerance": ZENO,
        "on_zeno": st.sampled_from(["hold", "stop"]),
    },
)
