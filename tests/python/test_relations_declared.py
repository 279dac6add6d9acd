"""Relations and edge resets declared in Python: truths held between instants, resets at edges."""

import numpy as np
import pytest
import saltus
from saltus.library import Comparator, Constant, Pulse

METHODS = ["dopri5", "dop853", "adams", "bdf", "radau"]
PYTHON = ["traced", "called"]


class Tank(saltus.LeafSystem):
    """x' = 1 while x <= 25, else 1/2; from 20 it reaches 25 at 5 s."""

    def __init__(self):
        super().__init__(name="tank")
        self.declare_continuous_state([20.0], ode=self.ode)
        self.full = self.declare_relation(self.above, name="full")
        self.declare_continuous_state_output("x")
        self.declare_output_port(self.truth, name="full", shape=())

    def above(self, time, state):
        return state.continuous_state[0] - 25.0

    def ode(self, time, state):
        return [0.5 if state.relations[self.full] else 1.0]

    def truth(self, time, state):
        return float(state.relations[self.full])


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("python", PYTHON)
def test_the_derivative_jumps_where_the_guard_is_zero(python, method):
    """The solution has two straight pieces, which every method follows to roundings."""
    tank = Tank()
    results = saltus.simulate(
        tank,
        tank.create_context(),
        (0.0, 9.0),
        recorded_signals={"x": tank.output("x"), "full": tank.output("full")},
        ode_solver_method=method,
        python=python,
    )
    time = results.time
    expected = np.where(time < 5.0, 20.0 + time, 25.0 + 0.5 * (time - 5.0))
    np.testing.assert_allclose(results.outputs["x"][:, 0], expected, rtol=0.0, atol=1e-9)
    full = results.outputs["full"]
    assert np.all(full[time < 5.0 - 1e-9] == 0.0) and np.all(full[time > 5.0 + 1e-9] == 1.0)


def test_the_guard_is_traced_and_a_reader_of_the_truth_is_called():
    explained = {callback.callback: callback for callback in Tank().explain()}
    assert explained["guard of relation 'full'"][2] == "traced"
    assert explained["ode"][2] == "called"
    assert "reads state.relations" in explained["ode"].reason


class Signs(saltus.LeafSystem):
    """Two truths of one relation, of x_0 = t - 1 and x_1 = 2 - t."""

    def __init__(self, true_at_zero=False):
        super().__init__(name="signs")
        self.declare_continuous_state([-1.0, 2.0], ode=lambda t, s: [1.0, -1.0])
        self.signs = self.declare_relation(
            lambda t, s: s.continuous_state, name="signs", size=2, true_at_zero=true_at_zero
        )
        self.declare_output_port(self.truths, name="truths", shape=2)

    def truths(self, time, state):
        assert not state.relations[self.signs].flags.writeable
        return state.relations[self.signs]


def test_a_relation_of_two_entries():
    signs = Signs()
    context = signs.create_context()
    recorded = {"truths": signs.output("truths")}
    results = saltus.simulate(
        signs, context, (0.0, 3.0), recorded_signals=recorded, save_at=[0.5, 1.5, 2.5]
    )
    rows = {t: row.tolist() for t, row in zip(results.time, results.outputs["truths"], strict=True)}
    assert [rows[t] for t in (0.5, 1.5, 2.5)] == [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]


@pytest.mark.parametrize("true_at_zero", [False, True])
def test_the_truth_at_zero_where_no_side_is_known(true_at_zero):
    class Still(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="still")
            self.declare_continuous_state([0.0])
            self.declare_relation(lambda t, s: s.continuous_state[0], true_at_zero=true_at_zero)
            self.declare_output_port(lambda t, s: float(s.relations[0]), name="y", shape=())

    still = Still()
    results = saltus.simulate(
        still, still.create_context(), (0.0, 1.0), recorded_signals={"y": still.output("y")}
    )
    assert np.all(results.outputs["y"] == float(true_at_zero))


class Counter(saltus.LeafSystem):
    """Counts the edges of its input."""

    def __init__(self, edge):
        super().__init__(name="counter")
        self.declare_discrete_state([0.0])
        self.declare_input_port("gate")
        self.declare_edge_reset(self.count, input=0, edge=edge, name="edge")

    def count(self, time, state, gate):
        return state.with_discrete_state(state.discrete_state + 1.0)


def counting(edge, **options):
    """Counts of a pulse that is on from k to k + 1/2 s, k = 0, 1, ..., until 3.75 s."""
    builder = saltus.DiagramBuilder()
    pulse, counter = builder.add(Pulse(period=1.0, pulse_width=0.5), Counter(edge))
    builder.connect(pulse.output(), counter.input())
    diagram = builder.build()
    return saltus.simulate(diagram, diagram.create_context(), (0.0, 3.75), **options)


@pytest.mark.parametrize("python", PYTHON)
@pytest.mark.parametrize(("edge", "count"), [("rising", 3.0), ("falling", 4.0), ("either", 7.0)])
def test_edges_are_counted(edge, count, python):
    """Nothing is reset at the start, where the pulse is on already."""
    results = counting(edge, python=python)
    assert results.context.discrete_state.tolist() == [count]


def test_an_edge_reset_is_traced():
    explained = Counter("rising").explain()
    assert [(c.callback, c[2]) for c in explained] == [("reset map of 'edge'", "traced")]


@pytest.mark.parametrize("method", METHODS)
def test_an_edge_of_a_comparison_resets_a_state_at_its_time(method):
    """A ramp that falls back to zero when it reaches 1: a saw of period 1 s."""

    class Saw(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="saw")
            self.declare_input_port("high")
            self.declare_continuous_state([0.0], ode=lambda t, s: [1.0], requires_inputs=False)
            self.declare_edge_reset(
                lambda t, s: s.with_continuous_state([0.0]), input=0, requires_inputs=False
            )
            self.declare_continuous_state_output("x")

    builder = saltus.DiagramBuilder()
    saw, one, high = builder.add(Saw(), Constant(1.0), Comparator(">="))
    builder.connect(saw.output(), high.input(0))
    builder.connect(one.output(), high.input(1))
    builder.connect(high.output(), saw.input())
    diagram = builder.build()
    results = saltus.simulate(
        diagram, diagram.create_context(), (0.0, 3.5), ode_solver_method=method
    )
    assert results.context.continuous_state[0] == pytest.approx(0.5, abs=1e-9)


def declared(**arguments):
    class Block(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="block")
            self.declare_input_port("in")
            self.declare_edge_reset(lambda t, s, u: s, 0, name="n", **arguments)

    return Block()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"edge": "risin"}, "edge reset 'n': unknown edge 'risin'; did you mean 'rising'"),
        ({"on_zeno": "halt"}, "edge reset 'n': unknown on_zeno 'halt'"),
        ({"zeno_tolerance": "small"}, "zeno_tolerance: expected a time"),
        ({"period": 1.0}, "unknown option 'period'"),
    ],
)
def test_arguments_that_make_no_sense_are_refused(arguments, message):
    with pytest.raises(saltus.ModelError, match=message):
        declared(**arguments)


def test_a_relation_needs_an_entry_and_a_name_of_its_own():
    block = saltus.LeafSystem(name="block")
    with pytest.raises(saltus.ModelError, match="relation 'r': size 0; expected 1 or more"):
        block.declare_relation(lambda t, s: 1.0, name="r", size=0)
    block.declare_relation(lambda t, s: 1.0, name="r")
    with pytest.raises(saltus.ModelError, match="the name 'r' is declared twice"):
        block.declare_relation(lambda t, s: 1.0, name="r")


def test_the_relations_of_a_block_without_any_are_empty():
    seen = []

    class Block(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="block")
            self.declare_continuous_state([1.0], ode=self.ode)

        def ode(self, time, state):
            seen.append(state.relations)
            return [0.0]

    block = Block()
    saltus.simulate(block, block.create_context(), (0.0, 1.0))
    assert set(seen) == {()}
