"""A wrong scene is a SceneError that says the file, the line, the column, and what was expected."""

import json
import pickle

import pytest
import saltus
from saltus.errors import SceneError
from saltus.scene_files import loads

LEAF = "version = 1\n[states]\n"
GAINS = 'version = 1\n[blocks]\na = { block = "Clock" }\nb = { block = "Gain", gain = 2.0 }\n'
WIRED = 'version = 1\nwires = ["a -> b"]\n[blocks]\na = { block = "Clock" }\n'

# text, line and column, parts of the message
CASES = {
    "unknown block": (
        'version = 1\n[blocks]\na = { block = "Gian" }',
        (3, 7),
        ["'Gian'", "did you mean 'Gain'"],
    ),
    "name of another tool": (
        'version = 1\n[blocks]\na = { block = "Sum" }',
        (3, 7),
        ["called Adder here"],
    ),
    "a block that is none here": (
        'version = 1\n[blocks]\na = { block = "Scope" }',
        (3, 7),
        ["record the signal"],
    ),
    "unknown argument": (
        'version = 1\n[blocks]\na = { block = "Gain", gian = 1 }',
        (3, 23),
        ["'gian'", "'gain'"],
    ),
    "missing argument": ('version = 1\n[blocks]\na = { block = "Gain" }', (3, 1), ["needs 'gain'"]),
    "argument of a wrong type": (
        'version = 1\n[blocks]\na = { block = "Gain", gain = true }',
        (3, 23),
        ["a number or a list", "found a truth"],
    ),
    "impossible value": (
        'version = 1\n[blocks]\na = { block = "Pulse", period = -1 }',
        (3, 1),
        ["period"],
    ),
    "missing wire": (GAINS, (4, 1), ["input 'in' of block 'b' is not connected"]),
    "wire from an unknown block": (
        'version = 1\nwires = [\n  "a -> b",\n  "c -> b"\n]\n' + GAINS[12:],
        (4, 3),
        ["unknown block 'c'"],
    ),
    "wire to an unknown port": (
        'version = 1\nwires = ["a.put -> b"]\n' + GAINS[12:],
        (2, 10),
        ["'put'", "'out'"],
    ),
    "wire without an arrow": (
        'version = 1\nwires = ["a b"]\n' + GAINS[12:],
        (2, 10),
        ["expected a wire such as"],
    ),
    "two wires to one input": (
        'version = 1\nwires = ["a -> b", "a -> b"]\n' + GAINS[12:],
        (2, 20),
        ["already has a source"],
    ),
    "which port": (
        WIRED + 'b = { block = "Adder", operators = "+-" }',
        (2, 10),
        ["2 inputs", "'b.in_0'"],
    ),
    "wrong shape": (
        'version = 1\nwires = ["a -> b"]\n[blocks]\na = { block = "Constant", value = [1, 2, 3] }\n'
        'b = { block = "Integrator", initial_state = [1, 2] }',
        (5, 1),
        ["'b'", "3", "2"],
    ),
    "wires below a header": (
        GAINS + 'wires = ["a -> b"]',
        (5, 1),
        ["above the first header"],
    ),
    "unknown name": (
        LEAF + 'v = { rate = "-gg * v" }\n[parameters]\ng = 1',
        (3, 16),
        ["column 2", "unknown name 'gg'", "did you mean 'g'"],
    ),
    "unknown function": (
        LEAF + 'v = { rate = "sine(v)" }',
        (3, 15),
        ["'sine'", "did you mean 'sin'"],
    ),
    "syntax of an expression": (
        LEAF + 'v = { rate = "2 * (v + " }',
        (3, 19),
        ["no expression", "expected one such as"],
    ),
    "a power of C": (LEAF + 'v = { rate = "v ^ 2" }', (3, 15), ["a power is written '**'"]),
    "an attribute": (LEAF + 'v = { rate = "v.real" }', (3, 15), ["a name has no '.'"]),
    "too few arguments": (
        LEAF + 'v = { rate = "v + atan2(v)" }',
        (3, 19),
        ["expected 2 arguments"],
    ),
    "a constant that overflows": (LEAF + 'v = { rate = "9**9**9**9" }', (3, 18), ["finite number"]),
    "a constant that a parameter makes": (
        "version = 1\n[parameters]\nk = 1000000000\n[blocks]\n"
        'a = { block = "SourceBlock", function = "t * 9**k" }',
        (5, 46),
        ["finite number"],
    ),
    "a division by zero": (LEAF + 'v = { start = "1 / 0" }', (3, 16), ["finite number"]),
    "a root that is none": (
        LEAF + 'v = { start = "sqrt(-1)" }',
        (3, 16),
        ["sqrt(-1) has no value"],
    ),
    "a complex power": (
        LEAF + 'v = { start = "k ** 0.5" }\n[parameters]\nk = -1',
        (3, 16),
        ["(-1) ** 0.5 has no value"],
    ),
    "a loop of parameters": (
        'version = 1\n[parameters]\na = "b"\nb = "a"\n[outputs]\ny = "a"',
        (3, 6),
        ["unknown name 'b'"],
    ),
    "a vector as a number": (
        'version = 1\n[outputs]\ny = "k"\n[parameters]\nk = [1, 2]',
        (3, 6),
        ["write k[0]"],
    ),
    "beyond a vector": (
        'version = 1\n[outputs]\ny = "k[2]"\n[parameters]\nk = [1, 2]',
        (3, 8),
        ["0 to 1"],
    ),
    "text in place of a table": (LEAF + 'v = "-g"', (3, 1), ["expected a table such as"]),
    "a table in place of a number": (
        LEAF + "v = { start = {} }",
        (3, 7),
        ["expected an expression"],
    ),
    "unknown key": (LEAF + "v = { rat = 1 }", (3, 7), ["unknown key 'rat'", "did you mean 'rate'"]),
    "unknown table": ("version = 1\n[stats]\n", (2, 2), ["unknown key 'stats'", "'states'"]),
    "duplicate key": (LEAF + "v = {}\nv = {}\nw = {}", (4, 7), ["no TOML"]),
    "unfinished TOML": ("version = 1\nx = [", (2, 6), ["no TOML"]),
    "no version": ("[states]\nv = {}", None, ["expected 'version = 1'"]),
    "another version": ("version = 2\n[states]\nv = {}", (1, 1), ["expected 1, found 2"]),
    "no system": ("version = 1", None, ["expected 'blocks'"]),
    "a name that Python has": ("version = 1\n[states]\nlambda = {}", (3, 1), ["no word of Python"]),
    "a name that means the time": ("version = 1\n[states]\nt = {}", (3, 1), ["'t' is taken"]),
    "one name twice": (
        "version = 1\n[states]\nv = {}\n[discrete]\nv = 0",
        (5, 1),
        ["is a state already"],
    ),
    "a name with a dot": (
        'version = 1\n[blocks]\n"a.b" = { block = "Clock" }',
        (3, 1),
        ["found 'a.b'"],
    ),
    "unknown direction": (
        LEAF + 'v = {}\n[guards.g]\nguard = "v"\ndirection = "down"',
        (6, 1),
        ["unknown direction"],
    ),
    "unknown mode": (
        'version = 1\nmodes = ["on", "off"]\n[guards.g]\nguard = "t"\nto = "of"',
        (5, 1),
        ["unknown mode 'of'", "'off'"],
    ),
    "unknown state in a reset": (
        LEAF + 'v = {}\n[guards.g]\nguard = "v"\nset = { w = 0 }',
        (6, 9),
        ["unknown state 'w'"],
    ),
    "a guard without a guard": (LEAF + "v = {}\n[guards.g]\n", (4, 9), ["expected a key 'guard'"]),
    "an update without times": (
        'version = 1\n[discrete]\nk = 0\n[updates.u]\nset = { k = "k + 1" }',
        (4, 10),
        ["time"],
    ),
    "a period of zero": (
        "version = 1\n[discrete]\nk = 0\n[updates.u]\nperiod = 0\nset = { k = 1 }",
        (4, 10),
        ["period"],
    ),
    "an unknown input of an edge": (
        'version = 1\ninputs = ["u"]\n[states]\nv = {}\n[edges.e]\ninput = "w"\nset = { v = 0 }',
        (6, 1),
        ["unknown input 'w'"],
    ),
    "unknown system": (
        'version = 1\n[blocks]\na = { system = "wheel" }',
        (3, 7),
        ["unknown system 'wheel'"],
    ),
    "a system in itself": (
        'version = 1\n[systems.a.blocks]\nx = { system = "a" }\n[blocks]\na = { system = "a" }',
        (3, 7),
        ["contains itself"],
    ),
    "unknown parameter of a system": (
        'version = 1\n[systems.s]\noutputs = { y = 1 }\n[blocks]\na = { system = "s", k = 1 }',
        (5, 21),
        ["no parameter 'k'"],
    ),
    "states of a diagram": (GAINS + "[states]\nv = {}", (5, 2), ["a diagram has no 'states'"]),
    "wires of a leaf": ('version = 1\nwires = ["a -> b"]\n[states]\nv = {}', (2, 1), ["'blocks'"]),
    "systems of a leaf": (
        "version = 1\n[systems.a]\nfoo = 1\n[states]\nv = {}",
        (2, 2),
        ["'blocks'"],
    ),
    "neither block nor system": (
        "version = 1\n[blocks]\na = { gain = 1 }",
        (3, 1),
        ["either 'block'"],
    ),
    "unknown option": (LEAF + "v = {}\n[run]\nrtoll = 1", (5, 1), ["'rtoll'", "'rtol'"]),
    "unknown method": (LEAF + 'v = {}\n[run]\nmethod = "ode45"', (5, 1), ["ode45"]),
    "a number of times without an end": (LEAF + "v = {}\n[run]\nsave_at = 5", (5, 1), ["'until'"]),
    "an end before the begin": (LEAF + "v = {}\n[run]\nuntil = -1", (5, 1), ["begin <= until"]),
    "no end": (LEAF + "v = {}\n[run]\nuntil = inf", (5, 1), ["finite times"]),
    "an impossible tolerance": (LEAF + "v = {}\n[run]\nrtol = -1", (5, 1), ["positive number"]),
    "a mode set twice": (
        'version = 1\nmodes = ["on"]\n[guards.g]\nguard = "t"\nto = "on"\nset = { mode = "on" }',
        (5, 1),
        ["keep one of"],
    ),
    "a ragged matrix": (
        'version = 1\n[parameters]\nk = [[1, 2], [3]]\n[outputs]\ny = "interp(t, k, k)"',
        (3, 1),
        ["different lengths"],
    ),
    "unknown recorded signal": (LEAF + 'v = {}\n[run]\nrecord = ["w"]', (5, 11), ["'w'", "'v'"]),
    "values to vary that are none": (
        LEAF + "v = {}\n[sweep.values]\ne = 3",
        (5, 1),
        ["expected a list of values"],
    ),
    "a file in a text": (
        LEAF + 'v = {}\n[include]\na = "b.toml"',
        (5, 1),
        ["load it from a file"],
    ),
    "a date": (LEAF + "v = { start = 2020-01-01 }", (3, 7), ["expected text, a number"]),
    "a number that is none": (LEAF + "v = { start = nan }", (3, 7), ["found nan"]),
}


@pytest.mark.parametrize("case", CASES)
def test_a_mistake_has_a_place_and_says_what_was_expected(case):
    text, place, parts = CASES[case]
    with pytest.raises(SceneError) as caught:
        loads(text)
    error = caught.value
    for part in parts:
        assert part in str(error)
    assert (error.line, error.column) == (place or (None, None))
    where = "<text>" if place is None else f"<text>:{place[0]}:{place[1]}"
    assert str(error).startswith(f"{where}: ")


DEEP = {
    "lists": "version = 1\nx = " + "[" * 1_000_000,
    "lists that end": "version = 1\nx = " + "[" * 1_000_000 + "]" * 1_000_000,
    "tables": "version = 1\nx = " + "{a=" * 1_000_000,
    "dotted keys": "version = 1\n" + ".".join("a" * 1_000_00) + " = 1",
    "brackets of an expression": f'{LEAF}v = {{ rate = "{"(" * 4000}v{")" * 4000}" }}',
    "signs": f'{LEAF}v = {{ rate = "{"-" * 9000}v" }}',
    "a million signs": f'{LEAF}v = {{ rate = "{"-" * 1_000_000}v" }}',
    "a sum": f'{LEAF}v = {{ rate = "{"v+" * 4900}v" }}',
    "functions": f'{LEAF}v = {{ rate = "{"sin(" * 2000}v{")" * 2000}" }}',
    "variables": LEAF
    + "v = {}\n[variables]\na0 = 1\n"
    + "".join(f'a{i} = "a{i - 1} + a{i - 1}"\n' for i in range(1, 100))
    + 'b = "unknown"',
}


@pytest.mark.parametrize("case", DEEP)
def test_what_is_nested_too_deeply_is_refused(case):
    with pytest.raises(SceneError):
        loads(DEEP[case])


@pytest.mark.parametrize(
    "text", ['{"a":' * 1_000_000, "[" * 1_000_000, '{"version": 1, "x": ' + "1" * 5000]
)
def test_deep_json_is_refused(text):
    with pytest.raises(SceneError):
        loads(text, "json")


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ('{"version": 1, "version": 1}', "'version' stands twice"),
        ('{"version": 1, "states": {"v": {"start": NaN}}}', "found NaN"),
        ('{"version": 1', "no JSON"),
        ("[]", "expected a table"),
        ('{"version": 1,\n "states": {"v":\n  {"rate": "-g"}}}', "<text>:3:14: states.v.rate"),
    ],
)
def test_a_mistake_in_json(text, part):
    with pytest.raises(SceneError, match=None) as caught:
        loads(text, "json")
    assert part in str(caught.value)


def test_a_million_blocks_are_refused(tmp_path):
    file = tmp_path / "big.toml"
    blocks = "\n".join(f"b{i}={{block='Clock'}}" for i in range(1_000_000))
    file.write_text(f"version=1\n[blocks]\n{blocks}\n")
    with pytest.raises(SceneError, match="at most 8 MB"):
        saltus.load_scene(file)


def test_systems_that_multiply_are_counted():
    text = "version = 1\n"
    for i in range(20):
        inner = f'system = "s{i + 1}"' if i < 19 else 'block = "Clock"'
        text += f"[systems.s{i}.blocks]\n" + "".join(f"b{j} = {{ {inner} }}\n" for j in range(10))
    with pytest.raises(SceneError, match="at most 100000 blocks"):
        loads(text + '[blocks]\na = { system = "s0" }\n')


def test_a_file_that_is_not_utf_8(tmp_path):
    file = tmp_path / "latin.toml"
    file.write_bytes(b'version = 1\ntitle = "B\xe4ll"\n')
    with pytest.raises(SceneError, match="UTF-8, found the byte 0xe4") as caught:
        saltus.load_scene(file)
    assert (caught.value.line, caught.value.column) == (2, 11)


def test_a_file_of_windows_has_the_same_lines(tmp_path):
    file = tmp_path / "windows.toml"
    file.write_bytes(b'\xef\xbb\xbfversion = 1\r\n[states]\r\nv = { rate = "-g" }\r\n')
    with pytest.raises(SceneError) as caught:
        saltus.load_scene(file)
    assert (caught.value.line, caught.value.column) == (3, 16)


def test_files_that_are_none(tmp_path):
    for name in ("missing.toml", "ball.txt"):
        with pytest.raises(SceneError, match=name):
            saltus.load_scene(tmp_path / name)
    (tmp_path / "folder.toml").mkdir()
    with pytest.raises(SceneError, match="cannot be read"):
        saltus.load_scene(tmp_path / "folder.toml")
    with pytest.raises(SceneError):
        saltus.load_scene("zero\0.toml")
    with pytest.raises(saltus.ModelError, match="expected the path"):
        saltus.load_scene(3)


def write(folder, **files):
    for name, text in files.items():
        (folder / f"{name}.toml").write_text(f"version = 1\n{text}")
    return folder


def test_files_that_include_one_another(tmp_path):
    block = '[blocks]\nx = { system = "b" }\n'
    write(
        tmp_path,
        a=f'include = {{ b = "b.toml" }}\n{block}',
        b=f'include = {{ b = "a.toml" }}\n{block}',
    )
    with pytest.raises(SceneError, match=r"a\.toml includes b\.toml includes a\.toml") as caught:
        saltus.load_scene(tmp_path / "a.toml")
    assert caught.value.file.endswith("b.toml") and caught.value.line == 2
    write(tmp_path, c='include = { c = "c.toml" }')
    with pytest.raises(SceneError):
        saltus.load_scene(tmp_path / "c.toml")


def test_a_mistake_in_an_included_file_names_that_file(tmp_path):
    write(
        tmp_path,
        part='[states]\nv = { rate = "-g" }',
        whole='include = { p = "part.toml" }\n[blocks]\nx = { system = "p" }',
    )
    with pytest.raises(SceneError, match="unknown name 'g'") as caught:
        saltus.load_scene(tmp_path / "whole.toml")
    assert caught.value.file == str(tmp_path / "part.toml") and caught.value.line == 3
    with pytest.raises(SceneError, match="there is no file"):
        saltus.load_scene(
            write(tmp_path, w='include = { p = "pert.toml" }\n[states]\nv = {}') / "w.toml"
        )


def test_an_error_keeps_its_place_when_it_is_pickled():
    with pytest.raises(SceneError) as caught:
        loads(CASES["unknown name"][0])
    again = pickle.loads(pickle.dumps(caught.value))
    assert (str(again), again.line, again.key) == (str(caught.value), 3, "states.v.rate")


CODE = [
    "__import__('os')",
    "t.__class__",
    "(lambda: 1)()",
    "[x for x in [1]]",
    "open('a')",
    "f'{t}'",
    "t := 1",
    "print(t)",
    "exec('1')",
    "np.sin(t)",
    "'a' * 9",
    "{1}",
    "...",
    "True",
    "1j",
    "t if t",
    "*t",
    "await t",
]


@pytest.mark.parametrize("code", CODE)
def test_no_code_is_executed(code):
    with pytest.raises(SceneError):
        loads(json.dumps({"version": 1, "outputs": {"y": code}}), "json")


def test_the_shelf_says_how_a_file_is_read():
    with pytest.raises(saltus.ModelError, match=r"saltus\.load_scene\('ball\.toml'\)"):
        saltus.scene("ball.toml")


def test_unknown_parameters_of_a_scene():
    with pytest.raises(saltus.ModelError, match="did you mean 'e'"):
        loads('version = 1\n[parameters]\ne = 1\n[outputs]\ny = "e"', "toml", ee=2)


@pytest.mark.parametrize(
    ("text", "here"),
    [
        ("[states]\nx = { initial = 1.0, rate = 0 }", "start"),
        ("[states]\nx = { start = 1.0, ode = 0 }", "rate"),
        ("[states]\nx = {}\n[guards.g]\ncondition = 'x'", "guard"),
        ("[states]\nx = {}\n[guards.g]\nguard = 'x'\nreset = { x = 1 }", "set"),
        ("[states]\nx = {}\n[run]\nt_end = 1.0", "until"),
        ("[states]\nx = {}\n[run]\nsolver = 'bdf'", "method"),
        ("params = { k = 1 }\n[states]\nx = {}", "parameters"),
    ],
)
def test_a_key_of_another_format_has_its_name_here(text, here):
    with pytest.raises(SceneError, match=f"unknown key '[a-z_]+'; it is '{here}' here"):
        loads(f"version = 1\n{text}\n")
