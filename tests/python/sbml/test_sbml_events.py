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
    ends = [after(TIE, "n", [1.5], seed=seed)[0] for seed in range(32)]
    assert set(ends) == {1.0, 2.0}
    assert ends == [after(TIE, "n", [1.5], seed=seed)[0] for seed in range(32)]


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


ENDLESS = counted([
    dict(trigger="n > 0.5", assign={"n": "0"}, name="down", initial=False),
    dict(trigger="n < 0.5", assign={"n": "1"}, name="up", initial=False)])  # fmt: skip
CROWD = counted([dict(trigger="sin(x * 100) > 0", assign=COUNT, delay="9", name="crowd")])
NEGATIVE = counted([dict(trigger="x > 1", assign=COUNT, delay="-1", name="early")])


@pytest.mark.parametrize(
    ("text", "words"),
    [(ENDLESS, "down, up"), (CROWD, "'crowd'.*32"), (NEGATIVE, "'early'.*negative")],
)
def test_events_without_end_are_named(text, words):
    with pytest.raises(saltus.SimulationError, match=words):
        after(text, "n", [4.0], max_minor_step_size=0.01)
