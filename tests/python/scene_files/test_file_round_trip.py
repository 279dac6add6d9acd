"""What is written is read again as the same scene, from TOML and from JSON."""

import pickle

import pytest
import saltus
from file_models import FILES, bits
from saltus.scene_files import dumps, first_scene, loads

SCENES = pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)


@SCENES
@pytest.mark.parametrize("kind", ["toml", "json"])
def test_a_written_scene_is_the_same(file, kind, tmp_path):
    scene = saltus.load_scene(file)
    other = tmp_path / f"{file.stem}.{kind}"
    scene.save(other)
    assert saltus.load_scene(other) == scene
    assert dumps(saltus.load_scene(other), kind) == other.read_text()


@pytest.mark.parametrize("name", ["tutorial_2", "two_tanks", "elevator", "battery"])
@pytest.mark.parametrize("kind", ["toml", "json"])
def test_a_written_scene_runs_to_the_same_bits(name, kind):
    file = next(f for f in FILES if f.stem == name)
    scene = saltus.load_scene(file)
    assert bits(loads(dumps(scene, kind), kind).simulate()) == bits(scene.simulate())


def test_all_kinds_of_values_survive():
    text = r"""
version = 1
title = "quotes \" ' \\ and lines\nand ä, \u007f, \t"
name = "all-kinds"
wires = ["a-b -> 1", "y -> z"]
[parameters]
whole = 3
tiny = 5e-324
"large" = 1.7976931348623157e308
never = inf
vector = [1, 2.5, "whole * 2"]
matrix = [[0, 1], [-1, 0]]
unit = { value = 2.0, unit = "m/s", description = "a speed" }
[blocks]
y = { block = "Clock" }
z = { block = "LTISystem", A = "matrix", B = [[0], [1]], C = [[1, 0]] }
"a-b" = { block = "Constant", value = ["whole", -0.0] }
"1" = { block = "Integrator", initial_state = [0, 0], enable_reset = false }
"""
    scene = loads(text)
    assert scene.parameters["vector"] == [1, 2.5, 6.0]
    assert scene.parameters["never"] == float("inf")
    for kind in ("toml", "json"):
        again = loads(dumps(scene, kind), kind)
        assert again == scene
        assert list(again.tree["blocks"]) == ["y", "z", "a-b", "1"]  # the order of the states


def test_chosen_parameters_are_written():
    scene = loads(first_scene(), e=0.5)
    again = loads(dumps(scene))
    assert again == scene != loads(first_scene())
    assert again.parameters["e"] == 0.5


def test_included_files_are_written_as_systems(tmp_path):
    (tmp_path / "part.toml").write_text(
        'version = 1\ntitle = "a lag"\ninputs = ["u"]\n[parameters]\ntau = 1\n[states]\n'
        'x = { rate = "(u - x) / tau" }\n[outputs]\nx = "x"\n[run]\nuntil = 1\n'
    )
    (tmp_path / "whole.toml").write_text(
        'version = 1\ninclude = { lag = "part.toml" }\nwires = ["c -> a.u", "a -> b.u"]\n[blocks]\n'
        'c = { block = "Constant", value = 1 }\na = { system = "lag" }\n'
        'b = { system = "lag", tau = 2 }\n[outputs]\nx = "b.x"\n[run]\nuntil = 3\n'
    )
    scene = saltus.load_scene(tmp_path / "whole.toml")
    assert scene.tree["systems"]["lag"]["description"] == "a lag"
    assert "run" not in scene.tree["systems"]["lag"]
    again = loads(dumps(scene))
    assert again.tree == scene.tree
    assert bits(again.simulate()) == bits(scene.simulate())


def test_a_scene_can_go_to_another_process():
    scene = pickle.loads(pickle.dumps(loads(first_scene(), e=0.5)))
    assert scene == loads(first_scene(), e=0.5)
    assert bits(scene.simulate()) == bits(loads(first_scene(), e=0.5).simulate())


def test_another_kind_of_file_is_refused(tmp_path):
    scene = loads(first_scene())
    with pytest.raises(saltus.ModelError, match=r"\.toml or \.json"):
        scene.save(tmp_path / "ball.yaml")
    with pytest.raises(saltus.ModelError):
        loads(first_scene(), "yaml")
