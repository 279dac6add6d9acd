"""Events that one instant triggers are triggered together, whatever the roundings of its zeros."""

import pytest

pytest.importorskip("libsbml", reason="python-libsbml reads the models")

from saltus.sbml import time_course
from sbml_texts import model

SLOPES = [("rate", "x", "1"), ("rate", "y", "2")]
PAIRS = {
    "one state, two differences": ("x >= {0}", "2 * x >= 2 * {0}", SLOPES),
    "two states": ("x >= {0}", "y >= 2 * {0}", SLOPES),
    "strict": ("x > {0}", "y > 2 * {0}", SLOPES),
    "a state and a rule": ("x >= {0}", "r >= 3 * {0} + 1", [*SLOPES,
        ("assignment", "r", "3 * x + 1")]),
    "a state and the time": ("x >= {0}", "time >= {0}", SLOPES),
    "a state and an equality": ("x >= {0}", "eq(y, 2 * {0})", SLOPES),
    "two equalities": ("eq(x, {0})", "eq(y, 2 * {0})", SLOPES),
    "a large number": ("x >= {0}", "w >= 1000000 + {0}", [*SLOPES, ("rate", "w", "1")]),
    "a product": ("x >= {0}", "3 * (y - 2 * {0}) >= 0", SLOPES),
    "decays": ("u <= 10 * exp(-{0})", "v >= -10 * exp(-{0})",
               [("rate", "u", "-u"), ("rate", "v", "-v")]),
}  # fmt: skip
VALUES = {"x": 0, "y": 0, "u": 10, "v": -10, "w": 1_000_000, "n": 0, "m": 0, "c": 0, "s": 1}


def ends(rules, events, names=("n", "m"), **how):
    moved = {rule[1] for rule in rules if rule[0] == "assignment"}
    parameters = {**VALUES, **dict.fromkeys(moved)}
    text = model(parameters=parameters, rules=rules, events=events)
    return time_course(text, start=0, duration=9, steps=3, variables=list(names), **how)[
        -1, 1:
    ].tolist()


@pytest.mark.parametrize("threshold", ["5", "0.7", "3.3"])
@pytest.mark.parametrize("order", [1, -1])
@pytest.mark.parametrize("what", PAIRS)
def test_values_are_those_before_the_instant(what, order, threshold):
    """n := m + 10 and m := n + 1 at once, from n = m = 0, in either order of the triggers."""
    first, second, rules = PAIRS[what]
    first, second = (each.format(threshold) for each in (first, second)[::order])
    events = [
        dict(trigger=first, assign={"n": "m + 10", "c": "c + 1"}, priority="2"),
        dict(trigger=second, assign={"m": "n + 1", "s": "s + 1"}, priority="3"),
    ]
    assert ends(rules, events, "nmcs") == [10.0, 1.0, 1.0, 2.0]


@pytest.mark.parametrize("method", ["dopri5", "dop853", "bdf", "adams", "radau"])
def test_by_every_method(method):
    events = [
        dict(trigger="x >= 3.3", assign={"n": "m + 10"}, priority="2"),
        dict(trigger="y >= 6.6", assign={"m": "n + 1"}, priority="3"),
    ]
    assert ends(SLOPES, events, ode_solver_method=method) == [10.0, 1.0]


@pytest.mark.parametrize("threshold", ["5", "0.7", "3.3"])
def test_an_execution_that_is_due_waits_for_a_higher_priority(threshold):
    events = [
        dict(trigger="time >= 0", initial=False, delay=threshold, early=False, priority="3",
             assign={"m": "n + 1"}),
        dict(trigger=f"x >= {threshold}", priority="5", assign={"n": "m + 10"}),
    ]  # fmt: skip
    assert ends(SLOPES, events) == [10.0, 11.0]


@pytest.mark.parametrize("threshold", ["5", "0.7", "3.3"])
def test_a_trigger_that_turns_at_the_instant_becomes_false_again(threshold):
    """x reaches its threshold where the other event turns it around: it counts once, and the rate
    of d, 1 from then on only while x is above, stays 0.
    """
    rules = [("rate", "x", "s"), ("rate", "y", "2"),
             ("rate", "u", f"piecewise(1, x > {threshold}, 0)")]  # fmt: skip
    events = [
        dict(trigger=f"y >= 2 * {threshold}", assign={"s": "-1"}, priority="3"),
        dict(trigger=f"x >= {threshold}", assign={"n": "n + 1"}, priority="2"),
    ]
    assert ends(rules, events, "nsu") == pytest.approx([1.0, -1.0, 10.0], abs=1e-9)


def test_a_near_miss_is_no_crossing():
    """The top of x = 5 t - t^2 / 2 is 12.5 at 5; what is asked lies 1e-6 above it."""
    events = [
        dict(trigger="time >= 5", assign={"n": "m + 10"}),
        dict(trigger="x >= 12.500001", assign={"m": "n + 1"}),
    ]
    assert ends([("rate", "x", "5 - time")], events) == [10.0, 0.0]


def test_one_after_the_other_where_the_instants_differ():
    """1e-6 apart: the second sees what the first has assigned."""
    events = [
        dict(trigger="x >= 5", assign={"n": "m + 10"}, priority="2"),
        dict(trigger="y >= 10.000002", assign={"m": "n + 1"}, priority="3"),
    ]
    assert ends(SLOPES, events) == [10.0, 11.0]
