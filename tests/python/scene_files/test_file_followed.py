"""A sweep over a parameter of a scene runs one system, with the bits of systems made anew."""

from dataclasses import replace

import numpy as np
import pytest
import saltus
from file_models import FILES
from saltus import library
from saltus.cli import main
from saltus.cli.one_system import OneSystem
from saltus.scene_files import loads, scene_sweep
from saltus.scene_files.library_block import arguments_of
from saltus.scene_files.scene import FileScene

MADE_ANEW = ("wall_time", "attrs")


def made_anew(monkeypatch):
    monkeypatch.setattr(scene_sweep, "one_system", lambda *_: None)


def follows(scene, *names):
    return (
        scene_sweep.one_system(scene, {name: [1.0] for name in names}, frozenset(names), {})
        is not None
    )


def require_equal(one, other):
    assert one.keys() == other.keys()
    for name in other.keys() - set(MADE_ANEW):
        assert np.array_equal(one[name], other[name], equal_nan=one[name].dtype.kind == "f"), name


def compare(scene, values, monkeypatch, **how):
    one = scene.sweep(values, as_dict=True, **how)
    with monkeypatch.context() as patch:
        made_anew(patch)
        require_equal(one, scene.sweep(values, as_dict=True, **how))
    return one


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_the_parameters_of_an_example(file, monkeypatch):
    scene = saltus.load_scene(file)
    begin, end = scene.t_span
    end = begin + 0.1 * (end - begin)
    scene.t_span = (begin, end)
    scene.options = replace(
        scene.options, save_at=[time for time in scene.options.save_at if time <= end]
    )
    numbers = {n: v for n, v in scene.parameters.items() if isinstance(v, float)}
    for name, value in numbers.items():
        compare(scene, {name: [value, 1.01 * value + 0.001]}, monkeypatch)


def test_which_parameters_of_the_examples_are_structure():
    made = {
        (file.stem, name)
        for file in FILES
        for scene in [saltus.load_scene(file)]
        for name, value in scene.parameters.items()
        if isinstance(value, float)
        and scene_sweep.one_system(scene, {name: [value]}, frozenset({name}), {}) is None
    }
    assert made == {
        ("buck_converter", "period"),
        ("spiking_cells", "excitation"),
        ("spiking_cells", "inhibition"),
        ("spiking_cells", "travel"),
        ("tutorial_3", "drop"),
        ("tutorial_4", "drop"),
    }


SPECIAL = {
    "DeadZone": {"half_range": "p"}, "Gain": {"gain": "p"}, "Hysteresis": {"on": 0.5, "off": -0.5},
    "LookupTable1d": {"input_array": [0.0, 1.0], "output_array": [0.0, "p"]},
    "Power": {"exponent": 2.0}, "Pulse": {"period": 0.7}, "Sawtooth": {"period": 0.7},
    "ZeroOrderHold": {"dt": 0.1},
}  # fmt: skip
"""arguments that a block needs to be made"""


def scenes_of_the_library():
    """(block, argument) and a scene in which the argument is a parameter that varies."""
    for block in sorted(library.__all__):
        needed = SPECIAL.get(block, {})
        kind = getattr(library, block)
        if not issubclass(kind, saltus.System):  # a transition
            continue
        for argument in arguments_of(block):
            given = {**needed, argument: "p"}
            try:
                made = kind(
                    **{key: 0.75 if value == "p" else value for key, value in given.items()}
                )
            except (saltus.ModelError, TypeError, ValueError):
                continue
            table = ", ".join(f"{key} = {value!r}" for key, value in given.items())
            wires = [f"wave -> block.{name}" for name in made.input_names]
            yield (
                f"{block}.{argument}",
                f"version = 1\nwires = {wires}\nparameters = {{ p = 0.75 }}\n"
                f"[blocks]\nblock = {{ block = '{block}', {table} }}\n"
                "wave = { block = 'Sine', frequency = 9.0 }\n[run]\nuntil = 1.0\n"
                f"record = {[f'block.{name}' for name in made.output_names]}\n",
            )


LIBRARY = dict(scenes_of_the_library())


@pytest.mark.parametrize("case", LIBRARY)
def test_an_argument_of_a_block_of_the_library(case, monkeypatch):
    try:
        scene = loads(LIBRARY[case])
    except saltus.ModelError:
        pytest.skip("no scene with numbers as signals")
    compare(scene, {"p": [0.75, 0.8, 0.3]}, monkeypatch)


def test_many_arguments_are_parameters():
    followed = 0
    for text in LIBRARY.values():
        try:
            followed += follows(loads(text), "p")
        except saltus.ModelError:
            continue
    assert followed > 20


NESTED = """
version = 1
wires = ["one -> pair.u", "pair.y -> door.u", "one -> saturated"]
[parameters]
base = 1.0
rate = "2 * base"
high = "base + 1"
levels = [1.0, 2.0]
lag = 0.1
[systems.cell]
parameters = { k = 1.0, half = "k / 2", start = 0.5, n0 = 0 }
inputs = ["u"]
states = { x = { start = "start", rate = "half * u - k * x" }, v = { start = 0.1, rate = 0 } }
discrete = { n = "n0 + k" }
guards = { up = { guard = "x - 0.75", direction = "rising", set = { n = "n + k" } } }
outputs = { y = "x + n" }
[systems.pair]
parameters = { k = 1.0 }
wires = ["left -> right"]
inputs = { u = "left.u" }
outputs = { y = "right.y" }
[systems.pair.blocks]
left = { system = "cell", k = "k", start = "k / 8" }
right = { system = "cell", k = 3.0 }
[blocks]
one = { block = "Constant", value = "base" }
pair = { system = "pair", k = "rate" }
saturated = { block = "Saturate", upper_limit = "high", lower_limit = -5.0 }
[blocks.door]
block = "StateMachine"
states = ["low", "tall"]
inputs = ["u"]
variables = { n = 0 }
transitions = [
  { source = "low", target = "tall", trigger = "u > high", action = { n = "n + rate" } },
  { source = "tall", target = "low", after = "lag" },
]
[run]
until = 1.5
record = ["pair.y", "pair.left.n", "door.n", "saturated.out"]
"""


def test_computed_parameters_nested_systems_and_state_machines(monkeypatch):
    scene = loads(NESTED)
    assert follows(scene, "base") and follows(scene, "rate", "high") and not follows(scene, "lag")
    compare(scene, {"base": [0.5, 1.0, 1.7]}, monkeypatch)
    compare(scene, {"rate": [0.5, 2.0], "high": [0.6, 3.0]}, monkeypatch)
    compare(scene, {"lag": [0.05, 0.2], "base": [0.9, 1.0]}, monkeypatch)


def test_a_value_of_a_block_wins_over_one_that_follows(monkeypatch):
    values = {"base": [0.5, 1.5], "one.value": [1.0, 4.0], "pair.left.x[1]": [0.0, 1.0]}
    compare(loads(NESTED), values, monkeypatch)
    compare(loads(NESTED), {"rate": [0.5, 1.5], "pair.left.x[0]": [0.3, 0.4]}, monkeypatch)
    rows = [{"base": 0.5, "one.value": 3.0}, {"base": 0.7, "one.value": 1.0}]
    compare(loads(NESTED), rows, monkeypatch)


LOG = """
version = 1
parameters = { k = 2.0 }
states = { x = { start = 1.0, rate = "-log(k) * x" } }
outputs = { x = "x" }
run = { until = 1.0 }
"""


def test_a_value_that_the_file_does_not_allow_has_the_same_reason(monkeypatch):
    values = {"k": [1.0, -1.0, 3.0]}
    rows = compare(loads(LOG), values, monkeypatch)
    assert rows["status"].tolist() == ["reached_end", "failed", "reached_end"]
    assert "log(-1) has no value" in rows["message"][1]


def test_a_block_refuses_a_value_in_the_same_words(monkeypatch):
    rows = compare(loads(NESTED), {"high": [2.0, -9.0]}, monkeypatch)
    assert rows["status"].tolist() == ["reached_end", "failed"]


def rows_of_the_command(arguments, tmp_path, name):
    assert main([*arguments, "--csv", str(tmp_path / name)]) == 0
    return (tmp_path / name).read_text()


@pytest.mark.parametrize(
    "more",
    [
        ["--vary", "base=0.5,1,1.7"],
        ["--vary", "base=0.5,1", "--vary", "lag=0.05,0.2"],
        ["--vary", "base=0.5,1", "--vary", "one.value=1,2", "--set", "rate=3"],
        ["--vary", "high=2,-9"],
        ["--vary", "base=0.5,1", "--set", "pair.right.x[0]=0.2", "--record", "pair.right.n"],
        ["--vary", "base=0.5,1", "--rtol", "1e-8", "--t-end", "1"],
        ["--vary", "base=0.5,1,2", "--workers", "2"],
    ],
)
def test_the_command_has_equal_rows(more, tmp_path, monkeypatch, capsys):
    file = tmp_path / "nested.toml"
    file.write_text(NESTED)
    arguments = ["sweep", str(file), *more]
    one = rows_of_the_command(arguments, tmp_path, "one.csv")
    monkeypatch.setattr(OneSystem, "of", lambda *_: None)
    assert rows_of_the_command(arguments, tmp_path, "other.csv") == one


def test_settings_of_the_run_that_follow_are_of_each_row(tmp_path, monkeypatch, capsys):
    file = tmp_path / "log.toml"
    file.write_text(LOG.replace("until = 1.0", 'until = "k"'))
    arguments = ["sweep", str(file), "--vary", "k=1.5,2.5"]
    one = rows_of_the_command(arguments, tmp_path, "one.csv")
    assert "1.5,reached_end,1.5" in one and "2.5,reached_end,2.5" in one


def test_the_command_makes_one_system(tmp_path, monkeypatch, capsys):
    file = tmp_path / "nested.toml"
    file.write_text(NESTED)
    made = []
    monkeypatch.setattr(FileScene, "_make", counted(FileScene._make, made))
    main(["sweep", str(file), "--vary", "base=0.5:2:20", "--json"])
    assert len(made) <= 4  # that of the file, of the first row, and of the settings


def counted(function, calls):
    def call(self):
        calls.append(1)
        return function(self)

    return call
