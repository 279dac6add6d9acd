"""Times of rows before the begin of a run or after its end are refused; none is dropped unsaid."""

import numpy as np
import pytest
import saltus
from saltus.errors import ModelError, SceneError
from saltus.scene_files import loads

FILE = """version = 1
[states]
y = {{ start = 1.0, rate = '-y' }}
[outputs]
o = 'y'
[run]
until = 1.0
save_at = {}
"""
OUTSIDE = [([0.5, 1.5], "1.5 s"), ([-0.5, 0.5], "-0.5 s"), ([2.0], "2.0 s"),
           (np.linspace(0.0, 7.0, 8), "2.0 s, 3.0 s, 4.0 s, 5.0 s and 2 more")]  # fmt: skip


def decay(t, x):
    return -x


@pytest.fixture
def ball():
    return saltus.scene("bouncing-ball")


@pytest.mark.parametrize(("times", "found"), OUTSIDE)
def test_simulate(ball, times, found):
    message = (
        f"simulate: option save_at: expected times within the run, 0.0 s to 1.0 s, found {found}"
    )
    span = (0.0, 1.0)
    for _ in range(2):  # the second time with the plan of the first
        with pytest.raises(ModelError) as caught:
            saltus.simulate(ball.system, span, save_at=times)
        assert str(caught.value).startswith(message)
    with pytest.raises(ModelError, match="option save_at: expected times within"):
        saltus.simulate(ball.system, span, options=saltus.SimulatorOptions(save_at=times))


def test_the_span_of_a_scene(ball):
    with pytest.raises(ModelError, match=r"0\.0 s to 12\.0 s, found 99\.0 s"):
        ball.simulate(save_at=[1.0, 99.0])


@pytest.mark.parametrize(("times", "found"), OUTSIDE)
def test_sweep(ball, times, found):
    with pytest.raises(
        ModelError, match=f"sweep: option save_at: .* 0.0 s to 1.0 s, found {found}"
    ):
        saltus.sweep(ball.system, {"e": [0.5, 0.9]}, (0.0, 1.0), save_at=times)


@pytest.mark.parametrize("times", [times for times, _ in OUTSIDE])
def test_solve_says_it_of_t_eval(times):
    with pytest.raises(ModelError, match="t_eval: expected increasing times within t_span"):
        saltus.solve(decay, (0, 1), [1.0], t_eval=times)


def test_a_scene_file_has_the_place_of_the_time():
    with pytest.raises(SceneError, match=r"expected a time from 0 s to 1 s, found 3") as caught:
        loads(FILE.format("[0.5, 3.0]"))
    assert (caught.value.line, caught.value.key) == (8, "run.save_at[1]")


def test_a_time_of_a_file_that_is_beyond_the_end_by_rounding():
    scene = loads(
        FILE.format("['3 * 0.1', '10 * 0.1 + 1e-15']").replace("until", "event_rows = false\nuntil")
    )
    assert scene.simulate().time.tolist() == [3 * 0.1, 1.0]


def test_times_at_the_ends_and_none_at_all(ball):
    whole = ball.simulate(save_at=[0.0, 12.0], event_rows=False)
    assert whole.time.tolist() == [0.0, 12.0]
    assert len(ball.simulate(save_at=()).time) > 2


def test_a_run_that_ends_early_drops_what_comes_after_its_end():
    def low(t, x):
        return x[0] - 0.5

    low.terminal = True
    solution = saltus.solve(decay, (0, 9), [1.0], t_eval=[0.1, 5.0], events=low)
    assert solution.t.tolist() == [0.1]


def test_a_simulator_records_as_far_as_it_is_advanced(ball):
    simulator = saltus.Simulator(
        ball.system,
        recorded_signals={"y": ball.system.output()},
        save_at=[0.5, 1.5],
        event_rows=False,
    )
    simulator.advance_to(1.0, ball.system.create_context())
    assert simulator.results.time.tolist() == [0.5]
    simulator.advance_to(2.0)
    assert simulator.results.time.tolist()[-1] == 1.5


def test_a_time_that_is_beyond_the_end_by_rounding_is_the_end():
    scene = saltus.scene("bouncing-ball")
    ticks = np.arange(20) * 0.1
    assert ticks[-1] > 1.9
    recorded = {"y": scene.system.output()}
    for times in (ticks, [*ticks[:-1], 1.9, ticks[-1]]):
        found = saltus.simulate(
            scene.system, (0.0, 1.9), recorded_signals=recorded, save_at=times, event_rows=False
        )
        assert found.time.tolist() == [*ticks[:-1], 1.9]
    swept = saltus.sweep(
        scene.system, {"e": [0.5]}, (0.0, 1.9), recorded_signals=recorded, save_at=ticks
    )
    assert swept["time"].values[-1] == 1.9
    assert np.isfinite(swept["y"].values).all()


def test_pieces_of_a_scene_whose_options_have_rows_for_all_of_it():
    """The refusal of either piece says how to choose its times; together they have all rows."""
    scene = saltus.scene("lorenz")
    half, times = 0.5 * scene.t_span[1], np.array(scene.options.save_at)
    with pytest.raises(ModelError, match=rf"save_at=\[t for t in times if t <= {half}\], or make"):
        saltus.simulate(scene.system, scene.context, (0.0, half), scene.options)
    first = saltus.simulate(
        scene.system, scene.context, (0.0, half), scene.options, save_at=times[times <= half]
    )
    span = (half, scene.t_span[1])
    with pytest.raises(ModelError, match=rf"save_at=\[t for t in times if {half} <= t\], or begin"):
        saltus.simulate(scene.system, first.context, span, scene.options)
    last = saltus.simulate(
        scene.system, first.context, span, scene.options, save_at=times[times >= half]
    )
    assert set(times) <= {*first.time, *last.time}
