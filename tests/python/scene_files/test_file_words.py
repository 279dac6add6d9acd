"""Mistakes that were seen late, or said in the words of Python."""

import pytest
from saltus.cli import main
from saltus.errors import SceneError, SimulationError
from saltus.scene_files import loads

COUNT = """version = 1
[discrete]
n = 0
[updates.tick]
{times}
set = {{ n = "n + 1" }}
[run]
begin = 1.0
until = 3.0
"""
TIMES = {
    "at = []": ("at", "expected times .* found an empty list"),
    "at = [0.0, 0.5]": ("at", "expected a time from 1 s on, the begin of the run, found 0.5"),
    "at = 0.5": ("at", "found 0.5"),
    "period = 0.1\nend = 0.5": ("end", "found 0.5"),
    "at = [0.5, 2.0]\nend = 0.7": ("at", "found 0.7"),
    "period = 1.0\ncount = 2.5": ("count", "expected a whole number from 1 on, found 2.5"),
    "period = 1.0\ncount = 0": ("count", "expected a whole number from 1 on, found 0"),
    "period = 1.0\ncount = true": ("count", "found a truth"),
}


@pytest.mark.parametrize("times", TIMES)
def test_updates_that_never_come(times):
    key, said = TIMES[times]
    with pytest.raises(SceneError, match=said) as error:
        loads(COUNT.format(times=times))
    assert error.value.key.startswith(f"updates.tick.{key}") and error.value.line >= 5


@pytest.mark.parametrize("times", ["at = [0.5, 1.0]", "at = 3.0", "period = 1.0\nend = 1.0"])
def test_updates_that_come(times):
    results = loads(COUNT.format(times=times)).simulate()
    assert results.statistics.events_by_name["scene.tick"] == 1


LEAF = 'version = 1\n[states]\nx = { start = 1.0, rate = "-x" }\n[discrete]\nn = 0\n'
GUARD = '[guards.g]\nguard = "x - 0.5"\nset = { n = "n + 1" }\n'
WRONG = {
    LEAF.replace("start", "unit = 3, start"): "unit: expected text such as 'm/s', found 3",
    LEAF.replace("start", "description = 7, start"): "description: expected text",
    LEAF.replace("[states]", "description = 7\n[states]"): "description: expected text",
    LEAF + "[parameters]\ng = { value = 1, unit = 3 }": "g.unit: expected text",
    LEAF + "[parameters]\ng = { value = 1, description = [] }": "g.description: expected text",
    LEAF.replace(
        "[states]", 'inputs = ["y[0]"]\n[states]'
    ): r"inputs\[0\]: expected a vector of 1 entry or more",
    LEAF + GUARD + 'terminal = "yes"': "terminal: expected true or false",
    LEAF + GUARD + "terminal = true\nmax_count = 1.5": "max_count: expected a whole number",
    LEAF + GUARD + 'at_start = "begin"': "unknown choice 'begin'",
    LEAF + GUARD + 'on_zeno = "holt"': "unknown choice 'holt'; did you mean 'hold'",
    LEAF + "[run]\nrtol = true": "rtol: expected a number, or a list with one for each",
    LEAF + "[run]\natol = [true]": "atol: expected a number, or a list with one for each",
    LEAF.replace('"-x"', '"round(x, ndigits=2)"'): "'ndigits=': arguments of round have no names",
    LEAF.replace('"-x"', '"round(x, 2)"'): "expected 1 argument of round, found 2",
    LEAF + "n = 1\n": ":6:6: no TOML: key 'n' stands twice in one table",
    LEAF + "[sweep.values]\ny = [1, 2]": "sweep.values.y: unknown parameter or state 'y'",
    LEAF + '[sweep.values]\n"scene.x[3]" = [1]': "sweep.values",
}


@pytest.mark.parametrize("text", WRONG)
def test_a_mistake_in_the_words_of_the_file(text):
    with pytest.raises(SceneError, match=WRONG[text]) as error:
        loads(text)
    assert error.value.line is not None


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ('{"version": 1,\n"states": {"x": {"start": null}}}', 2, "found null; leave the key out"),
        ('{"version": 1,\n"states": {"x": {},\n"x": {}}}', 3, "key 'x' stands twice"),
        ('{"version": 1,\n"parameters": {"x": NaN}}', 2, "found NaN"),
    ],
)
def test_json(text, line, said):
    with pytest.raises(SceneError, match=said) as error:
        loads(text, "json")
    assert error.value.line == line


def test_initial_outputs_are_a_table():
    text = """version = 1
wires = ["clock -> acc.u", "clock -> acc.trigger"]
[systems.acc]
inputs = ["u"]
outputs = { total = "2 * u" }
[blocks]
clock = { block = "Clock" }
acc = { block = "TriggeredSubsystem", system = "acc", initial_outputs = VALUE }
"""
    loads(text.replace("VALUE", "{ total = 7.0 }"))
    for value in ("7.0", "[7.0]", '"total"'):
        with pytest.raises(SceneError, match="expected a table such as { out = 1.0 }") as error:
            loads(text.replace("VALUE", value))
        assert error.value.key == "blocks.acc.initial_outputs"


FAILS = """version = 1
[systems.tank]
states = { h = { start = 2.0, rate = "-1" }, flow = { start = 0.5, rate = "sqrt(h - 1)" } }
[blocks]
upper = { system = "tank" }
[run]
until = 3.0
"""


def test_a_run_that_fails_names_the_states(capsys, tmp_path):
    """The square root has no value once h is below 1."""
    with pytest.raises(
        SimulationError, match="block 'upper' .*the rate of 'flow' is -?nan where h = "
    ):
        loads(FAILS).simulate()
    leaf = (
        'version = 1\n[states]\nx = {start = 1, rate = "y"}\ny = {start = 1, rate = "sqrt(-x)"}\n'
    )
    file = tmp_path / "leaf.toml"
    file.write_text(leaf + "[run]\nuntil = 1.0\n")
    assert main(["run", str(file)]) == 1
    assert "the rate of 'y' is" in capsys.readouterr().err


def test_names_of_files(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "my.ball.toml"]) == 0
    assert main(["run", "my.ball.toml"]) == 0
    assert "my_ball.bounce" in capsys.readouterr().out
    (tmp_path / "ball.txt").write_text("version = 1")
    for name in ("ball.txt", "s1.yaml", str(tmp_path)):
        assert main(["run", name]) == 2
        assert "a scene file ends in .toml or .json" in capsys.readouterr().err


def test_a_misspelt_name_of_a_sweep_is_seen_by_all_commands(capsys, tmp_path):
    file = tmp_path / "leaf.toml"
    file.write_text(LEAF + "[run]\nuntil = 1.0\n[sweep.values]\nxx = [1, 2]\n")
    for command in ("run", "describe", "sweep"):
        assert main([command, str(file)]) == 2
        assert f"{file}:9:1: sweep.values.xx: unknown" in capsys.readouterr().err
