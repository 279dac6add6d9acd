"""`saltus sweep`: workers, stores, rows that fail, Ctrl-C."""

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from saltus.cli import main

MINE = f"{Path(__file__).with_name('scenes_of_mine.py')}"
GRID = ["bouncing-ball", "--vary", "e=0.5:0.9:5", "--t-end", "5", "--json"]


def rows_of(capsys, *arguments, code=0):
    capsys.readouterr()
    assert main(["sweep", *arguments]) == code
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize(
    "scene",
    [
        GRID,
        [f"{MINE}:Ball", "--vary", "e=0.1,0.9", "--vary", "g=1,9.81", "--t-end", "3", "--json"],
        [*GRID, "--option", "islands=True"],
        [*GRID, "--record", "ball:y", "--method", "bdf", "--rtol", "1e-8"],
    ],
    ids=["shelf", "own", "islands", "options"],
)
def test_workers_and_stores_change_no_bit(capsys, tmp_path, scene):
    alone = rows_of(capsys, *scene)
    assert rows_of(capsys, *scene, "--workers", "2") == alone
    store = ["--store", str(tmp_path / "store"), "--chunk", "1"]
    assert rows_of(capsys, *scene, *store) == alone
    assert rows_of(capsys, *scene, *store) == alone


def test_a_scene_file_in_other_processes(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "ball.toml"]) == 0
    alone = rows_of(capsys, "ball.toml", "--json")
    assert rows_of(capsys, "ball.toml", "--json", "--workers", "2", "--store", "rows") == alone


def test_only_missing_chunks_are_run(capsys, tmp_path, monkeypatch):
    store = ["--store", str(tmp_path / "store"), "--chunk", "1"]
    alone = rows_of(capsys, *GRID, *store)
    (tmp_path / "store" / "chunk-000003.pickle").unlink()
    made = []
    simulate = sys.modules["saltus.cli.sweep_runs"].simulate

    def counted(*arguments, **options):
        made.append(arguments)
        return simulate(*arguments, **options)

    monkeypatch.setattr("saltus.cli.sweep_runs.simulate", counted)
    assert rows_of(capsys, *GRID, *store) == alone
    assert len(made) == 2  # the missing row, and one that shows that nothing has changed


def test_a_store_of_another_command_is_refused(capsys, tmp_path):
    store = ["--store", str(tmp_path / "store")]
    rows_of(capsys, *GRID, *store)
    for other in (["--rtol", "1e-3"], ["--set", "g=1"], ["--record", "ball:y"], ["--t-begin", "1"]):
        assert main(["sweep", *GRID, *store, *other]) == 2
        assert "another sweep" in capsys.readouterr().err


def test_a_changed_file_is_another_sweep(capsys, tmp_path):
    file = tmp_path / "mine.py"
    file.write_text(Path(MINE).read_text())
    mine = [f"{file}:Ball", "--vary", "e=0.5,0.9", "--t-end", "2", "--json"]
    store = ["--store", str(tmp_path / "store")]
    rows_of(capsys, *mine, *store)
    file.write_text(file.read_text().replace("9.81", "1.62"))
    assert main(["sweep", *mine, *store]) == 2
    assert "another sweep, with other scene" in capsys.readouterr().err


def test_a_row_that_fails_says_why_and_the_others_go_on(capsys):
    fuse = [f"{MINE}:Fuse", "--vary", "limit=0.5,2", "--t-end", "1", "--json"]
    blown, whole = rows_of(capsys, *fuse)
    assert blown["status"] == "failed" and "the fuse blew" in blown["message"]
    assert whole["status"] == "reached_end" and "message" not in whole
    ball = ["bouncing-ball", "--vary", "e=0.5,70", "--json"]
    good, refused = rows_of(capsys, *ball)
    assert (good["status"], refused["status"]) == ("reached_end", "failed")
    assert "expected 0 to 1, found 70" in refused["message"]
    rows_of(capsys, f"{MINE}:Fuse", "--vary", "limit=0.1,0.2", "--t-end", "1", "--json", code=1)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--retries", "2"], "say --store DIRECTORY too"),
        (["--chunk", "2"], "say --store DIRECTORY too"),
        (["--workers", "0"], "workers: expected 1 or more, found 0"),
        (["--store", MINE], "expected a directory, found the file"),
        (["--record", "speed"], "no output 'speed'"),
        (["--option", "rtoll=1"], "unknown option 'rtoll'"),
        (["--set", "q=1"], "unknown parameter or state 'q'"),
    ],
)
def test_refused_before_anything_is_run(capsys, monkeypatch, arguments, said):
    monkeypatch.setattr("saltus.cli.sweep_runs.simulate", None)
    assert main(["sweep", *GRID, *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == "" and said in err
    assert err.startswith("saltus sweep: ") and not err.startswith("saltus sweep: sweep: ")


def test_ctrl_c_shows_the_finished_rows(tmp_path):
    command = [sys.executable, "-m", "saltus", "sweep", "bouncing-ball", "--json"]
    command += ["--vary", "e=0.5:0.9:100000", "--store", str(tmp_path), "--chunk", "10"]
    environment = os.environ | {"PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment
    ) as running:
        while not (tmp_path / "chunk-000001.pickle").exists():
            assert running.poll() is None
            time.sleep(0.01)
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=60)
    assert running.returncode == 130
    assert b"interrupted" in err and b"Traceback" not in err
    rows = json.loads(out)
    assert len(rows) == 100_000
    done = [row for row in rows if row["status"] == "reached_end"]
    assert 20 <= len(done) < 100_000
    assert {row["status"] for row in rows[len(done) :]} == {"not_run"}


@pytest.mark.parametrize("store", [False, True])
@pytest.mark.parametrize("times", [1, 2])
def test_ctrl_c_ends_the_workers_too(tmp_path, times, store):
    """From a terminal it goes to the whole group. The runs are endless; no worker is left."""
    command = [sys.executable, "-u", "-m", "saltus", "sweep", f"{MINE}:Endless", "--workers", "2"]
    command += ["--vary", "z[0]=0:1:4", "--t-end", "1e12"]
    command += ["--store", str(tmp_path)] if store else []
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True
    ) as running:
        assert running.stdout.readline().startswith(b"begun")
        for _ in range(times):
            os.killpg(running.pid, signal.SIGINT)
            time.sleep(0.2)
        try:
            _, err = running.communicate(timeout=20)
            assert running.returncode == 130
            assert b"interrupted" in err and b"Traceback" not in err
            end = time.monotonic() + 10.0
            with pytest.raises(ProcessLookupError):
                while time.monotonic() < end:
                    os.killpg(running.pid, 0)
                    time.sleep(0.02)
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(running.pid, signal.SIGKILL)


DECAY = """version = 1
[parameters]
k = 1.0
{name} = 2.0
[states]
p = {{ start = 1.0, rate = "-k * p" }}
[outputs]
{output} = "2 * p"
[run]
until = 1.0
"""
SECOND = {
    "the end of the run": ("time", "k=1,2"),
    "its status": ("status", "k=1,2"),
    "its events": ("events", "k=1,2"),
    "its reason": ("message", "k=1,2"),
    "a parameter that is varied": ("k", "k=1,2"),
    "a state that is varied": ("p", "p=1,2"),
}


@pytest.mark.parametrize("column", SECOND)
def test_a_column_is_not_written_over_by_an_output(capsys, tmp_path, column):
    """Refused as Python's sweep refuses it."""
    output, varied = SECOND[column]
    file = tmp_path / "decay.toml"
    text = DECAY.format(name="b", output=output)
    file.write_text(text if output != "p" else text.replace('"2 * p"', '"p"'))
    assert main(["sweep", str(file), "--vary", varied]) == 2
    out, err = capsys.readouterr()
    assert out == "" and f"'{output}': this name is taken; give another" in err


@pytest.mark.parametrize("name", ["status", "events", "message", "steps"])
def test_a_varied_value_has_no_name_of_a_column(capsys, tmp_path, name):
    file = tmp_path / "decay.toml"
    file.write_text(DECAY.format(name=name, output="y"))
    assert main(["sweep", str(file), "--vary", f"{name}=1,2"]) == 2
    assert f"'{name}' is a name of the results" in capsys.readouterr().err


def test_an_entry_of_a_recorded_vector_is_no_second_column(capsys, tmp_path):
    file = tmp_path / "vector.toml"
    file.write_text(
        "version = 1\n[states]\nx = { start = 1.0, rate = 0 }\n"
        'v = { start = 1.0, rate = 0 }\n[outputs]\nx = ["v", "v"]\n[run]\nuntil = 1.0\n'
    )
    assert main(["sweep", str(file), "--vary", "x[0]=1,2"]) == 2
    assert "'x[0]': this name is taken" in capsys.readouterr().err
    assert main(["sweep", f"{MINE}:ramp", "--vary", "ramp.x[0]=1,2", "--t-end", "1"]) == 0
