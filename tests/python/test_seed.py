"""The four scenes of the tutorial against closed forms: our own scripts, and the tutorial's if it
lies beside us.

Tolerances: 1e-9 s and 1e-9 m are what the scenes are bound to. A bounce located to 1e-11 s moves a
height by 14 m/s * 1e-11 s = 1.4e-10 m, so the second follows from the first with room to spare.
"""

import re
import runpy
from pathlib import Path

import numpy as np
import pytest
from closed_forms import Ball

HERE = Path(__file__).parent
SEED = HERE.parents[2] / "shared" / "seed"
T1 = np.sqrt(2 * 10.0 / 9.81)
EXACT = {
    "scene1": Ball(10.0, 9.81, 1.0, end=6 * T1),
    "scene2": Ball(10.0, 9.81, 0.9, end=12.0),
    "scene3": Ball(1e-3, 9.81, 0.8, drops=[(1.0, -1e-3)], end=1.1),
    "scene4": Ball(10.0, 9.81, 0.9, floor=5.0, drops=[(10.0, 0.0)], end=40.0),
}


def seed_script(name, directory):
    """The tutorial's code with its imports changed, nothing else."""
    source = SEED / name
    if not source.exists():
        pytest.skip(f"{source} is not there")
    text = source.read_text().replace("jax.numpy", "numpy")
    script = directory / name
    script.write_text(re.sub(r"\bcollimator\b", "saltus", text))
    return script


@pytest.fixture(scope="module", params=["own", "seed"])
def scenes(request, tmp_path_factory):
    import matplotlib.pyplot as plt

    found = {}
    for name in ("ball_leaf.py", "ball_zeno.py"):
        own = HERE / "scenes" / name
        script = (
            own if request.param == "own" else seed_script(name, tmp_path_factory.mktemp("seed"))
        )
        for key, value in runpy.run_path(str(script)).items():
            if key.startswith("scene"):
                found[key] = value[2] if isinstance(value, tuple) else value
    plt.close("all")
    return found


def height(results):
    y = results.outputs["y"]
    return y[:, 0] if y.ndim == 2 else y


def bounces(results):
    """Every time at which the ball was turned round: rows whose jump went up, with the height on
    the floor.
    """
    names = {event.name for event in results.events}
    return results.events.times("reset" if "reset" in names else min(names))


@pytest.mark.parametrize("scene", EXACT)
def test_every_row_has_the_exact_height(scenes, scene):
    results = scenes[scene]
    assert results.status == "reached_end"
    assert len(results.time) > 1000  # max_minor_step_size says so
    np.testing.assert_allclose(
        height(results), EXACT[scene].heights(results.time), rtol=0, atol=1e-9
    )


@pytest.mark.parametrize("scene", EXACT)
def test_rows_are_in_order_and_the_span_is_whole(scenes, scene):
    results = scenes[scene]
    assert results.time[0] == 0.0
    assert results.time[-1] == results.context.time
    assert np.all(np.diff(results.time) >= 0)
    assert np.all(np.diff(results.jump) >= 0)
    assert len(set(zip(results.time.tolist(), results.jump.tolist(), strict=True))) == len(
        results.time
    )


@pytest.mark.parametrize("scene", ["scene1", "scene2"])
def test_bounces_of_the_leaf(scenes, scene):
    found = bounces(scenes[scene])
    exact = EXACT[scene].bounces
    assert len(found) == len(exact)
    np.testing.assert_allclose(found, exact, rtol=0, atol=1e-9)


def test_elastic_ball_keeps_its_energy(scenes):
    y, v = scenes["scene1"].outputs["y"].T
    energy = 9.81 * y + 0.5 * v * v
    np.testing.assert_allclose(
        energy, 98.1, rtol=1e-9
    )  # rtol of the run is 1e-10 a step, exact for a parabola


def reset_times(results):
    """Of the integrator of the height; both are reset together."""
    block = next(
        event.block
        for event in results.events
        if event.name == "reset" and event.block.endswith(("_y", "height"))
    )
    return np.array(
        [
            e.time
            for e in results.events
            if e.block == block and e.name == "reset" and e.kind == "zero_crossing"
        ]
    )


def of_kind(results, kind):
    return [event for event in results.events if event.kind == kind]


@pytest.mark.parametrize("scene", ["scene3", "scene4"])
def test_bounces_of_the_diagram(scenes, scene):
    found = reset_times(scenes[scene])
    exact = EXACT[scene].bounces
    rest = EXACT[scene].rests[0]
    before = found[found < rest]
    np.testing.assert_allclose(before, exact[: len(before)], rtol=0, atol=1e-9)
    assert rest - before[-1] < 1e-5  # gap <= 1e-6 s, and what is left is gap q / (1 - q), q <= 0.9


def test_small_ball_comes_to_rest_once_and_is_released_when_the_floor_falls(scenes):
    results = scenes["scene3"]
    entered, released = of_kind(results, "zeno_enter"), of_kind(results, "zeno_release")
    assert len({event.time for event in entered}) == 1
    assert {event.time for event in released} == {1.0}
    for event in entered:
        assert event.predicted == pytest.approx(EXACT["scene3"].rests[0], abs=1e-9)
        assert abs(event.after[0]) < 1e-9  # height 0 or velocity 0
    held = (results.time > entered[0].time) & (results.time < 1.0)
    assert held.any()
    np.testing.assert_allclose(height(results)[held], 0.0, rtol=0, atol=1e-9)
    if "v" in results.outputs:
        assert np.all(np.abs(results.outputs["v"][held]) < 1e-9)
    again = reset_times(results)
    again = again[again > 1.0]
    exact = EXACT["scene3"].bounces
    exact = exact[exact > 1.0]
    assert len(again) == len(exact) == 7
    np.testing.assert_allclose(again, exact, rtol=0, atol=1e-9)


def test_large_ball_is_in_flight_when_the_floor_falls(scenes):
    results = scenes["scene4"]
    found = reset_times(results)
    assert (found < 10.0).sum() == 7
    at_drop = height(results)[results.time == 10.0]
    assert np.all(at_drop > 5.1)
    assert not [event for event in of_kind(results, "zeno_enter") if event.time < 10.0]
    entered = of_kind(results, "zeno_enter")
    assert len({event.time for event in entered}) == 1
    for event in entered:
        assert event.predicted == pytest.approx(31.272333732171473, abs=1e-9)
    assert EXACT["scene4"].rests[0] == pytest.approx(31.272333732171473, abs=1e-12)
    assert results.context.continuous_state == pytest.approx([0.0, 0.0], abs=1e-9)
