"""Each wrong option and each wrong value is refused with exit code 2 and one line, before anything
is run or written.
"""

import subprocess
import sys

import pytest
from saltus.cli import main

RUN = ["run", "bouncing-ball"]
REPORT = ["report", "bouncing-ball", "--methods", "dopri5", "--rtols", "1e-4"]
LONG = "9" * 5000  # more digits than Python reads as an integer

WRONG = [
    *(
        [*RUN, "--option", option]
        for option in (
            "throw=maybe",
            "throw=False",
            "progress=maybe",
            "python=5",
            "save_at=5",
            "save_at=x",
            "recorded_signals=5",
            "max_major_steps=1.5",
            "max_major_steps=-1",
            f"max_passes={LONG}",
            "interrupt=1",
            "rtol=abc",
            "rtol=[1,2,3]",
            "ode_solver_method=5",
            "linear_solver=5",
            "dense_output=7",
            "record_events=maybe",
            "a.b=3",
            "rtol",
            "=3",
        )
    ),
    *(
        [*RUN, f"--save-at={times}"]
        for times in ("100000000000", LONG, "-5", "²", "nan,1", "inf", "3,2,1", "1,,2", "x")
    ),
    *([*RUN, f"--t-end={t}"] for t in ("nan", "inf", "-5", "x")),
    *([*RUN, flag] for flag in ("--t-begin=-inf", "--rtol=0", "--atol=inf", "--zeno-tolerance=-1")),
    *(
        [*RUN, "--set", value]
        for value in (
            "e=abc",
            "e=[1,2]",
            "e={'a':1}",
            f"e={'(' * 5000}",
            f"e={LONG}",
            "x[7]=1",
            "x=[1,2,3]",
            "mode=1.5",
            "nobody=1",
        )
    ),
    [*RUN, "--record", ""],
    [*RUN, "--record", "a.b.c"],
    [*RUN, "--method", "nope"],
    [*RUN, "--frob"],
    ["run", "kepler:"],
    ["run", ":"],
    ["run", ""],
    ["run", "os:path"],
    ["run", "os:getcwd"],
    ["describe", "bouncing-ball", "--option", "throw=maybe"],
    ["describe", "bouncing-ball", "--option", "save_at=5"],
    ["report", "bouncing-ball", "--rtols", "abc"],
    ["report", "bouncing-ball", "--rtols", "0"],
    ["report", "bouncing-ball", "--rtols=-1,nan"],
    [*REPORT, "--time-limit=-1"],
    [*REPORT, "--time-limit=nan"],
    [*REPORT, "--least-time=nan"],
    ["list", "--nope"],
    ["frob"],
    [],
]


def refused(arguments, capsys):
    try:
        code = main(arguments)
    except SystemExit as ended:  # of argparse
        code = ended.code
    shown = capsys.readouterr()
    assert code == 2
    assert shown.out == ""
    assert shown.err.count("\n") == 1
    return shown.err


@pytest.mark.parametrize("arguments", WRONG, ids=lambda a: " ".join(a)[:60])
def test_wrong_use_ends_with_code_2_and_one_line(capsys, arguments):
    assert refused(arguments, capsys).startswith("saltus")


@pytest.mark.parametrize(
    ("command", "flag", "name"),
    [
        (RUN, "--csv", "rows.parquet"),
        (RUN, "--csv", "rows.json"),
        (RUN, "--plot", "chart.csv"),
        (RUN, "--plot", "chart"),
        (REPORT, "--csv", "rows.parquet"),
        (REPORT, "--json", "rows.csv"),
        (REPORT, "--plot", "chart.parquet"),
    ],
)
def test_a_suffix_is_honoured_or_refused_and_no_file_is_written(
    capsys, tmp_path, command, flag, name
):
    pytest.importorskip("matplotlib")
    path = tmp_path / name
    assert flag in refused([*command, flag, str(path)], capsys)
    assert not path.exists()


def test_a_file_without_suffix_is_written_as_it_is_named(tmp_path):
    assert main([*RUN, "--quiet", "--csv", str(tmp_path / "rows")]) == 0
    assert (tmp_path / "rows").read_text().startswith("time,jump")


def test_from_a_shell_there_is_no_traceback():
    command = [sys.executable, "-m", "saltus", *RUN, "--option", "throw=maybe"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1


FILE = """version = 1
[parameters]
k = 1.0
[states]
y = { start = 1.0, rate = "-k * y" }
[outputs]
o = "y"
[run]
until = 1.0
save_at = [0.25, 0.75]
"""


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        (["sweep", "SCENE", "--vary", "k=1,2", "--set", "k=3"], ["--set: 'k' is varied by --vary"]),
        (["sweep", "SWEPT", "--set", "k=3"], ["--set: 'k' is varied by the table 'sweep'"]),
        (["sweep", "SCENE", "--vary", "k=1,2", "--vary", "k=3"], ["--vary", "once for each name"]),
        (["run", "SCENE", "--set", "k=1", "--set", "k=2"], ["--set: 'k' is set twice"]),
        (["run", "SCENE", "--rtol", "1e-3", "--option", "rtol=1e-4"], ["'rtol' is set by --rtol"]),
        (["run", "SCENE", "--save-at", "5", "--option", "save_at=[0.1]"], ["set by --save-at"]),
        (["run", "SCENE", "--option", "save_at=[0.5, 3.0]"], ["save_at", "1.0 s, found 3.0 s"]),
        (["run", "SCENE", "--save-at", "0.5,3"], ["0 s to 1 s", "found 3"]),
        (["sweep", "SCENE", "--vary", "k=1,2", "--option", "save_at=[3.0]"], ["found 3.0 s"]),
    ],
)
def test_what_would_be_ignored_is_refused(arguments, parts, tmp_path, capsys):
    (tmp_path / "SCENE.toml").write_text(FILE)
    (tmp_path / "SWEPT.toml").write_text(f"{FILE}[sweep]\nvalues = {{ k = [1.0, 2.0] }}\n")
    named = [str(tmp_path / f"{a}.toml") if a.isupper() else a for a in arguments]
    assert main(named) == 2
    said = capsys.readouterr()
    assert not said.out and said.err.count("\n") == 1
    assert all(part in said.err for part in parts), said.err


def test_a_shorter_run_has_the_rows_of_the_scene_as_far_as_it_goes(tmp_path, capsys):
    (tmp_path / "scene.toml").write_text(FILE)
    rows = tmp_path / "rows.csv"
    assert main(["run", str(tmp_path / "scene.toml"), "--t-end", "0.5", "--csv", str(rows)]) == 0
    times = [float(line.split(",")[0]) for line in rows.read_text().split()[1:]]
    assert times == [0.0, 0.25, 0.5]
