"""Section 2: when a guard fires, and where."""

import numpy as np
import pytest
import saltus
from blocks import Ball, Block, crossing, go, kinds, ramp, x

METHODS = ["dopri5", "adams", "bdf", "radau", "taylor", "auto"]
EPS = np.finfo(float).eps


def wave(direction, **options):
    """sin(2 pi t), from 0 to 2: falls at 0.5, 1.5, rises at 1."""
    guard = lambda t, s: np.sin(2.0 * np.pi * t)  # noqa: E731
    return go(crossing(guard, direction=direction, **options), 1.9, begin=0.1)


@pytest.mark.parametrize(
    ("direction", "times", "signs"),
    [
        ("none", [], []),
        ("positive_then_non_positive", [0.5, 1.5], [-1, -1]),
        ("negative_then_non_negative", [1.0], [1]),
        ("crosses_zero", [0.5, 1.0, 1.5], [-1, 1, -1]),
    ],
)
def test_2_1_directions(direction, times, signs):
    results = wave(direction)
    np.testing.assert_allclose(results.events.times("cross"), times, atol=1e-12)
    assert [e.direction for e in results.events] == signs


def test_2_1_a_guard_reads_time_both_states_mode_inputs_and_parameters():
    seen = []

    def declare(self):
        ramp()(self)
        self.declare_discrete_state([2.0])
        self.declare_default_mode(3)
        self.declare_dynamic_parameter("p", 4.0)

        def guard(t, s, p):
            seen.append((s.discrete_state[0], s.mode, p))
            return s.continuous_state[0] + t - p / 4.0

        self.declare_zero_crossing(guard, name="cross")

    results = go(Block(declare), 1.0)
    assert results.events.times("cross") == pytest.approx([0.5], abs=1e-12)
    assert set(seen) == {(2.0, 3, 4.0)}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("begin", [0.0, 0.1, -1.5])
def test_2_3_a_ball_at_rest_on_the_floor_rests(e, method, begin):
    results = go(Ball(e=e), begin + 1.0, begin, ode_solver_method=method)
    assert np.all(results.outputs["x"] == 0.0)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_2_3_a_ball_thrown_up_from_the_floor_flies(e, method):
    results = go(Ball(e=e, v=9.81), 1.9, ode_solver_method=method, rtol=1e-9)
    t, y = results.time, results.outputs["x"][:, 0]
    np.testing.assert_allclose(y, 9.81 * t - 0.5 * 9.81 * t**2, atol=1e-6)
    assert len(results.events) == 0


@pytest.mark.parametrize("v", [0.0, -1.0])
def test_2_3_contact_at_the_start_is_an_event_at_the_start(v):
    results = go(Ball(e=0.5, v=v), 0.01, 0.0)
    assert results.events.times("bounce")[0] == 0.0


@pytest.mark.parametrize("options", [{}, {"terminal": True}])
def test_2_3_a_monitor_or_a_terminal_guard_waits_at_its_own_finish_line(options):
    """An orbit that starts on it ends after one turn, not at once."""

    def declare(self):
        self.declare_continuous_state(
            [0.0, 1.0], ode=lambda t, s: [s.continuous_state[1], -s.continuous_state[0]]
        )
        self.declare_zero_crossing(
            x, name="line", direction="negative_then_non_negative", **options
        )

    results = go(Block(declare), 7.0, rtol=1e-9, atol=1e-12)
    assert [e.time for e in results.events] == pytest.approx([2.0 * np.pi], abs=1e-6)


@pytest.mark.parametrize("method", METHODS)
def test_2_4_on_the_firing_side_it_waits_until_it_has_been_on_the_other(method):
    """x = -0.5 + 2 t - t^2 goes up and down again."""

    def declare(self):
        self.declare_continuous_state([-0.5], ode=lambda t, s: [2.0 - 2.0 * t])
        self.declare_discrete_state([0.0])
        self.declare_zero_crossing(
            x,
            lambda t, s: s.with_discrete_state(s.discrete_state + 1.0),
            name="fall",
            direction="positive_then_non_positive",
        )

    results = go(Block(declare), 3.0, ode_solver_method=method, rtol=1e-9, atol=1e-12)
    # -0.5 + 2 t - t^2 = 0
    assert results.events.times("fall") == pytest.approx([1.0 + 0.5**0.5], abs=1e-6)


def at_start(choice, start):
    return crossing(
        lambda t, s: -x(t, s),
        "count",
        start=start,
        direction="positive_then_non_positive",
        at_start=choice,
    )


@pytest.mark.parametrize(
    ("choice", "start", "times"),
    [
        ("ignore", 0.0, []),
        ("ignore", 1.0, []),
        ("fire", 0.0, [0.0]),
        ("fire", 1.0, [0.0]),
    ],
)
def test_2_4_at_start_decides_both_cases(choice, start, times):
    assert go(at_start(choice, start), 1.0).events.times("cross").tolist() == times


@pytest.mark.parametrize("start", [0.0, 1.0])
def test_2_4_at_start_may_be_an_error(start):
    with pytest.raises(saltus.SimulationError, match=r"t = 0 s: .*block.cross"):
        go(at_start("error", start), 1.0)


def test_2_4_at_start_does_not_matter_off_zero_before_the_crossing():
    for choice in ("auto", "ignore", "fire", "error"):
        assert go(at_start(choice, -0.5), 1.0).events.times("cross") == pytest.approx([0.5])


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("rtol", [1e-2, 1e-6, 1e-10])
@pytest.mark.parametrize("e", [0.0, 0.3, 0.9, 1.0])
def test_2_5_no_ball_falls_through_a_floor(e, rtol, method):
    results = go(Ball(e=e, y=1.0), 6.0, rtol=rtol, atol=1e-2 * rtol, ode_solver_method=method)
    assert results.outputs["x"][:, 0].min() >= -10.0 * rtol


def test_2_5_a_guard_that_was_passed_through_waits_until_it_was_off_zero():
    results = go(crossing(lambda t, s: x(t, s) - 0.5, "count"), 1.0)
    assert kinds(results) == [("zero_crossing", "cross")]


@pytest.mark.parametrize("method", METHODS)
def test_2_6_a_guard_that_is_zero_for_a_while_fires_neither_then_nor_on_leaving(method, capfd):
    guard = lambda t, s: max(0.0, x(t, s) - 0.5)  # noqa: E731
    system = crossing(guard, "count", direction="positive_then_non_positive")
    assert len(go(system, 1.0, ode_solver_method=method).events) == 0
    assert capfd.readouterr() == ("", "")


def test_2_7_a_guard_that_cannot_fire_is_not_called():
    calls = []

    def guard(t, s):
        calls.append(t)
        return x(t, s) - 0.5

    go(crossing(guard, "count", direction="none"), 1.0)
    assert calls == []
    system = crossing(guard, "count", start_mode=1)
    assert len(go(system, 1.0).events) == 0
    assert calls == []


def test_2_8_two_crossings_in_one_step_are_found_by_looking_inside():
    """The guard dips below zero between t = 0.45 and 0.55."""
    guard = lambda t, s: (t - 0.5) ** 2 - 0.05**2  # noqa: E731
    assert len(go(crossing(guard), 1.0, event_scan_points=20).events) == 2


@pytest.mark.parametrize("method", METHODS)
def test_2_9_the_state_handed_on_is_at_zero_or_beyond_and_the_earliest_comes_first(method):
    def declare(self):
        ramp(3.0)(self)
        for level in (8, 4, 6):
            self.declare_zero_crossing(
                lambda t, s, level=level: x(t, s) - level / 4,
                lambda t, s: s.with_continuous_state(s.continuous_state),
                name=f"at {level}/4",
            )

    results = go(Block(declare), 1.0, ode_solver_method=method)
    assert [e.name for e in results.events] == ["at 4/4", "at 6/4", "at 8/4"]
    for e in results.events:
        level = int(e.name[3]) / 4
        # the interpolant of a straight line is exact to rounding
        assert abs(e.time - level / 3.0) <= 100.0 * EPS * (1.0 + e.time)
        assert e.before[0] >= level


@pytest.mark.parametrize("scale", [1e-200, 1e200])
def test_2_9a_a_guard_of_any_size_is_located_as_well(scale):
    guard = lambda t, s: scale * (x(t, s) - 0.5)  # noqa: E731
    assert go(crossing(guard, "count"), 1.0).events.times("cross") == pytest.approx(
        [0.5], abs=1e-13
    )


@pytest.mark.parametrize("method", METHODS)
def test_2_10_a_monitor_changes_no_bit(method):
    def decay(watched):
        def declare(self):
            self.declare_continuous_state([1.0], ode=lambda t, s: -s.continuous_state)
            self.declare_continuous_state_output("x")
            if watched:
                self.declare_zero_crossing(lambda t, s: x(t, s) - 0.5, name="half")

        return go(Block(declare), 1.0, ode_solver_method=method)

    with_monitor, without = decay(True), decay(False)
    assert len(with_monitor.events) == 1
    assert np.array_equal(with_monitor.time, without.time)
    assert np.array_equal(with_monitor.outputs["x"], without.outputs["x"])


def test_2_11_the_mode_is_frozen_between_instants():
    modes = []

    def declare(self):
        def ode(t, s):
            modes.append((t, s.mode))
            return [1.0]

        self.declare_continuous_state([0.0], ode=ode)
        self.declare_default_mode(0)
        self.declare_zero_crossing(lambda t, s: x(t, s) - 0.5, name="up", end_mode=1)

    results = go(Block(declare), 1.0)
    (event,) = results.events
    at = next(i for i, (_, mode) in enumerate(modes) if mode == 1)
    assert {mode for _, mode in modes[at:]} == {1}
    assert all(t >= event.time for t, mode in modes if mode == 1)
