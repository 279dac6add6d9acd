"""Blocks that sample their input: their difference equations, and what happens at a common tick."""

import itertools

import numpy as np
import pytest
import saltus
from saltus.library import *

response = saltus.response
TICKS = np.arange(6.0)
METHODS = ["dopri5", "dop853", "taylor", "radau", "bdf", "adams", "auto"]


def impulse():
    """u[0] = 1, afterwards 0."""
    return Step(1.0, 0.0, step_time=0.5)


@pytest.mark.parametrize(
    ("block", "source", "expected"),
    [
        (DelayN(1.0, 2, initial_state=-1.0), Clock(), [-1, -1, 0, 1, 2, 3]),
        (DiscreteClock(2.0), None, [0, 0, 2, 2, 4, 4]),
        (RateTransition(2.0), Clock(), [0, 0, 2, 2, 4, 4]),
        (EdgeDetection(1.0, "falling", True), impulse(), [0, 1, 0, 0, 0, 0]),
        (DerivativeDiscrete(1.0), impulse(), [0, -1, 0, 0, 0, 0]),
        (DerivativeDiscrete(1.0, 1.0), impulse(), [0, -0.5, -0.25, -0.125, -0.0625, -0.03125]),
        (FilterDiscrete(1.0, [1.0, 10.0]), impulse(), [1, 10, 0, 0, 0, 0]),
        (IntegratorDiscrete(1.0), Clock(), [0, 0, 1, 3, 6, 10]),
        (IntegratorDiscrete(1.0, method="backward"), Clock(), [0, 1, 3, 6, 10, 15]),
        (LTISystemDiscrete(1.0, 0.5, 1.0, 2.0, 3.0), impulse(), [3, 2, 1, 0.5, 0.25, 0.125]),
        (PIDDiscrete(1.0, 2.0, ki=1.0, initial_state=5.0), impulse(), [7, 6, 6, 6, 6, 6]),
        (TransferFunctionDiscrete(1.0, [1, 0, 0], [1, -1, -1]), impulse(), [1, 1, 2, 3, 5, 8]),
    ],
    ids=lambda value: type(value).__name__ if isinstance(value, saltus.System) else "",
)
def test_the_difference_equation(block, source, expected):
    inputs = [source] if source else []
    assert response(block, *inputs, t=TICKS).tolist() == expected


def test_vectors():
    block = DelayN(1.0, 1, initial_state=[5.0, 6.0])
    assert response(block, [1.0, 2.0], t=[0.5, 1.0]).tolist() == [[5, 6], [1, 2]]
    block = FilterDiscrete(1.0, [2.0], initial_state=[0.0, 0.0])
    assert response(block, [1.0, 3.0]).tolist() == [2.0, 6.0]


def row(*blocks):
    """A diagram of blocks in a row."""
    builder = saltus.DiagramBuilder()
    builder.add(*blocks)
    for source, target in itertools.pairwise(blocks):
        builder.connect(source.output(), target.input())
    builder.export_output(blocks[-1].output(), "y")
    return builder.build()


def test_blocks_in_a_row_add_no_delay():
    one = [1.0]
    diagram = row(
        DiscreteClock(1.0),
        FilterDiscrete(1.0, one),
        TransferFunctionDiscrete(1.0, one, one),
        PIDDiscrete(1.0),
        RateTransition(1.0),
    )
    assert response(diagram, t=TICKS).tolist() == TICKS.tolist()


def test_a_loop_without_a_delay_is_refused():
    builder = saltus.DiagramBuilder()
    a, b = builder.add(RateTransition(1.0), FilterDiscrete(1.0, [0.5]))
    builder.connect(a.output(), b.input())
    builder.connect(b.output(), a.input())
    with pytest.raises(saltus.ModelError, match="algebraic loop"):
        saltus.simulate(builder.build(), (0.0, 1.0))


@pytest.mark.parametrize("method", METHODS)
def test_a_sampled_loop(method):
    """x' = u, u[k] = -3 x(0.1 k): x[k + 1] = (1 - 0.3) x[k]. Between ticks x is a line, exactly."""
    builder = saltus.DiagramBuilder()
    controller, x = builder.add(PIDDiscrete(0.1, -3.0), Integrator(1.0, name="x"))
    builder.connect(x.output(), controller.input())
    builder.connect(controller.output(), x.input())
    diagram = builder.build()
    ticks = np.arange(20) * 0.1
    found = saltus.simulate(
        diagram,
        (0.0, 1.9),
        ode_solver_method=method,
        recorded_signals={"x": x.output()},
        save_at=ticks,
        save_steps=False,
    )
    at = np.searchsorted(found.time, ticks - 1e-9)
    np.testing.assert_allclose(found.outputs["x"][at], 0.7 ** np.arange(20), rtol=0, atol=1e-10)


def test_a_run_in_two_parts_has_the_bits_of_one():
    diagram = row(Sine(), IntegratorDiscrete(1 / 3), TransferFunctionDiscrete(0.5, [1], [1, -0.9]))
    whole = saltus.simulate(diagram, (0.0, 20.0)).context
    for middle in [7.0, 22 / 3, 8.1]:
        half = saltus.simulate(diagram, (0.0, middle)).context
        rest = saltus.simulate(diagram, half, (middle, 20.0)).context
        for block in diagram.nodes:
            assert rest[block].discrete_state.tolist() == whole[block].discrete_state.tolist()


def test_a_reset_and_a_hold_are_read_at_ticks():
    block = IntegratorDiscrete(1.0, enable_reset=True, enable_external_reset=True, enable_hold=True)
    trigger = Pulse(1.0, period=9.0, pulse_width=2 / 9, phase_delay=1.5)
    hold = Step(step_time=3.5)
    y = response(block, 1.0, trigger, 10.0, hold, t=TICKS)
    assert y.tolist() == [0, 1, 10, 11, 12, 12]


@pytest.mark.parametrize(
    "method, weight", [("forward", 0.0), ("backward", 1.0), ("trapezoidal", 0.5)]
)
def test_a_limited_sum_is_limited_once_a_tick(method, weight):
    """y[k] = y[k-1] + dt (w u[k] + (1 - w) u[k-1]), kept between -1 and 1.5; y[0] = 0."""
    u = np.random.default_rng(2).choice([-1.0, -0.5, 0.5, 1.0], 60)
    block = IntegratorDiscrete(
        1.0, method=method, enable_limits=True, lower_limit=-1.0, upper_limit=1.5
    )
    source = DataSource(np.arange(60.0), u, interpolation="zero_order_hold")
    expected = [0.0]
    for before, now in itertools.pairwise(u):
        step = weight * now + (1.0 - weight) * before
        expected.append(min(max(expected[-1] + step, -1.0), 1.5))
    assert response(block, source, t=np.arange(60) + 0.5).tolist() == expected


def test_limits_do_not_wind_up():
    turn = Step(1.0, -1.0, step_time=3.0)
    block = IntegratorDiscrete(1.0, enable_limits=True, upper_limit=2.0)
    assert response(block, turn, t=TICKS).tolist() == [0, 1, 2, 2, 1, 0]
    pid = PIDDiscrete(1.0, 0.0, ki=1.0, upper_limit=2.5)
    assert response(pid, turn, t=TICKS).tolist() == [0, 1, 2, 2.5, 2, 1]


def test_nothing_behind_a_sampled_block_is_located():
    builder = saltus.DiagramBuilder()
    sine, table = builder.add(Sine(), LookupTable1d([-1, 0, 1], [0, 1, 0]))
    sampled, x = builder.add(RateTransition(0.1), Integrator())
    builder.connect(sine.output(), table.input())
    builder.connect(table.output(), sampled.input())
    builder.connect(sampled.output(), x.input())
    assert "no root-finding" in saltus.Simulator(builder.build()).describe()


def test_parameters_are_those_of_the_context():
    block = FilterDiscrete(1.0, [1.0, 1.0], name="f")
    diagram = row(DiscreteClock(1.0), block)
    context = diagram.create_context().with_parameter("f.b_coefficients", [0.0, 3.0])
    results = saltus.simulate(diagram, context, (0.0, 4.0))
    assert results.outputs["y"][-1] == 9.0


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: DelayN(1.0, 0), "expected 1 ticks of delay or more"),
        (lambda: DiscreteClock(-1.0), "dt = -1 s"),
        (lambda: EdgeDetection(1.0, "raising"), "did you mean 'rising'"),
        (lambda: DerivativeDiscrete(1.0, -1.0), "filter_coefficient = -1"),
        (lambda: FilterDiscrete(1.0, []), "expected 1 b_coefficients or more"),
        (lambda: IntegratorDiscrete(1.0, method="forwards"), "did you mean 'forward'"),
        (lambda: LTISystemDiscrete(1.0, [[1, 2]], 1, 1), "A is 1 x 2"),
        (lambda: PIDDiscrete(1.0, n=0.0), "n = 0 1/s"),
        (lambda: TransferFunctionDiscrete(1.0, [1, 0], [1]), "the degree 1 in z"),
        (lambda: RateTransition(np.inf), "dt = inf s"),
    ],
)
def test_refusals(make, message):
    with pytest.raises(saltus.ModelError, match=message):
        make()


U = 3.0
"""an input that is constant from the first tick on"""


@pytest.mark.parametrize(
    ("block", "first"),
    [
        (DelayN(0.5, 2, 7.0), [7.0, 7.0, U]),
        (UnitDelay(0.5, 7.0), [7.0, U, U]),
        (DerivativeDiscrete(0.5), [0.0, 0.0, 0.0]),
        (DerivativeDiscrete(0.5, 2.0), [0.0, 0.0, 0.0]),
        (EdgeDetection(0.5, "rising"), [1.0, 0.0, 0.0]),
        (EdgeDetection(0.5, "rising", True), [0.0, 0.0, 0.0]),
        (FilterDiscrete(0.5, [1.0, 10.0], 7.0), [U + 70.0, 11.0 * U, 11.0 * U]),
        (IntegratorDiscrete(0.5, 7.0), [7.0, 7.0 + U / 2, 7.0 + U]),
        (IntegratorDiscrete(0.5, 7.0, "backward"), [7.0, 7.0 + U / 2, 7.0 + U]),
        (IntegratorDiscrete(0.5, 7.0, "trapezoidal"), [7.0, 7.0 + U / 2, 7.0 + U]),
        (LTISystemDiscrete(0.5, 0.5, 1.0, 1.0, 0.0, 7.0), [7.0, 3.5 + U, 1.75 + 1.5 * U]),
        (PIDDiscrete(0.5, 0.0, kd=1.0, n=2.0), [0.0, 0.0, 0.0]),
        (PIDDiscrete(0.5, 0.0, ki=1.0, initial_state=7.0), [7.0, 7.0 + U / 2, 7.0 + U]),
        (RateLimiter(0.5, 1.0, -1.0, 7.0), [U, U, U]),
        (TransferFunctionDiscrete(0.5, [1.0], [1.0, -0.5]), [0.0, U, 1.5 * U]),
    ],
    ids=lambda case: type(case).__name__ if not isinstance(case, list) else "",
)
def test_the_first_ticks_are_those_of_the_equation(block, first):
    """docs/blocks.md says what a block reads of ticks before the first."""
    shown = saltus.response(block, U, t=[0.25, 0.75, 1.25])
    np.testing.assert_allclose(shown, first, rtol=1e-15)


def test_a_context_starts_the_derivative_of_a_pid_as_other_tools_do():
    """d[0] = n u / (1 + n dt), and each tick divides it by 1 + n dt: f[-1] = 0."""
    dt, n = 0.1, 3.0
    builder = saltus.DiagramBuilder()
    u, pid = builder.add(Constant(U), PIDDiscrete(dt, 0.0, kd=1.0, n=n, name="pid"))
    builder.connect(u.output(), pid.input())
    diagram = builder.build()
    context = diagram.create_context()
    state = [*context[pid].discrete_state[:-1], 1.0]
    context = context.with_subcontext(pid, context[pid].with_discrete_state(state))
    run = saltus.simulate(
        diagram, context, (0.0, 0.35), recorded_signals={"y": pid.output()}, save_at=[0.05, 0.15, 0.25]
    )  # fmt: skip
    shown = [run["y"][run.time == t][0] for t in (0.05, 0.15, 0.25)]
    np.testing.assert_allclose(shown, n * U / (1 + n * dt) ** np.arange(1, 4), rtol=1e-14)
