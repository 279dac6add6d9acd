"""Blocks written in Python: what their callbacks get and give."""

import re

import numpy as np
import pytest
import saltus
from saltus.library import Constant, Gain, Integrator, Sine, Step
from systems import Ball, flow, run


class Block(saltus.LeafSystem):
    """Declares what `declare(self)` says."""

    def __init__(self, declare, name="block"):
        super().__init__(name=name)
        declare(self)


def seen_by(declare, connect=(), **options):
    """What an ode of a block gets: the arguments of its first call."""
    calls = []

    def ode(time, state, *inputs, **params):
        calls.append((time, state, inputs, params))
        return np.zeros_like(state.continuous_state)

    builder = saltus.DiagramBuilder()
    block = builder.add(Block(lambda self: declare(self, ode)))
    for i, source in enumerate(connect):
        builder.connect(builder.add(source).output(), block.input(i))
    diagram = builder.build()
    saltus.simulate(diagram, diagram.create_context(), (0.0, 1.0), **options)
    return calls[0]


def test_time_and_state():
    def declare(self, ode):
        self.declare_continuous_state(default_value=np.arange(6.0).reshape(2, 3), ode=ode)
        self.declare_discrete_state(default_value=[7.0])
        self.declare_default_mode(4)

    time, state, inputs, params = seen_by(declare)
    assert type(time) is float
    assert time == 0.0
    assert state.continuous_state.tolist() == [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]]
    assert state.discrete_state.tolist() == [7.0]
    assert state.mode == 4
    assert inputs == ()
    assert params == {}


def test_inputs_are_floats_or_arrays():
    def declare(self, ode):
        for shape in (None, None, 1):
            self.declare_input_port(shape=shape)
        self.declare_continuous_state(1, ode=ode)

    _, _, (scalar, vector, one), _ = seen_by(
        declare, [Constant(2.5), Constant([1.0, 2.0]), Constant([3.0])]
    )
    assert type(scalar) is float
    assert scalar == 2.5
    assert vector.tolist() == [1.0, 2.0]
    assert one.tolist() == [3.0]


@pytest.mark.parametrize(
    ("requires_inputs", "expected"),
    [(True, (1.0, 2.0, 3.0)), (False, ()), ([2, 0], (3.0, 1.0)), ([], ())],
)
def test_requires_inputs(requires_inputs, expected):
    def declare(self, ode):
        for _ in range(3):
            self.declare_input_port()
        self.declare_continuous_state(1, ode=ode, requires_inputs=requires_inputs)

    _, _, inputs, _ = seen_by(declare, [Constant(1.0), Constant(2.0), Constant(3.0)])
    assert inputs == expected


def test_parameters_come_by_keyword():
    def declare(self, ode):
        self.declare_dynamic_parameter("k", 2)
        self.declare_dynamic_parameter("matrix", [[1, 2], [3, 4]])
        self.declare_continuous_state(1, ode=ode)

    _, _, _, params = seen_by(declare)
    assert type(params["k"]) is float
    assert params["k"] == 2.0
    assert params["matrix"].tolist() == [[1.0, 2.0], [3.0, 4.0]]


def test_parameters_are_those_of_the_context():
    ball = Ball(e=1.0)
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    for g in (9.81, 1.62, 9.81):
        results = saltus.simulate(ball, context.with_parameter("g", g), (0.0, 1.0))
        assert results.context.continuous_state[1] == pytest.approx(-g)


def test_nothing_that_a_callback_gets_can_be_written_to():
    def declare(self, ode):
        self.declare_input_port()
        self.declare_dynamic_parameter("p", [1.0, 2.0])
        self.declare_continuous_state(2, ode=ode)

    _, state, (u,), params = seen_by(declare, [Constant([1.0, 2.0])])
    for array in (state.continuous_state, state.discrete_state, u, params["p"]):
        assert not array.flags.writeable
    with pytest.raises(AttributeError):
        state.mode = 3


def test_arrays_may_be_kept():
    """Each keeps the value it had, however many calls follow, and after the block is gone."""
    kept = []

    def ode(t, x):
        kept.append((t, x, x[:1]))
        return [1.0]

    assert flow(ode, [0.0], (0.0, 1.0)) == pytest.approx(1.0)
    assert len(kept) > 10
    for t, x, view in kept:
        # every stage of an explicit method is exact for dx/dt = 1, to the rounding of its few sums
        assert x[0] == view[0] == pytest.approx(t, abs=1e-14)


def test_states_are_values():
    def declare(self, ode):
        self.declare_continuous_state(2, ode=ode)
        self.declare_discrete_state(default_value=[1.0])

    _, state, _, _ = seen_by(declare)
    given = np.array([3.0, 4.0])
    other = state.with_continuous_state(given).with_mode(2)
    given[:] = 0.0
    assert other.continuous_state.tolist() == [3.0, 4.0]
    assert (other.mode, state.mode) == (2, 0)
    assert state.continuous_state.tolist() == [0.0, 0.0]
    assert repr(other) == "State(continuous_state=[3. 4.], discrete_state=[1.], mode=2)"
    with pytest.raises(
        saltus.ModelError, match="block 'block': continuous state: expected 2 numbers, found 3"
    ):
        state.with_continuous_state([1.0, 2.0, 3.0])


@pytest.mark.parametrize(
    "give",
    [
        lambda v: np.array([v, -9.81]),
        lambda v: [v, -9.81],
        lambda v: (float(v), -9.81),
        lambda v: np.array([v, -9.81], dtype=np.float32).astype(np.float64),
        lambda v: np.array([[v, -9.81]]),
    ],
)
def test_an_ode_may_give_arrays_lists_and_tuples(give):
    y, v = flow(lambda t, x: give(x[1]), [10.0, 0.0], (0.0, 1.0))
    assert v == pytest.approx(-9.81, rel=1e-7)  # float32 has 7 digits
    assert y == pytest.approx(10.0 - 9.81 / 2, rel=1e-6)


def test_scalar_state():
    def declare(self):
        self.declare_continuous_state((), ode=lambda t, s: 1.0 - s.continuous_state)
        self.declare_continuous_state_output("x")

    results = run(Block(declare), (0.0, 2.0), rtol=1e-10, atol=1e-12)
    assert results.outputs["x"].shape == results.time.shape
    # at most 1e-10 of error a step, and contraction keeps it there: some hundred steps at the most
    np.testing.assert_allclose(results.outputs["x"], 1.0 - np.exp(-results.time), atol=1e-8)


@pytest.mark.parametrize("method", ["dopri5", "adams", "bdf"])
def test_inputs_reach_the_ode(method):
    builder = saltus.DiagramBuilder()

    def declare(self):
        self.declare_input_port("u")
        self.declare_continuous_state(1, ode=lambda t, s, u: [u])
        self.declare_continuous_state_output("x")

    block, sine = builder.add(Block(declare), Sine(name="sine"))
    builder.connect(sine.output(), block.input())
    diagram = builder.build()
    results = saltus.simulate(
        diagram,
        diagram.create_context(),
        (0.0, 3.0),
        recorded_signals={"x": block.output()},
        ode_solver_method=method,
        rtol=1e-9,
        atol=1e-11,
    )
    # rtol holds for each step; BDF and Adams lose two or three digits over a hundred of them
    np.testing.assert_allclose(results.outputs["x"][:, 0], 1.0 - np.cos(results.time), atol=1e-6)


def chain(**declared):
    """x_i' = 50 (x_{i-1} - 2 x_i + x_{i+1}), ends at zero."""
    n = 40

    def ode(t, s):
        x = np.concatenate(([0.0], s.continuous_state, [0.0]))
        return 50.0 * (x[:-2] - 2.0 * x[1:-1] + x[2:])

    return Block(
        lambda self: self.declare_continuous_state(
            default_value=np.sin(np.pi * np.arange(1, n + 1) / (n + 1)), ode=ode, **declared
        )
    )


def places_of_chain(n=40):
    return tuple(
        np.array([(i, j) for i in range(n) for j in range(n) if abs(i - j) <= 1]).T.tolist()
    )


@pytest.mark.parametrize("form", ["pair", "array", "values"])
def test_a_sparse_jacobian_gives_the_same_with_fewer_calls(form):
    rows, columns = places_of_chain()
    mask = np.zeros((40, 40))
    mask[rows, columns] = 1
    values = np.where(np.equal(rows, columns), -100.0, 50.0)
    declared = {
        "pair": {"jacobian_sparsity": (rows, columns)},
        "array": {"jacobian_sparsity": mask},
        "values": {
            "jacobian_sparsity": (rows, columns),
            "sparse_jacobian": lambda t, s: values,
        },
    }[form]

    def run(system):  # called: a traced ode knows its Jacobian, declared or not
        return saltus.simulate(
            system,
            system.create_context(),
            (0.0, 1.0),
            ode_solver_method="bdf",
            rtol=1e-7,
            python="called",
        )

    dense, sparse = run(chain()), run(chain(**declared))
    # The first mode decays with 100 (cos(pi / 41) - 1); BDF adds up a hundred errors of 1e-7.
    exact = np.sin(np.pi * np.arange(1, 41) / 41) * np.exp(100.0 * (np.cos(np.pi / 41) - 1.0))
    np.testing.assert_allclose(sparse.context.continuous_state, exact, atol=1e-5)
    assert "dense: n = 40, 1600 places, 40 colours" in dense.statistics.linear_solver
    told = "none by differences" if form == "values" else "3 colours"
    assert sparse.statistics.linear_solver.startswith(f"band: n = 40, 118 places, {told}")
    saved = dense.statistics.right_hand_side_calls - sparse.statistics.right_hand_side_calls
    assert saved > 30


@pytest.mark.parametrize(
    ("declared", "message"),
    [
        ({"jacobian_sparsity": ([0, 1], [0])}, "expected an n by n array, a sparse matrix or"),
        ({"jacobian_sparsity": 3.5}, "expected an n by n array, a sparse matrix or"),
        ({"sparse_jacobian": len}, "sparse_jacobian without jacobian_sparsity; give both"),
    ],
)
def test_a_sparsity_that_is_none_is_refused(declared, message):
    with pytest.raises(saltus.ModelError, match=re.escape(message)):
        chain(**declared)


def test_a_sparsity_outside_the_matrix_is_refused_by_a_stiff_method():
    system = chain(jacobian_sparsity=([0], [40]))
    with pytest.raises(saltus.ModelError, match=re.escape("names entry (0, 40)")):
        saltus.simulate(system, system.create_context(), (0.0, 1.0), ode_solver_method="bdf")


def test_a_linear_solver_can_be_asked_for_and_a_wrong_one_is_refused():
    system = chain()
    results = saltus.simulate(
        system,
        system.create_context(),
        (0.0, 1.0),
        ode_solver_method="bdf",
        linear_solver="gmres",
    )
    assert results.statistics.linear_solver.startswith("gmres: n = 40")
    with pytest.raises(saltus.ModelError, match="did you mean 'band'"):
        saltus.Simulator(system, linear_solver="bnad")


def test_jacobian_is_used_and_read_row_by_row():
    matrix = np.array(
        [[-1.0, 1000.0], [0.0, -1000.0]]
    )  # its transpose would not converge to the same
    calls = []

    def declare(self):
        def jacobian(t, s):
            calls.append(t)
            return matrix

        self.declare_continuous_state(
            default_value=[1.0, 1.0],
            ode=lambda t, s: matrix @ s.continuous_state,
            jacobian=jacobian,
        )

    system = Block(declare)
    results = saltus.simulate(
        system, system.create_context(), (0.0, 1.0), ode_solver_method="bdf", rtol=1e-8, atol=1e-10
    )
    assert results.statistics.jacobian_calls == len(calls) > 0
    # x_1 = exp(-1000 t); x_0 = (1 + c) exp(-t) - c exp(-1000 t), c = 1000/999
    assert results.context.continuous_state[0] == pytest.approx(
        (1 + 1000 / 999) * np.exp(-1.0), rel=1e-5
    )


def test_outputs_find_their_shape_by_one_call():
    def declare(self):
        self.declare_input_port("u")
        self.declare_continuous_state(2, ode=lambda t, s, u: [0.0, 0.0])
        self.declare_output_port(lambda t, s, u: 2.0 * np.asarray(u), name="as input")
        self.declare_output_port(
            lambda t, s: s.continuous_state, name="state", requires_inputs=False
        )
        self.declare_output_port(
            lambda t, s: s.continuous_state[0], name="first", requires_inputs=False
        )
        self.declare_output_port(
            lambda t, s: np.ones(3), name="fixed", requires_inputs=False, shape=3
        )
        self.declare_output_port(
            lambda t, s: [t], name="default", requires_inputs=False, default_value=[0.0]
        )

    builder = saltus.DiagramBuilder()
    block, source = builder.add(Block(declare), Constant([1.0, 2.0, 3.0]))
    builder.connect(source.output(), block.input())
    diagram = builder.build()
    recorded = {port.name: port for port in block.output_ports}
    outputs = saltus.simulate(
        diagram, diagram.create_context(), (0.0, 1.0), recorded_signals=recorded
    ).outputs
    widths = {name: array.shape[1:] for name, array in outputs.items()}
    assert widths == {"as input": (3,), "state": (2,), "first": (), "fixed": (3,), "default": (1,)}
    assert outputs["as input"][0].tolist() == [2.0, 4.0, 6.0]


def test_an_output_that_needs_no_input_closes_a_loop():
    """Only declared feedthrough counts: block -> gain -> block is no algebraic loop."""

    def declare(self, requires_inputs):
        self.declare_input_port("u")
        self.declare_continuous_state(default_value=[1.0], ode=lambda t, s, u: [u])
        self.declare_output_port(
            lambda t, s, *u: s.continuous_state[0], name="y", requires_inputs=requires_inputs
        )

    def diagram(requires_inputs):
        builder = saltus.DiagramBuilder()
        block, gain = builder.add(
            Block(lambda self: declare(self, requires_inputs)), Gain(-1.0, name="gain")
        )
        builder.connect(block.output(), gain.input())
        builder.connect(gain.output(), block.input())
        return builder.build()

    good = diagram(False)
    end = saltus.simulate(good, good.create_context(), (0.0, 1.0), rtol=1e-9, atol=1e-11).context
    assert end.continuous_state[0] == pytest.approx(np.exp(-1.0), abs=1e-8)
    bad = diagram(True)
    with pytest.raises(saltus.ModelError, match="loop"):
        saltus.simulate(bad, bad.create_context(), (0.0, 1.0))


def test_boolean_output_resets_an_integrator():
    """A sawtooth of period 1: the integrator of 1 falls back when a Python block says it is
    full.
    """

    def declare(self):
        self.declare_input_port("level")
        self.declare_output_port(lambda t, s, level: level >= 1.0, name="full")

    builder = saltus.DiagramBuilder()
    one, tank, full = builder.add(
        Constant(1.0), Integrator(enable_reset=True, name="tank"), Block(declare)
    )
    builder.connect(one.output(), tank.input("in"))
    builder.connect(tank.output(), full.input())
    builder.connect(full.output(), tank.input("reset_trigger"))
    diagram = builder.build()
    results = saltus.simulate(
        diagram, diagram.create_context(), (0.0, 3.5), recorded_signals={"x": tank.output()}
    )
    # located to a hundred roundings of the time; three of them add up
    np.testing.assert_allclose(
        results.events.times("tank.reset"), [1.0, 2.0, 3.0], rtol=0, atol=3e-13
    )
    assert results.outputs["x"][-1] == pytest.approx(0.5, abs=1e-12)


def test_modes_choose_among_guards():
    """A thermostat: heat until 21, cool until 19. Both legs are straight lines, so every switch is
    known.
    """

    def declare(self):
        self.declare_continuous_state(
            default_value=[20.0], ode=lambda t, s: [2.0 if s.mode == 1 else -1.0]
        )
        self.declare_default_mode(1)
        self.declare_mode_output("mode")
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - 21.0,
            name="hot",
            start_mode=1,
            end_mode=0,
            direction="negative_then_non_negative",
        )
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - 19.0,
            name="cold",
            start_mode=0,
            end_mode=1,
            direction="positive_then_non_positive",
        )

    results = run(Block(declare), (0.0, 7.0))
    np.testing.assert_allclose(results.events.times("hot"), [0.5, 3.5, 6.5], rtol=0, atol=1e-11)
    np.testing.assert_allclose(results.events.times("cold"), [2.5, 5.5], rtol=0, atol=1e-11)
    assert results.context.mode == 0
    assert set(results.outputs["mode"]) == {0.0, 1.0}


def test_reset_map_may_set_the_mode():
    def declare(self):
        self.declare_continuous_state(1, ode=lambda t, s: [1.0])
        self.declare_default_mode(0)
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - 1.0, lambda t, s: s.with_mode(s.mode + 5)
        )

    system = Block(declare)
    assert saltus.simulate(system, system.create_context(), (0.0, 2.0)).context.mode == 5


def test_terminal_event_ends_the_run_after_its_reset():
    ball = Ball(terminal=True)
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    results = run(ball, (0.0, 100.0), context, rtol=1e-10, atol=1e-12)
    t1 = np.sqrt(20.0 / 9.81)
    assert results.status == "terminal"
    assert results.context.time == pytest.approx(t1, abs=1e-11)
    assert results.context.continuous_state[1] == pytest.approx(0.9 * 9.81 * t1, abs=1e-9)
    assert results.events[-1].kind == "terminal"


def test_a_monitor_changes_no_bit():
    def oscillator(monitored):
        def declare(self):
            self.declare_continuous_state(
                default_value=[1.0, 0.0],
                ode=lambda t, s: [s.continuous_state[1], -s.continuous_state[0]],
            )
            self.declare_continuous_state_output("x")
            if monitored:
                self.declare_zero_crossing(lambda t, s: s.continuous_state[0], name="zero")

        return run(Block(declare), (0.0, 10.0), rtol=1e-9, atol=1e-12)

    plain, watched = oscillator(False), oscillator(True)
    assert np.array_equal(plain.outputs["x"], watched.outputs["x"])
    zeros = (np.arange(3) + 0.5) * np.pi
    # the error of the state, some 1e-9 a step over a hundred steps, at unit speed
    np.testing.assert_allclose(watched.events.times("zero"), zeros, rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    "direction",
    ["crosses_zero", "positive_then_non_positive", "negative_then_non_negative", "none"],
)
def test_directions(direction):
    def declare(self):
        self.declare_continuous_state(1, ode=lambda t, s: [1.0])
        self.declare_zero_crossing(
            lambda t, s: np.sin(t), lambda t, s: s, name="wave", direction=direction
        )

    system = Block(declare)
    found = saltus.simulate(
        system, system.create_context(), (0.5, 10.0), max_minor_step_size=0.5
    ).events.times("wave")
    expected = {
        "crosses_zero": [1, 2, 3],
        "positive_then_non_positive": [1, 3],
        "negative_then_non_negative": [2],
        "none": [],
    }
    np.testing.assert_allclose(found, np.pi * np.array(expected[direction]), rtol=0, atol=1e-12)


@pytest.mark.parametrize("whole_state", [True, False])
def test_periodic_update(whole_state):
    """It may give a state, or the discrete state alone."""

    def count(t, s):
        return (
            s.with_discrete_state(s.discrete_state + 1.0) if whole_state else s.discrete_state + 1.0
        )

    def declare(self):
        self.declare_discrete_state(default_value=[0.0])
        self.declare_discrete_state_output("count")
        self.declare_periodic_update(count, period=1 / 3, offset=0.5)

    results = run(Block(declare), (0.0, 0.5 + 99 / 3))
    assert results.context.discrete_state == [
        100.0
    ]  # 100 ticks of 1/3 s, the first at 0.5 s, the last at the end
    assert results.events[0].time == 0.5


def test_one_shot():
    def declare(self):
        self.declare_continuous_state(1, ode=lambda t, s: [1.0])
        self.declare_one_shot(lambda t, s: s.with_continuous_state([0.0]), 0.75, name="back")

    system = Block(declare)
    results = saltus.simulate(system, system.create_context(), (0.0, 1.0))
    assert results.events.times("back", kind="time").tolist() == [0.75]
    assert results.context.continuous_state[0] == pytest.approx(0.25, abs=1e-15)


def test_a_discrete_controller_restarts_what_it_drives():
    """The output reads everything, so nothing but the update says that it jumped."""

    def declare(self):
        self.declare_discrete_state(default_value=[1.0])
        self.declare_output_port(lambda t, s: s.discrete_state[0], name="u")
        self.declare_periodic_update(lambda t, s: -s.discrete_state, period=1.0, offset=1.0)

    builder = saltus.DiagramBuilder()
    controller, plant = builder.add(Block(declare), Integrator(name="plant"))
    builder.connect(controller.output(), plant.input())
    diagram = builder.build()
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 3.5))
    assert results.statistics.restarts == 3
    assert results.context.continuous_state[0] == pytest.approx(
        0.5, abs=1e-14
    )  # straight lines are exact


def test_reads_decides_how_often_an_output_is_called():
    def calls(**reads):
        seen = []

        def declare(self):
            self.declare_discrete_state(default_value=[1.0])
            self.declare_output_port(
                lambda t, s: seen.append(t) or s.discrete_state[0], name="u", **reads
            )

        builder = saltus.DiagramBuilder()
        block, plant = builder.add(Block(declare), Integrator(name="plant"))
        builder.connect(block.output(), plant.input())
        diagram = builder.build()
        steps = saltus.simulate(
            diagram, diagram.create_context(), (0.0, 1.0), max_minor_step_size=0.01
        ).statistics.steps
        return len(seen), steps

    often, steps = calls()
    assert often > 5 * steps  # at every stage
    seldom, _ = calls(reads=["discrete_state"])
    assert seldom < 10


def test_step_input_reaches_a_guard():
    """A guard with an input: the floor of a ball is another block's output."""

    def declare(self):
        self.declare_input_port("floor")
        self.declare_continuous_state(default_value=[1.0], ode=lambda t, s, floor: [-1.0])
        self.declare_zero_crossing(
            lambda t, s, floor: s.continuous_state[0] - floor,
            lambda t, s, floor: s.with_continuous_state([floor + 1.0]),
            name="hit",
            direction="positive_then_non_positive",
        )

    builder = saltus.DiagramBuilder()
    block, floor = builder.add(Block(declare), Step(start_value=0.0, end_value=-1.0, step_time=1.5))
    builder.connect(floor.output(), block.input())
    diagram = builder.build()
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 3.5))
    # falls from 1 to 0 in 1 s; half way down again the floor drops by 1: 1.5 s more
    np.testing.assert_allclose(results.events.times("hit"), [1.0, 3.0], rtol=0, atol=1e-12)


def test_default_name_is_class_and_id():
    class Engine(saltus.LeafSystem):
        pass

    engine = Engine()
    assert engine.name == f"Engine_{engine.system_id}"


@pytest.mark.parametrize(
    ("declare", "message"),
    [
        (
            lambda s: s.declare_continuous_state(),
            "block 'block': continuous state: give a shape, such as 2, or a default_value",
        ),
        (
            lambda s: s.declare_continuous_state(2, ode=3),
            "block 'block': ode: expected a function, found 3",
        ),
        (
            lambda s: (s.declare_continuous_state(1), s.declare_continuous_state(1)),
            "block 'block': the continuous state is declared twice; declare it once, as one vector",
        ),
        (
            lambda s: s.declare_continuous_state(1, mass_matrix=[1]),
            "declare_continuous_state: no option 'mass_matrix': divide by it in the ode",
        ),
        (
            lambda s: s.declare_continuous_state(1, odd=len),
            "declare_continuous_state: unknown option 'odd'; did you mean 'ode'? "
            "Known: 'shape', 'default_value', 'ode', 'requires_inputs', 'jacobian', "
            "'jacobian_sparsity', 'sparse_jacobian'",
        ),
        (
            lambda s: s.declare_zero_crossing(len, direction="crosses_zer0"),
            "block 'block': zero crossing 'zero_crossing_0': "
            "unknown direction 'crosses_zer0'; did you mean 'crosses_zero'? "
            "Known: 'none', 'crosses_zero', "
            "'positive_then_non_positive', 'negative_then_non_negative', 'edge_detection'",
        ),
        (
            lambda s: s.declare_output_port(len, period=0.1),
            "declare_output_port: no option 'period': put a ZeroOrderHold behind the output",
        ),
        (
            lambda s: s.declare_output_port(len, reads=["mood"]),
            "block 'block': output 'out_0' reads 'mood'; did you mean 'mode'? "
            "Known: 'time', 'continuous_state', 'discrete_state', 'mode', 'inputs'",
        ),
        (
            lambda s: s.declare_dynamic_parameter("k", "much"),
            "block 'block': parameter 'k': expected numbers, found 'much' (str)",
        ),
        (
            lambda s: s.declare_periodic_update(len, period=0.0),
            "block 'block': periodic update 'periodic_0': period 0 s, offset 0 s; "
            "expected period > 0 and a finite offset",
        ),
    ],
)
def test_bad_declarations(declare, message):
    with pytest.raises(saltus.ModelError) as caught:
        Block(declare)
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("ode", "message"),
    [
        (
            lambda t, s: None,
            "block 'flow': ode returned None, expected 2 numbers; is a `return` missing?",
        ),
        (lambda t, s: [1.0], "block 'flow': ode returned 1 numbers, expected 2"),
        (lambda t, s: "no", "block 'flow': ode returned 'no' (str), expected 2 numbers"),
        (
            lambda t, s: [1j, 2],
            "block 'flow': ode returned a list whose entry [0] is 1j (complex), expected 2 numbers",
        ),
    ],
)
@pytest.mark.parametrize("method", ["dopri5", "adams", "bdf"])
def test_bad_results_of_an_ode(ode, message, method):
    class Flow(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="flow")
            self.declare_continuous_state(2, ode=ode)

    system = Flow()
    with pytest.raises(saltus.ModelError) as caught:
        saltus.simulate(system, system.create_context(), (0.0, 1.0), ode_solver_method=method)
    assert str(caught.value) == message


@pytest.mark.parametrize("where", ["output", "ode"])
def test_required_inputs_must_be_there(where):
    def declare(self):
        self.declare_input_port()
        if where == "ode":
            self.declare_continuous_state(1, ode=lambda t, s, u: [u], requires_inputs=[1])
        else:
            self.declare_output_port(lambda t, s, u: u, requires_inputs=[1])

    builder = saltus.DiagramBuilder()
    block, source = builder.add(Block(declare), Constant(1.0))
    builder.connect(source.output(), block.input())
    diagram = builder.build()
    with pytest.raises(saltus.ModelError, match="input 1, the block has 1"):
        saltus.simulate(diagram, diagram.create_context(), (0.0, 1.0))


@pytest.mark.parametrize("result", [None, [1.0], 3])
def test_a_reset_map_gives_a_state(result):
    def declare(self):
        self.declare_continuous_state(1, ode=lambda t, s: [1.0])
        self.declare_zero_crossing(lambda t, s: t - 0.5, lambda t, s: result, name="half")

    system = Block(declare)
    with pytest.raises(
        saltus.ModelError,
        match=r"reset map of 'half' returned .*, expected a state: `return state.with_",
    ):
        saltus.simulate(system, system.create_context(), (0.0, 1.0))
