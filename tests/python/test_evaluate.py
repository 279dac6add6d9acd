"""Values at a context without a run, and inputs with a fixed value."""

import gc

import numpy as np
import pytest
import saltus
from saltus.errors import (
    AlgebraicLoopError,
    BlockParameterError,
    BuilderError,
    EmptyDiagramError,
    InputNotConnectedError,
    ModelError,
    ShapeMismatchError,
    StaticError,
    SystemNameNotUniqueError,
)
from saltus.library import (
    Adder,
    Clock,
    Constant,
    FeedthroughBlock,
    Gain,
    Integrator,
    ReduceBlock,
    SourceBlock,
)


class Relaxation(saltus.LeafSystem):
    """x' = -a x + u, with the outputs x, x' and u."""

    def __init__(self, a=1.5, name=None):
        super().__init__(name=name)
        self.declare_continuous_state(shape=(), ode=self.ode)
        self.declare_dynamic_parameter("a", a)
        self.declare_input_port("u")
        self.declare_continuous_state_output("x")
        self.declare_output_port(self.ode, name="rate")
        self.declare_output_port(lambda time, state, u, a: u, name="u_out")

    def ode(self, time, state, u, *, a):
        return -a * state.continuous_state + u


def loop():
    """x' = 2 x by blocks."""
    builder = saltus.DiagramBuilder()
    x, twice = builder.add(Integrator(3.0, name="x"), Gain(2.0, name="twice"))
    builder.connect(x.output(), twice.input())
    builder.connect(twice.output(), x.input())
    return builder.build(name="loop"), x, twice


def test_an_open_input_may_have_a_fixed_value():
    plant = Relaxation()
    plant.input_ports[0].fix_value(0.0)
    begin = plant.create_context().with_continuous_state(4.0)
    end = saltus.simulate(plant, begin, (0.0, 2.0)).context
    # x(2) = 4 exp(-3); ten tolerances of rtol = 1e-6
    assert end.continuous_state == pytest.approx(4.0 * np.exp(-3.0), rel=1e-5)


def test_a_new_fixed_value_counts_for_the_next_run():
    plant = Relaxation(a=1.0)
    begin = plant.create_context()
    rates = []
    for value in (1.0, 2.0, 2.0, 3.0):
        plant.input().fix_value(value)
        rates.append(saltus.simulate(plant, begin, (0.0, 50.0)).context.continuous_state[0])
    assert rates == pytest.approx([1.0, 2.0, 2.0, 3.0], rel=1e-5)


def test_a_fixed_value_of_another_width_counts_too():
    square = FeedthroughBlock(lambda u: u * u)
    for value in (3.0, [1.0, 2.0], [[4.0]], [[[1.0]]], [[1.0, 2.0], [3.0, 4.0]], 5.0):
        if np.ndim(value) == 3:
            with pytest.raises(
                ModelError, match=r"expected a number, a vector or a matrix, .* 3 dim"
            ):
                square.input().fix_value(value)
            continue
        square.input().fix_value(value)
        begin = square.create_context()
        expected = np.square(value)
        assert np.array_equal(square.output().eval(begin), expected)
        rows = saltus.simulate(
            square, begin, (0.0, 1.0), recorded_signals={"y": square.output()}
        ).outputs["y"]
        assert np.array_equal(rows[-1], expected)


def test_a_block_of_a_diagram_may_have_a_fixed_input():
    builder = saltus.DiagramBuilder()
    gain, x = builder.add(Gain(2.0, name="gain"), Integrator(name="x"))
    gain.input().fix_value(3.0)
    builder.connect(gain.output(), x.input())
    diagram = builder.build()
    assert saltus.simulate(
        diagram, diagram.create_context(), (0.0, 2.0)
    ).context.continuous_state == pytest.approx(12.0)
    gain.input().fix_value(4.0)  # the plan that the diagram keeps is of no use now
    assert saltus.simulate(
        diagram, diagram.create_context(), (0.0, 2.0)
    ).context.continuous_state == pytest.approx(16.0)


def test_an_input_has_one_source():
    builder = saltus.DiagramBuilder()
    clock, gain = builder.add(Clock(name="clock"), Gain(2.0, name="gain"))
    gain.input().fix_value(3.0)
    with pytest.raises(BuilderError, match="already has a source, its fixed value"):
        builder.connect(clock.output(), gain.input())


@pytest.mark.parametrize(
    "value", [np.nan, [1.0, np.inf], [], "much", [[[1.0]]], [[]], [[1.0], [2.0, 3.0]]]
)
def test_impossible_fixed_values_are_refused(value):
    with pytest.raises(ModelError, match="input"):
        Gain(2.0, name="gain").input().fix_value(value)


def test_ports_and_rates_of_a_diagram():
    diagram, x, twice = loop()
    begin = diagram.create_context()
    assert twice.output_ports[0].eval(begin) == 6.0
    assert twice.input_ports[0].eval(begin) == 3.0
    assert list(diagram.eval_time_derivatives(begin)) == [6.0]
    assert list(x.eval_time_derivatives(begin)) == [6.0]
    assert x.eval_time_derivatives(begin.with_continuous_state(5.0)) == 10.0


def test_an_exported_output_of_an_inner_diagram():
    builder = saltus.DiagramBuilder()
    gain = builder.add(Gain(2.0, name="gain"))
    builder.export_input(gain.input(), "u")
    builder.export_output(gain.output(), "y")
    inner = builder.build("inner")
    builder = saltus.DiagramBuilder()
    builder.add(inner)
    four = builder.add(Constant(4.0))
    builder.connect(four.output(), inner.input())
    outer = builder.build()
    begin = outer.create_context()
    assert inner.output().eval(begin) == inner.output_ports[0].eval(begin) == 8.0
    assert inner.input().eval(begin) == 4.0


def test_the_context_of_one_block_is_enough_for_what_reads_no_input():
    plant = Relaxation(name="plant")
    builder = saltus.DiagramBuilder()
    builder.add(plant)
    source = builder.add(Constant(1.0))
    builder.connect(source.output(), plant.input())
    diagram = builder.build()
    begin = diagram.create_context().with_subcontext(
        plant.system_id, plant.create_context().with_continuous_state(2.0)
    )
    assert plant.eval_time_derivatives(begin) == -2.0  # -1.5 * 2 + 1
    assert plant.output("u_out").eval(begin) == 1.0
    with pytest.raises(InputNotConnectedError, match="input 'u'"):
        plant.eval_time_derivatives(begin[plant])


def test_a_diagram_of_one_block_and_the_block_are_told_apart():
    builder = saltus.DiagramBuilder()
    x = builder.add(Integrator(2.0, name="x"))
    x.input().fix_value(7.0)
    diagram = builder.build()
    begin = diagram.create_context()
    assert begin.system_id == diagram.system_id
    assert begin[x].system_id == x.system_id
    assert x.eval_time_derivatives(begin) == x.eval_time_derivatives(begin[x]) == 7.0


def test_a_context_of_a_diagram_that_does_not_live():
    diagram, x, _ = loop()
    part = diagram.create_context()
    del diagram
    gc.collect()
    with pytest.raises(ModelError, match="a diagram around 'x' that does not live any more"):
        x.eval_time_derivatives(part)
    with pytest.raises(ModelError, match="expected a context"):
        x.eval_time_derivatives(3.0)


def test_contexts_from_elsewhere():
    """From a file, of an inner diagram, of the shelf, of an equal system."""
    diagram, x, twice = loop()
    begin = diagram.context_from_json(diagram.create_context().to_json())
    assert twice.output().eval(begin) == 6.0
    builder = saltus.DiagramBuilder()
    builder.add(diagram)
    outer = builder.build("outer")
    assert x.eval_time_derivatives(outer.create_context()[diagram]) == 6.0
    other = loop()[0]
    assert list(diagram.eval_time_derivatives(other.create_context())) == [6.0]
    scene = saltus.scene("bouncing-ball-blocks")
    speed = scene.system["integrator_v"]
    assert speed.eval_time_derivatives(scene.context) == pytest.approx(-9.81)
    with pytest.raises(ModelError, match="the context is not one of this system"):
        diagram.eval_time_derivatives(scene.context)


def test_a_block_of_the_shelf_keeps_its_sources():
    block = saltus.scene("bouncing-ball-blocks").system["integrator_v"]
    with pytest.raises(
        ModelError, match="input 'in' of block 'integrator_v': .* that C\\+\\+ made"
    ):
        block.input().fix_value(99.0)


@pytest.mark.parametrize("python", ["traced", "called"])
def test_a_simulator_begins_with_the_present_fixed_value(python):
    plant = Relaxation(a=0.0)
    plant.input().fix_value(1.0)
    simulator = saltus.Simulator(plant, python=python)
    ends = []
    for value in (1.0, 5.0):
        plant.input().fix_value(value)
        simulator.initialize(plant.create_context())
        simulator.advance_to(1.0)
        ends.append(simulator.context.continuous_state[0])
    assert ends == pytest.approx([1.0, 5.0])


def test_a_fixed_value_can_be_taken_away():
    gain = Gain(2.0, name="gain")
    gain.input().fix_value(3.0)
    gain.input().fix_value(None)
    with pytest.raises(InputNotConnectedError, match="input 'in'"):
        gain.output().eval(gain.create_context())
    gain.input().fix_value(None)  # nothing to take away


def test_the_exception_of_a_function_comes_out_unchanged():
    def breaks(u):
        raise KeyError("mine")

    block = FeedthroughBlock(breaks)
    block.input().fix_value(1.0)
    with pytest.raises(KeyError, match="mine"):
        block.output().eval(block.create_context())


def test_a_source_is_a_function_of_time():
    source = SourceBlock(np.sin, name="source")
    x = Integrator(name="x")
    builder = saltus.DiagramBuilder()
    builder.add(source, x)
    builder.connect(source.output(), x.input())
    diagram = builder.build()
    end = saltus.simulate(diagram, diagram.create_context(), (0.0, 2.0)).context
    assert end.continuous_state == pytest.approx(1.0 - np.cos(2.0), rel=1e-5)
    assert source.explain()[0].runs == "traced"
    with pytest.raises(ModelError, match="expected a function, found 3"):
        SourceBlock(3)


def test_a_simulator_advances_from_a_context():
    diagram, *_ = loop()
    simulator = saltus.Simulator(diagram)
    begin = diagram.create_context()
    assert simulator.initialize(begin).context == begin
    first = simulator.advance_to(1.0, begin)
    assert first == "reached_end" and first.context.time == 1.0
    second = simulator.advance_to(2.0, first.context)
    assert second.context.continuous_state == pytest.approx(3.0 * np.exp(4.0), rel=1e-5)
    assert first.context.time == 1.0  # a context is a value
    again = simulator.advance_to(1.0, begin)
    assert again.context == first.context
    with pytest.raises(ModelError, match="expected a time of 5.0 s or later, found 1.0 s"):
        simulator.advance_to(1.0, begin.with_time(5.0))
    assert simulator.time == 1.0  # the run is still there


def test_counts_names_and_paths():
    builder = saltus.DiagramBuilder()
    builder.add(loop()[0])
    outer = builder.build("outer")
    assert outer.num_systems == 1 and outer.nodes == (outer["loop"],)
    assert outer.find_system_with_path("loop.twice").name == "twice"
    with pytest.raises(ModelError, match="did you mean 'twice'"):
        outer.find_system_with_path("loop.twize")
    with pytest.raises(ModelError, match="expected a path such as 'car.engine', found 3"):
        outer.find_system_with_path(3)
    with pytest.raises(ModelError, match="'twice' is no diagram: it has no block 'gain'"):
        outer.find_system_with_path("loop.twice.gain")
    assert (Adder(3).num_input_ports, Adder(3).num_output_ports) == (3, 1)
    context = outer.create_context()
    assert context.num_continuous_states == 1 and context.num_discrete_states == 0
    assert context.state.continuous_state == context.continuous_state
    lines = []
    outer.pprint(lines.append)
    assert lines == [
        "outer  Diagram  () -> ()\n"
        "    loop  Diagram  () -> ()\n"
        "        x  Integrator  (in) -> (out)\n"
        "        twice  Gain  (in) -> (out)"
    ]


def test_a_class_of_the_user_may_have_attributes_of_these_names():
    class Plant(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="plant")
            self.num_input_ports = "mine"
            self.nodes = self.parameters = self._tree = None

    lines = []
    Plant().pprint(lines.append)
    assert Plant().num_input_ports == "mine" and lines == ["plant  Plant  () -> ()"]


def test_the_tree_of_a_diagram_that_was_made_in_cpp():
    lines = []
    saltus.scene("bouncing-ball-blocks").system.pprint(lines.append)
    assert "    integrator_v  SharedSystem  (in, reset_trigger, reset_value) -> (out)" in lines[0]


def twice_the_same():
    saltus.DiagramBuilder().add(Gain(1.0, name="a"), Gain(1.0, name="a"))


def algebraic():
    builder = saltus.DiagramBuilder()
    gain = builder.add(Gain(2.0))
    builder.connect(gain.output(), gain.input())
    builder.build()


def open_input():
    builder = saltus.DiagramBuilder()
    builder.add(Gain(2.0))
    builder.build()


def two_widths():
    builder = saltus.DiagramBuilder()
    total, a, b = builder.add(Adder(2), Constant([1.0, 2.0]), Constant([1.0, 2.0, 3.0]))
    builder.connect(a.output(), total.input(0))
    builder.connect(b.output(), total.input(1))
    diagram = builder.build()
    saltus.simulate(diagram, diagram.create_context(), (0.0, 0.0))


@pytest.mark.parametrize(
    "mistake, kind, wider",
    [
        (twice_the_same, SystemNameNotUniqueError, BuilderError),
        (lambda: saltus.DiagramBuilder().build(), EmptyDiagramError, BuilderError),
        (algebraic, AlgebraicLoopError, StaticError),
        (open_input, InputNotConnectedError, StaticError),
        (two_widths, ShapeMismatchError, StaticError),
        (lambda: Adder("*"), BlockParameterError, StaticError),
        (lambda: Adder(2.5), BlockParameterError, StaticError),
        (lambda: ReduceBlock(0, sum), BlockParameterError, StaticError),
    ],
)
def test_each_kind_of_mistake_has_its_exception(mistake, kind, wider):
    with pytest.raises(kind) as raised:
        mistake()
    assert type(raised.value) is kind
    assert isinstance(raised.value, wider) and isinstance(raised.value, ModelError)
