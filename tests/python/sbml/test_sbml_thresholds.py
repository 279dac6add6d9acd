"""Values that stop at a threshold, leave one slowly, or begin on one, by closed forms."""

import numpy as np
import pytest

pytest.importorskip("libsbml", reason="python-libsbml reads the models")

import saltus
from saltus.sbml import load, time_course
from sbml_texts import model

METHODS = ["auto", "dopri5", "dop853", "bdf", "adams", "radau"]
COUNT = {"n": "n + 1"}


def states(rates, events=(), **begin):
    """Rate rules by id, and a counter n; every number begins at 0 if not said."""
    names = {name: 0 for name in ("n", "m", "k", *rates)} | begin
    return model(parameters=names, rules=[("rate", *pair) for pair in rates.items()], events=events)


def on(trigger, assign=None, **how):
    return dict(trigger=trigger, assign=assign or COUNT, **how)


def rows_of(text, end, steps, *names, **how):
    table = time_course(text, start=0, duration=end, steps=steps, variables=list(names), **how)
    return table[:, 0], table[:, 1:]


# {what: (model, id, its closed form)}
STOPS = {
    "a cap": (states({"x": "piecewise(1, x < 1, 0)"}), "x", lambda t: np.minimum(t, 1)),
    "a cap that counts": (states({"x": "piecewise(1, x <= 1, 0)"}), "x",
        lambda t: np.minimum(t, 1)),
    "a cap the other way round": (states({"x": "piecewise(0, x >= 2, 0.25)"}), "x",
        lambda t: np.minimum(t / 4, 2)),
    "a floor": (states({"x": "piecewise(-1, x > 1, 0)"}, x=3), "x",
        lambda t: np.maximum(3 - t, 1)),
    "a cap that is no binary number": (states({"x": "piecewise(0.7, x < 0.3, 0)"}), "x",
        lambda t: np.minimum(0.7 * t, 0.3)),
    "a curve to a cap": (states({"x": "piecewise(exp(x), x < 1, 0)"}), "x",
        lambda t: np.where(t < 1 - np.exp(-1), -np.log(1 - np.minimum(t, 0.7)), 1)),
    "another value with it": (states({"x": "piecewise(-1, x > 0, 0)",
        "y": "piecewise(1, x > 0, 0)"}, x=2), "y", lambda t: np.minimum(t, 2)),
    "a cap that an event lifts": (states({"x": "piecewise(1, x < k, 0)"},
        [on("time >= 6", {"k": "3"})], k=2), "x",
        lambda t: np.where(t < 6, np.minimum(t, 2), np.minimum(t - 4, 3))),
    "a species that is used up": (model({"c": 4.0}, {"s": dict(amount=2.0)}, {"k": (0.5, True)},
        reactions=[dict(law="piecewise(k, s > 0, 0)", reactants=["s"])]), "s",
        lambda t: np.maximum(2 - t / 2, 0) / 4),
    "no trigger beyond it": (states({"x": "piecewise(1, x < 1, 0)"}, [on("x > 1")]), "n",
        lambda t: 0 * t),
    "a trigger at it": (states({"x": "piecewise(1, x < 1, 0)"}, [on("x >= 1")]), "n",
        lambda t: t >= 1),
}  # fmt: skip


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("what", STOPS)
def test_a_value_stops_at_its_threshold(what, method):
    """1e-6: the tolerances, and the width of a located time."""
    text, name, form = STOPS[what]
    t, found = rows_of(text, 10.0, 7, name, ode_solver_method=method)
    assert found[:, 0] == pytest.approx(form(t).astype(float), abs=1e-6)


def test_a_value_stops_in_a_run_without_rows_too():
    small = load(STOPS["a cap"][0])
    end = saltus.simulate(small, (0.0, 10.0), rtol=1e-9, atol=1e-13).context
    assert end.continuous_state[0] == pytest.approx(1.0, abs=1e-9)


PUT = [on("time >= 2.5", {"x": "5", "k": "0"})]
# {what: (model, executions of the event at the end)}: x comes to 5 and rests there
RESTS = {
    "below": (states({"x": "k"}, [*PUT, on("x < 5")], x=10, k=-1), 0),
    "above": (states({"x": "k"}, [*PUT, on("x > 5")], k=1), 0),
    "below or at": (states({"x": "k"}, [*PUT, on("x <= 5")], x=10, k=-1), 1),
    "beside an equality": (states({"x": "k"}, [*PUT, on("x < 5"), on("eq(x, 5)", {"m": "1"})],
        x=10, k=-1), 0),
    "an equality": (states({"x": "k"}, [*PUT, on("eq(x, 5)")], x=10, k=-1), 1),
    "an equilibrium": (states({"x": "5 - x"}, [*PUT, on("x < 5"), on("x > 5")], x=10), 0),
    "stopped by its own event": (states({"x": "k"}, [on("x <= 5", {"k": "0"}), on("x < 5")],
        x=10, k=-1), 0),
    "stopped by an equality": (states({"x": "k"}, [on("eq(x, 5)", {"k": "0", "n": "n + 1"})],
        x=10, k=-1), 1),
    "turned around": (states({"x": "k"}, [on("x <= 5", {"k": "1"}), on("x < 5")], x=8, k=-1), 0),
}  # fmt: skip


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("what", RESTS)
def test_a_value_rests_on_a_threshold(what, method):
    text, expected = RESTS[what]
    assert rows_of(text, 9.7, 7, "n", ode_solver_method=method)[1][-1, 0] == expected


@pytest.mark.parametrize("method", ["auto", "dopri5", "dop853", "radau"])
@pytest.mark.parametrize("rate", [1.0, -0.7, 13.7])
@pytest.mark.parametrize("threshold", [0.3, 3.3, 5.0])
@pytest.mark.parametrize("stop", ["x <= {0}", "eq(x, {0})"])
def test_a_value_that_rests_goes_on(stop, threshold, rate, method):
    """Stopped from above, by a rounding beyond or before it, it goes on downwards or back."""
    events = [
        on(stop.format(threshold), {"k": "0"}),
        on("time >= 15", {"k": f"{-rate}"}),
        on(f"x < {threshold}"),
        on(f"x > {threshold}", {"m": "m + 1"}),
    ]
    text = states({"x": "k"}, events, x=10, k=-abs(rate))
    found = rows_of(text, 18.0, 6, "n", "m", ode_solver_method=method)[1]
    assert found[-1].tolist() == ([1.0, 0.0] if rate > 0 else [0.0, 1.0])


# {what: model}: the event is executed once, just after the start or the jump to the threshold
LEAVES = {
    "a parabola in the time": states({"x": "2 * time"}, [on("x > 0")]),
    "a parabola in a state": states({"x": "y", "y": "1"}, [on("x > 0")]),
    "a cubic": states({"x": "time^2"}, [on("x > 0")]),
    "downwards": states({"x": "-2 * time"}, [on("x < 0")]),
    "a parabola from a large number": states({"x": "2 * time"}, [on("x > 5")], x=5),
    "an equality ends": states({"x": "2 * time"}, [on("neq(x, 5)")], x=5),
    "an equality ends downwards": states({"x": "-2 * time"}, [on("!eq(x, 0.3)")], x=0.3),
    "initially false": states({"x": "2 * time"}, [on("x > 0", initial=False)]),
    "the end of a chain": model({"c": 1.0}, {"a": dict(amount=10), "b": dict(amount=0.0),
        "p": dict(amount=0.0)}, {"n": 0}, reactions=[
        dict(law="a", reactants=["a"], products=["b"], name="r"),
        dict(law="b", reactants=["b"], products=["p"], name="q")], events=[on("p > 0")]),
}  # fmt: skip


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("what", LEAVES)
def test_a_value_leaves_its_threshold_with_slope_zero(what, method):
    text = LEAVES[what]
    assert rows_of(text, 10.0, 4, "n", ode_solver_method=method)[1][1:, 0].tolist() == [1.0] * 4


@pytest.mark.parametrize("method", ["auto", "dopri5", "dop853", "radau"])
def test_a_value_leaves_slowly_after_a_jump(method):
    """Here bdf and adams may count twice: the error of their first step passes zero again."""
    events = [on("time >= 1", {"x": "0"}), on("x > 0")]
    text = states({"x": "2 * (time - 1)"}, events, x=-5)
    assert rows_of(text, 10.0, 4, "n", ode_solver_method=method)[1][1:, 0].tolist() == [1.0] * 4


# {trigger: time at which it becomes true first}, with x = time
JUMPS = {
    "ceil(x / 2) > 2": 4, "ceil(x / 2) > 1": 2, "ceil(x / 2) >= 3": 4, "ceil(time / 2) > 2": 4,
    "floor(x) > 3": 4, "floor(time) > 3": 4, "floor(x / 2) >= 2": 4, "floor(x) - 3 > 0": 4,
    "floor(10 - x) < 3": 7, "floor(10 - x) <= 3": 6, "ceil(10 - x) < 3": 8,
    "ceil(10 - x) <= 3": 7, "floor(x) + ceil(x) > 6": 3, "quotient(x, 2) > 1": 4,
    "rem(x, 6) >= 3": 3, "rem(x + 3, 7) < 1": 4,
}  # fmt: skip


@pytest.mark.parametrize("trigger", JUMPS)
def test_a_comparison_of_a_floor_changes_where_it_jumps(trigger):
    text = states({"x": "1"}, [on(trigger, {"n": "x"})], n=-1)
    found = rows_of(text, 8.5, 17, "n")[1][:, 0]
    assert found[-1] == pytest.approx(JUMPS[trigger], abs=1e-6)


LIGHT = ["time - 24 * floor(time / 24) < 12", "rem(time, 24) < 12",
         "quotient(time, 12) - 2 * quotient(time, 24) < 1",
         "eq(floor(time / 12) - 2 * floor(time / 24), 0)"]  # fmt: skip


@pytest.mark.parametrize("trigger", LIGHT)
@pytest.mark.parametrize("steps", [20, 240])
def test_days_and_nights(trigger, steps):
    """x grows by 1 an hour in the first 12 hours of each day."""
    light = ("assignment", "light", f"piecewise(1, {trigger}, 0)")
    text = model(parameters={"x": 0, "light": None}, rules=[light, ("rate", "x", "light")])
    t, found = rows_of(text, 240.0, steps, "x")
    days, hours = np.divmod(t, 24.0)
    assert found[:, 0] == pytest.approx(12 * days + np.minimum(hours, 12), abs=1e-6)


@pytest.mark.parametrize("scale", [1e-15, 1e-10, 1e-3, 1.0, 1e6])
def test_a_comparison_of_the_time_alone_by_numbers_of_any_size(scale):
    text = states({"x": "1"}, [on(f"{scale!r} * time > 5 * {scale!r}", {"n": "x"})])
    assert rows_of(text, 10.0, 4, "n")[1][-1, 0] == pytest.approx(5.0, abs=1e-9)


def test_a_decay_in_the_time_alone_to_a_small_number():
    rules = [("assignment", "y", "1e-12 * exp(-time / 10)"), ("rate", "x", "1")]
    events = [on("y < 5e-13", {"n": "x"})]
    text = model(parameters={"y": None, "x": 0, "n": 0}, events=events, rules=rules)
    assert rows_of(text, 20.0, 10, "n")[1][-1, 0] == pytest.approx(10 * np.log(2), abs=1e-6)


@pytest.mark.parametrize("moving", ["x", "time"])
def test_a_truth_of_one_moment(moving):
    """Without an equality: each comparison counts zero to another side."""
    both = f"{moving} >= 4 && {moving} <= 4"
    text = states({"x": "1"}, [on(both), on(f"!({both})", {"m": "m + 1"})])
    assert rows_of(text, 10.0, 3, "n", "m")[1][-1].tolist() == [1.0, 1.0]


@pytest.mark.parametrize("moving", ["x", "time"])
def test_a_strict_comparison_beside_one_that_is_not(moving):
    """One after the other: the second sees the assignment of the first."""
    events = [on(f"{moving} >= 4", {"n": "m + 1"}, priority="1"),
              on(f"{moving} > 4", {"m": "n + 1"}, priority="2")]  # fmt: skip
    found = rows_of(states({"x": "1"}, events), 10.0, 3, "n", "m")[1][-1]
    assert found.tolist() == [1.0, 2.0]


# {what: (model, n at time 0 and after it)}
BEGINS = {
    "a state": (states({"x": "1.5"}, [on("x > 1")], x=1), [0, 1]),
    "the time": (states({"x": "1"}, [on("time > 0")]), [0, 1]),
    "the time, denied": (states({"x": "1"}, [on("!(0 >= time)")]), [0, 1]),
    "beside an equality": (states({"x": "2"}, [on("!(0 >= time)"), on("eq(x, -3)")], x=-2), [0, 1]),
    "the time, at once": (states({"x": "1"}, [on("time >= 0", initial=False)]), [1, 1]),
    "after an event of the start": (states({"x": "1"}, [
        on("time >= 0", {"x": "2"}, initial=False), on("x > 2")]), [0, 1]),
}  # fmt: skip


@pytest.mark.parametrize("what", BEGINS)
def test_the_row_of_the_start_is_that_of_time_zero(what):
    text, expected = BEGINS[what]
    assert rows_of(text, 1.0, 4, "n")[1][:, 0].tolist() == [expected[0], *[expected[1]] * 4]


def test_an_execution_at_the_start_that_turns_a_difference_around():
    """m is 0, that of the time, when the run begins, and 2 when what is due has been executed."""
    events = [
        on("x > -1", {"m": "2"}, initial=False, delay="time / 4"),
        on("m > time || x > 1", {"n": "n + 1"}, initial=False),
    ]
    assert rows_of(states({"x": "1"}, events), 1.5, 3, "n")[1][:, 0].tolist() == [1.0] * 4


def test_rows_at_sums_of_decimal_numbers_have_what_happens_there():
    """0.1 + 0.1 + ... is a rounding from the row of the same name."""
    text = model(parameters={"t": 0.1, "n": 0},
                 events=[on("time >= t", {"t": "t + 0.1", "n": "n + 1"})])  # fmt: skip
    t, found = rows_of(text, 2.0, 20, "n")
    assert found[:, 0].tolist() == np.round(10 * t).tolist()


@pytest.mark.parametrize("names", [("a", "b"), ("b", "a")])
def test_an_algebraic_rule_determines_a_number_without_a_value(names):
    """Of two that it could determine; the other one keeps its value."""
    given, free = names
    text = model(
        parameters={given: 3.0, free: None}, rules=[("algebraic", f"{given} - 2 * {free}")]
    )
    assert rows_of(text, 1.0, 1, given, free)[1][-1].tolist() == [3.0, 1.5]


@pytest.mark.parametrize(
    "wrong", [{"steps": 2.5}, {"steps": "5"}, {"start": "0"}, {"duration": None}]
)
def test_rows_of_the_wrong_kind_are_refused(wrong):
    how = {"start": 0, "duration": 1, "steps": 4, "variables": ["x"]} | wrong
    with pytest.raises(saltus.ModelError, match="time_course: expected numbers"):
        time_course(states({"x": "1"}), **how)


def test_values_that_are_no_dict_are_refused():
    with pytest.raises(saltus.ModelError, match="expected a dict"):
        load(states({"x": "1"}), values=[1])
