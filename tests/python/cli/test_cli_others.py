"""`saltus list`, `describe`, `report`, `--version`, and the command as a shell starts it."""

import json
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import saltus
from saltus.cli import main


def test_list(capsys):
    assert main(["list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == list(saltus.shelf())
    assert main(["list", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == saltus.shelf()


def test_describe(capsys):
    assert main(["describe", "water-tanks", "--method", "bdf"]) == 0
    out = capsys.readouterr().out
    for part in ("w = 0.75", "guard 'tanks.second_low'", "closed form", "method: bdf"):
        assert part in out
    assert main(["describe", "water-tank"]) == 2
    assert main(["describe", "water-tanks", "--option", "rtoll=1"]) == 2


@pytest.mark.parametrize("name", sorted(saltus.shelf()))
def test_describe_knows_every_scene(capsys, name):
    assert main(["describe", name]) == 0
    assert "guards:" in capsys.readouterr().out


def test_report(capsys, tmp_path):
    file = tmp_path / "rows.csv"
    arguments = ["--methods", "dopri5", "--rtols", "1e-6,1e-9", "--least-time", "0.001"]
    assert main(["report", "bouncing-ball", *arguments, "--csv", str(file)]) == 0
    out = capsys.readouterr().out
    assert "errors against (exact)" in out
    assert sum(line.startswith("dopri5") for line in out.splitlines()) == 2
    assert len([line for line in file.read_text().splitlines() if line[0] != "#"]) == 3
    assert main(["report", "bouncing-ball", "--set", "e=0.5", *arguments]) == 0
    assert "(exact)" in capsys.readouterr().out  # the closed form of these values
    assert main(["report", "bouncing-ball", "--methods", "dopri"]) == 2


def test_report_of_values_nothing_is_known_of(capsys):
    arguments = ["--methods", "dopri5", "--rtols", "1e-6", "--least-time", "0.001"]
    assert main(["report", "ball-drag", "--set", "x[0]=3", "--t-end", "1", *arguments]) == 0
    assert "errors against (run)" in capsys.readouterr().out


def test_version(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["--version"])
    assert ended.value.code == 0
    assert capsys.readouterr().out == f"saltus {saltus.__version__}\n"


@pytest.mark.parametrize("arguments", [[], ["frob"], ["run"], ["run", "kepler", "--frob"]])
def test_what_argparse_refuses(arguments):
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert ended.value.code == 2


def shell(*arguments, **how):
    command = [sys.executable, "-m", "saltus", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, **how)


def test_from_a_shell():
    done = shell("run", "bouncing-ball", "--json")
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["events"] == {"ball.bounce": 6}
    assert shell("run", "bouncing-bal").returncode == 2


def test_the_script_is_installed():
    script = shutil.which("saltus", path=str(sys.executable).rpartition("/")[0])
    if script is None:
        pytest.skip("installed without scripts")
    done = subprocess.run([script, "--version"], capture_output=True, text=True, timeout=60)
    assert done.stdout == f"saltus {saltus.__version__}\n"


def test_a_reader_that_goes_away():
    command = [sys.executable, "-m", "saltus", "list"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as listing:
        listing.stdout.close()
        assert listing.stderr.read() == b""


def test_ctrl_c_ends_a_run_with_what_it_has(tmp_path):
    file = tmp_path / "rows.csv"
    scene = [f"{Path(__file__).with_name('scenes_of_mine.py')}:Endless", "--t-end", "1e12"]
    command = [sys.executable, "-m", "saltus", "run", *scene, "--save-at", "0,1"]
    command += ["--csv", str(file)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as running:
        assert running.stdout.readline() == b"begun\n"
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=60)
    assert running.returncode == 130
    assert b"interrupted" in out and b"Traceback" not in err
    assert file.exists()


def test_a_run_imports_only_what_it_uses():
    code = (
        "import sys, saltus.cli; saltus.cli.main(['run', 'kepler', '--quiet']);"
        "print(*{name.split('.')[0] for name in sys.modules})"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    unwanted = {"matplotlib", "pandas", "xarray", "rich", "tqdm", "concurrent"}
    assert not set(done.stdout.split()) & (unwanted - {"concurrent"})
