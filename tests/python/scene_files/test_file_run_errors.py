"""A run that fails names the line of the expression at fault."""

import pytest
import saltus
from saltus.cli import main
from saltus.scene_files import load, loads

LEAF = """version = 1
[parameters]
k = 400.0
[states]
x = { start = 1.0, rate = "RATE" }
v = { start = 1.0, rate = "x" }
[outputs]
y = "OUTPUT"
[guards.full]
guard = "GUARD"
set = { v = "SET" }
[run]
until = 3.0
"""
PLAIN = {"RATE": "1", "OUTPUT": "x", "GUARD": "x - 2", "SET": "v"}

# what is replaced, and the words, line and key that the message has
CASES = {
    "overflow of a rate": ({"RATE": "exp(k * x)"}, "", 4, "states"),
    "no real value of a rate": ({"RATE": "-sqrt(x)"}, "the rate of 'x' is nan", 5, "states.x.rate"),
    "infinite at the start": ({"RATE": "exp(1000 * k)"}, "is inf", 5, "states.x.rate"),
    "blows up": ({"RATE": "x**2"}, "the step size underflows", 4, "states"),
    "slides": ({"RATE": "-1 / x"}, "of state 'x' of block", 5, "states.x.rate"),
    "an output": ({"OUTPUT": "log(1 - t)"}, "recorded as 'y'", 8, "outputs.y"),
    "overflow of an output": ({"OUTPUT": "exp(k * t)"}, "recorded as 'y'", 8, "outputs.y"),
    "a guard": ({"GUARD": "log(2 - x)"}, "guard", 10, "guards.full.guard"),
    "a reset": ({"SET": "exp(1000 * x)"}, "not finite", 11, "guards.full.set"),
}


def text_of(changes):
    text = LEAF
    for word, value in {**PLAIN, **changes}.items():
        text = text.replace(f'"{word}"', f'"{value}"')
    return text


@pytest.mark.parametrize("what", CASES)
def test_an_expression_of_the_scene(what):
    changes, words, line, key = CASES[what]
    with pytest.raises(saltus.SimulationError) as caught:
        loads(text_of(changes)).simulate()
    message = str(caught.value)
    assert words in message and message.endswith(f": {key})") and f"(<text>:{line}:" in message


def test_in_a_nested_system_and_in_another_file(tmp_path):
    (tmp_path / "part.toml").write_text(text_of({"RATE": "-sqrt(x)"}))
    whole = tmp_path / "whole.toml"
    whole.write_text(
        "version = 1\ninclude = { part = 'part.toml' }\n"
        "[systems.pair.blocks]\none = { system = 'part', k = 1.0 }\n"
        "[blocks]\npair = { system = 'pair' }\n[run]\nuntil = 3.0\n"
    )
    with pytest.raises(saltus.SimulationError) as caught:
        load(whole).simulate()
    assert f"{tmp_path / 'part.toml'}:5:" in str(caught.value)
    assert "block 'pair.one'" in str(caught.value)


def test_the_command_line_says_it(tmp_path, capsys):
    file = tmp_path / "leaf.toml"
    file.write_text(text_of({"RATE": "-sqrt(x)"}))
    assert main(["run", str(file), "--quiet"]) == 1
    assert f"{file}:5:" in capsys.readouterr().err


def test_a_block_of_the_library_has_no_expression():
    scene = loads(
        "version = 1\nwires = ['one -> root']\n[blocks]\none = { block = 'Constant', value = -1.0 }\n"
        "root = { block = 'SquareRoot' }\n[run]\nuntil = 1.0\nrecord = ['root.out']\n"
    )
    with pytest.raises(saltus.SimulationError) as caught:
        scene.simulate()
    assert "<text>" not in str(caught.value)
