"""Guards with a delay, a priority and the like in scene files."""

import json

import jsonschema
import pytest
import saltus
from saltus.scene_files import dumps, loads, schema

TANK = """
version = 1
[parameters]
tau = 0.25
[states]
level = { start = 0, rate = 1 }
[discrete]
n = 0
[guards.empty]
guard = "level - 1"
direction = "rising"
set = { level = 0, n = "n + 1" }
delay = "tau + level"
priority = 2
persistent = true
initial_value = true
use_values_from_trigger_time = false
[run]
until = 4.0
event_seed = 3
"""


def log(scene):
    return [(e.name, e.kind, round(e.time, 9)) for e in scene.simulate().events]


PERIOD = [("empty", "scheduled", 1.0), ("empty", "executed", 2.25),
          ("empty", "scheduled", 3.25)]  # fmt: skip


def test_a_delay_is_an_expression():
    assert log(loads(TANK)) == PERIOD


@pytest.mark.parametrize("kind", ["toml", "json"])
def test_it_is_written_and_read_again(kind):
    scene = loads(TANK)
    again = loads(dumps(scene, kind), kind)
    assert again == scene and log(again) == PERIOD


def test_the_schema_takes_it():
    jsonschema.Draft202012Validator(schema()).validate(json.loads(dumps(loads(TANK), "json")))


TIE = """
version = 1
inputs = ["u"]
[states]
x = { start = 0, rate = 1 }
[discrete]
a = 0
b = 0
[guards.first]
guard = "x - 1"
direction = "rising"
set = { a = "b + 1" }
priority = "u"
[guards.second]
guard = "x - 1"
direction = "rising"
set = { b = "a + 1" }
priority = 5
"""


@pytest.mark.parametrize(("u", "values"), [(9.0, [1.0, 2.0]), (1.0, [2.0, 1.0])])
def test_a_priority_reads_the_inputs(u, values):
    scene = f"""
version = 1
wires = ["u -> tie"]
[systems.tie]{
        TIE.replace("version = 1", "")
        .replace("[", "[systems.tie.")
        .replace('inputs = [systems.tie."u"]', 'inputs = ["u"]')
    }
[blocks]
u = {{ block = "Constant", value = {u} }}
tie = {{ system = "tie" }}
[run]
until = 2.0
"""
    assert list(loads(scene).simulate().context.discrete_state) == values


MISTAKES = {
    "a truth as a text": ('persistent = true', 'persistent = "yes"', "expected true or false"),
    "an unknown name": ('"tau + level"', '"taw + level"', "taw"),
    "a negative delay": ('delay = "tau + level"', "delay = -1", "empty.*delay"),
    "no direction": ('direction = "rising"', "", "direction"),
    "no effect": ('set = { level = 0, n = "n + 1" }', "", "neither a reset map"),
    "a list": ("priority = 2", "priority = [1]", "priority"),
}  # fmt: skip


@pytest.mark.parametrize("what", MISTAKES)
def test_a_mistake_is_named(what):
    old, new, words = MISTAKES[what]
    assert old in TANK
    with pytest.raises(saltus.ModelError, match=words):
        loads(TANK.replace(old, new)).simulate()
