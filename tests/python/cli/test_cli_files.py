"""Files that a command writes are checked before its work."""

import os
from pathlib import Path

import pytest
from saltus.cli import main

BALL = "bouncing-ball"
MINE = Path(__file__).with_name("scenes_of_mine.py")
COMMANDS = {
    "run --csv": ["run", BALL, "--csv"],
    "run --plot": ["run", BALL, "--plot"],
    "sweep --csv": ["sweep", BALL, "--vary", "e=0.5,0.6", "--csv"],
    "report --csv": ["report", BALL, "--csv"],
    "report --json": ["report", BALL, "--json"],
    "report --plot": ["report", BALL, "--plot"],
    "view --output": ["view", BALL, "-o"],
}


def refused(capsys, monkeypatch, command, name):
    for work in (
        "run_scene.simulate", "sweep_runs.simulate", "report_scene.work_precision",
    ):  # fmt: skip
        monkeypatch.setattr(f"saltus.cli.{work}", None)
    monkeypatch.setattr("saltus.simulation.simulate", None)
    assert main([*COMMANDS[command], str(name)]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert f"{command.split()[1]}: " in err
    return err


def suffix(command):
    return {"--csv": ".csv", "--json": ".json", "--plot": ".svg"}.get(command.split()[1], ".html")


@pytest.mark.parametrize("command", COMMANDS)
def test_a_folder_that_is_missing(capsys, monkeypatch, tmp_path, command):
    pytest.importorskip("matplotlib")
    missing = tmp_path / "missing"
    assert f"no folder '{missing}'" in refused(
        capsys, monkeypatch, command, missing / f"a{suffix(command)}"
    )


@pytest.mark.parametrize("command", COMMANDS)
def test_a_folder_or_an_empty_name(capsys, monkeypatch, tmp_path, command):
    for name in (tmp_path, ""):
        said = refused(capsys, monkeypatch, command, name)
        assert "expected the name of a file, found the folder" in said


@pytest.mark.parametrize("command", COMMANDS)
def test_a_file_that_cannot_be_written(capsys, monkeypatch, tmp_path, command):
    pytest.importorskip("matplotlib")
    usual = os.access
    denied = {tmp_path, tmp_path / f"old{suffix(command)}"}
    monkeypatch.setattr(os, "access", lambda path, how: path not in denied and usual(path, how))
    (tmp_path / f"old{suffix(command)}").write_text("")
    for name in ("new", "old"):
        said = refused(capsys, monkeypatch, command, tmp_path / f"{name}{suffix(command)}")
        assert "is not writable" in said


def test_view_of_a_run_that_fails(capsys, tmp_path):
    pytest.importorskip("matplotlib")
    page = tmp_path / "page.html"
    command = ["view", f"{MINE}:Fuse", "--set", "limit=0.5", "--t-end", "1", "-o", str(page)]
    assert main(command) == 1
    assert "the fuse blew" in capsys.readouterr().err and page.exists()
