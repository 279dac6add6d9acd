"""Options of the command line: each once, and atol beside rtol by the rule of scene files."""

import pytest
import saltus
from saltus.cli import main
from saltus.scene_files import loads

BALL = "bouncing-ball"


@pytest.mark.parametrize(
    "given",
    [
        ["run", BALL, "--rtol", "1e-3", "--rtol", "1e-9"],
        ["run", BALL, "--t-end", "1", "--until", "2"],
        ["run", BALL, "--t-end", "1", "--t-end", "1"],
        ["run", BALL, "--t-begin", "0", "--t-begin=0.5"],
        ["run", BALL, "--atol", "1e-3", "--ato", "1e-9"],
        ["run", BALL, "--method", "bdf", "--method", "radau"],
        ["run", BALL, "--zeno-tolerance", "0", "--zeno-tolerance", "1"],
        ["run", BALL, "--save-at", "3", "--save-at", "4"],
        ["run", BALL, "--csv", "a.csv", "--csv", "b.csv"],
        ["run", BALL, "--plot", "a.svg", "--plot", "b.svg"],
        ["run", BALL, "--json", "--json"],
        ["run", BALL, "--record", "ball:y", "--record", "ball:y"],
        ["sweep", BALL, "--vary", "e=0.5", "--vary", "e=0.6"],
        ["sweep", BALL, "--vary", "e=0.5", "--record", "ball:y", "--record", "ball:y"],
        ["sweep", BALL, "--vary", "e=0.5", "--workers", "1", "--workers", "2"],
        ["sweep", BALL, "--vary", "e=0.5", "--store", "a", "--store", "b"],
        ["sweep", BALL, "--vary", "e=0.5", "--chunk", "1", "--chunk", "2"],
        ["sweep", BALL, "--vary", "e=0.5", "--paired", "--paired"],
        ["report", BALL, "--methods", "bdf", "--methods", "radau"],
        ["report", BALL, "--rtols", "1e-4", "--rtols", "1e-5"],
        ["report", BALL, "--time-limit", "1", "--time-limit", "2"],
        ["view", BALL, "-o", "a.html", "--output", "b.html"],
        ["view", BALL, "--draw", "none", "--draw", "ball"],
        ["view", BALL, "--speed", "1", "--speed", "2"],
        ["describe", BALL, "--rtol", "1e-3", "--rtol", "1e-9"],
        ["new", "--schema", "a.json", "--schema", "b.json"],
        ["list", "--json", "--json"],
    ],
    ids=" ".join,
)
def test_an_option_is_given_once(capsys, tmp_path, monkeypatch, given):
    monkeypatch.chdir(tmp_path)
    try:
        code = main(given)
    except SystemExit as exit:
        code = exit.code
    out, err = capsys.readouterr()
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "twice" in err or "once" in err
    assert not list(tmp_path.iterdir())


def test_options_that_may_be_given_again(capsys):
    """Each for another name."""
    command = ["run", BALL, "--set", "e=0.5", "--set", "g=1", "--quiet"]
    assert main([*command, "--option", "max_passes=9", "--option", "save_steps=False"]) == 0


DECAY = "version = 1\n[states]\nx = { start = 1.0, rate = '-x' }\n[run]\nuntil = 1.0\n"


def tolerances(capsys, file, text, *options):
    file.write_text(text)
    assert main(["describe", str(file), *options]) == 0
    out = capsys.readouterr().out
    return next(line for line in out.splitlines() if line.startswith("tolerances")).split("  ")[-1]


@pytest.mark.parametrize(
    ("written", "options", "rtol", "atol"),
    [
        ("", [], "1e-06", "1e-08"),
        ("rtol = 1e-9", [], "1e-09", "1e-11"),
        ("atol = 1e-4", [], "1e-06", "0.0001"),
        ("rtol = [1e-5]", [], "1e-05", "1e-07"),
        ("rtol = 1e-9", ["--rtol", "1e-3"], "0.001", "1e-05"),
        ("atol = 1e-4", ["--rtol", "1e-3"], "0.001", "0.0001"),
        ("rtol = 1e-9\natol = 1e-4", ["--rtol", "1e-3"], "0.001", "0.0001"),
        ("rtol = 1e-9\natol = 1e-4", ["--atol", "1e-3"], "1e-09", "0.001"),
        ("rtol = 1e-9\natol = 1e-4", ["--rtol", "1e-3", "--atol", "1e-7"], "0.001", "1e-07"),
        ("rtol = 1e-9", ["--option", "rtol=1e-3"], "0.001", "1e-05"),
        ("", ["--rtol", "1e-3"], "0.001", "1e-05"),
    ],
)
def test_an_atol_that_is_written_stays(capsys, tmp_path, written, options, rtol, atol):
    found = tolerances(capsys, tmp_path / "decay.toml", f"{DECAY}{written}\n", *options)
    assert found == f"rtol {rtol}, atol {atol}"


def test_it_is_so_in_python(capsys, tmp_path):
    """The steps of a run tell its tolerances."""
    for written in ("rtol = 1e-9\n", "rtol = 1e-9\natol = 1e-5\n"):
        scene = loads(DECAY + written)
        atol = 1e-5 if "atol" in written else 1e-6
        plain = saltus.simulate(
            scene.system, scene.context, (0.0, 1.0), scene.options, rtol=1e-4, atol=atol
        )
        assert scene.simulate(rtol=1e-4).context == plain.context
        swept = scene.sweep({"x": [1.0]}, rtol=1e-4, as_dict=True)
        assert swept["continuous_state"][0, 0] == plain.context.continuous_state[0]


def test_a_tolerance_that_is_none(capsys):
    with pytest.raises(SystemExit):
        main(["run", BALL, "--rtol", "small"])
    assert "expected a number, or one for each state, 1e-6,1e-9, found 'small'" in (
        capsys.readouterr().err
    )
