"""`saltus run`, `describe`, `report`, `sweep` and `new` with scene files."""

import csv
import json
import subprocess
import sys

import pytest
import saltus
from file_models import FOLDER
from saltus.cli import main
from saltus.errors import ModelError


@pytest.fixture
def ball(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "ball.toml"]) == 0
    return tmp_path / "ball.toml"


def test_new_writes_a_scene_that_runs_and_never_overwrites(ball, capsys):
    text = ball.read_text()
    assert "saltus run ball.toml" in text
    assert saltus.load_scene(ball).simulate().status == "reached_end"
    assert main(["new", "ball.toml"]) == 2
    assert "exists already" in capsys.readouterr().err
    assert ball.read_text() == text
    assert main(["new", "ball.json"]) == 0
    assert saltus.load_scene("ball.json") == saltus.load_scene(ball)
    assert main(["new", "ball.py"]) == main(["new"]) == 2


def test_new_writes_the_schema(tmp_path):
    file = tmp_path / "schema.json"
    assert main(["new", "--schema", str(file)]) == 0
    assert json.loads(file.read_text())["title"] == "A scene of Saltus"


def test_run_is_the_run_of_the_scene(ball, capsys):
    capsys.readouterr()
    assert main(["run", "ball.toml", "--set", "e=0.5", "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    results = saltus.load_scene(ball, e=0.5).simulate()
    assert said["scene"] == "ball"
    assert said["final"]["height"] == results.outputs["height"][-1]
    assert said["cost"]["steps"] == results.statistics.steps
    assert main(["run", "ball.toml", "--set", "y=2", "--rtol", "1e-6", "--csv", "rows.csv"]) == 0
    with open("rows.csv") as file:
        rows = list(csv.reader(file))
    assert rows[0] == ["time", "jump", "height", "energy"]
    assert float(rows[1][2]) == 2.0


def test_describe_and_report(ball, capsys):
    assert main(["describe", "ball.toml", "--set", "e=0.5"]) == 0
    out = capsys.readouterr().out
    for part in (
        "A ball that bounces",
        "e = 0.5",
        "y0 = 10",
        "guard 'ball.bounce'",
        "height, energy",
    ):
        assert part in out
    arguments = ["--methods", "dopri5", "--rtols", "1e-6", "--least-time", "0.001"]
    assert main(["report", "ball.toml", *arguments]) == 0
    assert "dopri5" in capsys.readouterr().out


def test_sweep_has_the_rows_of_the_runs(ball, capsys):
    capsys.readouterr()
    assert main(["sweep", "ball.toml", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert [row["e"] for row in rows] == [0.5, 0.7, 0.9]
    for row in rows:
        results = saltus.load_scene(ball, e=row["e"]).simulate()
        assert row["height"] == results.outputs["height"][-1]
        assert row["events"] == sum(results.statistics.events_by_name.values())


def test_sweep_reads_its_file_once(ball, capsys, monkeypatch):
    capsys.readouterr()
    read = []
    load = saltus.load_scene
    monkeypatch.setattr(
        "saltus.cli.scene_of.load_scene",
        lambda *args, **kw: (read.append(args), load(*args, **kw))[1],
    )
    assert main(["sweep", "ball.toml", "--vary", "e=0.5,0.6,0.7", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert len(read) == 1
    for row in rows:
        assert row["height"] == load(ball, e=row["e"]).simulate().outputs["height"][-1]


def test_a_scene_with_parameters_is_the_file_with_these(ball):
    scene = saltus.load_scene(ball)
    assert scene.with_parameters(e=0.5, y0=3.0) == saltus.load_scene(ball, e=0.5, y0=3.0)
    assert scene.with_parameters(e=0.5).with_parameters(y0=3.0).parameters["e"] == 0.5
    assert scene.parameters["e"] != 0.5
    with pytest.raises(ModelError, match="'restitution'"):
        scene.with_parameters(restitution=0.5)


def test_sweep_of_any_scene(capsys, tmp_path):
    file = tmp_path / "rows.csv"
    vary = ["--vary", "e=0.5:0.9:3", "--vary", "x[0]=1,2"]
    assert main(["sweep", "bouncing-ball", *vary, "--csv", str(file), "--t-end", "2"]) == 0
    with open(file) as opened:
        rows = list(csv.DictReader(opened))
    assert [(row["e"], row["x[0]"]) for row in rows][:3] == [
        ("0.5", "1.0"),
        ("0.5", "2.0"),
        ("0.7", "1.0"),
    ]
    assert {row["status"] for row in rows} == {"reached_end"}
    capsys.readouterr()
    paired = ["--vary", "e=0.5,0.9", "--vary", "x[0]=1,2", "--paired"]
    assert main(["sweep", "bouncing-ball", *paired]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 3


@pytest.mark.parametrize(
    "arguments",
    [
        [], ["--vary", "e"], ["--vary", "e=a"], ["--vary", "e=1:2"], ["--vary", "q=1"],
        ["--vary", "e=1", "--vary", "e=2"], ["--vary", "e=0:1:0"],
        ["--vary", "e=0.5,0.6", "--vary", "x[0]=1", "--paired"], ["--vary", "e=0:1:9999999"],
    ],
)  # fmt: skip
def test_sweep_refuses(arguments, capsys):
    assert main(["sweep", "bouncing-ball", *arguments]) == 2
    assert capsys.readouterr().err.startswith("saltus sweep: ")


@pytest.mark.parametrize("command", ["run", "describe", "report", "sweep"])
def test_a_wrong_file_is_one_line_and_no_traceback(command, tmp_path):
    file = tmp_path / "wrong.toml"
    file.write_text('version = 1\n[states]\nv = { rate = "-g" }\n')
    for name, part in (
        (file, f"{file}:3:16: states.v.rate: "),
        (tmp_path / "no.toml", "cannot be read"),
    ):
        arguments = [sys.executable, "-m", "saltus", command, str(name)]
        done = subprocess.run(arguments, capture_output=True, text=True, timeout=60)
        assert done.returncode == 2 and "Traceback" not in done.stderr
        assert len(done.stderr.splitlines()) == 1
        assert done.stderr.startswith(f"saltus {command}: ") and part in done.stderr


def test_a_file_without_an_end_needs_one(tmp_path, capsys):
    file = tmp_path / "clock.toml"
    file.write_text('version = 1\n[outputs]\ny = "t"\n')
    assert main(["run", str(file)]) == 2
    assert "--t-end" in capsys.readouterr().err
    assert main(["run", str(file), "--t-end", "2", "--quiet"]) == 0
    with pytest.raises(saltus.ModelError, match="until"):
        saltus.load_scene(file).simulate()


def test_a_sweep_in_python_makes_the_system_anew_or_varies_the_context():
    scene = saltus.load_scene(FOLDER / "two_tanks.toml")
    by_parameter = scene.sweep({"wide": [1.0, 2.0]}, as_dict=True)
    by_context = scene.sweep({"lower.area": [1.0, 2.0]}, as_dict=True)
    assert by_parameter["lower"].tobytes() == by_context["lower"].tobytes()
    whole = saltus.load_scene(FOLDER / "two_tanks.toml", wide=1.0).simulate()
    assert by_parameter["lower"][0] == whole.outputs["lower"][-1]
    both = scene.sweep({"wide": [1.0, 2.0], "upper.h": [0.5, 0.6]}, as_dict=True)
    assert both["lower"].shape == (2, 2)
    with pytest.raises(saltus.ModelError, match="unknown parameter or state 'wid'"):
        scene.sweep({"wid": [1.0]}, as_dict=True)
    with pytest.raises(saltus.ModelError, match="nothing to vary"):
        scene.sweep(as_dict=True)
    for values in ({"wide": [1.0, 2.0]}, {"lower.area": [1.0, 2.0]}):
        apart = scene.sweep(values, as_dict=True, executor="processes", workers=2)
        assert apart["lower"].tobytes() == by_parameter["lower"].tobytes()


def test_a_scene_file_needs_no_parser_before_it_is_read():
    code = (
        "import sys, saltus, saltus.cli\n"
        "print('tomllib' in sys.modules, 'saltus.scene_files' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.stdout.split() == ["False", "False"]
