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
