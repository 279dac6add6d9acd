"""The JSON Schema takes every example, and refuses what the loader refuses by its form."""

import json

import jsonschema
import pytest
import saltus
from file_models import FILES, FOLDER
from saltus import library
from saltus.scene_files import dumps, first_scene, loads, schema
from saltus.scene_files.files import SCHEMA
from saltus.scene_files.leaf_guards import GUARD_KEYS
from saltus.scene_files.root import ROOT_KEYS
from saltus.scene_files.run import KEYS as RUN_KEYS
from saltus.scene_files.systems import SYSTEM_KEYS

BALL = json.loads(dumps(loads(first_scene()), "json"))
GAIN = {"version": 1, "blocks": {"a": {"block": "Gain", "gain": 2.0}}}


@pytest.fixture(scope="module", params=["with the blocks", "as a file"])
def validator(request):
    whole = schema() if request.param == "with the blocks" else json.loads(SCHEMA.read_text())
    jsonschema.Draft202012Validator.check_schema(whole)
    return jsonschema.Draft202012Validator(whole)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_the_examples_are_accepted(validator, file):
    validator.validate(json.loads(dumps(saltus.load_scene(file), "json")))


def test_the_first_scene_is_accepted(validator):
    validator.validate(BALL)


WRONG = {
    "no version": {"states": {"v": {}}},
    "another version": {**BALL, "version": 2},
    "no system": {"version": 1},
    "unknown table": {**BALL, "stats": {}},
    "unknown key of a state": {**BALL, "states": {"v": {"rat": 1}}},
    "text in place of a state": {**BALL, "states": {"v": "-g"}},
    "a table as an expression": {**BALL, "states": {"v": {"rate": {}}}},
    "a name with a dot": {**GAIN, "blocks": {"a.b": {"block": "Clock"}}},
    "neither block nor system": {**GAIN, "blocks": {"a": {"gain": 2.0}}},
    "a wire without an arrow": {**GAIN, "wires": ["a b"]},
    "wires as text": {**GAIN, "wires": "a -> b"},
    "unknown direction": {**BALL, "guards": {"g": {"guard": "y", "direction": "down"}}},
    "a guard without a guard": {**BALL, "guards": {"g": {"direction": "falling"}}},
    "an update that sets nothing": {**BALL, "updates": {"u": {"period": 1}}},
    "an empty reset": {**BALL, "guards": {"g": {"guard": "y", "set": {}}}},
    "unknown option": {**BALL, "run": {"rtoll": 1}},
    "unknown method": {**BALL, "run": {"method": "ode45"}},
    "values to vary that are none": {**BALL, "sweep": {"values": {"e": 3}}},
    "a range without a count": {**BALL, "sweep": {"values": {"e": {"from": 0, "to": 1}}}},
    "a truth as a number": {**BALL, "parameters": {"g": True}},
}


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_form_is_refused_by_the_schema_and_by_the_loader(validator, case):
    assert not validator.is_valid(WRONG[case])
    with pytest.raises(saltus.ModelError):
        loads(json.dumps(WRONG[case]), "json").simulate()


@pytest.mark.parametrize(
    "arguments", [{"block": "Gian"}, {"block": "Gain", "gian": 1}, {"block": "Gain"}]
)
def test_the_whole_schema_knows_the_blocks_of_the_library(arguments):
    whole = jsonschema.Draft202012Validator(schema())
    assert not whole.is_valid({"version": 1, "blocks": {"a": arguments}})
    assert whole.is_valid(GAIN)
    assert len(schema()["$defs"]["libraryBlock"]["oneOf"]) == len(library.__all__)


def test_the_schema_has_the_keys_of_the_loader():
    whole = json.loads(SCHEMA.read_text())
    parts = whole["$defs"]
    assert set(parts["run"]["properties"]) == set(RUN_KEYS)
    assert set(parts["system"]["properties"]) == set(SYSTEM_KEYS)
    assert set(whole["properties"]) == ROOT_KEYS | set(SYSTEM_KEYS)
    assert set(parts["guard"]["properties"]) == set(GUARD_KEYS)


WRONG_WIRES = {
    "a list in a wire": [["a", "b"]],
    "no arrow": ["a.fire b.synapse"],
    "an unknown key": [{"wire": "a -> b", "wieght": 1.0}],
    "no wire": [{"weight": 1.0}],
    "a truth": [{"wire": "a -> b", "weight": True}],
}


@pytest.mark.parametrize("case", WRONG_WIRES)
def test_the_schema_refuses_wrong_event_wires(validator, case):
    good = json.loads(dumps(saltus.load_scene(FOLDER / "spiking_cells.toml"), "json"))
    validator.validate(good)
    wrong = {**good, "event_wires": WRONG_WIRES[case]}
    assert not validator.is_valid(wrong)
    with pytest.raises(saltus.ModelError):
        loads(json.dumps(wrong), "json")
