"""`record` takes discrete states, the mode, and the names of modes."""

import numpy as np
import pytest
import saltus
from saltus.errors import SceneError
from saltus.scene_files import dumps, loads

HEATER = """
version = 1
modes = ["heating", "off"]
[states]
T = { start = 20.0, rate = "where(mode == heating, 25, -5)" }
[discrete]
switches = 0
[guards.warm]
guard = "T - 21"
from = "heating"
to = "off"
set = { switches = "switches + 1" }
[guards.cold]
guard = "T - 19"
from = "off"
to = "heating"
set = { switches = "switches + 1" }
[run]
until = 1.0
record = ["T", "switches", "mode", "heating", "off"]
"""


def test_they_have_the_values_of_the_event_log():
    results = loads(HEATER).simulate()
    events = len(results.events)
    assert events > 2
    assert results.outputs["switches"].tolist() == sorted(results.outputs["switches"])
    assert results.outputs["switches"][-1] == events
    assert np.array_equal(results.outputs["heating"], results.outputs["mode"] == 0.0)
    assert np.array_equal(results.outputs["off"], 1.0 - results.outputs["heating"])
    falls = np.diff(results.outputs["T"]) < 0
    assert np.array_equal(results.outputs["off"][:-1][falls], np.ones(falls.sum()))


def test_they_change_no_other_bit():
    scene = loads(HEATER)
    plain = loads(HEATER.replace('"T", "switches", "mode", "heating", "off"', '"T"'))
    more, less = scene.simulate(), plain.simulate()
    assert more.outputs["T"].tobytes() == less.outputs["T"].tobytes()
    assert more.statistics.right_hand_side_calls == less.statistics.right_hand_side_calls


def test_they_are_traced_and_need_no_interpreter():
    scene = loads(HEATER)
    assert [c for c in scene.system.explain() if c.runs != "traced"] == []


def test_without_record_only_the_outputs_of_the_file_are_recorded():
    text = HEATER.partition("record")[0] + '[outputs]\nroom = "T"\n'
    assert list(loads(text).simulate().outputs) == ["room"]


def test_an_output_of_the_file_keeps_its_name():
    text = HEATER + '[outputs]\nswitches = "100 + switches"\noff = "7"\n'
    outputs = loads(text).simulate().outputs
    assert outputs["switches"][0] == 100.0 and outputs["off"][0] == 7.0


IN_A_DIAGRAM = (
    'version = 1\nwires = ["room -> twice"]\n[systems.room]\n'
    + HEATER.partition("[run]")[0].replace("version = 1\n", "").replace("[", "[systems.room.")
    + '[systems.room.outputs]\nT = "T"\n[blocks]\nroom = { system = "room" }\n'
    'twice = { block = "Gain", gain = 2.0 }\n'
    '[run]\nuntil = 1.0\nrecord = { n = "room.switches", hot = "room.heating", m = "room.mode" }\n'
).replace('modes = [systems.room."heating"', 'modes = ["heating"')


def test_in_a_diagram_by_path_and_the_only_output_of_the_file_needs_no_name():
    results = loads(IN_A_DIAGRAM).simulate()
    alone = loads(HEATER).simulate()
    assert results.outputs["n"][-1] == alone.outputs["switches"][-1]
    assert loads(dumps(loads(IN_A_DIAGRAM))).simulate().outputs["hot"][0] == 1.0


def test_a_sweep_keeps_them():
    text = HEATER.replace('record = ["T", ', "record = [")
    table = loads(text).sweep({"T": [19.5, 20.5]}, as_dict=True)
    assert table["heating"].tolist() == [
        loads(HEATER.replace("start = 20.0", f"start = {start}")).simulate().outputs["heating"][-1]
        for start in (19.5, 20.5)
    ]


def test_a_wrong_name_has_the_nearest():
    with pytest.raises(SceneError, match="did you mean 'switches'"):
        loads(HEATER.replace('"switches", "mode"', '"switchs", "mode"'))


def test_the_command_line_takes_them(tmp_path, capsys):
    from saltus.cli import main

    file = tmp_path / "heater.toml"
    file.write_text(HEATER)
    assert main(["run", str(file), "--record", "switches", "--record", "heating"]) == 0
    shown = capsys.readouterr().out
    assert "switches" in shown and "heating" in shown
    assert saltus.load_scene(file).simulate().status == "reached_end"
