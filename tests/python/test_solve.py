"""`saltus.solve`: the short door, shaped like scipy.integrate.solve_ivp."""

import functools
import pickle

import numpy as np
import pytest
import saltus
from saltus import Guard, solve

G = 10.0


def fall(t, x):
    return [x[1], -G]


def height(t, x):
    return x[0]


def bounce(t, x):
    return [0.0, -0.5 * x[1]]


BALL = {"events": [Guard(height, reset=bounce, direction="falling", name="bounce")]}


class Ball(saltus.LeafSystem):
    """The same as a class."""

    def __init__(self):
        super().__init__(name="solve")
        self.declare_continuous_state(
            default_value=[5.0, 0.0], ode=lambda t, s: fall(t, s.continuous_state)
        )
        self.declare_continuous_state_output("x")
        self.declare_zero_crossing(
            lambda t, s: height(t, s.continuous_state),
            lambda t, s: s.with_continuous_state(bounce(t, s.continuous_state)),
            name="bounce",
            direction="positive_then_non_positive",
        )


@pytest.mark.parametrize("method", ["auto", "dopri5", "dop853", "adams", "bdf", "radau", "taylor"])
def test_it_has_the_bits_of_the_class(method):
    short = solve(fall, (0.0, 4.0), [5.0, 0.0], method=method, rtol=1e-8, atol=1e-10, **BALL)
    ball = Ball()
    long = saltus.simulate(
        ball,
        ball.create_context(),
        (0.0, 4.0),
        recorded_signals={"x": ball.output("x")},
        ode_solver_method=method,
        rtol=1e-8,
        atol=1e-10,
    )
    assert np.array_equal(short.time, long.time)
    assert np.array_equal(short.outputs["x"], long.outputs["x"])
    assert np.array_equal(short.events.times("bounce"), long.events.times("bounce"))
    assert short.context == long.context
    assert short.stats.right_hand_side_calls == long.stats.right_hand_side_calls


def test_a_ball_comes_to_rest():
    """From 5 m at 10 m/s^2: impacts at 1, 2, 2.5, 2.75, ... s, rest from 3 s on."""
    solution = solve(fall, (0, 10), [5.0, 0.0], **BALL)
    assert solution.status == "reached_end" and solution.success
    np.testing.assert_allclose(solution.t_events[0][:4], [1, 2, 2.5, 2.75], atol=1e-12)
    assert solution.y[:, -1].tolist() == [0.0, 0.0]
    enter = [e for e in solution.events if e.kind == "zeno_enter"]
    assert enter[0].predicted == pytest.approx(3.0, abs=1e-9)


def test_names_of_scipy():
    solution = solve(fall, (0, 4), [5.0, 0.0], dense_output=True, **BALL)
    assert solution.t is solution.time
    assert solution.y.shape == (2, len(solution.t))
    assert np.array_equal(solution.y, solution.outputs["x"].T)
    assert solution.y_events[0].shape == (len(solution.t_events[0]), 2)
    assert solution.y_events[0][0, 1] == pytest.approx(-10.0, abs=1e-12)
    assert solution.sol(0.5).shape == (2,)
    assert solution.sol([0.5, 1.5, 2.2]).shape == (2, 3)
    assert solution.sol(0.5)[0] == pytest.approx(3.75, abs=1e-12)
    assert solution.nfev == solution.stats.right_hand_side_calls > 0
    assert (solution.njev, solution.nlu) == (0, 0)
    assert solution.message == "the end of the span was reached"
    assert "<Solution: reached_end" in repr(solution)
    plain = solve(fall, (0, 0.5), [5.0, 0.0])
    assert plain.sol is plain.t_events is plain.y_events is None


def test_it_agrees_with_scipy():
    integrate = pytest.importorskip("scipy.integrate")

    def predator(t, x, a, b):
        return [x[0] * (a - x[1]), x[1] * (x[0] - b)]

    def full(t, x, a, b):
        return x[0] - 0.4

    full.direction = 1
    arguments = {"args": (1.1, 0.4), "rtol": 1e-10, "atol": 1e-12}
    times = np.linspace(0.0, 30.0, 61)
    ours = solve(predator, (0, 30), [0.5, 0.8], events=full, t_eval=times, **arguments)
    theirs = integrate.solve_ivp(
        predator, (0, 30), [0.5, 0.8], events=full, t_eval=times, method="DOP853", **arguments
    )
    assert np.array_equal(ours.t, theirs.t)
    np.testing.assert_allclose(ours.y, theirs.y, rtol=1e-7)
    assert len(ours.t_events[0]) == len(theirs.t_events[0]) > 1
    np.testing.assert_allclose(ours.t_events[0], theirs.t_events[0], atol=1e-7)
    np.testing.assert_allclose(ours.y_events[0], theirs.y_events[0], rtol=1e-6)


def test_functions_with_the_attributes_of_scipy():
    def apex(t, x):
        return x[1]

    def floor(t, x):
        return x[0]

    floor.terminal, floor.direction = True, -1
    solution = solve(fall, (0, 10), [0.0, 10.0], events=[floor, apex])
    assert solution.status == "terminal" and solution.success
    assert solution.t[-1] == pytest.approx(2.0, abs=1e-9)
    assert [times.tolist() for times in solution.t_events] == [
        [pytest.approx(2.0, abs=1e-9)],
        [pytest.approx(1.0, abs=1e-9)],
    ]
    apex.direction = 1  # the velocity never rises through zero
    assert solve(fall, (0, 10), [0.0, 10.0], events=[floor, apex]).t_events[1].size == 0


@pytest.mark.parametrize("terminal", [{"terminal": 3}, {"terminal": True, "max_count": 3}])
def test_the_run_ends_at_the_third(terminal):
    guard = Guard(height, bounce, "falling", **terminal)
    solution = solve(fall, (0, 10), [5.0, 0.0], events=guard)
    assert solution.status == "terminal"
    assert solution.t[-1] == pytest.approx(2.5, abs=1e-12)
    assert len(solution.t_events[0]) == 3


def test_directions():
    turns = {
        direction: len(
            solve(
                lambda t, x: [np.cos(t)], (0.0, 20.0), [0.5], events=Guard(height, None, direction)
            ).t_events[0]
        )
        for direction in ("both", "falling", "rising", 0, -1, 2.5, "crosses_zero", "none")
    }
    # 0.5 + sin t falls at 7 pi / 6 + 2 pi k, rises at 11 pi / 6 + 2 pi k: three times each to 20 s
    assert turns == {
        "both": 6,
        "falling": 3,
        "rising": 3,
        0: 6,
        -1: 3,
        2.5: 3,
        "crosses_zero": 6,
        "none": 0,
    }


def test_forms_of_f():
    def returned(t, x, k):
        return -k * x

    def filled(t, x, out, k):
        out[:] = -k * x

    def bare(t, x, out):
        out[0] = -2.0 * x[0]

    class Callable:
        def __call__(self, t, x):
            return -2.0 * x

    ends = [
        solve(f, (0, 1), [1.0], args=args).y[0, -1]
        for f, args in [
            (returned, (2.0,)),
            (returned, [2.0]),
            (filled, (2.0,)),
            (bare, ()),
            (Callable(), ()),
            (functools.partial(returned, k=2.0), ()),
            (lambda t, x, *args: -args[0] * x, (2.0,)),
            (lambda t, x, k=2.0: -k * x, ()),
        ]
    ]
    assert len(set(ends)) == 1
    assert ends[0] == pytest.approx(np.exp(-2.0), abs=1e-6)


def test_args_reach_everything():
    solution = solve(
        lambda t, x, v: [v],
        (0.0, 3.5),
        [0.0],
        args=(2.0,),
        events=Guard(lambda t, x, v: x[0] - v, lambda t, x, v: x - v, "rising"),
        jacobian=lambda t, x, v: [[0.0 * v]],
        method="bdf",
    )
    np.testing.assert_allclose(solution.t_events[0], [1.0, 2.0, 3.0], atol=1e-6)


def test_a_reset_may_change_its_copy():
    def flip(t, x):
        x[0], x[1] = 0.0, -0.5 * x[1]
        return x

    changed = solve(fall, (0, 4), [5.0, 0.0], events=Guard(height, flip, "falling", name="bounce"))
    assert np.array_equal(changed.y, solve(fall, (0, 4), [5.0, 0.0], **BALL).y)


def test_t_eval_gives_exactly_these_rows():
    times = [0.25, 1.0, 2.0, 3.5]
    solution = solve(fall, (0, 4), [5.0, 0.0], t_eval=times, **BALL)
    assert solution.t.tolist() == times
    assert solution.y.shape == (2, 4)
    step = Guard(lambda t, x: t - 1.0, lambda t, x: x + 1.0)
    event = solve(lambda t, x: [0.0], (0.0, 2.0), [0.0], events=step).t_events[0][0]
    stairs = solve(lambda t, x: [0.0], (0.0, 2.0), [0.0], t_eval=[0.5, event, 1.5], events=step)
    assert stairs.y[0].tolist() == [0.0, 1.0, 1.0]  # at an event the row after it


def test_max_step_and_other_options():
    assert solve(fall, (0, 1), [5.0, 0.0], max_step=0.01).stats.steps >= 100
    busy = {"zeno_tolerance": 0.0, "throw": False}
    assert solve(fall, (0, 4), [5.0, 0.0], **BALL, **busy).status == "chattering"
    failed = solve(lambda t, x: x**2, (0, 2), [1.0], throw=False)
    assert failed.status == "failed" and not failed.success
    assert failed.message
    with pytest.raises(saltus.SimulationError) as caught:
        solve(lambda t, x: x**2, (0, 2), [1.0])
    assert isinstance(caught.value.results, saltus.Solution)
    assert caught.value.results.t[-1] == pytest.approx(1.0, abs=1e-3)


def test_stiff_with_a_jacobian():
    def stiff(t, x):
        return [-1e4 * (x[0] - np.cos(t))]

    for jacobian in ([[-1e4]], lambda t, x: [[-1e4]], None):
        solution = solve(stiff, (0, 2), [1.0], method="bdf", jacobian=jacobian)
        assert solution.y[0, -1] == pytest.approx(np.cos(2.0), abs=1e-3)
    rod = solve(lambda t, x: -x, (0, 1), np.ones(5), method="bdf", jacobian_sparsity=np.eye(5))
    np.testing.assert_allclose(rod.y[:, -1], np.exp(-1), atol=1e-4)


def test_the_system_can_be_run_again():
    solution = solve(fall, (0, 2), [5.0, 0.0], **BALL)
    half = saltus.simulate(solution.system, solution.system.create_context(), (0, 1.5))
    rest = saltus.simulate(solution.system, half.context, (1.5, 2))
    np.testing.assert_allclose(rest.context.continuous_state, solution.y[:, -1], atol=1e-9)


def test_guards_in_a_loop_have_names_of_their_own():
    levels = [lambda t, x, level=level: x[0] - level for level in (0.25, 0.5)]

    def make(level):
        def crosses(t, x):
            return x[0] - level

        return crosses

    for events in (levels, [make(0.25), make(0.5)]):
        solution = solve(lambda t, x: [1.0], (0, 1), [0.0], events=events)
        assert {e.name for e in solution.events} == {"event_0", "event_1"}
        np.testing.assert_allclose(np.concatenate(solution.t_events), [0.25, 0.5])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        ({"rtoll": 1e-3}, "solve: unknown option 'rtoll'; did you mean 'rtol'"),
        ({"jac": None}, "no option 'jac': it is called jacobian here"),
        ({"save_at": [1.0]}, "no option 'save_at': it is called t_eval here"),
        ({"method": "dopri"}, "did you mean 'dopri5'"),
        ({"x0": [[1.0, 2.0]]}, r"x0: expected shape \(n,\), found \(1, 2\)"),
        ({"x0": ["1", 2]}, r"x0: expected numbers, found a list whose entry \[0\] is '1' \(str\)"),
        ({"x0": [1.0, 0.0, 0.0]}, r"fall\(t, x\) returned shape \(2,\), expected \(3,\)"),
        (
            {"t_span": (1.0, np.nan)},
            "t_span: expected a span with begin <= end, found 1.0 s to nan s",
        ),
        ({"t_span": 3.0}, r"t_span: expected a span \(begin, end\) in seconds, found 3.0"),
        ({"t_eval": [0.5, 0.2]}, "t_eval: expected increasing times within t_span"),
        ({"t_eval": [0.5, 2.0]}, "t_eval: expected increasing times within t_span, 0 s to 1 s"),
        ({"t_eval": []}, "t_eval: expected some times"),
        ({"args": 3.0}, r"args: expected a tuple, found 3.0; .* args=\(3.0,\)"),
        ({"args": (1, 2, 3)}, r"f takes \(t, x\), but it is called with t, x and 3 arguments"),
        ({"f": 3}, "f: expected a function"),
        ({"events": 3}, r"events: expected Guard\(...\) or a function"),
        ({"events": [height, 4]}, "or a list of them, found 4"),
        ({"jacobian": np.eye(3)}, r"jacobian: expected shape \(2, 2\), found \(3, 3\)"),
        ({"atol": [1e-6, 1e-8, 1e-8]}, "atol: expected a number, or 2 numbers"),
    ],
)
def test_bad_input(call, message):
    given = {"f": fall, "t_span": (0.0, 1.0), "x0": [5.0, 0.0]} | call
    f, t_span, x0 = (given.pop(name) for name in ("f", "t_span", "x0"))
    with pytest.raises(saltus.ModelError, match=message):
        solve(f, t_span, x0, **given)


def test_bad_guards():
    with pytest.raises(saltus.ModelError, match="unknown direction 'fallin'; did you mean 'fall"):
        Guard(height, direction="fallin")
    with pytest.raises(saltus.ModelError, match="direction: expected 'both', 'falling'"):
        Guard(height, direction=[1])
    with pytest.raises(saltus.ModelError, match="reset: expected a function, found 3"):
        Guard(height, reset=3)
    with pytest.raises(saltus.ModelError, match="terminal: expected"):
        Guard(height, terminal=-1)
    with pytest.raises(saltus.ModelError, match="the reset of 'bounce' returned None"):
        solve(fall, (0, 4), [5.0, 0.0], events=Guard(height, lambda t, x: None, name="bounce"))
    with pytest.raises(saltus.ModelError, match="name 'bounce' is declared twice"):
        twice = [Guard(height, name="bounce"), Guard(height, name="bounce")]
        solve(fall, (0, 4), [5.0, 0.0], events=twice)


def test_a_forgotten_argument_is_told():
    with pytest.raises(saltus.ModelError, match=r"Is a parameter missing in args"):
        solve(lambda t, x, k: -k * x, (0, 1), [1.0])


def test_what_a_function_raises_comes_out_as_it_was():
    class Own(Exception):
        pass

    def broken(t, x):
        if t > 0.5:
            raise Own("here")
        return -x

    with pytest.raises(Own, match="here"):
        solve(broken, (0, 1), [1.0])
    partial = solve(broken, (0, 1), [1.0], throw=False)
    assert partial.status == "failed" and isinstance(partial.cause, Own)
    with pytest.raises(ZeroDivisionError):
        solve(lambda t, x: [1 / 0], (0, 1), [1.0])


def test_a_number_for_x0_and_no_state_at_all():
    assert solve(lambda t, x: -x, (0, 1), 1.0).y.shape[0] == 1
    empty = solve(lambda t, x: x, (0, 1), [])
    assert empty.y.shape[0] == 0 and empty.t[-1] == 1.0


def test_an_endless_span_needs_a_terminal_event():
    with pytest.raises(saltus.ModelError, match="the end is infinite, and no event is terminal"):
        saltus.solve(lambda t, x: [1.0], (0.0, np.inf), [0.0])
    wall = saltus.Guard(lambda t, x: x[0] - 3.0, terminal=True)
    ended = saltus.solve(lambda t, x: [1.0], (0.0, np.inf), [0.0], events=[wall])
    assert abs(ended.t[-1] - 3.0) < 1e-12  # rounding of 3 s and of the state


STIFF = np.array([[-1.0, -5.0], [1.0, 1.0]])


@pytest.mark.parametrize(
    "form", ["csc_matrix", "csr_matrix", "coo_matrix", "csc_array", "lil_matrix"]
)
@pytest.mark.parametrize("constant", [True, False])
def test_a_sparse_jacobian_is_taken_as_scipy_returns_it(form, constant):
    sparse = pytest.importorskip("scipy.sparse")
    matrix = getattr(sparse, form)(STIFF)
    jacobian = matrix if constant else (lambda t, x: matrix)
    fine = {"method": "bdf", "rtol": 1e-8, "atol": 1e-10}
    found = solve(lambda t, x: STIFF @ x, (0, 2), [0.0, 2.0], jacobian=jacobian, **fine)
    dense = solve(lambda t, x: STIFF @ x, (0, 2), [0.0, 2.0], jacobian=lambda t, x: STIFF, **fine)
    # the same Newton matrices but for the order in which a sparse solver eliminates
    assert found.y[:, -1] == pytest.approx(dense.y[:, -1], rel=1e-6)


def test_entries_of_a_sparse_jacobian_that_are_named_twice_add_up():
    sparse = pytest.importorskip("scipy.sparse")
    halves = sparse.coo_matrix(([-30.0, -20.0], ([0, 0], [0, 0])), shape=(1, 1))
    found = solve(lambda t, x: -50.0 * x, (0, 1), [1.0], method="bdf", jacobian=halves)
    right = solve(lambda t, x: -50.0 * x, (0, 1), [1.0], method="bdf", jacobian=[[-50.0]])
    assert found.statistics.steps == right.statistics.steps


def test_a_sparse_jacobian_in_a_leaf_system():
    sparse = pytest.importorskip("scipy.sparse")
    leaf = saltus.LeafSystem(name="leaf")
    leaf.declare_continuous_state(
        [0.0, 2.0],
        ode=lambda t, s: STIFF @ s.continuous_state,
        jacobian=lambda t, s: sparse.csc_matrix(STIFF),
    )
    results = saltus.simulate(leaf, (0, 2), ode_solver_method="bdf")
    assert results.statistics.jacobian_calls > 0


@pytest.mark.parametrize("shape", [(1, 2), (2, 1), (3, 3)])
@pytest.mark.parametrize("form", ["dense", "sparse"])
def test_a_constant_jacobian_of_another_shape_is_refused(form, shape):
    jacobian = np.ones(shape)
    if form == "sparse":
        jacobian = pytest.importorskip("scipy.sparse").csr_matrix(jacobian)
    with pytest.raises(saltus.ModelError, match=r"solve: jacobian: expected shape \(2, 2\)"):
        solve(lambda t, x: STIFF @ x, (0, 2), [0.0, 2.0], jacobian=jacobian)


@pytest.mark.parametrize("form", ["list", "array", "sparse"])
def test_a_constant_jacobian_is_never_computed(form, tmp_path):
    jacobian = {"list": STIFF.tolist(), "array": STIFF}.get(form)
    if jacobian is None:
        jacobian = pytest.importorskip("scipy.sparse").csc_matrix(STIFF)
    bdf = {"method": "bdf"}
    found = solve(lambda t, x: STIFF @ x, (0, 2), [0.0, 2.0], jacobian=jacobian, **bdf)
    assert found.njev == 0
    assert found.nlu > 0
    found.save(tmp_path / "run.npz")
    assert saltus.load_results(tmp_path / "run.npz").njev == 0
    assert pickle.loads(pickle.dumps(found)).njev == 0
    computed = solve(lambda t, x: STIFF @ x, (0, 2), [0.0, 2.0], jacobian=lambda t, x: STIFF, **bdf)
    assert computed.njev > 0
    assert solve(lambda t, x: STIFF @ x, (0, 2), [0.0, 2.0], **bdf).njev > 0


@pytest.mark.parametrize("where", ["f", "guard"])
def test_a_write_to_x_in_place_says_what_to_do(where):
    def write(t, x):
        x[0] = 1.0
        return x

    f, guards = (write, None) if where == "f" else (fall, [Guard(write)])
    with pytest.raises(
        saltus.ModelError, match=r"may only be read at test_solve.py:\d+: .* `x = x"
    ):
        solve(f, (0, 1), [0.0, 2.0], events=guards)


@pytest.mark.parametrize("returned", [[1.0], [1.0, 2.0, 3.0], 5.0])
def test_a_reset_of_the_wrong_length_is_named(returned):
    guard = Guard(height, reset=lambda t, x: returned, direction="falling", name="bounce")
    with pytest.raises(
        saltus.ModelError, match=r"reset map of 'bounce' returned \d numbers, expect"
    ):
        solve(fall, (0, 4), [5.0, 0.0], events=guard)
