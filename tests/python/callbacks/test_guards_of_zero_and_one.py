"""Guards that write a truth as 0 and 1 (docs/semantics.md, 2.1).

x' = cos t from 0: x = sin t rises through 0.3 at a and at a + 2 pi, and falls at pi - a, a = arcsin 0.3.
"""

import numpy as np
import pytest
import saltus
from saltus import Guard, solve

A = np.arcsin(0.3)
RISES, FALLS = [A, A + 2.0 * np.pi], [np.pi - A]
EXPECTED = {
    "rising": RISES,
    "falling": FALLS,
    "both": sorted(RISES + FALLS),
    "edge_detection": sorted(RISES + FALLS),
}
TRACED = {
    "int": lambda t, x: int(x[0] > 0.3),
    "float": lambda t, x: float(x[0] > 0.3),
    "times": lambda t, x: 1.0 * (x[0] > 0.3),
    "where": lambda t, x: np.where(x[0] > 0.3, 1, 0),
    "where of floats": lambda t, x: np.where(x[0] > 0.3, 1.0, 0.0),
    "exchanged": lambda t, x: np.where(x[0] <= 0.3, 0, 1),
    "astype": lambda t, x: (x[0] > 0.3).astype(int),
    "and": lambda t, x: np.where((x[0] > 0.3) & (x[0] < 2.0), 1, 0),
}
CALLED = {
    "branch": lambda t, x: 1 if x[0] > 0.3 else 0,
    "NumPy": lambda t, x: np.int64(1 if x[0] > 0.3 else 0),
    "array": lambda t, x: np.array([1 if x[0] > 0.3 else 0]),
    "list": lambda t, x: [1 if x[0] > 0.3 else 0],
}


def run(guard, direction, **options):
    return solve(
        lambda t, x: [np.cos(t)],
        (0.0, 7.0),
        [0.0],
        events=Guard(guard, direction=direction),
        rtol=1e-10,
        atol=1e-12,
        **options,
    )


@pytest.mark.parametrize("name", TRACED)
@pytest.mark.parametrize("direction", EXPECTED)
def test_a_traced_guard_is_the_truth(name, direction):
    found = run(TRACED[name], direction)
    assert found.t_events[0] == pytest.approx(EXPECTED[direction], abs=1e-8)  # some 100 steps


@pytest.mark.parametrize("name", CALLED)
@pytest.mark.parametrize("direction", EXPECTED)
def test_a_called_guard_is_right_or_refused(name, direction):
    """By 2.2 a number at zero has no side, so it would not fire where it becomes 1."""
    if direction in ("rising", "both"):
        with pytest.raises(saltus.ModelError, match="'event_0' returned the integer 0.*a truth"):
            run(CALLED[name], direction)
    else:
        found = run(CALLED[name], direction)
        assert found.t_events[0] == pytest.approx(EXPECTED[direction], abs=1e-8)


def test_a_number_that_is_no_truth_keeps_its_zero():
    """A count that comes to zero fires there: 3 - n for n = 0, 1, 2, ... at 3 s, as a float or not."""
    for as_number in (int, float):
        found = solve(
            lambda t, x: [1.0],
            (0.0, 5.5),
            [0.0],
            events=Guard(lambda t, x: as_number(3 - int(np.floor(x[0]))), direction="falling"),
            python="called",
        )
        assert found.t_events[0] == pytest.approx([3.0], abs=1e-8)


def test_a_derivative_of_zero_and_one_is_no_truth():
    """Only guards are truths: an ode np.where(x > 0.3, 1, 0) keeps its values."""
    found = solve(lambda t, x: [np.where(x[0] > -1.0, 1, 0)], (0.0, 2.0), [0.0])
    assert found.y[0, -1] == pytest.approx(2.0, abs=1e-12)
