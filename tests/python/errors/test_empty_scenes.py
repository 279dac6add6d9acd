"""No time, no state, no guard, no output: a legal scene each."""

import pytest
import saltus
from saltus.library import Constant, Pulse, Sine
from troubles import METHODS, Everything, go


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("time", [0.0, 0.25, -1.0])
def test_a_run_of_no_length_has_the_rows_of_its_instant(method, time):
    system = Everything()
    context = system.create_context(time)
    results = saltus.simulate(
        system,
        context,
        (time, time),
        ode_solver_method=method,
        recorded_signals={"y": system.output()},
    )
    ticks = 0 if time < 0.0 else 1
    assert results.status == "reached_end"
    assert results.time.tolist() == [time] * (1 + ticks)
    assert results.jump.tolist() == [0, 1][: 1 + ticks]
    assert results.outputs["y"].tolist() == [1.0] * (1 + ticks)
    assert [(e.time, e.name) for e in results.events] == [(time, "tick")] * ticks
    assert results.context.time == time


@pytest.mark.parametrize("method", METHODS)
def test_a_block_with_nothing_in_it_runs(method):
    system = saltus.LeafSystem(name="nothing")
    results = go(system, method=method)
    assert (results.status, results.context.time) == ("reached_end", 2.0)
    assert results.statistics.right_hand_side_calls == results.statistics.guard_calls == 0
    assert len(results.events) == 0


@pytest.mark.parametrize(
    ("source", "expected"),
    [(Constant(2.0), {2.0}), (Pulse(period=1.0), {0.0, 1.0}), (Sine(name="sine"), None)],
)
def test_a_scene_without_state_shows_its_outputs(source, expected):
    results = go(source)
    assert results.status == "reached_end"
    assert (results.time[0], results.time[-1]) == (0.0, 2.0)
    assert expected is None or set(results.outputs["out"]) == expected


@pytest.mark.parametrize("method", METHODS)
def test_a_guard_without_state_is_located(method):
    class Alarm(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="alarm")
            self.declare_zero_crossing(lambda t, s: t - 1 / 3, name="ring")

    results = go(Alarm(), method=method)
    assert results.events.times("ring") == pytest.approx([1 / 3], abs=1e-13)


@pytest.mark.parametrize("method", METHODS)
def test_a_state_without_equation_guard_or_output_stays(method):
    class Still(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="still")
            self.declare_continuous_state([1.0, 2.0])

    results = go(Still(), method=method)
    assert results.status == "reached_end"
    assert results.context.continuous_state.tolist() == [1.0, 2.0]
