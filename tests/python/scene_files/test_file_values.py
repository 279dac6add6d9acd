"""Values of blocks by the names of a file: a value is applied as a whole, or refused."""

import pytest
from saltus.cli import main
from saltus.errors import ModelError
from saltus.scene_files import loads

SAMPLED = """version = 1
wires = ["ctl.u -> plant.u", "door.light -> ctl.y"]
[parameters]
Ts = 0.25
[systems.ctl]
inputs = ["y"]
parameters = { Ts = 0.5, start = 1.0, lag = 2.0, only = 1.0, band = 0.0 }
discrete = { u_ = 0.0, I = "start" }
states = { s = { start = "lag", rate = "-s / lag" } }
outputs = { u = "u_ + I + start + only" }
updates = { tick = { period = "Ts", set = { u_ = "u_ + Ts", I = "I + y" } } }
guards = { low = { guard = "s - band", zeno_tolerance = "band", set = { s = "s" } } }
[systems.plant]
inputs = ["u"]
states = { v = { start = 0, rate = "u - v" } }
[systems.group]
blocks = { inner = { system = "ctl" }, one = { block = "Constant", value = 1.0 } }
wires = ["one -> inner"]
[blocks]
ctl = { system = "ctl", Ts = "Ts" }
plain = { system = "group" }
plant = { system = "plant" }
[blocks.door]
block = "StateMachine"
states = ["shut", "open"]
parameters = { stay = 1.0, level = 2.0 }
variables = { visits = 0, best = "stay" }
outputs = { light = "where(since > stay, level, visits)" }
transitions = [{ source = "shut", target = "open", after = "stay" }]
[run]
until = 1.0
record = ["ctl.u"]
"""
HALF = {
    "ctl.Ts": "'period'.*set 'Ts', the parameter of the scene",
    "ctl.start": "'I'.*start = 'NAME'",
    "ctl.lag": "'start'.*lag = 'NAME'",
    "ctl.band": "'zeno_tolerance'",
    "plain.inner.Ts": "'period'.*Ts = 'NAME'",
    "door.stay": "stay = 'NAME'",
}


@pytest.fixture(name="file")
def written(tmp_path):
    file = tmp_path / "sampled.toml"
    file.write_text(SAMPLED)
    return str(file)


@pytest.mark.parametrize("name", HALF)
def test_a_value_that_would_be_half_applied_is_refused(capsys, file, name):
    scene = loads(SAMPLED)
    for values in ({name: [0.1, 0.2]}, [{name: 0.1}, {name: 0.2}]):
        with pytest.raises(ModelError, match=HALF[name]):
            scene.sweep(values, as_dict=True)
    for command in (["run", file, "--set", f"{name}=1"], ["sweep", file, "--vary", f"{name}=1,2"]):
        assert main(command) == 2
        assert f"'{name}' is in equations and in " in capsys.readouterr().err


def test_the_parameter_of_the_scene_is_applied_to_all():
    """Ticks at 0, Ts, ..., 1 s: two fewer where Ts is 0.5 in place of 0.25."""
    events = loads(SAMPLED).sweep({"Ts": [0.25, 0.5]}, as_dict=True)["events"]
    assert events[0] == events[1] + 2


@pytest.mark.parametrize("name", ["ctl.only", "door.level", "plant.v", "plain.inner.only"])
def test_other_values_are_set(file, name):
    assert main(["run", file, "--set", f"{name}=1.5", "--quiet"]) == 0


def test_discrete_states_and_variables_have_names(capsys, file):
    scene = loads(SAMPLED)
    assert scene.entry_named("ctl.I") == "ctl.z[1]"
    assert scene.entry_named("door.best") == "door.z[2]"
    assert scene.entry_named("plain.inner.u_") == "plain.inner.z[0]"
    by_name = scene.sweep({"ctl.I": [3.0]}, as_dict=True)["ctl.u"]
    assert by_name == scene.sweep({"ctl.z[1]": [3.0]}, as_dict=True)["ctl.u"]
    assert by_name != scene.sweep({"ctl.z[1]": [0.0]}, as_dict=True)["ctl.u"]
    assert main(["run", file, "--set", "ctl.I=1", "--set", "ctl.z[1]=2"]) == 2
    assert "the same value" in capsys.readouterr().err


def test_of_a_leaf_that_is_the_whole_scene():
    leaf = loads(
        "version = 1\nparameters = { T = 1.0 }\ndiscrete = { m = 0, n = 0 }\n"
        'updates.tick = { period = "T", set = { n = "n + T" } }'
    )
    assert (leaf.entry_named("n"), leaf.entry_named("T")) == ("z[1]", "T")
    with pytest.raises(ModelError, match="set 'T', the parameter of the scene"):
        leaf.entry_named("scene.T")
