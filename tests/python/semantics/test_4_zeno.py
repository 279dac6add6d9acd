"""Section 4: firings that accumulate end in rest, at the exact time and state."""

import numpy as np
import pytest
import saltus
from blocks import Ball, Block, go, kinds, x
from saltus.library import Adder, Ramp, Slice, Step

FINE = {"rtol": 1e-10, "atol": 1e-12}
METHODS = ["dopri5", "adams", "bdf", "radau", "taylor", "auto"]


def rest_time(y, e, g=9.81):
    return np.sqrt(2.0 * y / g) * (1.0 + e) / (1.0 - e)


def entered(results):
    return [e for e in results.events if e.kind == "zeno_enter"]


@pytest.mark.parametrize("e", [0.3, 0.5, 0.8])
def test_4_1_any_guard_with_a_reset_has_a_monitor_and_4_3_predicts_the_rest(e):
    results = go(Ball(e=e, y=1.0), 10.0, **FINE)
    (event,) = entered(results)
    assert event.predicted == pytest.approx(rest_time(1.0, e), abs=1e-9)
    assert event.after == pytest.approx([0.0, 0.0], abs=1e-9)
    assert results.context.continuous_state == pytest.approx([0.0, 0.0], abs=1e-9)


def test_4_1_the_tolerance_of_a_guard_overrides_that_of_the_options():
    early = go(Ball(e=0.5, y=1.0, zeno_tolerance=1e-2), 3.0, **FINE)
    late = go(Ball(e=0.5, y=1.0, zeno_tolerance=1e-8), 3.0, zeno_tolerance=1e-2, **FINE)
    assert len(early.events) < len(late.events)
    for results in (early, late):
        assert entered(results)[0].predicted == pytest.approx(rest_time(1.0, 0.5), abs=1e-8)


@pytest.mark.parametrize("begin", [0.0, 1.0, -7.0, 1e6])
def test_4_2_the_first_firing_is_never_zeno_whatever_the_time(begin):
    results = go(Ball(e=0.5, y=1.0), begin + 0.5, begin)
    assert kinds(results) == [("zero_crossing", "bounce")]


def test_4_2_a_steady_fast_rhythm_is_not_zeno():
    """x rises from 0 to 1 in 1e-7 s, and is set back."""

    def declare(self):
        self.declare_continuous_state([0.0], ode=lambda t, s: [1e7])
        self.declare_zero_crossing(
            lambda t, s: x(t, s) - 1.0, lambda t, s: s.with_continuous_state([0.0]), name="back"
        )

    results = go(Block(declare), 1.0005e-4)
    assert results.events.times("back") == pytest.approx(1e-7 * np.arange(1, 1001), rel=1e-6)
    assert entered(results) == []


def slides(self):
    """x' = -t from 0: `count` fires at once, and the slope of its guard is zero there."""
    self.declare_continuous_state([0.0], ode=lambda t, s: [-t])
    self.declare_continuous_state_output("x")
    self.declare_discrete_state([0.0])
    self.declare_zero_crossing(
        x,
        lambda t, s: s.with_discrete_state(s.discrete_state + 1.0),
        name="count",
        direction="positive_then_non_positive",
    )


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize("recorded", [False, True])
@pytest.mark.parametrize("method", METHODS)
def test_4_2_a_recorded_sum_with_a_ball_that_comes_to_rest_brings_nothing_else_to_rest(
    method, recorded, python
):
    if (method, python) == ("taylor", "called"):  # no series of what is called
        method = "dop853"
    builder = saltus.DiagramBuilder()
    block, ball = builder.add(Block(slides, "slides"), Ball())
    total = builder.add(Adder(2))
    height = builder.add(Slice("0"))
    builder.connect(block.output_ports[0], total.input_ports[0])
    builder.connect(ball.output_ports[0], height.input_ports[0])
    builder.connect(height.output_ports[0], total.input_ports[1])
    if recorded:
        builder.export_output(total.output_ports[0], "sum")
    results = go(builder.build(), 1.0, ode_solver_method=method, python=python, **FINE)
    # x(1) = -1/2, and each of fewer than a thousand steps may err by the tolerance.
    assert results.context.continuous_state == pytest.approx([-0.5, 0.0, 0.0], abs=1e-7)
    assert [event.block for event in entered(results)] == ["ball"]


@pytest.mark.parametrize("method", METHODS)
def test_4_2_a_reset_that_leads_straight_back_is_rest_at_once(method):
    results = go(Ball(e=0.0, y=1.0), 2.0, ode_solver_method=method, rtol=1e-8, atol=1e-10)
    (event,) = entered(results)
    assert event.time == pytest.approx(np.sqrt(2.0 / 9.81), abs=1e-5)
    assert results.context.continuous_state.tolist() == [0.0, 0.0]


def test_4_4_on_zeno_stop_ends_the_run_there():
    results = go(Ball(e=0.5, y=1.0, on_zeno="stop"), 10.0, **FINE)
    assert results.status == "zeno_stop"
    assert results.message == ""
    assert results.context.time == pytest.approx(rest_time(1.0, 0.5), abs=1e-5)
    assert results.context.continuous_state == pytest.approx([0.0, 0.0], abs=1e-9)


def test_4_4_on_zeno_error_says_which_guard():
    with pytest.raises(saltus.SimulationError, match=r"t = \S+ s: .*ball.*bounce") as caught:
        go(Ball(e=0.5, y=1.0, on_zeno="error"), 10.0, **FINE)
    assert caught.value.block == "ball"
    assert caught.value.time == pytest.approx(rest_time(1.0, 0.5), abs=1e-5)


def test_4_4_on_zeno_a_mode_goes_on_with_dynamics_of_its_own():
    """A ball that rolls away once it has come to rest."""

    def declare(self):
        def ode(t, s):
            return [s.continuous_state[1], -9.81, 0.0] if s.mode == 0 else [0.0, 0.0, 1.0]

        def bounce(t, s):
            return s.with_continuous_state([0.0, -0.5 * s.continuous_state[1], 0.0])

        self.declare_continuous_state([1.0, 0.0, 0.0], ode=ode)
        self.declare_default_mode(0)
        self.declare_zero_crossing(
            x,
            bounce,
            name="bounce",
            direction="positive_then_non_positive",
            start_mode=0,
            on_zeno=1,
        )

    results = go(Block(declare), 3.0, **FINE)
    assert results.context.mode == 1
    assert results.context.continuous_state == pytest.approx(
        [0.0, 0.0, 3.0 - rest_time(1.0, 0.5)], abs=1e-5
    )


def test_4_4_holds_names_the_states_that_rest():
    """A clock in the same block goes on."""

    def declare(self):
        self.declare_continuous_state(
            [1.0, 0.0, 0.0], ode=lambda t, s: [s.continuous_state[1], -9.81, 1.0]
        )
        self.declare_zero_crossing(
            x,
            lambda t, s: s.with_continuous_state([0.0, -0.5 * s.continuous_state[1], t]),
            name="bounce",
            direction="positive_then_non_positive",
            holds=[[0, 1]],
        )

    results = go(Block(declare), 3.0, **FINE)
    assert results.context.continuous_state == pytest.approx([0.0, 0.0, 3.0], abs=1e-8)


def on_floor(source, **options):
    builder = saltus.DiagramBuilder()
    ball, floor = builder.add(Ball(floor=True, **options), source)
    builder.connect(floor.output(), ball.input())
    return builder.build(), ball


def test_4_5_a_floor_that_drops_releases_the_ball_at_that_moment():
    diagram, ball = on_floor(Step(start_value=0.0, end_value=-1.0, step_time=2.0), y=1.0)
    recorded = {"x": ball.output()}
    context = diagram.create_context()
    results = saltus.simulate(diagram, context, (0.0, 2.2), recorded_signals=recorded, **FINE)
    release = [e.time for e in results.events if e.kind == "zeno_release"]
    assert release == [2.0]
    flying = results.time > 2.0
    np.testing.assert_allclose(
        results.outputs["x"][flying, 0], -0.5 * 9.81 * (results.time[flying] - 2.0) ** 2, atol=1e-9
    )


def test_4_5_a_floor_that_steps_up_carries_the_ball():
    diagram, _ = on_floor(Step(start_value=0.0, end_value=0.3, step_time=2.0), y=1.0)
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 3.0), **FINE)
    assert results.context.continuous_state == pytest.approx([0.3, 0.0], abs=1e-9)


def test_4_5_a_floor_that_rises_continuously_carries_the_ball():
    diagram, _ = on_floor(Ramp(start_value=0.0, slope=0.1, start_time=2.0), y=1.0)
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 3.0), **FINE)
    assert results.context.continuous_state[0] == pytest.approx(0.1, abs=1e-6)


def test_4_6_holding_costs_nothing():
    short, long = (go(Ball(e=0.5, y=1.0), end, **FINE) for end in (3.0, 3000.0))
    assert len(short.events) == len(long.events)
    assert long.statistics.steps - short.statistics.steps < 20
    assert long.statistics.guard_calls - short.statistics.guard_calls < 200


def test_4_7_chattering_says_where_how_often_and_what_helps():
    """dx/dt = -sign(x), switched by modes: it slides along x = 0."""

    def declare(self):
        self.declare_continuous_state([1.0], ode=lambda t, s: [-1.0 if s.mode == 0 else 1.0])
        self.declare_default_mode(0)
        for mode, direction in (
            (0, "positive_then_non_positive"),
            (1, "negative_then_non_negative"),
        ):
            self.declare_zero_crossing(
                x,
                name=f"to{1 - mode}",
                direction=direction,
                start_mode=mode,
                end_mode=1 - mode,
                zeno_tolerance=0.0,
            )

    with pytest.raises(saltus.SimulationError, match=r"^t = 1\S* s: guard 'to") as caught:
        go(Block(declare), 3.0)
    assert caught.value.results.status == "chattering"
    assert caught.value.time == pytest.approx(1.0, abs=1e-6)
    assert len(caught.value.results.events) < 5000
    for word in ("of block 'block'", "times in", "hysteresis", "zeno_tolerance"):
        assert word in str(caught.value)


def beside(time, state):
    """A ball, and a state that has nothing to do with it."""
    return [state.continuous_state[1], -10.0, 0.37]


@pytest.mark.parametrize("python", ["traced", "called"])
def test_4_4_a_hold_stops_what_a_traced_guard_and_its_reset_touch(python, tmp_path):
    ball = saltus.LeafSystem(name="ball")
    ball.declare_continuous_state([1.0, 0.0, 0.0], ode=beside)
    ball.declare_zero_crossing(
        lambda t, s: s.continuous_state[0],
        lambda t, s: s.with_continuous_state(
            [0.0, -0.5 * s.continuous_state[1], s.continuous_state[2]]
        ),
        name="bounce",
        direction="falling",
    )
    results = saltus.simulate(ball, ball.create_context(), (0, 9.5), python=python)
    hold = next(e for e in results.events if e.kind == "zeno_enter")
    assert hold.rests == ((0, 1) if python == "traced" else (0, 1, 2))
    flown = 9.5 if python == "traced" else hold.time
    assert results.context.continuous_state[2] == pytest.approx(0.37 * flown, rel=1e-6)
    results.save(tmp_path / "ball.npz")
    again = saltus.load_results(tmp_path / "ball.npz")
    assert [e.rests for e in again.events] == [e.rests for e in results.events]


@pytest.mark.parametrize("holds", [[0, 1], [[0, 1]]])
@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("python", ["traced", "called"])
def test_4_4_a_ball_rests_on_a_table_of_its_own_block_that_swings_on(holds, mirrored, python):
    w = np.pi

    def flow(t, s):
        _, v, h, u = s.continuous_state
        return np.array([v, -9.81, u, -(w**2) * h])

    def bounce(t, s):
        y, v, h, u = s.continuous_state
        return s.with_continuous_state(
            np.array([h + np.abs(y - h) if mirrored else h, u - 0.4 * (v - u), h, u])
        )

    both = saltus.LeafSystem(name="both")
    both.declare_continuous_state([0.5, 0.0, 0.1, 0.0], ode=flow)
    both.declare_zero_crossing(
        lambda t, s: s.continuous_state[0] - s.continuous_state[2],
        bounce,
        name="hit",
        direction="positive_then_non_positive",
        holds=holds,
    )
    results = go(both, 6.0, python=python, rtol=1e-9, atol=1e-11)
    assert len(entered(results)) == 1
    # The table swings with 0.1 cos(w t), whose acceleration of 1 m/s^2 never lets the ball go. An
    # oscillation adds up the errors of its steps: hundreds, each within the tolerance.
    at_end = [0.1 * np.cos(6 * w), -0.1 * w * np.sin(6 * w)]
    assert results.context.continuous_state == pytest.approx(np.tile(at_end, 2), abs=1e-7)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("islands", [False, True])
@pytest.mark.parametrize("reset", [None, lambda t, state: state.with_discrete_state([1.0])])
def test_4_7_edge_detection_of_a_number_that_varies_chatters(method, islands, reset):
    leaf = saltus.LeafSystem(name="tank")
    leaf.declare_continuous_state([0.0], ode=lambda t, state: [1.0])
    leaf.declare_discrete_state([0.0])
    leaf.declare_zero_crossing(
        lambda t, state: state.continuous_state[0] - 0.7, reset, "full", "edge_detection"
    )
    results = saltus.simulate(
        leaf, (0.0, 1.0), ode_solver_method=method, islands=islands, throw=False
    )
    assert results.status == "chattering"
    assert "guard 'tank.full' fired 1000 times" in results.message
    assert "crosses_zero" in results.message
    with pytest.raises(saltus.SimulationError, match="its direction is edge_detection"):
        saltus.simulate(leaf, (0.0, 1.0), ode_solver_method=method, islands=islands)
