"""Comparisons become smooth differences with the signs of a Relation."""

import itertools

import numpy as np
import pytest
from tracing_cases import evaluate, traced

SCALAR = [(), ()]
POINTS = [(0.3, 0.7), (0.7, 0.3), (0.5, 0.5), (-1.0, 1.0), (0.0, 0.0)]


def of_inputs(function, shapes=SCALAR):
    return traced(function, convention="inputs", input_shapes=shapes)


@pytest.mark.parametrize(
    ("function", "sign", "at_zero"),
    [
        (lambda x: x[0] < x[1], -1.0, False),
        (lambda x: x[0] <= x[1], -1.0, True),
        (lambda x: x[0] > x[1], 1.0, False),
        (lambda x: x[0] >= x[1], 1.0, True),
        (lambda x: np.less(x[0], x[1]), -1.0, False),
        (lambda x: np.logical_not(x[0] < x[1]), 1.0, True),
        (lambda x: bool(x[0] > x[1]), 1.0, False),
    ],
)
def test_one_comparison(function, sign, at_zero):
    outcome = of_inputs(function)
    assert outcome.boolean
    assert outcome.shape == ()
    difference, true_at_zero = outcome.comparison
    assert true_at_zero is at_zero
    for a, b in POINTS:
        (g,) = difference(0.0, [], [], 0, 0, [], [[a], [b]])
        assert g == sign * (a - b)
        assert function((a, b)) == (g > 0 or (g == 0 and at_zero))
        assert evaluate(outcome, [], u=[[a], [b]]) == function((a, b))


def test_entry_by_entry():
    outcome = of_inputs(lambda x: x[0] > x[1], [(3,), ()])
    difference, true_at_zero = outcome.comparison
    found = difference(0.0, [], [], 0, 0, [], [[1.0, 2.0, 3.0], [2.0]])
    np.testing.assert_array_equal(found, [-1.0, 0.0, 1.0])
    assert outcome.shape == (3,)
    assert not true_at_zero


def test_of_a_state():
    outcome = traced(lambda t, s: s.continuous_state[0] ** 2 > np.sin(t))
    (g,) = outcome.comparison[0](1.0, [0.5, 0.0], [], 0, 0, [], [])
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
    outcome = of_inputs(function)
    relations = outcome.relations
    assert outcome.boolean
    assert relations.truth.reads in (["discrete_state"], [])
    for a, b in itertools.product((-0.3, 0.2, 0.5, 0.55, 0.7), repeat=2):
        g = relations.differences(0.0, [], [], 0, 0, [], [[a], [b]])
        at_zero = np.array(relations.true_at_zero)
        truths = np.where(g == 0.0, at_zero, g > 0.0).astype(float)
        found = relations.truth(0.0, [], truths, 0, 0, [], [])
        np.testing.assert_array_equal(found, np.ravel(function((a, b))).astype(float))


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
    assert outcome.comparison is None
    assert outcome.relations is None


def test_a_known_truth_is_no_relation():
    outcome = of_inputs(lambda x: np.array([True, False]))
    assert outcome.boolean
    assert outcome.comparison is None
    assert outcome.relations is None


def test_mixed_senses_are_relations_but_no_single_comparison():
    outcome = of_inputs(lambda x: [x[0] < x[1], x[0] >= 0.0])
    assert outcome.comparison is None
    assert outcome.relations.true_at_zero == (False, True)
