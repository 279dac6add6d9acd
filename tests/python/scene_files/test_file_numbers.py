"""Numbers of expressions: no whole numbers that overflow, truths that count, comments refused."""

import numpy as np
import pytest
from saltus.errors import SceneError
from saltus.scene_files import dumps, loads

LEAF = "version = 1\n[parameters]\nk = 2.0\n[states]\ny = {{ start = 1.0, rate = '-y' }}\n{}"


def value(text, run="[run]\nuntil = 0.0\n"):
    outputs = f"[variables]\nover = 'y > 0.5'\n[outputs]\no = '''{text}'''\n{run}"
    return float(loads(LEAF.format(outputs)).simulate().outputs["o"][0])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("abs(2)**64", 2.0**64),
        ("abs(10)**20", 1e20),
        ("max(2, 3)**70", 3.0**70),
        ("where(1, 3, 2)**50", 3.0**50),
        ("abs(9007199254740991) * abs(9007199254740991)", 9007199254740991.0**2),
        ("abs(2)**-1", 0.5),
        ("7 % 4 + -7 % 4", 3.0 + 1.0),
        ("1 / 2", 0.5),
    ],
)
def test_whole_numbers_are_numbers(text, expected):
    assert value(text) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("(y < 9) + (y < 8)", 2.0),
        ("(k < 9) + (k < 8) + (t < 1)", 3.0),
        ("(k < 3 and k < 4) + (k < 5 and k < 6)", 2.0),
        ("(y < 9) - (y < 8)", 0.0),
        ("-(y < 9)", -1.0),
        ("over + over + (not over)", 2.0),
        ("3 * (0 < y < 2) + (y < 0)", 3.0),
    ],
)
def test_truths_are_counted(text, expected):
    assert value(text) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("y  # a comment", "column 4: '#' begins a comment"),
        ("interp(y, [3, 2, 1], [1, 2, 3])", "points of interp that increase"),
        ("interp(y, [1, 2], [1])", "as many points as values, found 2 and 1"),
        ("interp(y, [], [])", "found 0 and 0"),
        (f"max({', '.join(['y'] * 300)})", "expected at most"),
        (" and ".join(["y"] * 300), "expected at most"),
    ],
)
def test_what_would_be_wrong_without_a_word_is_refused(text, message):
    with pytest.raises(SceneError, match=message.replace("(", r"\(")):
        value(text)


@pytest.mark.parametrize("name", ["hold", "stop", "error"])
def test_a_mode_is_no_word_of_on_zeno(name):
    with pytest.raises(SceneError, match="is a word of on_zeno"):
        loads(LEAF.format("").replace("version = 1", f"version = 1\nmodes = ['go', '{name}']"))


@pytest.mark.parametrize("name", ["time", "state"])
def test_names_of_arguments_are_refused(name):
    with pytest.raises(SceneError, match="is taken by expressions"):
        loads(LEAF.format("").replace("k = 2.0", f"k = 2.0\n{name} = 1.0"))


def test_names_beyond_sixteen_bits_are_written_and_read():
    rest = '[outputs]\no = "y"\n[run]\nuntil = 1.0\nrecord = { "h\U0001f600" = "o" }'
    scene = loads(LEAF.format(rest))
    assert loads(dumps(scene)) == scene


def test_the_end_of_a_run_has_the_numbers_of_its_beginning():
    assert np.isclose(value("(y < 9) + (y < 8)", "[run]\nuntil = 1.0\n"), 2.0)
