"""State machines in scene files: the same run as of the block in Python, and its mistakes."""

import json

import jsonschema
import numpy as np
import pytest
import saltus
from saltus.library import Integrator, Pulse, StateMachine, Transition
from saltus.scene_files import dumps, loads, schema

DOOR = """
version = 1
wires = ["bell -> door.call", "door.light -> lamp.in"]

[parameters]
least = 0.5
levels = [0.25, 2.0]

[blocks]
bell = { block = "Pulse", period = 5.0, phase_delay = 1.0, pulse_width = 0.1 }
lamp = { block = "Integrator" }

[blocks.door]
block = "StateMachine"
states = ["closed", "open", "broken"]
inputs = ["call"]
initial = "closed"
parameters = { most = "1 + 1" }
variables = { visits = 0, opened = "-least" }
entry = { open = { visits = "visits + 1", opened = "t" } }
exit = { open = { visits = "visits + 0.125" } }

[[blocks.door.transitions]]
source = "closed"
target = "open"
trigger = "call > least"

[[blocks.door.transitions]]
source = "open"
target = "closed"
after = "3 * least"
action = { visits = "visits + 0.5" }

[[blocks.door.transitions]]
source = "closed"
target = "broken"
guard = "visits >= most and since > 0.5"
priority = 1
name = "breaks"

[blocks.door.outputs]
light = "where(state == open, levels[1], 0)"
dark = { closed = "levels[0]", broken = 1 }

[outputs]
state = "door.state"
visits = "door.visits"
opened = "door.opened"
dark = "door.dark"
light = "lamp.out"

[run]
until = 20.0
"""


def in_python():
    """The same diagram."""
    door = StateMachine(
        ["closed", "open", "broken"],
        [
            Transition("closed", "open", trigger=lambda call, least: call > least),
            Transition(
                "open", "closed", after=1.5, action=lambda visits: {"visits": visits + 0.5}
            ),
            Transition(
                "closed", "broken", priority=1, name="breaks",
                guard=lambda visits, since, most: np.logical_and(visits >= most, since > 0.5),
            ),
        ],
        inputs=["call"],
        parameters={"most": 2.0, "least": 0.5},
        variables={"visits": 0.0, "opened": -0.5},
        entry={"open": lambda visits, time: {"visits": visits + 1, "opened": time}},
        exit={"open": lambda visits: {"visits": visits + 0.125}},
        outputs={"light": {"open": 2.0}, "dark": {"closed": 0.25, "broken": 1.0}},
        name="door",
    )  # fmt: skip
    builder = saltus.DiagramBuilder()
    bell = Pulse(period=5.0, phase_delay=1.0, pulse_width=0.1, name="bell")
    lamp = Integrator(name="lamp")
    builder.add(bell, lamp, door)
    builder.connect(bell.output(), door.input())
    builder.connect(door.output("light"), lamp.input())
    for name in ("state", "visits", "opened", "dark"):
        builder.export_output(door.output(name), name)
    builder.export_output(lamp.output(), "light")
    return builder.build()


def log(results):
    return [(event.name, event.kind, event.time) for event in results.events]


@pytest.mark.parametrize("method", ["dopri5", "taylor", "bdf"])
def test_it_runs_as_the_block_in_python(method):
    found = loads(DOOR).simulate(ode_solver_method=method)
    wanted = saltus.simulate(in_python(), (0.0, 20.0), ode_solver_method=method)
    assert log(found) == log(wanted)
    for name in ("state", "visits", "opened", "dark", "light"):
        assert np.array_equal(found[name], wanted[name]), name


def test_it_opens_and_breaks_when_its_sentences_say():
    """Opened at 1 and at 6 for 1.5 s: 1 + 0.125 + 0.5 visits each time; 3.25 >= 2 at 7.5, and it
    breaks half a second later. The lamp has burnt 2 * 1.5 s at 2."""
    results = loads(DOOR).simulate()
    times = {name: results.events.times(name).tolist() for name in ("closed_to_open", "breaks")}
    assert times["closed_to_open"][:2] == [1.0, 6.0]
    assert times["breaks"] == pytest.approx([8.0], abs=1e-12)
    assert results["visits"][-1] == 3.25
    assert results["light"][-1] == pytest.approx(6.0, abs=1e-9)
    assert results["state"][-1] == 2.0


@pytest.mark.parametrize("kind", ["toml", "json"])
def test_it_is_written_and_read_again(kind):
    scene = loads(DOOR)
    again = loads(dumps(scene, kind), kind)
    assert again == scene and log(again.simulate()) == log(scene.simulate())


def test_the_schema_takes_it():
    jsonschema.Draft202012Validator(schema()).validate(json.loads(dumps(loads(DOOR), "json")))


def test_parameters_that_it_reads_are_parameters_of_its_context():
    scene = loads(DOOR, least=0.75)
    assert scene.context[scene.system["door"]].parameters == {"most": 2.0, "least": 0.75}


@pytest.mark.parametrize(
    ("old", "new", "key", "message"),
    [
        ('source = "closed"\ntarget = "open"', 'source = "close"\ntarget = "open"',
         "blocks.door.transitions[0].source", "unknown state 'close'"),
        ('trigger = "call > least"', 'trigger = "call"',
         "blocks.door.transitions[0].trigger", "expected a truth such as 'call > 0.5'"),
        ('trigger = "call > least"', 'trigger = "cal > least"',
         "blocks.door.transitions[0].trigger", "unknown name 'cal'; did you mean 'call'"),
        ('trigger = "call > least"', 'triger = "call > least"',
         "blocks.door.transitions[0].triger", "unknown key 'triger'"),
        ('trigger = "call > least"', "", "blocks.door", "expected a guard, a trigger or a time"),
        ('after = "3 * least"', 'after = "call"', "blocks.door.transitions[1].after",
         "unknown name 'call'"),
        ('action = { visits = "visits + 0.5" }', 'action = { visit = "1" }',
         "blocks.door.transitions[1].action.visit", "unknown variable 'visit'"),
        ('action = { visits = "visits + 0.5" }', 'action = "visits + 0.5"',
         "blocks.door.transitions[1].action", "expected a table such as"),
        ('inputs = ["call"]', 'inputs = ["since"]', "blocks.door.inputs[0]", "'since' is a time"),
        ('inputs = ["call"]', 'inputs = "call"', "blocks.door.inputs", "expected a list"),
        ('inputs = ["call"]', 'inputs = ["open"]', "blocks.door.inputs[0]", "is a state already"),
        ('"open", "broken"]', '"open", "least"]', "blocks.door.states[2]",
         "is a parameter already"),
        ('initial = "closed"', 'initial = "shut"', "blocks.door.initial", "unknown state 'shut'"),
        ("entry = { open", "entry = { opens", "blocks.door.entry.opens", "unknown state 'opens'"),
        ("dark = { closed", "dark = { close", "blocks.door.outputs.dark.close", "unknown state"),
        ('"where(state == open, levels[1], 0)"', '"where(state == open, levels, 0)"',
         "blocks.door.outputs.light", "is a vector"),
    ],
)  # fmt: skip
def test_a_mistake_has_its_place(old, new, key, message):
    assert DOOR.count(old) == 1 or old == 'source = "closed"\ntarget = "open"'
    with pytest.raises(saltus.errors.SceneError) as caught:
        loads(DOOR.replace(old, new, 1))
    assert message in str(caught.value)
    assert caught.value.key == key
    assert caught.value.line is not None
