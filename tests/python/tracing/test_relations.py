"""Comparisons become smooth differences with the signs of a Relation."""

import itertools

import numpy as np
import pytest
from tracing_cases import evaluate, traced

SCALAR = [(), ()]
POINTS = [(0.3, 0.7), (0.7, 0.3), (0.5, 0.5), (-1.0, 1.0), (0.0, 0.0)]


def jumping(function):
    """The same function, whose truths are to be numbers that jump over zero."""

    def call(x):
        return function(x)

    call.jumps = True
    return call


def of_inputs(function, shapes=SCALAR):
    return traced(function, convention="inputs", input_shapes=shapes)


@pytest.mark.parametrize(
    ("function", "sign"),
    [
        (lambda x: x[0] < x[1], -1.0),
        (lambda x: x[0] <= x[1], -1.0),
        (lambda x: x[0] > x[1], 1.0),
        (lambda x: x[0] >= x[1], 1.0),
        (lambda x: np.less(x[0], x[1]), -1.0),
        (lambda x: np.logical_not(x[0] < x[1]), 1.0),
        (lambda x: bool(x[0] > x[1]), 1.0),
    ],
)
def test_one_comparison(function, sign):
    outcome = of_inputs(function)
    assert outcome.boolean
    assert outcome.shape == ()
    for a, b in POINTS:
        (g,) = outcome.residual(0.0, [], [], 0, 0, [], [[a], [b]])
        assert g == sign * (a - b)
        assert g == 0 or function((a, b)) == (g > 0)
        assert evaluate(outcome, [], u=[[a], [b]]) == function((a, b))


def test_entry_by_entry():
    outcome = of_inputs(lambda x: x[0] > x[1], [(3,), ()])
    found = outcome.residual(0.0, [], [], 0, 0, [], [[1.0, 2.0, 3.0], [2.0]])
    np.testing.assert_array_equal(found, [-1.0, 0.0, 1.0])
    assert outcome.shape == (3,)


def test_of_a_state():
    outcome = traced(lambda t, s: s.continuous_state[0] ** 2 > np.sin(t))
    (g,) = outcome.residual(1.0, [0.5, 0.0], [], 0, 0, [], [])
    assert g == pytest.approx(0.25 - np.sin(1.0), rel=1e-15)


COMPOUND = [
    lambda x: (x[0] < x[1]) & (x[0] > 0.0),
    lambda x: (x[0] < x[1]) | (x[1] <= 0.0),
    lambda x: np.logical_and(x[0] < x[1], np.logical_not(x[0] >= 0.5)),
    lambda x: np.logical_xor(x[0] < x[1], x[0] > 0.0),
    lambda x: np.where(x[0] < x[1], x[0] > 0.0, x[1] > 0.0),
    lambda x: (x[0] < x[1]) == (x[0] > 0.0),
    lambda x: [x[0] < x[1], x[1] <= x[0]],
    lambda x: np.any([x[0] < x[1], x[0] > 0.6, x[1] > 0.6]),
]


@pytest.mark.parametrize("function", COMPOUND)
def test_made_of_several(function):
    outcome, jumps = of_inputs(function), of_inputs(jumping(function))
    relations = outcome.relations
    assert outcome.boolean
    assert relations.truth.reads in (["discrete_state"], [])
    for a, b in itertools.product((-0.3, 0.2, 0.5, 0.55, 0.7), repeat=2):
        g = relations.differences(0.0, [], [], 0, 0, [], [[a], [b]])
        at_zero = np.array(relations.true_at_zero)
        truths = np.where(g == 0.0, at_zero, g > 0.0).astype(float)
        found = relations.truth(0.0, [], truths, 0, 0, [], [])
        np.testing.assert_array_equal(found, np.ravel(function((a, b))).astype(float))
        true = np.ravel(function((a, b)))
        g = outcome.residual(0.0, [], [], 0, 0, [], [[a], [b]])
        assert np.all(np.where(true, g >= 0.0, g <= 0.0))  # zero is the side of neither
        g = jumps.residual(0.0, [], [], 0, 0, [], [[a], [b]])
        assert np.all(np.where(true, g > 0.0, g < 0.0))


def test_a_residual_is_continuous_and_a_jump_is_small():
    """x goes from -1 to 1 in steps of h. No residual changes by more than h in a step, but for
    rounding. A number that jumps also changes by 2e-9 times what its comparisons compare: here that
    is below 1e-8.
    """
    h = 1e-3
    for function in COMPOUND:
        for outcome, more in ((of_inputs(function), 1e-12), (of_inputs(jumping(function)), 1e-8)):
            values = np.array([
                outcome.residual(0.0, [], [], 0, 0, [], [[u], [0.4]])
                for u in np.arange(-1.0, 1.0, h)
            ])  # fmt: skip
            assert np.abs(np.diff(values, axis=0)).max() <= h + more


def test_a_comparison_with_nan_in_a_truth_is_false():
    def truth(x):
        return (x[0] > 0.0) | np.logical_not(np.sqrt(x[1]) > 2.0)

    for outcome in (of_inputs(truth), of_inputs(jumping(truth))):
        (g,) = outcome.residual(0.0, [], [], 0, 0, [], [[-1.0], [-1.0]])
        assert g > 0.0  # the not of a false one


@pytest.mark.parametrize("mode", [0, 1])
def test_a_held_truth_chooses(mode):
    outcome = traced(lambda t, s: np.logical_and(s.mode == 1, s.continuous_state[0] > 0.25))
    (g,) = outcome.residual(0.0, [2.0, 0.0], [], mode, 0, [], [])
    assert g == (1.75 if mode == 1 else -1.0)


@pytest.mark.parametrize(
    "function",
    [
        lambda x: x[0] == x[1],
        lambda x: (x[0] < x[1]) & (x[1] != 0.0),
        lambda x: x[0] * 2.0,
        lambda x: np.where(x[0] < x[1], 1.0, 2.0),
    ],
)
def test_no_relation(function):
    outcome = of_inputs(function)
    assert outcome.residual is None
    assert outcome.relations is None


def test_a_known_truth_is_no_relation():
    outcome = of_inputs(lambda x: np.array([True, False]))
    assert outcome.boolean
    np.testing.assert_array_equal(outcome.residual(0.0, [], [], 0, 0, [], [[0.0], [0.0]]), [1, -1])
    assert outcome.relations is None


def test_mixed_senses_are_relations():
    outcome = of_inputs(lambda x: [x[0] < x[1], x[0] >= 0.0])
    assert outcome.relations.true_at_zero == (False, True)
