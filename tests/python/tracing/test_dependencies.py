"""A tape whose dependencies have changed is not used: never a stale answer."""

import functools
import sys
import weakref
from types import SimpleNamespace

import numpy as np
import pytest
from saltus.tracing.sandbox.dependencies import entries
from tracing_cases import evaluate, reason, traced

G = 9.81
WEIGHTS = np.array([1.0, 2.0])
TABLE = {"k": [1.0, 2.0]}


def scale(a):
    return G * a


def by_helper(time, state):
    return scale(state.continuous_state)


def by_array(time, state):
    return WEIGHTS * state.continuous_state


def by_table(time, state):
    return TABLE["k"][1] * state.continuous_state


class Ball:
    bounciness = 0.5

    def __init__(self):
        self.e = 0.9
        self.weights = np.array([1.0, 2.0])
        self.inner = SimpleNamespace(k=2.0)
        self.kind = "rubber"
        self.nothing = None

    def reset(self, time, state):
        return -self.e * state.continuous_state

    def weigh(self, time, state):
        return self.weights @ state.continuous_state

    def deep(self, time, state):
        return self.inner.k * time

    def words(self, time, state):
        return time if self.kind == "rubber" and self.nothing is None else 2 * time

    def by_class(self, time, state):
        return self.bounciness * time

    def by_method(self, time, state):
        return self.helper(time)

    def helper(self, a):
        return 2.0 * a

    @property
    def doubled(self):
        return 2.0 * self.e

    def by_property(self, time, state):
        return self.doubled * time


def set_to(name, value):
    return lambda ball: setattr(ball, name, value)


def write_weights(ball):
    ball.weights[1] = 5.0


def write_inner(ball):
    ball.inner.k = 3.0


CHANGES = [
    ("reset", set_to("e", 0.8), "self.e was 0.9, is 0.8"),
    ("reset", set_to("e", -0.9), "self.e was 0.9, is -0.9"),
    ("reset", set_to("e", np.float64(0.9)), "self.e was 0.9, is np.float64(0.9)"),
    ("reset", lambda ball: delattr(ball, "e"), "self.e was 0.9, is not there"),
    ("weigh", write_weights, "self.weights changed in place"),
    (
        "weigh",
        set_to("weights", np.ones(2)),
        "self.weights was array([1., 2.]), is array(",
    ),
    ("deep", write_inner, "self.inner.k was 2.0, is 3.0"),
    ("deep", set_to("inner", SimpleNamespace(k=2.0)), "self.inner was namespace(k=2.0), is"),
    ("words", set_to("kind", "steel"), "self.kind was 'rubber', is 'steel'"),
    ("words", set_to("nothing", 3), "self.nothing was None, is 3"),
    ("by_class", set_to("bounciness", 0.7), "self.bounciness was not there, is 0.7"),
    ("by_method", set_to("helper", abs), "self.helper was not there, is abs"),
    ("by_property", set_to("e", 0.1), "self.e was 0.9, is 0.1"),
]


@pytest.mark.parametrize(("method", "change", "words"), CHANGES)
def test_attributes(method, change, words):
    ball = Ball()
    outcome = traced(getattr(ball, method).__func__, owner=ball)
    assert outcome.dependencies.changed() is None
    change(ball)
    assert outcome.dependencies.changed().startswith(words)


@pytest.mark.parametrize(
    ("method", "name", "value"),
    [
        ("by_class", "bounciness", 0.7),
        ("by_method", "helper", lambda self, a: a),
        ("by_property", "doubled", 3.0),
    ],
)
def test_classes(monkeypatch, method, name, value):
    ball = Ball()
    outcome = traced(getattr(ball, method).__func__, owner=ball)
    monkeypatch.setattr(Ball, name, value)
    assert outcome.dependencies.changed().startswith(f"self.{name} was ")


def test_globals(monkeypatch):
    outcomes = [traced(f) for f in (by_helper, by_array, by_table)]
    assert [outcome.dependencies.changed() for outcome in outcomes] == [None] * 3
    monkeypatch.setitem(globals(), "G", 1.62)
    assert outcomes[0].dependencies.changed() == "G was 9.81, is 1.62"
    monkeypatch.setitem(globals(), "G", 9.81)
    monkeypatch.setitem(globals(), "scale", np.abs)
    assert outcomes[0].dependencies.changed() == "scale was scale, is absolute"
    WEIGHTS[0] = 7.0
    assert outcomes[1].dependencies.changed() == "WEIGHTS changed in place"
    WEIGHTS[0] = 1.0
    TABLE["k"][1] = 7.0
    assert outcomes[2].dependencies.changed() == "TABLE changed in place"
    TABLE["k"][1] = 2.0
    assert outcomes[1].dependencies.changed() is outcomes[2].dependencies.changed() is None


def test_a_builtin_that_gets_another_meaning(monkeypatch):
    outcome = traced(lambda t, s: abs(t))
    monkeypatch.setitem(globals(), "abs", np.sqrt)
    assert outcome.dependencies.changed() == "abs was not there, is sqrt"


def test_closures_defaults_code_and_partials():
    factor, extra = 2.0, [1.0, 2.0]

    def function(time, state, scale=3.0, *, offset=1.0):
        return factor * time * scale + offset + extra[0]

    outcome = traced(function)
    assert outcome.dependencies.changed() is None
    factor = 4.0
    assert outcome.dependencies.changed() == "factor was 2.0, is 4.0"
    factor = 2.0
    extra[0] = 3.0
    assert outcome.dependencies.changed() == "extra changed in place"
    extra[0] = 1.0
    function.__defaults__ = (5.0,)
    assert outcome.dependencies.changed() == "defaults of function was (3.0,), is (5.0,)"
    function.__defaults__ = (3.0,)
    function.__kwdefaults__["offset"] = 2.0
    assert outcome.dependencies.changed() == "defaults of function changed in place"
    function.__kwdefaults__["offset"] = 1.0
    assert outcome.dependencies.changed() is None
    function.__code__ = (lambda time, state, scale, *, offset: (factor, extra, 0.0)[2]).__code__
    assert outcome.dependencies.changed().startswith("function was compiled from line ")

    partial = functools.partial(lambda k, t, s: k[0] * t, np.array([2.0]))
    outcome = traced(partial)
    partial.args[0][0] = 3.0
    assert outcome.dependencies.changed() == "partial changed in place"


def test_what_was_not_read_may_change():
    ball = Ball()
    outcome = traced(Ball.reset, owner=ball)
    ball.kind, ball.inner = "steel", None
    ball.weights[0] = 9.0
    ball.new = 3.0
    assert outcome.dependencies.changed() is None


def test_a_tape_keeps_the_values_it_was_made_from():
    ball = Ball()
    outcome = traced(Ball.weigh, owner=ball)
    ball.weights[:] = 0.0
    assert evaluate(outcome, [1.0, 1.0]) == 3.0
    assert evaluate(traced(Ball.weigh, owner=ball), [1.0, 1.0]) == 0.0


def test_zeros_of_both_signs_and_nan():
    ball = Ball()
    ball.e = 0.0
    outcome = traced(Ball.reset, owner=ball)
    ball.e = -0.0
    assert outcome.dependencies.changed() == "self.e was 0.0, is -0.0"

    ball.limit = float("nan")
    outcome = traced(lambda t, s: t if ball.limit != ball.limit else 0.0)
    ball.limit = float("nan")
    assert outcome.dependencies.changed() is None


def test_a_refusal_watches_too():
    flag = True

    def function(time, state):
        return time if flag or time > 0 else 0.0

    assert traced(function).dependencies.changed() is None
    flag = False
    assert "branches on a value" in reason(function)


def calls_in(function):
    """How many functions are called, in Python and in C."""
    count = 0

    def add(_frame, event, _arg):
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(add)
    try:
        function()
    finally:
        sys.setprofile(None)
    return count


def test_a_look_at_dependencies_reads_each_once():
    """A value costs its getter, which may be a function in Python that calls one in C."""
    ball = Ball()
    dependencies = traced(Ball.reset, owner=ball).dependencies
    overhead = 2  # `changed`, and the end of the profile
    assert calls_in(dependencies.changed) <= overhead + 3 * len(dependencies)


@pytest.mark.parametrize("container", [list, dict, "list in a list", "list in a dict"])
def test_the_look_at_a_container_that_has_grown_does_not_look_at_its_entries(container):
    """A callback may append at each call, a million times: its length says that it has changed."""
    grows = {} if container is dict else []
    holder = {"list in a list": [grows], "list in a dict": {"log": grows}}.get(container, grows)
    dependencies = traced(lambda t, s: t if not isinstance(holder, tuple) else 0.0).dependencies
    assert dependencies.changed() is None
    n = 20_000
    if container is dict:
        grows.update((k, float(k)) for k in range(n))
    else:
        grows.extend(range(n))
    assert "changed in place" in dependencies.changed()
    assert calls_in(dependencies.changed) < 100
    assert calls_in(lambda: entries(holder)) < 100


def test_a_second_trace_does_not_search_again():
    """A new function with the code of a traced one costs as many calls as the one before."""

    def once():
        def ode(time, state, **params):  # a new one: else its trace is kept
            _, v = state.continuous_state
            return np.array([v, -params["g"]])

        return traced(ode, parameters={"g": 9.81})

    once()  # fills what is made once
    counts = [calls_in(once) for _ in range(5)]
    assert max(counts) <= 1.1 * min(counts)
    assert max(counts) < 1700  # half as many with Python 3.11: one search, not two


def test_nothing_stays_alive_after_a_trace():
    ball = Ball()
    gone = weakref.ref(ball)
    outcome = traced(Ball.by_property, owner=ball)
    del ball
    assert gone() is None  # at once, without the garbage collector
    assert outcome.dependencies.changed() is None


def test_a_table_by_mode():
    following = [1, 2, 0]
    outcome = traced(lambda t, s: s.with_mode(following[s.mode]), kind="reset")
    assert [evaluate(outcome, [0.0, 0.0], mode=m)[0] for m in range(3)] == [1.0, 2.0, 0.0]
