"""A tolerance of each state: in `solve`, `simulate`, `Simulator`, and by every method."""

import numpy as np
import pytest
import saltus
from saltus import Guard, solve
from systems import Ball

METHODS = ("auto", "dopri5", "dop853", "adams", "bdf", "radau", "taylor")
# The steps of taylor bound each term of its series, so a state with a wide tolerance costs steps,
# and a loose tolerance means a lower order.
WITHOUT_TAYLOR = METHODS[:-1]
SHAKE = 1000.0  # [1/s] of the state that nobody needs exactly


def slow_and_shaken(t, x):
    """x0 falls in a second, x1 = sin(SHAKE t) shakes; neither reads the other."""
    return np.array([-x[0], SHAKE * np.cos(SHAKE * t)])


def apex(t, x):
    return x[0] - 0.5


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("n", [1, 2, 3, 5])
def test_n_equal_numbers_are_one_number_to_the_bit(method, n):
    """One number for all and n equal ones give the same weights, by the same roundings."""

    def turns(t, x):
        return np.roll(x, 1) * np.cos(t) - x**3

    start = np.linspace(1.0, 2.0, n)
    runs = [
        solve(turns, (0, 3), start, method=method, rtol=rtol, atol=atol, events=apex)
        for rtol, atol in (
            (1e-7, 1e-9),
            (1e-7, [1e-9] * n),
            (np.full(n, 1e-7), 1e-9),
            (np.full(n, 1e-7), np.full(n, 1e-9)),
        )
    ]
    for run in runs[1:]:
        assert np.array_equal(run.t, runs[0].t)
        assert np.array_equal(run.y, runs[0].y)
        assert np.array_equal(run.t_events[0], runs[0].t_events[0])
        assert run.nfev == runs[0].nfev


@pytest.mark.parametrize("which", ["atol", "rtol"])
@pytest.mark.parametrize("method", WITHOUT_TAYLOR)
def test_a_state_with_a_wide_tolerance_costs_no_steps(method, which):
    """A shaken state of size 1 that may be wrong by a thousand: the steps are those of x0."""
    span, start = (0.0, 1.0), [1.0, 0.0]
    tight = {"rtol": 1e-6, "atol": 1e-6}
    wide = {"atol": [1e-6, 1e3]} if which == "atol" else {"rtol": [1e-6, 1e3], "atol": [1e-6, 1e2]}
    once = solve(slow_and_shaken, span, start, method=method, **tight)
    wider = solve(slow_and_shaken, span, start, method=method, **(tight | wide))
    alone = solve(lambda t, x: -x, span, [1.0], method=method, rtol=1e-6, atol=1e-6)
    assert wider.stats.steps < 0.1 * once.stats.steps
    # the mean over two states of which one has no error is half of that of one: steps that are
    # 2^(1/2p) longer, p >= 1 the order, and as many rejections as the shaken state can cause
    assert wider.stats.steps <= 3 * alone.stats.steps + 10
    # ten tolerances of 2e-6, the limit of docs for every method; the flow shrinks errors
    assert abs(wider.y[0, -1] - np.exp(-1.0)) < 10 * 2e-6


@pytest.mark.parametrize("method", METHODS)
def test_a_state_with_a_tight_tolerance_is_exact(method):
    """x0 = 1e-9 exp(-t) beside x1 of size 1: 1e-8 for all sees nothing of x0."""
    rate = np.array([-1.0, -2.0])
    exact = 1e-9 * np.exp(-1.0)

    def error(atol):
        run = solve(lambda t, x: rate * x, (0, 1), [1e-9, 1.0], method=method, rtol=1e-7, atol=atol)
        return abs(run.y[0, -1] - exact)

    # ten times rtol |x| + atol
    assert error([1e-17, 1e-8]) < 10 * (1e-7 * 1e-9 + 1e-17)


@pytest.mark.parametrize("method", WITHOUT_TAYLOR)
def test_rtol_by_state(method):
    """Two equal falls: the one with a hundredth of the tolerance sets the steps of both, and a
    wide one beside it costs none."""

    def run(rtol):
        return solve(lambda t, x: -x, (0, 5), [1.0, 1.0], method=method, rtol=rtol, atol=1e-12)

    both, one, none = run(1e-8), run([1e-8, 1e-2]), run(1e-2)
    assert none.stats.steps < one.stats.steps <= both.stats.steps
    # thirty tolerances, as KNOWN_GAPS says of BDF, for each of five time constants
    assert abs(one.y[0, -1] / np.exp(-5.0) - 1.0) < 30 * 5 * 1e-8


@pytest.mark.parametrize("method", METHODS)
def test_a_bouncing_ball_with_a_tolerance_of_each_state(method):
    """Impacts at 1, 2, 2.5, ... s and rest from 3 s on, with the height in units of a mm."""
    floor = Guard(lambda t, x: x[0], lambda t, x: [0.0, -0.5 * x[1]], "falling", name="floor")
    run = solve(
        lambda t, x: [1e3 * x[1], -10.0],
        (0, 5),
        [5e3, 0.0],
        events=floor,
        method=method,
        rtol=1e-9,
        atol=[1e-6, 1e-9],
    )
    # flights are parabolas: ten relative tolerances of the time of fall, which is 1 s
    np.testing.assert_allclose(run.t_events[0][:4], [1, 2, 2.5, 2.75], atol=1e-8)
    assert run.y[:, -1].tolist() == [0.0, 0.0]


@pytest.mark.parametrize("unit", [1.0, 1e3, 1e-6])
def test_a_ball_lifts_off_in_any_unit_of_its_height(unit):
    """It rests on a floor that swings with 2 sin(2 t) m, and lifts off where 8 sin(2 t) passes the
    gravity of 4 m/s^2: at pi / 12. The height is measured in `unit` m, the speed in m/s.
    """

    def floor(t):
        return 2.0 * np.sin(2.0 * t)

    contact = Guard(
        lambda t, x: x[0] * unit - floor(t),
        lambda t, x: [floor(t) / unit, 4.0 * np.cos(2.0 * t)],
        "falling",
        name="contact",
    )
    run = solve(
        lambda t, x: [x[1] / unit, -4.0],
        (-0.5, 0.5),
        [floor(-0.5) / unit, 4.0 * np.cos(-1.0)],
        events=contact,
        rtol=1e-8,
        atol=[1e-10 / unit, 1e-10],
    )
    released = run.events.times("contact", "zeno_release")
    # 1e-7 s, as KNOWN_GAPS says of the time of a lift-off
    np.testing.assert_allclose(released[0], np.pi / 12, atol=2e-7)


def two_balls():
    builder = saltus.DiagramBuilder()
    balls = builder.add(Ball(name="left"), Ball(name="right"))
    return builder.build(name="pair"), balls


def test_the_order_in_a_diagram_is_that_of_the_context():
    diagram, (left, right) = two_balls()
    context = diagram.create_context()
    for ball, height in ((left, 1.0), (right, 2.0)):
        sub = context[ball.system_id].with_continuous_state([height, 0.0])
        context = context.with_subcontext(ball.system_id, sub)
    assert context.continuous_state.tolist() == [1.0, 0.0, 2.0, 0.0]
    all_ = saltus.simulate(diagram, context, (0, 1), atol=1e-8)
    each = saltus.simulate(diagram, context, (0, 1), atol=[1e-8] * 4)
    assert all_.context == each.context


def test_a_wrong_width_names_the_blocks():
    diagram, _ = two_balls()
    with pytest.raises(
        saltus.ModelError,
        match=r"option atol: expected one number, or 4 numbers, one for each continuous state "
        r"\('left' 2, 'right' 2\); found 2",
    ):
        saltus.simulate(diagram, diagram.create_context(), (0, 1), atol=[1e-6, 1e-6])
    with pytest.raises(saltus.ModelError, match="option rtol: expected one number, or 4 numbers"):
        saltus.Simulator(diagram, rtol=np.full(5, 1e-6))
    with pytest.raises(
        saltus.ModelError, match="solve: atol: expected a number, or 2 numbers, one for each state"
    ):
        solve(slow_and_shaken, (0, 1), [1.0, 0.0], atol=[1e-6])


@pytest.mark.parametrize(
    ("option", "message"),
    [
        ({"atol": [1e-6, 0.0]}, r"option atol: expected positive numbers, found \[1e-06, 0\]"),
        ({"rtol": [1e-6, -1.0]}, "option rtol: expected positive numbers"),
        ({"rtol": [1e-6, np.nan]}, "option rtol: expected positive numbers"),
        ({"atol": [1e-6, np.inf]}, "option atol: expected positive numbers"),
        ({"atol": "1e-6"}, "option atol: expected numbers, found '1e-6'"),
        ({"atol": [[1e-6, 1e-6]]}, "option atol: expected one number, or a list"),
        ({"rtol": [1e-6, 1e-16]}, "option rtol: expected at least 1e-15"),
    ],
)
def test_what_is_no_tolerance_is_refused(option, message):
    ball = Ball()
    with pytest.raises(saltus.ModelError, match=message):
        saltus.simulate(ball, ball.create_context(), (0, 1), **option)


def test_options_with_arrays_compare_by_value_and_keep_a_copy():
    numbers = np.array([1e-6, 1e-9])
    options = saltus.SimulatorOptions(atol=numbers)
    numbers[0] = 1.0
    assert options == saltus.SimulatorOptions(atol=[1e-6, 1e-9])
    assert options != saltus.SimulatorOptions(atol=[1e-6, 1e-8])
    assert hash(options) == hash(saltus.SimulatorOptions(atol=(1e-6, 1e-9)))


def test_a_sweep_takes_them_too():
    ball = Ball()
    grid = {"x[0]": [1.0, 2.0]}
    each = saltus.sweep(ball, grid, (0.0, 0.5), rtol=[1e-6, 1e-6], atol=[1e-9, 1e-9])
    once = saltus.sweep(ball, grid, (0.0, 0.5), rtol=1e-6, atol=1e-9)
    assert (each["steps"] == once["steps"]).all()


def test_a_system_without_states_takes_an_empty_list():
    empty = saltus.LeafSystem(name="empty")
    assert saltus.simulate(empty, empty.create_context(), (0, 1), atol=[]).status == "reached_end"


def test_a_tiny_rtol_of_solve_is_raised_with_a_warning():
    with pytest.warns(UserWarning, match="At least one element of `rtol` is too small: 1e-16"):
        run = solve(lambda t, x: -x, (0, 1), [1.0, 1.0], rtol=[1e-1, 1e-16])
    assert abs(run.y[1, -1] - np.exp(-1.0)) < 1e-8  # atol
    with pytest.raises(saltus.ModelError, match="option rtol: expected a positive number"):
        solve(lambda t, x: -x, (0, 1), [1.0], rtol=0.0)
