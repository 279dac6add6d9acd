"""The cost of a first run grows with the number of functions, not with its square."""

from __future__ import annotations

import sys
from types import FrameType
from typing import Any

import saltus


def leaf(outputs: int) -> saltus.LeafSystem:
    """A decay with many traced outputs."""
    made = saltus.LeafSystem("many")
    made.declare_continuous_state([1.0], ode=lambda time, state: -state.continuous_state)
    for i in range(outputs):
        made.declare_output_port(
            lambda time, state, i=i: i * state.continuous_state[0], name=f"y{i}"
        )
    return made


def calls_of_first_run(system: Any) -> int:
    """The number of Python functions and generators that the first run enters."""
    count = 0

    def note(frame: FrameType, event: str, argument: Any) -> None:
        nonlocal count
        count += event == "call"

    sys.setprofile(note)
    try:
        saltus.simulate(system, (0.0, 1e-3))
    finally:
        sys.setprofile(None)
    return count


def test_twice_the_functions_cost_twice_the_calls():
    calls_of_first_run(leaf(2))  # modules that are imported late
    some, twice, four_times = (calls_of_first_run(leaf(n)) for n in (100, 200, 400))
    # With a constant part c and a part b a function, the calls are c + b n: equal differences. A
    # part n^2 makes the second difference four times the first one.
    assert four_times - twice <= 2.2 * (twice - some)
