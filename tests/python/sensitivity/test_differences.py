"""Derivatives of called functions: right for every scale, and never wrong in silence."""

import math

import numpy as np
import pytest
import saltus


def mapped(reset, p=1.0, width=1):
    """The derivative by `p` of states that a reset map sets from it."""
    block = saltus.LeafSystem(name="block")
    block.declare_dynamic_parameter("p", p)
    block.declare_continuous_state(
        [1.0] + [0.0] * width, ode=lambda time, state, p: [-1.0] + [0.0] * width
    )
    block.declare_zero_crossing(
        lambda time, state, p: state.continuous_state[0],
        lambda time, state, p: state.with_continuous_state([5.0, *np.atleast_1d(reset(p))]),
        name="hit",
        direction="positive_then_non_positive",
    )
    results = saltus.simulate(block, (0.0, 1.5), sensitivity=["p"])
    assert results.status == "reached_end"
    return results.sensitivities.continuous_state[1:, 0]


# A difference of one over a shift of 1e-3 has the error 2e-13 by rounding, and three times it here.
@pytest.mark.parametrize("size", [0.0, 1e-300, 1e-17, 1e-14, 1e-12, 1e-9, 1e-6, 1e-3, 1.0])
@pytest.mark.parametrize("sign", [-1, 1])
def test_a_tiny_value_moves_as_far_as_zero(size, sign):
    np.testing.assert_allclose(mapped(lambda p: 1.0 + 3.0 * p, sign * size), [3.0], rtol=1e-10)


# A small value that is the scale of the function: 1 / p changes as much as p itself.
@pytest.mark.parametrize("size", [1e-12, 1e-9, 1e-6, 1.0, 1e9])
def test_a_small_value_can_be_the_scale(size):
    found = mapped(lambda p: [size / p, p / (size + p), 1.0], size, width=3)
    np.testing.assert_allclose(found, [-1.0 / size, 0.25 / size, 0.0], rtol=1e-9)


# The rule of the ladder is 1e-9 of the derivative by its agreement. Rounding is eps over the last
# shift, 1e-9 of the argument: 2e-7 for 1e5, where c p itself loses that much.
@pytest.mark.parametrize(
    ("c", "tolerance"), [(1, 1e-9), (10, 1e-9), (50, 1e-8), (200, 1e-8), (1e3, 1e-8), (1e5, 1e-6)]
)
def test_a_fast_function(c, tolerance):
    np.testing.assert_allclose(mapped(lambda p: math.sin(c * p)), [c * math.cos(c)], rtol=tolerance)


def test_a_step_that_is_smooth():
    np.testing.assert_allclose(mapped(lambda p: math.tanh(p / 1e-6), 0.0), [1e6], rtol=1e-6)


# The kink lies inside the first shift beside the value: a smaller one finds the right side.
@pytest.mark.parametrize("big", [0.0, 1.0, 1e6, 1e9])
@pytest.mark.parametrize(("place", "expected"), [(0.9999, 1.0), (1.0001, 0.0)])
def test_a_large_neighbour_hides_no_kink(big, place, expected):
    found = mapped(lambda p: [big * p, max(p - place, 0.0)], width=2)
    np.testing.assert_allclose(found, [big, expected], rtol=1e-9, atol=1e-9)


DRAWN = np.random.default_rng(1)
NONE = {
    "a kink": (lambda p: max(p, 0.0), 0.0),
    "an even kink": (abs, 0.0),
    "a kink beside a slope": (lambda p: 2.0 * p + abs(p - 1.0) / 10, 1.0),
    "a jump": (lambda p: [1.0, 2.0, 3.0][int(p)], 1.0),
    "a root at zero": (lambda p: math.copysign(math.sqrt(abs(p)), p), 0.0),
    "a random number": (lambda p: p + DRAWN.normal(), 1.0),
}


@pytest.mark.parametrize("name", NONE)
def test_a_function_without_a_derivative_has_none(name):
    reset, p = NONE[name]
    found = mapped(lambda p: [7.0 * p, reset(p)], p, width=2)
    assert np.isnan(found[1])


# Each is flat there, and the calls at both sides agree only in falling to zero. The last difference
# is of a shift of 1e-6.
FLAT = {
    "p^2": lambda p: p * p,
    "p |p|": lambda p: p * abs(p),
    "p^3": lambda p: p**3,
    "cos": math.cos,
    "max(p, 0)^2": lambda p: max(p, 0.0) ** 2,
    "a difference of large values": lambda p: (1e6 + p) - 1e6 - p,
}


@pytest.mark.parametrize("name", FLAT)
def test_a_smooth_function_is_flat(name):
    found = mapped(lambda p: [1e6 + p, FLAT[name](p)], 0.0, width=2)
    np.testing.assert_allclose(found, [1.0, 0.0], atol=2e-6)


def checked(p):
    if not 0 <= p <= 1:
        raise ValueError(f"{p} is not in 0..1")
    return p


# At the end of its range a function raises at every shift; beside it only at the first.
@pytest.mark.parametrize(
    ("reset", "p", "expected"),
    [
        (checked, 1.0, math.nan),
        (math.asin, 1.0, math.nan),
        (math.sqrt, 0.0, math.nan),
        (checked, 1.0 - 1e-4, 1.0),
        (math.asin, 1.0 - 1e-4, 1.0 / math.sqrt(1.0 - (1.0 - 1e-4) ** 2)),
    ],
)
def test_a_call_that_raises_ends_no_run(reset, p, expected):
    np.testing.assert_allclose(mapped(reset, p), [expected], rtol=1e-8)


def test_an_interruption_goes_through():
    calls = []

    def reset(p):
        calls.append(p)
        if len(calls) > 1:
            raise KeyboardInterrupt
        return p

    with pytest.raises(KeyboardInterrupt):
        mapped(reset)


# exp(-1) of the linear equation at the origin. A difference of x / (K + x) needs a shift below K.
@pytest.mark.parametrize("scale", [1e-2, 1e-4, 1e-6])
def test_a_called_flow_of_a_small_scale(scale):
    block = saltus.LeafSystem(name="block")
    block.declare_continuous_state(
        [0.0],
        ode=lambda time, state: [
            -scale * state.continuous_state[0] / (scale + state.continuous_state[0])
        ],
    )
    results = saltus.simulate(block, (0.0, 1.0), sensitivity=["x[0]"], python="called")
    np.testing.assert_allclose(results.sensitivities.continuous_state, [[math.exp(-1)]], rtol=1e-6)


def test_smooth_functions_cost_four_calls():
    calls = []
    mapped(lambda p: calls.append(p) or 2.0 * p)
    moved = [p for p in calls if p != 1.0]
    assert len(moved) == 4
