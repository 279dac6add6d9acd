"""Scenes of the shelf with other parameters."""

import math
import pickle

import numpy as np
import pytest
import saltus
from saltus.errors import ModelError


def test_the_usual_parameters_make_the_usual_scene():
    for name in saltus.shelf():
        usual = saltus.scene(name)
        same = saltus.scene(name, **usual.parameters)
        assert same.context == usual.context
        assert same.t_span == usual.t_span
        assert usual.t_span[1] == usual.parameters["t_end"]


def test_the_known_answer_follows():
    """A ball lands after sqrt(2 y0 / g)."""
    scene = saltus.scene("bouncing-ball", y0=2.0, g=1.0, e=0.3, t_end=2.5)
    results = scene.simulate(rtol=1e-9)
    assert results.events.times("bounce")[0] == pytest.approx(math.sqrt(4.0), rel=1e-9)
    table = saltus.work_precision(scene, methods=["dopri5"], rtols=[1e-9], least_time=1e-3)
    assert table.reference["kind"] == "exact"
    assert table[0]["error"] < 1e-9


def test_where_nothing_is_known_it_says_so():
    assert saltus.scene("lorenz", rho=20.0).provenance.startswith("none")


@pytest.mark.parametrize(
    ("name", "parameters", "says"),
    [
        ("bouncing-ball", {"ee": 1.0}, "did you mean 'e'"),
        ("bouncing-ball", {"e": 1.5}, "'e': expected 0 to 1, found 1.5"),
        ("bouncing-ball", {"g": 0.0}, "'g': expected"),
        ("bouncing-ball", {"g": math.nan}, "'g': expected"),
        ("bouncing-ball", {"g": "heavy"}, "expected numbers"),
        ("newtons-cradle", {"balls": 2.5}, "expected an integer"),
        ("two-walls", {"v0": 0.0}, "scene 'two-walls': expected 0 < x0 < length, v0 not 0"),
        ("water-tanks", {"w": 0.3}, "v1 and v2 below w"),
        ("stick-slip", {"fk": 2.0}, "scene 'stick-slip': expected fk < fs"),
    ],
)
def test_values_without_meaning(name, parameters, says):
    with pytest.raises(ModelError, match=says):
        saltus.scene(name, **parameters)


@pytest.mark.parametrize("name", sorted(saltus.shelf()))
def test_every_parameter_can_be_tried(name):
    """Half, double, none, minus: a scene, or a ModelError; never a crash."""
    for parameter, value in saltus.scene(name).parameters.items():
        if parameter == "n":  # the size of a dense problem of its exact answer
            continue
        for factor in (0.5, 2.0, 0.0, -1.0):
            try:
                scene = saltus.scene(name, **{parameter: factor * value})
            except ModelError:
                continue
            assert scene.parameters[parameter] == factor * value


def test_a_system_of_the_shelf_can_be_pickled():
    system = saltus.scene("bouncing-ball-blocks", y0=0.5).system
    again = pickle.loads(pickle.dumps(system))
    assert again.create_context() == system.create_context()
    block = pickle.loads(pickle.dumps(system.blocks[1]))
    assert block.name == system.blocks[1].name
    x = saltus.simulate(again, again.create_context(), (0.0, 0.1)).context.continuous_state
    y = saltus.simulate(system, system.create_context(), (0.0, 0.1)).context.continuous_state
    assert np.array_equal(x, y)
