"""Where a run has no derivative, or none was found, there is a gap with its reason, never a number."""

import numpy as np
import pytest
import saltus
from scenes_with_derivatives import METHODS, Throw


def leaf(start, ode, **parameters):
    block = saltus.LeafSystem(name="block")
    for name, value in parameters.items():
        block.declare_dynamic_parameter(name, value)
    block.declare_continuous_state(start, ode=ode)
    return block


def lost(results, reason):
    """All derivatives of the end are NaN, each with a gap of this reason."""
    assert np.isnan(results.sensitivities.continuous_state).all()
    assert {gap.parameter for gap in results.sensitivity_gaps} == set(
        results.sensitivities.parameters
    )
    assert all(reason in gap.reason for gap in results.sensitivity_gaps)


@pytest.mark.parametrize("method", [m for m in METHODS if m != "taylor"])
def test_a_called_flow_that_jumps_without_an_event_has_a_gap(method):
    """x' = 2 below a and 1 above; that of a traced function is in test_moved_jumps.py."""
    block = leaf([0.3], lambda t, s, a: [2.0 if float(s.continuous_state[0]) < float(a) else 1.0],
                 a=1.0)  # fmt: skip
    results = saltus.simulate(
        block, (0.0, 2.0), sensitivity=["x[0]", "a"], ode_solver_method=method
    )
    lost(results, "jumps without an event")


# Kinks, smooth bends and jumps of the time alone are no such jumps: closed forms at t = 2.
SMOOTH = {
    "a kink": ([0.3], lambda t, s: [np.maximum(s.continuous_state[0], 1.0)],
               np.exp(1.3)),
    "a bend": ([0.3], lambda t, s: [1.0 - s.continuous_state[0] ** 2],
               (1 - np.tanh(2 + np.arctanh(0.3)) ** 2) / (1 - 0.3**2)),
    "a jump of the time": ([0.3], lambda t, s: [np.where(t > 1.0, 3.0, 1.0)
                                                - s.continuous_state[0]], np.exp(-2.0)),
    "at rest": ([1.0], lambda t, s: [1.0 - s.continuous_state[0]], np.exp(-2.0)),
}  # fmt: skip


@pytest.mark.parametrize("what", SMOOTH)
def test_a_flow_that_does_not_jump_has_a_derivative(what):
    start, ode, expected = SMOOTH[what]
    results = saltus.simulate(leaf(start, ode), (0.0, 2.0), sensitivity=["x[0]"], rtol=1e-9)
    assert not results.sensitivity_gaps
    # The kink costs the local error of the step that passes it, some sqrt(rtol) at most.
    assert results.sensitivities.continuous_state[0, 0] == pytest.approx(expected, rel=3e-5)


@pytest.mark.parametrize("python", ["traced", "called"])
def test_a_jump_of_the_time_after_an_event_that_moves(python):
    # x1 grows by floor(2 t) from the time tau = x0 of the event on: dx1/dx0 = -floor(2 tau) = -2.
    block = leaf([1.1, 0.0], lambda t, s: [-1.0, np.floor(2 * t)])
    block.declare_zero_crossing(
        lambda t, s: s.continuous_state[0],
        lambda t, s: s.with_continuous_state([9.0, 0.0]), name="hit", direction="falling")  # fmt: skip
    results = saltus.simulate(block, (0.0, 2.6), sensitivity=["x[0]"], python=python)
    np.testing.assert_allclose(results.sensitivities.continuous_state[:, 0], [1.0, -2.0], rtol=1e-6)


def test_a_guard_that_is_at_zero_at_the_start_and_fires_has_a_gap():
    ball = Throw(10.0, 0.5, height=0.0, speed=-3.0)
    results = saltus.simulate(ball, (0.0, 0.2), sensitivity=["x[0]"])
    assert len(results.events) == 1
    lost(results, "at zero already")


def test_a_ball_that_rests_from_the_start_has_a_gap():
    results = saltus.simulate(Throw(10.0, 0.5, height=0.0), (0.0, 1.0), sensitivity=["x[0]"])
    assert np.isnan(results.sensitivities.continuous_state).all() and results.sensitivity_gaps


def test_a_guard_that_is_flat_at_its_zero_has_a_gap():
    block = leaf([1.0], lambda t, s: [-1.0])
    block.declare_zero_crossing(
        lambda t, s: s.continuous_state[0] ** 3,
        lambda t, s: s.with_continuous_state([1.0]), name="hit", direction="falling")  # fmt: skip
    results = saltus.simulate(block, (0.0, 1.5), sensitivity=["x[0]"])
    slope = results.events.dt_dp("hit")[0, 0]
    assert np.isnan(slope) or slope == pytest.approx(1.0, rel=1e-6)


def test_each_nan_has_a_gap():
    # sqrt(v^2 + w^2) has no derivative at rest; the body is at rest until it is pushed.
    def ode(t, s):
        v, w = s.continuous_state
        return [np.where(t < 1.0, 0.0, 1.0) - v * np.sqrt(v * v + w * w), -w]

    results = saltus.simulate(leaf([0.0, 0.0], ode), (0.0, 2.0), sensitivity=["x[0]"])
    if np.isnan(results.sensitivities.continuous_state).any():
        assert results.sensitivity_gaps


@pytest.mark.parametrize("method", ["auto", "dopri5", "radau", "bdf"])
def test_pieces_of_a_run_that_meet_at_an_impact_obey_the_chain_rule_or_have_a_gap(method):
    options = {
        "rtol": 1e-10,
        "atol": 1e-12,
        "ode_solver_method": method,
        "sensitivity": ["x[0]", "x[1]"],
    }
    ball = Throw(9.81, 0.8, height=10.0)
    whole = saltus.simulate(ball, (0.0, 2.0), **options)
    impact = whole.events.times("bounce")[0]
    first = saltus.simulate(ball, (0.0, impact), **options)
    second = saltus.simulate(ball, first.context, (impact, 2.0), **options)
    found = second.sensitivities.continuous_state @ first.sensitivities.continuous_state
    with_gap = [piece for piece in (first, second) if piece.sensitivity_gaps]
    for piece in with_gap:  # the impact is in the first piece, or in the second
        assert np.isnan(piece.sensitivities.continuous_state).any()
    if not with_gap:  # the error of the event times of multistep methods is some hundred tolerances
        np.testing.assert_allclose(found, whole.sensitivities.continuous_state, rtol=1e-5)


# x0 is a clock, and x1' = z. At t = p = 0.5 the event changes one of them, or nothing.
AT_P = {
    "a jump": (lambda t, s, p: s.with_continuous_state([0.0, s.continuous_state[1]]), [1, 0, 0]),
    "a kink": (lambda t, s, p: s.with_discrete_state([1.0]), [0, 1, 1]),
    "nothing": (lambda t, s, p: s.with_continuous_state(s.continuous_state), [0, 0, 0]),
}


def event_at_p(reset):
    block = leaf([0.0, 0.0], lambda t, s, p: [1.0, s.discrete_state[0]], p=0.5)
    block.declare_discrete_state([0.0])
    block.declare_continuous_state_output("x")
    block.declare_zero_crossing(lambda t, s, p: t - p, reset, name="on", direction="rising")
    return block


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("what", AT_P)
def test_a_run_that_ends_at_an_event_that_moves_has_one_sided_derivatives_only(what, method):
    reset, changes = AT_P[what]
    results = saltus.simulate(
        event_at_p(reset), (0.0, 0.5), sensitivity=["p", "x[0]"], ode_solver_method=method
    )
    assert results.events.times("on") == [0.5]
    end = results.sensitivities
    by_p = [*end.continuous_state[:, 0], *end.discrete_state[:, 0]]
    np.testing.assert_array_equal(np.isnan(by_p), np.array(changes, bool))
    # The event does not move with the start.
    assert np.isfinite(end.continuous_state[:, 1]).all()
    assert [(gap.event, gap.parameter) for gap in results.sensitivity_gaps] == (
        [("block.on", "p")] if any(changes) else []
    )


def test_a_run_that_goes_on_has_derivatives_again():
    block = event_at_p(AT_P["a kink"][0])
    simulator = saltus.Simulator(block, sensitivity=["p"])
    simulator.initialize(block.create_context())
    simulator.advance_to(0.5)
    assert np.isnan(simulator.results.sensitivities.continuous_state[1, 0])
    simulator.advance_to(1.5)
    assert not simulator.results.sensitivity_gaps
    # x1 = t - p after the event; 1e-6: the tolerance of the run
    assert simulator.results.sensitivities.continuous_state[1, 0] == pytest.approx(-1.0, abs=1e-6)


@pytest.mark.parametrize("what", AT_P)
def test_a_row_at_an_event_that_moves_has_one_sided_derivatives_only(what):
    reset, changes = AT_P[what]
    block = event_at_p(reset)

    def run(**options):
        return saltus.simulate(
            block,
            (0.0, 1.0),
            sensitivity=["p"],
            save_at=[0.25, 0.5, 0.75],
            recorded_signals={"x": block.output("x")},
            **options,
        )

    single = run(event_rows=False)
    assert single.time.tolist() == [0.25, 0.5, 0.75]
    rows = single.sensitivities["x"][:, :, 0]
    np.testing.assert_array_equal(np.isnan(rows[1]), np.array(changes[:2], bool))
    assert np.isfinite(rows[[0, 2]]).all()
    assert [gap.time for gap in single.sensitivity_gaps] == ([0.5] if any(changes) else [])
    assert all("event_rows" in gap.reason for gap in single.sensitivity_gaps)
    # With a row on each side both have their one-sided derivatives.
    both = run()
    assert (both.time == 0.5).sum() == 2
    assert np.isfinite(both.sensitivities["x"]).all()
    assert not both.sensitivity_gaps


@pytest.mark.parametrize("after", [3, 2, 1])
def test_a_run_that_begins_just_before_the_rest_has_a_gap(after):
    """The place of rest is predicted from the last firings, some of which the run has not seen."""
    ball = saltus.scene("bouncing-ball")
    whole = saltus.simulate(ball.system, ball.context, (0.0, 30.0), rtol=1e-9, atol=1e-11)
    times = whole.events.times("bounce")
    begin = 0.5 * (times[-after - 1] + times[-after])
    first = saltus.simulate(ball.system, ball.context, (0.0, begin), rtol=1e-9, atol=1e-11)
    results = saltus.simulate(
        ball.system, first.context, (begin, 30.0), sensitivity=["x[1]"], rtol=1e-9, atol=1e-11
    )
    entered = [e for e in results.events if e.kind == "zeno_enter"]
    assert len(entered) == 1
    lost(results, "the run began between the last events before the rest")
    assert results.sensitivity_gaps[0].event == "ball.bounce"


def at_zero(slope, direction, *, effect=True, **options):
    """x' = slope, y' = 0.3 x, and a guard x - p that is at zero at the start."""
    block = leaf([1.0, 0.0], lambda t, s, p: [slope, 0.3 * s.continuous_state[0]], p=1.0)
    block.declare_zero_crossing(
        lambda t, s, p: s.continuous_state[0] - p,
        (lambda t, s, p: s.with_continuous_state(s.continuous_state + np.array([0.0, 5.0])))
        if effect
        else None,
        name="g",
        direction=direction,
        **options,
    )
    return block


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize("slope", [-1.0, 1.0])
@pytest.mark.parametrize("direction", ["falling", "rising", "crosses_zero"])
@pytest.mark.parametrize(
    "options",
    [{}, {"at_start": "ignore"}, {"terminal": True, "effect": False}, {"terminal": True}],
    ids=str,
)
def test_a_guard_at_zero_at_the_start_has_a_gap_where_a_shift_fires_it(
    options, direction, slope, python
):
    """A shift of x or p by one sign puts the guard on the side from which it fires."""
    fires = direction == "crosses_zero" or (direction == "rising") == (slope > 0.0)
    results = saltus.simulate(
        at_zero(slope, direction, **options), (0.0, 1.0), sensitivity=["x[0]", "p"], python=python
    )
    if fires:
        return lost(results, "zero")
    assert results.sensitivity_gaps == ()
    expected = np.array([[1.0, 0.0], [0.3, 0.0]])
    assert results.sensitivities.continuous_state == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("direction", ["falling", "rising", "crosses_zero"])
@pytest.mark.parametrize("method", ["dopri5", "bdf", "radau"])
def test_a_monitor_at_zero_changes_no_derivative(direction, method):
    results = saltus.simulate(
        at_zero(1.0, direction, effect=False),
        (0.0, 1.0),
        sensitivity=["x[0]"],
        ode_solver_method=method,
    )
    assert results.sensitivity_gaps == ()


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize("start", [1.0, 0.5])
def test_a_relation_that_a_write_puts_at_its_root_has_a_gap(start, python):
    """x' = 3 above p and 1 below. From the root itself, at the start or after a time event, the
    derivative by x is 1 and 3 on its two sides.
    """
    block = leaf([start], lambda t, s, p: [3.0 if s.relations[0] else 1.0], p=1.0)
    block.declare_relation(lambda t, s, p: s.continuous_state[0] - p, name="above")
    block.declare_time_event(lambda t, s, p: s.with_continuous_state([p]), times=[0.25])
    results = saltus.simulate(block, (0.0, 1.0), sensitivity=["p"], python=python)
    if start == 1.0:
        return lost(results, "the flow takes it across")
    # x = p moves with the root: no shift of p takes it off. x = p + 3 (t - 0.25) has slope 1 by p.
    assert results.sensitivity_gaps == ()
    assert results.sensitivities.continuous_state.ravel() == pytest.approx([1.0], abs=1e-9)


def test_a_kink_at_its_root_keeps_its_derivative():
    """x' = 1, y' = |x|: from x = 0 on, y(1) = 1/2 and dy/dx0 = 1 on both sides."""
    block = leaf([0.0, 0.0], lambda t, s: [1.0, np.abs(s.continuous_state[0])])
    results = saltus.simulate(block, (0.0, 1.0), sensitivity=["x[0]"])
    assert results.sensitivity_gaps == ()
    assert results.sensitivities.continuous_state[1] == pytest.approx([1.0], abs=1e-7)


def test_a_state_that_rests_at_a_kink_of_a_traced_function_has_a_gap():
    """x' = -max(x, 0): dx(1)/dx(0) is 1/e from above, and 1 from below."""
    block = leaf([0.0], lambda t, s: [-np.maximum(s.continuous_state[0], 0.0)])
    results = saltus.simulate(block, (0.0, 1.0), sensitivity=["x[0]"], python="traced")
    lost(results, "the flow has a kink, at which the state rests")


@pytest.mark.parametrize("block", ["Abs", "Sign", "Saturate", "DeadZone", "LookupTable1d", "Relay"])
def test_a_relation_that_rests_at_its_root_has_a_gap(block):
    """y' = f(s) of a state s that stays at the kink or jump of f: dy/ds has two values, or none."""
    library = saltus.library
    made, at = {
        "Abs": (library.Abs, 0.0),
        "Sign": (library.Sign, 0.0),
        "Saturate": (lambda: library.Saturate(-1.0, 0.5), 0.5),
        "DeadZone": (lambda: library.DeadZone(0.5), 0.5),
        "LookupTable1d": (lambda: library.LookupTable1d([-1.0, 0.0, 1.0], [1.0, 0.0, 3.0]), 0.0),
        "Relay": (lambda: library.Relay(0.5, 0.5, 1.0, 0.0), 0.5),
    }[block]
    builder = saltus.DiagramBuilder()
    rate, state = builder.add(library.Constant(0.0)), builder.add(library.Integrator(at, name="s"))
    of, y = builder.add(made()), builder.add(library.Integrator(name="y"))
    for source, target in ((rate, state), (state, of), (of, y)):
        builder.connect(source.output(), target.input(0))
    results = saltus.simulate(builder.build(), (0.0, 1.0), sensitivity=["s.x[0]"])
    lost(results, "the relation rests at its root")
