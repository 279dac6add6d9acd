"""`saltus run`: scenes of the shelf and of one's own, settings, files, exit codes."""

import csv
import json
import math
from pathlib import Path

import pytest
import saltus
from saltus.cli import main

MINE = str(Path(__file__).with_name("scenes_of_mine.py"))


def run(capsys, *arguments):
    code = main(["run", *arguments])
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def summary(capsys, *arguments):
    code, out, err = run(capsys, *arguments, "--json")
    assert code == 0, err
    return json.loads(out)


def fallen(t, y0=10.0, g=9.81):
    return [y0 - g * t * t / 2, -g * t]


def test_a_scene_of_the_shelf(capsys):
    code, out, err = run(capsys, "bouncing-ball")
    assert (code, err) == (0, "")
    assert "reached_end, t = 12 s" in out
    assert "ball.bounce 6" in out


def test_a_tolerance_of_each_state(capsys):
    found = summary(capsys, "bouncing-ball", "--rtol", "1e-9,1e-8", "--atol", "1e-11,1e-10")
    alone = saltus.scene("bouncing-ball").simulate(rtol=[1e-9, 1e-8], atol=[1e-11, 1e-10])
    assert found["cost"]["steps"] == alone.statistics.steps
    only_rtol = summary(capsys, "bouncing-ball", "--rtol", "1e-9,1e-9")
    assert (
        only_rtol["cost"]["steps"]
        == (summary(capsys, "bouncing-ball", "--rtol", "1e-9")["cost"]["steps"])
    )
    code, _, err = run(capsys, "bouncing-ball", "--atol", "1e-9,1e-9,1e-9")
    assert code != 0
    assert "option atol: expected one number, or 2 numbers" in err


def test_json_is_what_simulate_gives(capsys):
    found = summary(capsys, "bouncing-ball", "--rtol", "1e-9")
    alone = saltus.scene("bouncing-ball").simulate(rtol=1e-9, atol=1e-11)
    assert found["status"] == "reached_end"
    assert found["events"] == {"ball.bounce": 6}
    assert found["final"]["y"] == alone.outputs["y"][-1].tolist()
    assert found["continuous_state"] == alone.context.continuous_state.tolist()
    assert found["cost"]["steps"] == alone.statistics.steps


def test_parameters_of_a_scene_and_the_span(capsys):
    found = summary(capsys, "bouncing-ball", "--set", "y0=20", "--set", "g=1.62", "--t-end", "2")
    # parabolas are exact but for rounding
    assert found["time"] == 2.0
    assert found["continuous_state"] == pytest.approx(fallen(2.0, 20.0, 1.62), abs=1e-12)


def test_values_of_the_context(capsys):
    found = summary(capsys, "ball-drag", "--set", "x[0]=20", "--t-end", "0.0")
    assert found["continuous_state"][0] == 20.0
    found = summary(capsys, "kepler", "--set", "mu=0", "--t-end", "1")  # a straight line
    x, y, vx, vy = saltus.scene("kepler").context.continuous_state
    assert found["continuous_state"] == pytest.approx([x + vx, y + vy, vx, vy], abs=1e-9)


def test_method_and_options(capsys):
    found = summary(capsys, "vdpol", "--method", "bdf", "--rtol", "1e-8")
    assert found["cost"]["method"] == "bdf"
    assert found["cost"]["jacobian_calls"] > 0
    found = summary(capsys, "bouncing-ball", "--option", "zeno_tolerance=0.0", "--set", "e=0.5",
                    "--t-end", "2")  # fmt: skip
    assert found["zeno_holds"] == []


def test_a_zeno_hold_is_shown(capsys):
    code, out, _ = run(capsys, "bouncing-ball", "--set", "e=0.5", "--set", "y0=10")
    at = 3 * math.sqrt(2 * 10 / 9.81)  # t1 (1 + e) / (1 - e)
    assert code == 0
    assert f"from t = {at:.5f}"[:-1] in out


@pytest.mark.parametrize(
    ("name", "settings", "end"),
    [
        (":Ball", ["y0=20", "g=1.62"], fallen(2.0, 20.0, 1.62)),
        (":Ball", ["x=[20, 0]", "g=1.62"], fallen(2.0, 20.0, 1.62)),
        (":ramp", ["ramp.x[0]=5"], [7.0]),
        (":make_ramp", [], [2.0]),
    ],
)
def test_systems_of_ones_own(capsys, name, settings, end):
    sets = [word for setting in settings for word in ("--set", setting)]
    found = summary(capsys, MINE + name, *sets, "--t-end", "2")
    assert found["continuous_state"] == pytest.approx(end, abs=1e-9)


def test_a_module_and_a_scene_of_ones_own(capsys, monkeypatch):
    monkeypatch.chdir(Path(MINE).parent)
    found = summary(capsys, "scenes_of_mine:scene")
    assert found["time"] == saltus.scene("kepler").t_span[1]


def test_rows_as_csv(capsys, tmp_path):
    file = tmp_path / "rows.csv"
    code, out, _ = run(
        capsys, "bouncing-ball", "--save-at", "5", "--t-end", "1", "--csv", str(file), "--quiet"
    )
    assert (code, out) == (0, "")
    rows = list(csv.DictReader(file.read_text().splitlines()))
    assert [float(row["time"]) for row in rows] == [0.0, 0.25, 0.5, 0.75, 1.0]
    for row in rows:
        y, v = fallen(float(row["time"]))
        assert [float(row["y[0]"]), float(row["y[1]"])] == pytest.approx([y, v], abs=1e-12)


def test_what_is_recorded(capsys, tmp_path):
    file = tmp_path / "rows.csv"
    code, _, err = run(capsys, MINE + ":ramp", "--t-end", "1", "--record", "one.out", "--record",
                       "ramp", "--csv", str(file))  # fmt: skip
    assert code == 0, err
    assert file.read_text().splitlines()[0] == "time,jump,one.out,ramp"


def test_a_plot(capsys, tmp_path):
    pytest.importorskip("matplotlib")
    file = tmp_path / "ball.svg"
    assert run(capsys, "bouncing-ball", "--plot", str(file))[0] == 0
    assert "<svg" in file.read_text()


def test_a_run_that_fails_gives_what_it_has(capsys, tmp_path):
    file = tmp_path / "rows.csv"
    code, out, err = run(
        capsys, MINE + ":Fuse", "--set", "limit=1", "--t-end", "2", "--csv", str(file)
    )
    assert code == 1
    assert "failed" in out
    assert "the fuse blew" in err
    assert "Traceback" not in err
    assert len(file.read_text().splitlines()) > 1


def test_a_run_that_does_not_end_well(capsys):
    code, out, err = run(capsys, "thermostat", "--option", "max_major_steps=5")
    assert code == 1
    assert "step_limit" in out
    assert "raise max_major_steps" in err


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["bouncing-bal"], "did you mean 'bouncing-ball'"),
        (["bouncing-ball", "--set", "ee=1"], "did you mean 'e'"),
        (["bouncing-ball", "--set", "e=2"], "expected 0 to 1, found 2"),
        (["bouncing-ball", "--set", "e=high"], "expected numbers"),
        (["bouncing-ball", "--set", "e"], "expected NAME=VALUE"),
        (["bouncing-ball", "--set", "e=0.1", "--set", "e=0.2"], "set twice"),
        (["bouncing-ball", "--set", "x[0]=high"], "expected a number"),
        (["bouncing-ball", "--set", "x[7]=1"], "has 2 entries"),
        (["newtons-cradle", "--set", "balls=2.5"], "expected an integer"),
        (["bouncing-ball", "--method", "rk4"], "rk4"),
        (["bouncing-ball", "--rtol", "-1"], "rtol"),
        (["bouncing-ball", "--option", "rtoll=1"], "did you mean 'rtol'"),
        (["bouncing-ball", "--t-end", "-1"], "begin <= end"),
        (["bouncing-ball", "--save-at", "often"], "expected times"),
        (["bouncing-ball", "--record", "z"], "ball:y"),
        (["bouncing-ball", "--csv", "/nowhere/rows.csv", "--quiet"], "/nowhere/rows.csv"),
        ([MINE + ":Ball"], "say --t-end"),
        ([MINE + ":Bal", "--t-end", "1"], "did you mean 'Ball'"),
        ([MINE + ":number", "--t-end", "1"], "expected a system"),
        ([MINE + ":Fuse", "--t-end", "1"], "--set limit=VALUE"),
        ([MINE + ":Ball", "--set", "yO=1", "--t-end", "1"], "did you mean 'y0'"),
        ([MINE + ":make_wrong", "--t-end", "1"], "LookupError: nothing here (line"),
        (["nowhere.py:ball"], "there is no file 'nowhere.py'"),
        (["nowhere:ball"], "'nowhere' cannot be imported"),
    ],
)
def test_wrong_use(capsys, arguments, says):
    code, _, err = run(capsys, *arguments)
    assert code == 2
    assert says in err
    assert "Traceback" not in err


def test_a_file_that_cannot_be_read_as_python(capsys, tmp_path):
    file = tmp_path / "broken.py"
    file.write_text("ball = 1 +\n")
    code, _, err = run(capsys, f"{file}:ball")
    assert code == 2
    assert "SyntaxError" in err
