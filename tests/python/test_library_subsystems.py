"""Enabled and triggered subsystems: time stands still in what is not executed."""

import itertools
import math

import numpy as np
import pytest
import saltus
from saltus.library import (
    Adder,
    Clock,
    Comparator,
    Constant,
    ControlPort,
    DataSource,
    DelayN,
    EdgeDetection,
    EnabledSubsystem,
    Gain,
    IfThenElse,
    Integrator,
    Multiplexer,
    Pulse,
    Relay,
    Sine,
    Step,
    TransportDelay,
    TriggeredSubsystem,
    UnitDelay,
    ZeroOrderHold,
)

PRECISE = {"rtol": 1e-10, "atol": 1e-12}
METHODS = ["auto", "dopri5", "dop853", "radau", "bdf", "adams"]


def van_der_pol(called):
    """x'' = (1 - x^2) x' - x, with a kick at each zero of x that is counted; traced or called."""

    def rates(time, state):
        x, v = state.continuous_state
        if called and float(x) > 1e9:  # a number decides: this cannot be traced
            return np.zeros(2)
        return np.array([v, (1.0 - x * x) * v - x])

    leaf = saltus.LeafSystem(name="oscillator")
    leaf.declare_continuous_state(default_value=[2.0, 0.0], ode=rates)
    leaf.declare_discrete_state(default_value=0.0)
    leaf.declare_zero_crossing(
        lambda time, state: state.continuous_state[0],
        name="zero",
        reset_map=lambda time, state: state.with_continuous_state(
            np.array([state.continuous_state[0], 1.1 * state.continuous_state[1]])
        ).with_discrete_state(state.discrete_state + 1.0),
    )
    leaf.declare_continuous_state_output(name="state")
    leaf.declare_discrete_state_output(name="count")
    return leaf


def driven(part, control):
    builder = saltus.DiagramBuilder()
    builder.add(part, control)
    builder.connect(control.output(), part.input(len(part.input_names) - 1))
    return builder.build()


def enabled_time(t, period):
    """How long a pulse of width 1/2 was above 0 until t."""
    cycles, rest = divmod(t, period)
    return cycles * period / 2 + min(rest, period / 2)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("called", [False, True])
def test_a_system_that_is_enabled_now_and_then_is_the_system_in_its_own_time(method, called):
    oscillator = van_der_pol(called)
    part = EnabledSubsystem(oscillator, initial_outputs={"state": [2.0, 0.0], "count": [0.0]})
    scene = driven(part, Pulse(period=1.4))
    end = 20.3
    run = saltus.simulate(scene, time_span=(0.0, end), ode_solver_method=method, **PRECISE)
    alone = van_der_pol(called)
    own = saltus.simulate(
        alone, time_span=(0.0, enabled_time(end, 1.4)), ode_solver_method="dop853", rtol=1e-12
    )
    # 10 s of an attracting cycle: some hundred times the tolerance of the multistep methods
    assert run.context[oscillator].continuous_state == pytest.approx(
        own.context.continuous_state, abs=1e-6
    )
    assert run.context[oscillator].discrete_state == own.context.discrete_state


def test_the_run_in_pieces_is_the_run_in_one():
    oscillator = van_der_pol(False)
    part = EnabledSubsystem(oscillator, initial_outputs={"state": [2.0, 0.0], "count": [0.0]})
    scene = driven(part, Sine(frequency=3.0))
    whole = saltus.simulate(scene, time_span=(0.0, 12.0), **PRECISE)
    context = scene.create_context()
    for begin in range(12):
        context = saltus.simulate(scene, context, (begin, begin + 1.0), **PRECISE).context
    assert context.continuous_state == pytest.approx(whole.context.continuous_state, abs=1e-8)
    assert list(context.discrete_state) == pytest.approx(
        list(whole.context.discrete_state), abs=1e-8
    )


def test_the_derivative_by_the_time_at_which_it_is_enabled():
    """x = t - t_on: dx/dt_on = -1."""
    builder = saltus.DiagramBuilder()
    clock, level = builder.add(Clock(name="t"), Constant(1.5, name="on"))
    later, one = builder.add(Adder("+-", name="later"), Constant(1.0, name="one"))
    part = builder.add(EnabledSubsystem(Integrator(name="x"), name="sub"))
    builder.connect(clock.output(), later.input(0))
    builder.connect(level.output(), later.input(1))
    builder.connect(later.output(), part.input("enable"))
    builder.connect(one.output(), part.input(0))
    scene = builder.build()
    run = saltus.simulate(scene, time_span=(0.0, 4.0), sensitivity=["on.value"], **PRECISE)
    assert run.context.continuous_state == pytest.approx([2.5], abs=1e-9)
    assert run.sensitivities.continuous_state.ravel() == pytest.approx([-1.0], abs=1e-8)


def test_islands_of_which_one_is_a_subsystem():
    def scene():
        builder = saltus.DiagramBuilder()
        part, sine = builder.add(
            EnabledSubsystem(Integrator(name="x"), name="sub"), Sine(frequency=2.0, name="sine")
        )
        one, alone = builder.add(Constant(1.0, name="one"), Integrator(name="alone"))
        builder.connect(one.output(), part.input(0))
        builder.connect(sine.output(), part.input("enable"))
        builder.connect(one.output(), alone.input())
        return builder.build()

    whole, parts = (
        saltus.simulate(scene(), time_span=(0.0, 9.0), islands=islands, **PRECISE)
        for islands in (False, True)
    )
    assert parts.context.continuous_state == pytest.approx(whole.context.continuous_state, abs=1e-9)


def test_a_block_that_adds_up_the_widths_of_its_inputs_is_no_wider_for_its_control():
    builder = saltus.DiagramBuilder()
    both = builder.add(Multiplexer(2, name="both"))
    builder.export_input(both.input(0), "a")
    builder.export_input(both.input(1), "b")
    builder.export_output(both.output(), "ab")
    part = EnabledSubsystem(builder.build("part"), initial_outputs={"ab": [0.0, 0.0]})
    assert saltus.response(part, Clock(), 3.0, 1.0, t=2.0) == pytest.approx([2.0, 3.0])


def test_a_state_that_is_reset_on_a_tick_is_reset_before_its_update():
    """The delay takes u = 7 at the tick at 2 s, after it returned to its start."""
    part = EnabledSubsystem(UnitDelay(1.0, initial_state=-1.0, name="delay"), states="reset")
    y = saltus.response(part, 7.0, Pulse(period=2.0), t=[0.5, 2.5, 4.5])
    assert list(y) == [-1.0, -1.0, -1.0]
    held = EnabledSubsystem(UnitDelay(1.0, initial_state=-1.0, name="delay"))
    assert list(saltus.response(held, 7.0, Pulse(period=2.0), t=[0.5, 2.5, 4.5])) == [
        -1.0,
        7.0,
        7.0,
    ]


def test_a_comparison_decides_what_is_executed_without_a_subsystem():
    """Two tanks: the second fills while the first is above 1."""
    builder = saltus.DiagramBuilder()
    level, _ = builder.add(Constant(1.0, name="level"), Constant(1.0, name="one"))
    first, second = builder.add(Integrator(name="first"), Integrator(name="second"))
    above = builder.add(Comparator(">", name="above"))
    for source, to in [("one.out", "first.in"), ("one.out", "second.in")]:
        builder.connect(source, to)
    builder.connect(first.output(), above.input(0))
    builder.connect(level.output(), above.input(1))
    builder.execute(second, "above.out")
    run = saltus.simulate(builder.build(), time_span=(0.0, 3.0), **PRECISE)
    assert run.context[second].continuous_state == pytest.approx([2.0], abs=1e-9)


def test_a_leaf_in_python_takes_the_sample_time_of_the_trigger():
    leaf = saltus.LeafSystem(name="sum")
    leaf.declare_discrete_state(default_value=0.0)
    leaf.declare_input_port(name="u")
    leaf.declare_periodic_update(
        lambda time, state, u: state.with_discrete_state(state.discrete_state + u), period=-1.0
    )
    leaf.declare_output_port(
        lambda time, state, u: state.discrete_state + u, name="y", default_value=0.0
    )
    part = TriggeredSubsystem(leaf, edge="rising")
    y = saltus.response(part, 2.0, Pulse(period=1.0, phase_delay=0.5), t=[0.4, 0.6, 1.6, 2.6])
    assert list(y) == [0.0, 2.0, 4.0, 6.0]


def test_mistakes_say_what_to_do():
    def run(part, *inputs):
        return saltus.response(part, *inputs, t=1.0)

    with pytest.raises(
        saltus.ModelError, match=r"continuous state.*EnabledSubsystem takes the block"
    ):
        run(TriggeredSubsystem(Integrator(name="x")), 1.0, Sine())
    with pytest.raises(saltus.ModelError, match=r"delay': .*inherited sample time, -1"):
        run(TriggeredSubsystem(UnitDelay(0.1, name="delay")), 1.0, Sine())
    with pytest.raises(saltus.ModelError, match="put it into a TriggeredSubsystem"):
        run(UnitDelay(-1.0), 1.0)
    with pytest.raises(saltus.ModelError, match="zero crossing 'turn_on'"):
        run(TriggeredSubsystem(Relay(1.0)), 1.0, Sine())
    with pytest.raises(saltus.ModelError, match="history"):
        run(EnabledSubsystem(TransportDelay(0.1)), 1.0, Sine())
    with pytest.raises(saltus.ModelError, match=r"unknown states 'rest'; did you mean 'reset'"):
        EnabledSubsystem(Gain(1.0), states="rest")
    with pytest.raises(saltus.ModelError, match=r"unknown outputs 'hold'; did you mean 'held'"):
        EnabledSubsystem(Gain(1.0), outputs="hold")
    with pytest.raises(saltus.ModelError, match="unknown edge 'rise'"):
        TriggeredSubsystem(Gain(1.0), edge="rise")
    with pytest.raises(saltus.ModelError, match=r"unknown output 'y'.*'out'"):
        TriggeredSubsystem(Gain(1.0), initial_outputs={"y": 1.0})
    builder = saltus.DiagramBuilder()
    x, t, port = builder.add(Integrator(name="x"), Clock(name="t"), ControlPort(name="on"))
    builder.connect(t.output(), x.input())
    builder.connect(t.output(), port.input())
    with pytest.raises(saltus.ModelError, match="cannot control its own execution"):
        builder.execute(x, x.output())
    builder.execute(x, t.output())
    with pytest.raises(saltus.ModelError, match="'x' already has a control signal"):
        builder.execute(x, port.output())
    with pytest.raises(saltus.ModelError, match=r"expects one held value.*put a Comparator"):
        saltus.simulate(builder.build(), time_span=(0.0, 1.0))


def test_a_ball_at_rest_that_is_not_enabled_goes_on_resting():
    """It is at rest from 2 s on; the pulse disables it and enables it again and again."""
    ball = saltus.LeafSystem(name="ball")
    ball.declare_continuous_state(
        default_value=[1.0, 0.0], ode=lambda t, s: np.array([s.continuous_state[1], -9.81])
    )
    ball.declare_zero_crossing(
        lambda t, s: s.continuous_state[0],
        name="bounce",
        direction="positive_then_non_positive",
        reset_map=lambda t, s: s.with_continuous_state(
            np.array([0.0 * s.continuous_state[0], -0.5 * s.continuous_state[1]])
        ),
    )
    ball.declare_continuous_state_output(name="state")
    part = EnabledSubsystem(ball, initial_outputs={"state": [1.0, 0.0]})
    run = saltus.simulate(driven(part, Pulse(period=3.0)), time_span=(0.0, 30.0), **PRECISE)
    zeno = math.sqrt(2.0 / 9.81) * (1.0 + 2.0 * 0.5 / (1.0 - 0.5))  # 1.35 s < 1.5 s
    assert run.context.continuous_state == pytest.approx([0.0, 0.0], abs=1e-9)
    assert run.events.times("bounce", "zeno_enter")[0] == pytest.approx(
        zeno, abs=1e-6
    )  # the Zeno tolerance


def ball_on_a_floor(called):
    """Its floor is an input; its guard is a truth, which tells nothing of what happens at rest."""
    ball = saltus.LeafSystem(name="ball")
    ball.declare_input_port(name="floor")

    def above(time, state, floor):
        if called and float(time) < 0.0:  # a number decides: this cannot be traced
            return False
        return state.continuous_state[0] > floor

    ball.declare_continuous_state(
        default_value=[1.0, 0.0],
        ode=lambda t, s, floor: np.array([s.continuous_state[1], -9.81]),
    )
    ball.declare_zero_crossing(
        above,
        name="bounce",
        direction="positive_then_non_positive",
        reset_map=lambda t, s, floor: s.with_continuous_state(
            np.array([floor + 0.0 * s.continuous_state[0], -0.5 * s.continuous_state[1]])
        ),
    )
    ball.declare_continuous_state_output(name="state")
    return ball


@pytest.mark.parametrize("called", [False, True])
@pytest.mark.parametrize("method", METHODS)
def test_a_ball_whose_guard_is_a_truth_rests_through_times_at_which_it_is_not_enabled(
    called, method
):
    part = EnabledSubsystem(ball_on_a_floor(called), initial_outputs={"state": [1.0, 0.0]})
    y = saltus.response(
        part, 0.0, Pulse(period=3.0), t=[1.4, 2.9, 10.0, 19.0], ode_solver_method=method
    )
    assert np.abs(y).max() < 1e-4  # the height below which the bounces of 1e-6 s do not count


@pytest.mark.parametrize("method", METHODS)
def test_a_floor_that_moves_while_the_ball_on_it_is_not_enabled(method):
    """The floor is at 0 until 2 s and at `level` from then on; the ball may move from 3 s on."""
    for level, expected in [(0.5, 0.5), (-1.0, -1.0)]:
        part = EnabledSubsystem(ball_on_a_floor(False), initial_outputs={"state": [1.0, 0.0]})
        floor = Step(0.0, level, 2.0)
        y = saltus.response(
            part, floor, Pulse(period=3.0), t=[2.9, 4.45, 12.0], ode_solver_method=method
        )
        assert y[0] == pytest.approx([0.0, 0.0], abs=1e-4)
        assert y[2] == pytest.approx([expected, 0.0], abs=1e-4)


def delayed_by_hand():
    """(y, s) := (s, u) at ticks."""
    block = saltus.LeafSystem(name="delay")
    block.declare_input_port("in")
    block.declare_discrete_state([-1.0, -1.0])
    block.declare_output_port(
        lambda t, s: s.discrete_state[0], name="out", requires_inputs=False, shape=()
    )
    block.declare_periodic_update(
        lambda t, s, u: s.with_discrete_state(np.array([s.discrete_state[1], u])), period=0.5
    )
    return block


@pytest.mark.parametrize(
    "make",
    [
        delayed_by_hand,
        lambda: DelayN(0.5, 1, initial_state=-1.0),
        lambda: UnitDelay(0.5, initial_state=-1.0),
    ],
)
def test_ticks_of_a_part_that_is_not_enabled_are_none(make):
    """The part is not enabled from 1.3 s to 3.6 s, so the five ticks in between are not executed. At
    3.6 s its output is still that of the tick at 1 s, which is u(0.5) = 0.5."""
    builder = saltus.DiagramBuilder()
    part, clock = builder.add(EnabledSubsystem(make()), Clock())
    control = builder.add(
        DataSource([0.0, 1.3, 3.6], [1.0, 0.0, 1.0], interpolation="zero_order_hold")
    )
    builder.connect(clock.output(), part.input("in"))
    builder.connect(control.output(), part.input("enable"))
    builder.export_output(part.output(0), "y")
    times = [0.25, 0.75, 1.25, 2.0, 3.55, 3.61, 3.95, 4.25, 4.75]
    results = saltus.simulate(builder.build(), (0.0, 5.0), save_at=times, event_rows=False)
    assert results["y"].tolist() == [-1.0, 0.0, 0.5, 0.5, 0.5, 0.5, 0.5, 1.0, 4.0]


# --- one enabled part inside another


def nested(outer, inner, states, outputs):
    """x' = 1 in an enabled part of an enabled part. `outer`, `inner`: times and values of the
    control signals; `states`, `outputs`: the options of the outer and of the inner part."""
    part = EnabledSubsystem(
        Integrator(0.0, name="x"),
        name="inner",
        states=states[1],
        outputs=outputs[1],
        initial_outputs={"out": -1.0},
    )
    between = saltus.DiagramBuilder()
    between.add(part)
    between.export_input(part.input("enable"), "inner")
    between.export_input(part.input("in"), "u")
    between.export_output(part.output("out"), "y")
    whole = EnabledSubsystem(
        between.build("between"),
        name="outer",
        states=states[0],
        outputs=outputs[0],
        initial_outputs={"y": -2.0},
    )
    builder = saltus.DiagramBuilder()
    one = Constant(1.0, name="one")
    of_outer = DataSource(*outer, interpolation="zero_order_hold", name="of_outer")
    of_inner = DataSource(*inner, interpolation="zero_order_hold", name="of_inner")
    builder.add(whole, one, of_outer, of_inner)
    builder.connect(one.output(), whole.input("u"))
    builder.connect(of_inner.output(), whole.input("inner"))
    builder.connect(of_outer.output(), whole.input("enable"))
    builder.export_output(whole.output("y"), "y")
    return builder.build()


def expected_of_nested(outer, inner, states, outputs, times):
    """The same by hand: the inner part is enabled while both signals are true."""
    x, held, shown, before, seen = 0.0, -1.0, -2.0, (None, None), {}
    last = 0.0
    for t in np.unique(np.concatenate([outer[0], inner[0], times])):
        if all(before):
            x += t - last
        last = t
        first, second = (
            bool(values[np.searchsorted(starts, t, side="right") - 1] > 0.0)
            for starts, values in (outer, inner)
        )
        now = (first, first and second)
        of_inner = x if before[1] else held  # before t
        if before[1] and not now[1] and outputs[1] == "held":
            held = x
        if before[0] and not now[0] and outputs[0] == "held":
            shown = of_inner
        if before[1] is False and now[1] and states[1] == "reset":
            x = 0.0
        if before[0] is False and now[0] and states[0] == "reset":
            x, held = 0.0, -1.0  # what the inner part holds is a state of the outer one
        before = now
        seen[t] = (x if now[1] else held) if now[0] else shown
    return [seen[t] for t in times]


@pytest.mark.parametrize("python", ["traced", "called"])
def test_an_inner_part_is_enabled_while_both_control_signals_are_true(python):
    """160 drawn pairs of control signals, which change together now and then."""
    draw = np.random.default_rng(5)
    times = np.arange(0.1, 10.0, 0.25)  # no control signal changes there

    def control():
        changes = 0.25 * np.sort(draw.choice(np.arange(1, 40), 7, replace=False))
        return np.concatenate([[0.0], changes]), draw.integers(0, 2, 8).astype(float)

    for states in itertools.product(["held", "reset"], repeat=2):
        for outputs in itertools.product(["held", "reset"], repeat=2):
            for _ in range(10):
                scene = control(), control(), states, outputs
                results = saltus.simulate(nested(*scene), (0.0, 10.0), save_at=times, python=python)
                rows = np.searchsorted(results.time, times - 1e-9)
                # x' = 1 is integrated to some roundings of 10 s
                np.testing.assert_allclose(
                    np.ravel(results["y"])[rows], expected_of_nested(*scene, times), atol=1e-12
                )


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize(
    "part, expected",
    [(Gain(1.0, name="part"), 2.0), (ZeroOrderHold(1.0, name="part"), 2.0)],
    ids=["gain", "hold"],
)
def test_a_part_holds_its_output_before_the_instant_at_which_it_is_disabled(part, expected, python):
    """The input goes from 2 to 5 at 1 s, where the control signal falls."""
    system = EnabledSubsystem(part, name="part_enabled")
    control = DataSource([0.0, 1.0], [1.0, 0.0], interpolation="zero_order_hold", name="control")
    signal = DataSource([0.0, 1.0], [2.0, 5.0], interpolation="zero_order_hold", name="signal")
    builder = saltus.DiagramBuilder()
    builder.add(system, control, signal)
    builder.connect(signal.output(), system.input("in"))
    builder.connect(control.output(), system.input("enable"))
    builder.export_output(system.output("out"), "y")
    results = saltus.simulate(builder.build(), (0.0, 2.0), python=python)
    after = np.asarray(results.time) > 1.0
    assert set(np.ravel(results["y"])[after]) == {expected}


@pytest.mark.parametrize("python", ["traced", "called"])
def test_a_held_output_has_the_derivative_that_it_had_before_the_instant(python):
    """x' = p in two enabled parts; both fall at 2 s: y = x(2) = 2 p from then on."""
    level = saltus.LeafSystem(name="level")
    level.declare_dynamic_parameter("p", 3.0)
    level.declare_continuous_state(0.0, ode=lambda t, s, **p: p["p"])
    level.declare_continuous_state_output(name="out")
    inner = EnabledSubsystem(level, name="inner")
    between = saltus.DiagramBuilder()
    between.add(inner)
    between.export_input(inner.input("enable"), "inner")
    between.export_output(inner.output("out"), "y")
    outer = EnabledSubsystem(between.build("between"), name="outer")
    control = DataSource([0.0, 2.0], [1.0, 0.0], interpolation="zero_order_hold", name="control")
    builder = saltus.DiagramBuilder()
    builder.add(outer, control)
    builder.connect(control.output(), outer.input("inner"))
    builder.connect(control.output(), outer.input("enable"))
    builder.export_output(outer.output("y"), "y")
    system = builder.build()
    results = saltus.simulate(
        system, (0.0, 3.0), sensitivity=["outer.between.inner.level.p"], python=python
    )
    assert np.ravel(results["y"])[-1] == pytest.approx(6.0, abs=1e-9)
    # by differences of a called function: 1e-10 of the values
    assert np.ravel(results.sensitivities["y"])[-1] == pytest.approx(2.0, abs=1e-8)


@pytest.mark.parametrize("of_inner", [Constant, Sine, Pulse])
@pytest.mark.parametrize(("values", "updates"), [((0.0, 1.0), 1.0), ((1.0, 0.0), 2.0)])
def test_an_update_at_the_tick_at_which_the_outer_part_changes(of_inner, values, updates):
    """Ticks at 0, 0.5 and 1 s. The outer part is enabled or disabled at 1 s, the inner signal is true:
    the update of that tick runs if the part is enabled after it."""
    counter = saltus.LeafSystem(name="counter")
    counter.declare_discrete_state(0.0)
    counter.declare_periodic_update(
        lambda t, s: s.with_discrete_state(s.discrete_state + 1.0), period=0.5
    )
    counter.declare_discrete_state_output("y")
    options = {
        Constant: {"value": 1.0},
        Sine: {"frequency": 0.1, "phase": 1.0},
        Pulse: {"period": 4.0},
    }
    inner_control = of_inner(**options[of_inner], name="inner_control")
    inner = EnabledSubsystem(counter, name="inner")
    between = saltus.DiagramBuilder()
    between.add(inner, inner_control)
    between.connect(inner_control.output(), inner.input("enable"))
    between.export_output(inner.output("y"), "y")
    outer = EnabledSubsystem(between.build("between"), name="outer")
    builder = saltus.DiagramBuilder()
    control = DataSource([0.0, 1.0], list(values), interpolation="zero_order_hold", name="control")
    builder.add(outer, control)
    builder.connect(control.output(), outer.input("enable"))
    builder.export_output(outer.output("y"), "y")
    results = saltus.simulate(builder.build(), (0.0, 1.25))
    assert np.ravel(results["y"])[-1] == updates


@pytest.mark.parametrize("block", [EnabledSubsystem, TriggeredSubsystem])
@pytest.mark.parametrize("system", [2.0, "plant", None, saltus.LeafSystem])
def test_what_is_executed_is_a_system(block, system):
    with pytest.raises(saltus.ModelError, match="expected the system that it executes"):
        block(system)


def levels(name, changes):
    times, values = np.array(changes, float).T
    return DataSource(times, values, interpolation="zero_order_hold", name=name)


def sampler(edge, control):
    """It takes the time at the edges of its input "trigger", behind a control port or a comparison."""
    builder = saltus.DiagramBuilder()
    clock, taken = builder.add(Clock(), UnitDelay(-1.0, name="taken"))
    builder.connect(clock.output(), taken.input())
    if control == "port":
        decides = builder.add(ControlPort())
    else:
        decides, half = builder.add(Comparator(">"), Constant(0.5))
        builder.connect(half.output(), decides.input(1))
    builder.export_input(decides.input(0), "trigger")
    builder.execute(taken, decides.output(), "triggered", edge=edge)
    builder.export_output(taken.output(), "out")
    return builder.build(name="sampler")


UP, DOWN = [(0, 0), (4, 1)], [(0, 1), (4, 0)]
EDGES = [
    # the edge, the trigger, and the last edge that is seen; enabled until 3 s and from 6 s on
    ("rising", [(0, 0), (2, 1)], 2.0),
    ("rising", UP, 0.0),
    ("falling", DOWN, 0.0),
    ("either", UP, 0.0),
    ("either", DOWN, 0.0),
    ("rising", [(0, 0), (1, 1)], 1.0),
    ("falling", [(0, 1)], 0.0),
    ("rising", [(0, 0), (6, 1)], 6.0),
    ("rising", [(0, 0), (3, 1)], 0.0),
    ("rising", [(0, 0), (4, 1), (5, 0), (7, 1)], 7.0),
]


@pytest.mark.parametrize(("edge", "trigger", "last"), EDGES)
@pytest.mark.parametrize("control", ["port", "comparison"])
def test_an_edge_counts_at_its_time_if_the_part_around_it_is_enabled_then(
    edge, trigger, last, control
):
    """Neither an edge while it is not enabled, nor a return to a trigger that is true meanwhile."""
    builder = saltus.DiagramBuilder()
    outer = builder.add(EnabledSubsystem(sampler(edge, control), name="outer"))
    for name, source in (
        ("trigger", levels("trigger", trigger)),
        ("enable", levels("enable", [(0, 1), (3, 0), (6, 1)])),
    ):
        builder.connect(builder.add(source).output(), outer.input(name))
    builder.export_output(outer.output(), "out")
    results = saltus.simulate(builder.build(), (0.0, 10.0))
    assert results["out"][-1] == last


@pytest.mark.parametrize("depth", [1, 2])
@pytest.mark.parametrize("states", ["reset", "held"])
def test_a_part_inside_a_part_returns_to_its_start_where_that_is_enabled(states, depth):
    """The inner part is executed by the signal of a block that others read too: true from 1 s on. The
    outer part is enabled for the first half of each 4 s, so the integral of 1 begins anew at 4 s."""
    builder = saltus.DiagramBuilder()
    x, after = builder.add(Integrator(name="x"), Step(0.0, 1.0, step_time=1.0, name="after"))
    also = builder.add(Gain(2.0, name="also"))
    builder.connect(after.output(), also.input())
    builder.export_input(x.input(), "u")
    builder.export_output(x.output(), "y")
    builder.execute(x, after.output(), states=states)
    part = builder.build("inner")
    if depth == 2:  # a part between them that is always enabled
        between = saltus.DiagramBuilder()
        middle = between.add(EnabledSubsystem(part, name="middle"))
        between.export_input(middle.input(0), "u")
        between.export_input(middle.input("enable"), "on")
        between.export_output(middle.output(), "y")
        part = between.build("between")
    outer = saltus.DiagramBuilder()
    sub = outer.add(EnabledSubsystem(part, name="sub"))
    one = outer.add(Constant(1.0, name="one"))
    pulse = outer.add(Pulse(period=4.0, name="pulse"))
    outer.connect(one.output(), sub.input(0))
    if depth == 2:
        outer.connect(one.output(), sub.input(1))
    outer.connect(pulse.output(), sub.input("enable"))
    run = saltus.simulate(
        outer.build(),
        time_span=(0.0, 9.0),
        recorded_signals={"y": sub.output(0)},
        save_at=[0.5, 2.5, 4.0, 5.0, 7.0, 9.0],
        **PRECISE,
    )
    anew = {"reset": [0.0, 1.0, 0.0, 1.0, 2.0, 1.0], "held": [0.0, 1.0, 1.0, 2.0, 3.0, 4.0]}
    y = {
        round(t, 9): v for t, v in zip(run.time, run["y"], strict=True)
    }  # the last row of each time
    assert [y[t] for t in (0.5, 2.5, 4.0, 5.0, 7.0, 9.0)] == pytest.approx(anew[states], abs=1e-9)


def sums_at_triggers(part, hold):
    """A `TriggeredSubsystem` of a part with the inputs `in` and `enable`; with `hold` its output is
    the last one while it is not enabled.
    """
    builder = saltus.DiagramBuilder()
    builder.add(part)
    to_sum = builder.add(Gain(1.0, name="in"))
    enable = builder.add(Gain(1.0, name="enabled"))
    builder.connect(to_sum.output(), part.input("in"))
    builder.connect(enable.output(), part.input("enable"))
    shown = part.output()
    if hold:
        held, last = builder.add(IfThenElse(name="held"), UnitDelay(-1, name="last"))
        condition = builder.add(Comparator(">", name="condition"))
        zero = builder.add(Constant(0.0, name="zero"))
        builder.connect(enable.output(), condition.input(0))
        builder.connect(zero.output(), condition.input(1))
        builder.connect(condition.output(), held.input(0))
        builder.connect(shown, held.input(1))
        builder.connect(last.output(), held.input(2))
        builder.connect(held.output(), last.input())
        shown = held.output()
    builder.export_input(to_sum.input(), "in")
    builder.export_input(enable.input(), "enabled")
    builder.export_output(shown, "out")
    return TriggeredSubsystem(builder.build("part"), name="outer")


def summing():
    """y = the sum of the inputs at the executions."""
    builder = saltus.DiagramBuilder()
    add, last = builder.add(Adder("++", name="add"), UnitDelay(-1, name="last"))
    builder.connect(last.output(), add.input(1))
    builder.connect(add.output(), last.input())
    builder.export_input(add.input(0), "in")
    builder.export_output(add.output(), "out")
    return builder.build("sum")


@pytest.mark.parametrize("hold", [False, True])
def test_an_enabled_part_of_a_triggered_one_is_asked_at_the_triggers(hold):
    """Triggers at 0.5, 1.5, ...; enabled in [0, 2], [4, 6], ...: at 0.5, 1.5, 4.5, 5.5, ..."""
    part = EnabledSubsystem(summing(), outputs="reset", name="part")
    control = Pulse(period=4.0), Pulse(period=1.0, phase_delay=0.5)
    times = np.arange(0.75, 12.0, 0.5)
    shown = saltus.response(sums_at_triggers(part, hold), 1.0, *control, t=times)
    triggers = np.arange(0.5, 12.0)
    counts = np.cumsum(triggers % 4.0 < 2.0)
    values = counts if hold else np.where(triggers % 4.0 < 2.0, counts, 0)
    np.testing.assert_array_equal(shown, values[np.searchsorted(triggers, times) - 1])


@pytest.mark.parametrize(
    ("part", "words"),
    [
        (lambda: EnabledSubsystem(summing(), name="part"), "give outputs='reset'"),
        (
            lambda: EnabledSubsystem(summing(), states="reset", outputs="reset", name="part"),
            "give states='held'",
        ),
    ],
)
def test_what_follows_edges_is_refused_inside_a_triggered_part(part, words):
    with pytest.raises(saltus.ModelError, match=rf"block 'outer.part.part': .*{words}"):
        sums_at_triggers(part(), False)


def test_an_enabled_part_without_states_has_none_to_reset():
    part = EnabledSubsystem(Gain(2.0), states="reset", outputs="reset", name="part")
    outer = sums_at_triggers(part, False)
    shown = saltus.response(outer, 3.0, 1.0, Pulse(period=2.0, phase_delay=1.0), t=[0.5, 1.5])
    assert shown.tolist() == [0.0, 6.0]


def test_a_triggered_part_inside_a_triggered_one_is_refused():
    inner = TriggeredSubsystem(Gain(1.0), name="inner")
    builder = saltus.DiagramBuilder()
    builder.add(inner)
    builder.export_input(inner.input("in"), "in")
    builder.export_input(inner.input("trigger"), "call")
    builder.export_output(inner.output(), "out")
    with pytest.raises(saltus.ModelError, match=r"'outer.part.inner': .*EdgeDetection\(dt=-1\)"):
        TriggeredSubsystem(builder.build("part"), name="outer")


def test_an_edge_detection_stands_for_a_triggered_part_inside_a_triggered_one():
    """Calls rise at 1, 4, 7, ...; the triggers after them are at 1.5, 4.5, 7.5, ..."""
    part = EnabledSubsystem(summing(), outputs="reset", name="part")
    builder = saltus.DiagramBuilder()
    edge = builder.add(EdgeDetection(dt=-1, name="edge"))
    builder.add(part)
    builder.connect(edge.output(), part.input("enable"))
    builder.export_input(part.input("in"), "in")
    builder.export_input(edge.input(), "call")
    builder.export_output(part.output(), "out")
    outer = TriggeredSubsystem(builder.build("whole"), name="outer")
    calls = Pulse(period=3.0, pulse_width=0.5, phase_delay=1.0)
    times = np.arange(0.75, 12.0)
    shown = saltus.response(outer, 1.0, calls, Pulse(period=1.0, phase_delay=0.5), t=times)
    triggers = np.floor(times - 0.5) + 0.5
    called = triggers % 3.0 == 1.5
    np.testing.assert_array_equal(shown, np.where(called, (triggers - 1.5) // 3.0 + 1.0, 0.0))
