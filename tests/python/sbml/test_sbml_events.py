"""The events of a model in SBML: each rule of level 3 version 2, section 4.11, by a closed form."""

import pytest

pytest.importorskip("libsbml", reason="python-libsbml reads the models")

import saltus
from saltus.sbml import load, time_course
from sbml_texts import model


def after(text, name, times, **how):
    """The values of an id at times that are multiples of 0.125."""
    steps = round(max(times) / 0.125)
    table = time_course(text, start=0, duration=max(times), steps=steps, variables=[name], **how)
    return [table[round(t / 0.125), 1] for t in times]


def counted(events, **more):
    """A model that counts in n, with the time as a state x."""
    return model(parameters={"x": 0, "n": 0, "m": 0, "d": 1, **more}, rules=[("rate", "x", "1")],
                 events=events)  # fmt: skip


COUNT = {"n": "n + 1"}
PULSE = "time > 1 && time < 1.5"

# (what, model, id, {time: value})
RULES = {
    "a trigger that becomes true": (counted([dict(trigger="x > 1", assign=COUNT)]), "n",
                                    {0.75: 0, 1.25: 1, 2: 1}),
    "at each rise": (counted([dict(trigger="sin(x * 2 * pi) > 0.5", assign=COUNT)]), "n",
                     {0.5: 1, 1.5: 2, 2.5: 3}),
    "at the start, initially false": (counted([dict(trigger="x < 1", assign=COUNT,
        initial=False)]), "n", {0.125: 1, 2: 1}),
    "at the start, initially true": (counted([dict(trigger="x < 1", assign=COUNT)]), "n",
                                     {0.125: 0, 2: 0}),
    "not before it: time >= 1": (counted([dict(trigger="time >= 1", assign=COUNT)]), "n",
                                 {0.875: 0, 1: 1}),
    "not at it: time > 1": (counted([dict(trigger="time > 1", assign=COUNT)]), "n",
                            {1: 0, 1.125: 1}),
    "a delay": (counted([dict(trigger="x > 1", assign=COUNT, delay="0.5")]), "n",
                {1.375: 0, 1.625: 1}),
    "a delay evaluated at the trigger": (counted([
        dict(trigger="x > 1", assign=COUNT, delay="d"),
        dict(trigger="x > 1.25", assign={"d": "9"})]), "n", {1.875: 0, 2.125: 1}),
    "values from the trigger": (counted([dict(trigger="x > 1", assign={"n": "x"}, delay="1")]),
                                "n", {2.125: 1.0}),
    "values from the execution": (counted([dict(trigger="x > 1", assign={"n": "x"}, delay="1",
        early=False)]), "n", {2.125: 2.0}),
    "several wait": (counted([dict(trigger="sin(x * 2 * pi) > 0.5", assign=COUNT, delay="2.5",
        early=False)]),
                     "n", {2.5: 0, 3: 1, 4: 2, 5: 3}),
    "persistent": (counted([dict(trigger=PULSE, assign=COUNT, delay="1")]), "n", {2.5: 1}),
    "not persistent": (counted([dict(trigger=PULSE, assign=COUNT, delay="1", persistent=False)]),
                       "n", {2.5: 0}),
    "not persistent, in time": (counted([dict(trigger=PULSE, assign=COUNT, delay="0.25",
        persistent=False)]), "n", {2.5: 1}),
    "cancelled by another at the same time": (counted([
        dict(trigger="time >= 1 && m < 1", assign=COUNT, persistent=False, priority="1"),
        dict(trigger="time >= 1", assign={"m": "1"}, priority="2")]), "n", {1.5: 0}),
    "priorities": (counted([
        dict(trigger="time >= 1", assign={"n": "n * 2"}, priority="1", early=False),
        dict(trigger="time >= 1", assign={"n": "n + 3"}, priority="2", early=False)]), "n",
        {1.5: 6}),
    "priorities evaluated anew": (counted([
        dict(trigger="time >= 1", assign={"m": "5"}, priority="10"),
        dict(trigger="time >= 1", assign={"n": "n + 3"}, priority="2", early=False),
        dict(trigger="time >= 1", assign={"n": "n * 2"}, priority="m", early=False)]), "n",
        {1.5: 3}),
    "an event that triggers another": (counted([
        dict(trigger="time >= 1", assign={"m": "1"}), dict(trigger="m > 0.5", assign=COUNT)]),
        "n", {0.875: 0, 1: 1}),
    "values of all that trigger at once are those before": (counted([
        dict(trigger="time >= 1", assign={"n": "m + 1"}),
        dict(trigger="time >= 1", assign={"m": "n + 1"})]), "n", {1: 1}),
    "assignments of one event are simultaneous": (model(parameters={"a": 1, "b": 2}, events=[
        dict(trigger="time >= 1", assign={"a": "b", "b": "a"})]), "b", {1: 1}),
    "a state is reset": (counted([dict(trigger="x >= 1", assign={"x": "0"})]), "x",
                         {0.5: 0.5, 1.5: 0.5, 2.5: 0.5}),
    "without a trigger's mathematics": (counted([dict(trigger=None, assign=COUNT)]), "n", {2: 0}),
    "a delay of zero": (counted([dict(trigger="time >= 1", assign=COUNT, delay="0")]), "n",
                        {1: 1}),
    "a trigger made of parameters": (counted([dict(trigger="d > 0", assign=COUNT,
        initial=False)]), "n", {0.5: 1}),
    "equality in passing": (counted([dict(trigger="eq(time, 1)", assign=COUNT)]), "n",
                            {0.75: 0, 1.25: 1}),
    "an amount stays where a compartment jumps": (model({"c": 1.0}, {"s": dict(amount=6.0)},
        events=[dict(trigger="time >= 1", assign={"c": "2"})]), "s", {0.5: 6, 1.5: 3}),
    "a concentration is assigned": (model({"c": 2.0}, {"s": dict(amount=6.0)}, events=[
        dict(trigger="time >= 1", assign={"s": "7"})]), "s", {0.5: 3, 1.5: 7}),
    "a concentration assigned in the size before": (model({"c": 2.0}, {"s": dict(amount=6.0)},
        events=[dict(trigger="time >= 1", assign={"s": "4", "c": "1"})]), "s", {1.5: 8}),
    "a piecewise of the state after a reset": (model(parameters={"x": 0}, rules=[
        ("rate", "x", "piecewise(1, x < 0.5, 2)")], events=[
            dict(trigger="x >= 1", assign={"x": "0"})]), "x", {0.5: 0.5, 1.25: 0.5}),
}  # fmt: skip


@pytest.mark.parametrize("what", RULES)
def test_rule(what):
    text, name, expected = RULES[what]
    assert after(text, name, list(expected)) == pytest.approx(
        list(expected.values()), rel=1e-7, abs=1e-7
    )


TIE = counted([
    dict(trigger="time >= 1", assign={"n": "1"}, priority="1"),
    dict(trigger="time >= 1", assign={"n": "2"}, priority="1")])  # fmt: skip


def test_ties_are_random_by_seed():
    """Of 32 fair draws all are equal in one of 2^31 worlds; the seeds are those of this one."""
    ends = [after(TIE, "n", [1.5], event_seed=seed)[0] for seed in range(32)]
    assert set(ends) == {1.0, 2.0}
    assert ends == [after(TIE, "n", [1.5], event_seed=seed)[0] for seed in range(32)]


def test_a_queue_is_part_of_a_context():
    """A run in two parts has the events of one."""
    text = counted([dict(trigger="x > 1", assign={"n": "x"}, delay="1")])
    small = load(text)
    shown = {"n": small.output("n")}
    first = saltus.simulate(small, (0.0, 1.5), recorded_signals=shown)
    second = saltus.simulate(small, first.context, (1.5, 3.0), recorded_signals=shown)
    whole = saltus.simulate(small, (0.0, 3.0), recorded_signals=shown)
    assert first["n"][-1] == 0.0
    assert second["n"][-1] == whole["n"][-1] == pytest.approx(1.0, abs=1e-6)


def log_of(text, end, **how):
    events = saltus.simulate(load(text), (0.0, end), **how).events
    return [(event.name, event.kind, round(event.time, 6)) for event in events]


def test_the_log_has_the_rows_of_the_queue():
    text = counted([dict(trigger="x > 1", assign=COUNT, delay="0.5", name="late")])
    rows = [row for row in log_of(text, 3.0) if row[0] == "late"]
    assert rows == [("late", "scheduled", 1.0), ("late", "executed", 1.5)]


def test_the_log_has_cancelled_executions():
    text = counted([dict(trigger=PULSE, assign=COUNT, delay="1", persistent=False, name="late")])
    rows = [row for row in log_of(text, 3.0) if row[0] == "late"]
    assert rows == [("late", "scheduled", 1.0), ("late", "cancelled", 1.5)]


def test_no_callback_is_called():
    """All that happens is a tape."""
    text = counted([
        dict(trigger="x > 1 && eq(time, 2)", assign={"x": "n"}, delay="d", priority="n"),
        dict(trigger="x > 1", assign=COUNT, persistent=False)])  # fmt: skip
    assert {each.runs for each in load(text).explain()} == {"traced"}


def test_an_event_may_have_any_id():
    events = [dict(trigger="x > 1", assign=COUNT, name=name)
              for name in ("start", "comparisons", "events", "E")]  # fmt: skip
    rows = [row for row in log_of(counted(events), 2.0) if row[1] == "executed"]
    assert sorted(row[0] for row in rows) == ["E", "comparisons", "events", "start"]


@pytest.mark.parametrize("persistent", [True, False])
def test_an_equality_counts_once_with_what_is_due(persistent):
    """It is true at its instant, until all that is due has been executed."""
    text = counted([dict(trigger="eq(x, 1)", assign=COUNT, persistent=persistent)])
    assert after(text, "n", [0.75, 1.25, 2.0]) == [0.0, 1.0, 1.0]


def test_a_jump_across_an_equality_is_no_equality():
    text = counted([dict(trigger="time >= 1", assign={"x": "5"}),
                    dict(trigger="eq(x, 3)", assign=COUNT)])  # fmt: skip
    assert after(text, "n", [0.75, 1.25, 2.0]) == [0.0, 0.0, 0.0]


def test_a_value_that_is_that_of_the_trigger_is_assigned():
    """m is 0 at the trigger, when it is computed that it becomes 0, and 7 before the execution."""
    text = counted([dict(trigger="x > 1", assign={"m": "0"}, delay="1"),
                    dict(trigger="x > 1.5", assign={"m": "7"})])  # fmt: skip
    assert after(text, "m", [0.5, 1.75, 2.25]) == [0.0, 7.0, 0.0]


def test_any_number_of_executions_waits():
    text = counted([dict(trigger="sin(x * 100) > 0", assign=COUNT, delay="9", early=False)])
    assert after(text, "n", [12.5], max_minor_step_size=0.01) == [56.0]


def test_hundreds_are_executed_at_one_time():
    """Each is followed by a pass of assignments, more than max_passes in all."""
    events = [dict(trigger="time >= 1", assign=COUNT, early=False) for _ in range(150)]
    assert after(counted(events), "n", [1.5]) == [150.0]


ENDLESS = counted([
    dict(trigger="n > 0.5", assign={"n": "0"}, name="down", initial=False),
    dict(trigger="n < 0.5", assign={"n": "1"}, name="up", initial=False)])  # fmt: skip
NEGATIVE = counted([dict(trigger="x > 1", assign=COUNT, delay="-1", name="early")])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (ENDLESS, "'small.up' -> 'small.values assigned' -> 'small.down'"),
        (NEGATIVE, "early' is -1 s"),
    ],
)
def test_events_without_end_are_named(text, words):
    with pytest.raises(saltus.SimulationError, match=words):
        after(text, "n", [4.0], max_minor_step_size=0.01)
