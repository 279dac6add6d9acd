"""Event wires in scene files: weights, delays, inner diagrams, and each kind of mistake."""

import json

import jsonschema
import pytest
import saltus
from file_models import bits
from saltus.errors import SceneError
from saltus.scene_files import dumps, loads, schema

DIGITS = """
[systems.digits]
inputs = ["u"]
discrete = { z = 0 }
[systems.digits.event_inputs.digit]
set = { z = "10 * z + weight + u" }
"""
SCENE = f"""
version = 1
wires = ["zero -> digits"]
event_wires = [
  "bell.rings -> digits.digit",
  {{ wire = "bell.rings -> digits.digit, digits.digit", weight = "2 * w", delay = "lag" }},
]
[parameters]
w = 1.0
lag = 0.25
[systems.bell.updates.rings]
period = 1.0
offset = 1.0
set = {{ n = "n + 1" }}
[systems.bell.discrete]
n = 0
{DIGITS}
[blocks]
bell = {{ system = "bell" }}
zero = {{ block = "Constant", value = 0.0 }}
digits = {{ system = "digits" }}
[run]
until = 1.5
record = ["digits.z", "bell.n"]
"""


def ends(scene, **options):
    return {name: rows[-1] for name, rows in scene.simulate(**options).outputs.items()}


def test_weight_and_delay_are_expressions_of_the_parameters():
    # at 1 s the digit 1, at 1.25 s twice the digit 2 w
    assert ends(loads(SCENE)) == {"digits.z": 122.0, "bell.n": 1.0}
    assert ends(loads(SCENE, w=2.0)) == {"digits.z": 144.0, "bell.n": 1.0}
    assert ends(loads(SCENE, lag=0.6)) == {"digits.z": 1.0, "bell.n": 1.0}


def test_the_reset_reads_the_inputs_of_its_block():
    assert ends(loads(SCENE.replace("value = 0.0", "value = 3.0")))["digits.z"] == 455.0


ENTRIES = """
version = 1
event_wires = [
  "bell.rings -> sums.in[0]",
  { wire = "bell.rings -> sums.in[2], sums.in[2]", weight = 5.0, delay = 0.25 },
]
[systems.bell.updates.rings]
at = [1.0, 2.0]
set = { n = "n + 1" }
[systems.bell.discrete]
n = 0
[systems.sums.discrete]
a = 0
b = 0
last = -1
[systems.sums.event_inputs.in]
size = 3
set = { a = "a + (weight if entry == 0 else 0)", b = "where(entry == 2, b + weight, b)", last = "entry" }
[blocks]
bell = { system = "bell" }
sums = { system = "sums" }
[run]
until = 2.125
record = ["sums.a", "sums.b", "sums.last"]
"""


@pytest.mark.parametrize("python", ["traced", "called"])
def test_an_event_input_of_a_size_knows_the_entry_of_the_wire(python):
    # two rings at entry 0, and twice 5 at entry 2 behind the first of them
    scene = loads(ENTRIES)
    assert ends(scene, python=python) == {"sums.a": 2.0, "sums.b": 10.0, "sums.last": 0.0}
    jsonschema.Draft202012Validator(schema()).validate(json.loads(dumps(scene, "json")))
    again = loads(dumps(scene, "toml"))
    assert again == scene and bits(again.simulate()) == bits(scene.simulate())


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("size = 3", "size = 0", "expected a whole number from 1 on, found 0"),
        (
            "size = 3",
            "size = 2",
            "event input 'in' has 2 entries; expected the number of one, 0 to 1, found 2",
        ),
        ("size = 3", "", "'entry'"),
        ("last = -1", "entry = -1", "choose another name for the state 'entry'"),
    ],
)
def test_mistakes_with_a_size(old, new, words):
    with pytest.raises(SceneError) as caught:
        loads(ENTRIES.replace(old, new))
    assert words in str(caught.value)


@pytest.mark.parametrize("kind", ["toml", "json"])
def test_it_is_written_and_read_again(kind):
    scene = loads(SCENE)
    again = loads(dumps(scene, kind), kind)
    assert again == scene and bits(again.simulate()) == bits(scene.simulate())


def test_the_schema_takes_it():
    jsonschema.Draft202012Validator(schema()).validate(json.loads(dumps(loads(SCENE), "json")))


NESTED = (
    """
version = 1
event_wires = ["tower.rings -> shed.digit"]
[systems.tower]
event_outputs = { rings = "bell.rings" }
[systems.tower.systems.bell]
updates = { rings = { period = 1.0, offset = 1.0, set = { n = "n + 1" } } }
discrete = { n = 0 }
[systems.tower.blocks]
bell = { system = "bell" }
[systems.shed]
event_inputs = { digit = "digits" }
wires = ["zero -> digits"]
[systems.shed.blocks]
zero = { block = "Constant", value = 0.0 }
digits = { system = "digits" }
[blocks]
tower = { system = "tower" }
shed = { system = "shed" }
[run]
until = 2.5
record = ["shed.digits.z"]
"""
    + DIGITS
)


def test_diagrams_show_events_and_event_inputs_of_their_blocks():
    assert ends(loads(NESTED)) == {"shed.digits.z": 11.0}


def test_a_mode_is_set_by_a_delivery_and_recorded_by_its_name():
    scene = loads("""
version = 1
event_wires = ["bell.rise -> lamp.light", "bell.fall -> lamp.dark"]
[systems.lamp]
modes = ["off", "on"]
event_inputs = { light = { set = { mode = "on" } }, dark = { set = { mode = "off" } } }
[blocks]
bell = { block = "Pulse", period = 2.0, phase_delay = 0.5 }
lamp = { system = "lamp" }
[run]
until = 3.0
save_at = [0.25, 1.0, 2.0, 3.0]
event_rows = false
record = ["lamp.mode", "lamp.on"]
""")
    outputs = scene.simulate().outputs
    assert outputs["lamp.mode"].tolist() == [0.0, 1.0, 0.0, 1.0]
    assert outputs["lamp.on"].tolist() == [0.0, 1.0, 0.0, 1.0]


def test_a_library_block_is_a_source_and_a_block_may_lead_to_itself():
    scene = loads("""
version = 1
event_wires = [{ wire = "clock.tick -> clock.again", weight = 0.5, delay = 0.5 }]
[systems.clock.states]
x = { start = 0.0, rate = 1.0 }
[systems.clock.guards.tick]
guard = "x - 1"
direction = "rising"
set = { x = 0.0 }
[systems.clock.event_inputs.again]
set = { x = "x + weight" }
[blocks]
clock = { system = "clock" }
[run]
until = 3.0
""")
    # x is 1 at t = 1, and 0.5 + 0.5 at each half second after it
    times = [event.time for event in scene.simulate(rtol=1e-10).events]
    assert times == pytest.approx([1.0, 1.5, 2.0, 2.5, 3.0], abs=1e-9)


# text to replace, its replacement, line, column, parts of the message
MISTAKES = {
    "no arrow": ('"bell.rings -> digits.digit",', '"bell.rings digits.digit",', 5, 3,
                 ["expected a wire such as 'first.fire -> second.synapse'"]),
    "unknown source block": ('"bell.rings -> digits.digit",', '"bel.rings -> digits.digit",', 5, 3,
                             ["unknown block 'bel'; did you mean 'bell'"]),
    "unknown event": ('"bell.rings -> digits.digit",', '"bell.ring -> digits.digit",', 5, 3,
                      ["'ring'; did you mean 'rings'"]),
    "unknown event input": ('"bell.rings -> digits.digit",', '"bell.rings -> digits.digits",', 5, 3,
                            ["no event input 'digits'; did you mean 'digit'"]),
    "an output in place of an event": ('"bell.rings -> digits.digit",', '"zero -> digits.digit",',
                                       5, 3, ["block 'zero' has 0 event outputs"]),
    "an entry of one event": ('"bell.rings -> digits.digit",', '"bell.rings[2] -> digits.digit",',
                              5, 3, ["rings"]),
    "unknown key": ("weight =", "wieght =", 6, 56, ["unknown key 'wieght'; did you mean 'weight'"]),
    "no wire": ('wire = "bell.rings -> digits.digit, digits.digit", ', "", 6, 3,
                ["expected a key 'wire'"]),
    "a wrong weight": ('"2 * w"', '"2 * v"', 6, 70, ["unknown name 'v'", "'w'"]),
    "a truth": ('"2 * w"', "true", 6, 56, ["expected an expression", "a truth"]),
    "a delay below zero": ('"lag"', "-0.5", 6, 5, ["delay -0.5 s; expected a finite time >= 0 s"]),
    "weight outside of an event input": ('"n + 1"', '"n + weight"', 14, 18,
                                         ["unknown name 'weight'"]),
    "an unknown state": ('set = { z =', 'set = { zz =', 22, 9, ["unknown state 'zz'"]),
    "an unknown name": ('10 * z + weight', '10 * z + wait', 22, 23, ["unknown name 'wait'", "weight"]),
    "no set": ('set = { z = "10 * z + weight + u" }', "", 21, 30, ["expected a key 'set'"]),
    "an option that is none": ('set = { z = "10 * z + weight + u" }', 'sizes = 3', 22, 1,
                               ["unknown key 'sizes'"]),
    "weight as a state": ('discrete = { z = 0 }', 'discrete = { z = 0, weight = 1 }', 21, 30,
                          ["choose another name for the state 'weight'"]),
    "below a header": ("[run]", '[run]\nevent_wires = ["bell -> digits"]', 29, 1,
                       ["write it above the first header"]),
}  # fmt: skip


@pytest.mark.parametrize("what", MISTAKES)
def test_a_mistake_has_its_place(what):
    old, new, line, column, words = MISTAKES[what]
    assert old in SCENE
    with pytest.raises(SceneError) as caught:
        loads(SCENE.replace(old, new, 1))
    for word in words:
        assert word in str(caught.value)
    assert (caught.value.line, caught.value.column) == (line, column), str(caught.value)


def test_wires_that_are_no_list():
    text = 'version = 1\nevent_wires = "a -> b"\nblocks = { c = { block = "Clock" } }'
    with pytest.raises(SceneError, match="expected a list of event wires") as caught:
        loads(text)
    assert (caught.value.line, caught.value.column) == (2, 1)


def test_a_leaf_has_no_event_wires():
    with pytest.raises(SceneError, match="'event_wires' of a scene without 'blocks'"):
        loads('version = 1\nevent_wires = ["a -> b"]\noutputs = { t = "t" }')


def test_a_subsystem_that_a_signal_executes_refuses_event_wires():
    text = SCENE.replace(
        'digits = { system = "digits" }',
        'digits = { block = "EnabledSubsystem", system = "digits" }',
    )
    with pytest.raises(saltus.ModelError, match="digits"):
        loads(text)
