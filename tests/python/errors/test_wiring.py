"""Diagrams that cannot be run are refused with the port, the block and what to do; the builder
is as it was, and goes on.
"""

import pytest
import saltus
from saltus.errors import ModelError
from saltus.library import (
    Adder,
    Comparator,
    Constant,
    EnabledSubsystem,
    Gain,
    Integrator,
    ReduceBlock,
    TriggeredSubsystem,
)  # fmt: skip


def diagram(*wires, blocks):
    builder = saltus.DiagramBuilder()
    by_name = {block.name: block for block in blocks}
    builder.add(*blocks)
    for source, destination, port in wires:
        builder.connect(by_name[source].output(), by_name[destination].input(port))
    return builder


def x_at_one(built):
    results = saltus.simulate(built, built.create_context(), (0.0, 1.0))
    return results.context.continuous_state


def refused(call):
    with pytest.raises(saltus.ModelError) as caught:
        call()
    return str(caught.value)


def test_an_unconnected_input_is_named_and_can_be_connected_then():
    one, x = Constant(1.0, name="one"), Integrator(name="x")
    builder = diagram(blocks=[one, x])
    message = "input 'in' of block 'x' is not connected; connect it or export it"
    assert refused(builder.build) == message
    builder.connect(one.output(), x.input())
    assert x_at_one(builder.build()) == pytest.approx([1.0])


def test_an_unconnected_input_of_a_block_that_is_run_alone():
    x = Integrator(name="x")
    message = "input 'in' of block 'x' is not connected; connect it to a block, for example a "
    assert refused(lambda: saltus.simulate(x, x.create_context(), (0.0, 1.0))) == (
        message + "Constant"
    )


def test_a_second_connection_to_an_input_leaves_the_first():
    one, two, x = Constant(1.0, name="one"), Constant(2.0, name="two"), Integrator(name="x")
    builder = diagram(("one", "x", 0), blocks=[one, two, x])
    message = "input 'in' of block 'x' already has a source, block 'one'; an input takes one"
    assert refused(lambda: builder.connect(two.output(), x.input())) == message
    assert refused(lambda: builder.export_input(x.input())) == message
    assert x_at_one(builder.build()) == pytest.approx([1.0])


def test_an_algebraic_loop_is_printed_as_the_path_of_ports():
    def blocks():
        return [Adder("++", name="sum"), Gain(0.5, name="half"), Constant(1.0, name="one")]

    wires = [("one", "sum", 0), ("half", "sum", 1), ("sum", "half", 0)]
    message = refused(diagram(*wires, blocks=blocks()).build)
    lines = [line.strip() for line in message.splitlines()]
    assert "algebraic loop" in lines[0]
    start = next(i for i, line in enumerate(lines) if line.startswith("'"))
    assert {line.removesuffix(" reads") for line in lines[start : start + 3]} == {
        "'sum.out'",
        "'half.out'",
    }
    assert lines[start].split()[0] == lines[start + 2].split()[0]  # back where it began
    x = Integrator(name="x")
    broken = diagram(
        ("one", "sum", 0), ("half", "sum", 1), ("sum", "x", 0), ("x", "half", 0),
        blocks=[*blocks(), x],
    ).build()  # fmt: skip
    # dx/dt = 1 + x / 2
    assert x_at_one(broken) == pytest.approx([2.0 * (2.718281828459045**0.5 - 1.0)], rel=1e-5)


def test_a_name_used_twice_is_refused_and_the_first_stays():
    one = Constant(1.0, name="one")
    builder = diagram(blocks=[one])
    assert refused(lambda: builder.add(Integrator(name="one"))) == (
        "two blocks are called 'one'; give each block of a diagram its own name"
    )
    x = builder.add(Integrator(name="x"))
    builder.connect(one.output(), x.input())
    assert x_at_one(builder.build()) == pytest.approx([1.0])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda d: d["gian"], "diagram 'root' has no block 'gian'; did you mean 'gain'? Known: "),
        (
            lambda d: d["gain"].input("inn"),
            "block 'gain' has no input 'inn'; did you mean 'in'? Known: 'in'",
        ),
        (
            lambda d: d["gain"].output("outt"),
            "block 'gain' has no output 'outt'; did you mean 'out'? Known: 'out'",
        ),
        (lambda d: d["gain"].output(3), "block 'gain' has no output 3: it has 1 ('out')"),
        (
            lambda d: d["gain"].output(0.5),
            "expected the position or the name of a port, found 0.5",
        ),
        (
            lambda d: d.create_context().with_parameter("gain.gian", 1.0),
            "unknown parameter 'gain.gian'; did you mean 'gain.gain'? Known: ",
        ),
        (lambda d: d.create_context()[99], "no system with id 99 in this context. Known: "),
        (
            lambda d: saltus.simulate(d, d.create_context(), (0, 1)).outputs["y"],
            "nothing was recorded under 'y'; give the run recorded_signals={'name': 'block.port'}",
        ),
    ],
)
def test_an_unknown_name_is_answered_with_the_nearest(call, message):
    wires = [("one", "gain", 0), ("gain", "x", 0)]
    blocks = [Constant(1.0, name="one"), Gain(2.0, name="gain"), Integrator(name="x")]
    built = diagram(*wires, blocks=blocks).build()
    assert refused(lambda: call(built)).startswith(message)
    assert x_at_one(built) == pytest.approx([2.0])


@pytest.mark.parametrize(
    ("block", "message"),
    [
        (
            Gain([1.0, 2.0], name="k"),
            "block 'k': expected scalars and signals of one shape, found the shapes (2,), (3,); "
            "bring them to one shape, for example with a Multiplexer",
        ),
        (
            Integrator([0.0, 0.0], name="k"),
            "input 'in' of block 'k': expected shape (2,), found shape (3,) from output 'v.out'",
        ),
    ],
)
def test_a_signal_of_the_wrong_shape_is_refused(block, message):
    blocks = [Constant([1.0, 2.0, 3.0], name="v"), block]
    assert message == refused(diagram(("v", "k", 0), blocks=blocks).build)


def test_an_output_that_returns_another_number_than_it_declares_is_refused():
    block = ReduceBlock(1, lambda u: u[0], shape=2, boolean=False, name="k")
    built = diagram(("v", "k", 0), blocks=[Constant([1.0, 2.0, 3.0], name="v"), block]).build()
    record = {"y": block.output()}
    message = "block 'k': output 'out' returned 3 numbers, expected 2"
    assert message == refused(lambda: saltus.simulate(built, (0, 1), recorded_signals=record))


def test_ports_in_the_wrong_order_are_called_swapped():
    one, x = Constant(1.0, name="one"), Integrator(name="x")
    builder = diagram(blocks=[one, x])
    message = refused(lambda: builder.connect(x.input(), one.output()))
    assert message.startswith(
        "connect: the ports are swapped: expected an output and then an input"
    )
    builder.connect(one.output(), x.input())
    assert x_at_one(builder.build()) == pytest.approx([1.0])


def test_a_port_of_the_other_kind_is_said():
    one, x = Constant(1.0, name="one"), Integrator(name="x")
    builder = diagram(blocks=[one, x])
    wrong = "expected an output, such as block.output_ports[0], found <input 'in' of 'x'>"
    assert refused(lambda: builder.connect(x.input(), x.input())) == wrong
    assert refused(lambda: builder.export_output(x.input())) == wrong
    wrong = "expected an input, such as block.input_ports[0], found <output 'out' of 'one'>"
    assert refused(lambda: builder.connect(one.output(), x.output())).startswith(
        "expected an input"
    )
    assert refused(lambda: builder.export_input(one.output())) == wrong


def boxed(name, **ports):
    """A gain in a diagram of its own."""
    builder = saltus.DiagramBuilder()
    gain = builder.add(Gain(0.5, name="gain"))
    builder.export_input(gain.input(), "u")
    builder.export_output(gain.output(), "y")
    return builder.build(name)


LOOPS = {
    "itself": lambda: (Gain(0.5, name="a"), [("a", "a", 0)]),
    "through a function": lambda: (ReduceBlock(1, lambda u: u[0], name="a"), [("a", "a", 0)]),
    "through a diagram": lambda: (boxed("a"), [("a", "a", 0)]),
}


@pytest.mark.parametrize("kind", LOOPS)
def test_build_refuses_an_algebraic_loop_and_the_builder_goes_on(kind):
    block, wires = LOOPS[kind]()
    assert "algebraic loop" in refused(diagram(*wires, blocks=[block]).build)
    # an inner diagram with an open input is no loop before it is closed
    x = Integrator(1.0, name="x")
    block, _ = LOOPS[kind]()
    assert diagram(("a", "x", 0), ("x", "a", 0), blocks=[block, x]).build().name == "root"


def test_what_is_held_between_instants_is_no_loop():
    """A comparison that acts on its own input through a relation."""
    x, above = Integrator(0.0, name="x"), Comparator(">", name="above")
    level, speed = Constant(0.5, name="level"), Gain(-1.0, name="speed")
    one, sum_ = Constant(1.0, name="one"), Adder("++", name="sum")
    wires = [
        ("x", "above", 0), ("level", "above", 1), ("above", "speed", 0),
        ("speed", "sum", 0), ("one", "sum", 1), ("sum", "x", 0),
    ]  # fmt: skip
    built = diagram(*wires, blocks=[x, above, level, speed, one, sum_]).build()
    # rises at 1 to the level at 0.5 s, and stays there
    assert x_at_one(built) == pytest.approx([0.5])


def narrow(name):
    block = saltus.LeafSystem(name=name)
    block.declare_input_port("in", shape=2)
    block.declare_output_port(lambda t, s, u: u, "out", shape=2)
    return block


WIDTHS = {
    "a state": lambda: (Constant([1.0, 2.0, 3.0], name="v"), Integrator([0.0, 0.0], name="k")),
    "a declared input": lambda: (Constant([1.0, 2.0, 3.0], name="v"), narrow("k")),
    "after blocks of any width": lambda: (Constant([1.0, 2.0, 3.0], name="v"), narrow("k"), 2),
}


@pytest.mark.parametrize("kind", WIDTHS)
def test_build_refuses_widths_that_do_not_fit(kind):
    source, target, *between = WIDTHS[kind]()
    builder = saltus.DiagramBuilder()
    builder.add(source, target)
    port = source.output()
    for i in range(between[0] if between else 0):
        gain = builder.add(Gain(1.0, name=f"gain_{i}"))
        builder.connect(port, gain.input())
        port = gain.output()
    builder.connect(port, target.input())
    if not isinstance(target, Integrator):
        builder.export_output(target.output(), "y")
    assert refused(builder.build).startswith(
        "input 'in' of block 'k': expected shape (2,), found shape (3,) from output "
        f"'{port.system.name}.out'"
    )


def test_build_refuses_widths_that_meet_in_an_inner_diagram():
    builder = saltus.DiagramBuilder()
    two = builder.add(Constant([1.0, 2.0], name="two"))
    sum_ = builder.add(Adder("++", name="sum"))
    builder.export_input(sum_.input(0), "u")
    builder.connect(two.output(), sum_.input(1))
    builder.export_output(sum_.output(), "y")
    inner = builder.build("inner")  # nothing is known of the open input
    outer = saltus.DiagramBuilder()
    three = outer.add(Constant([1.0, 2.0, 3.0], name="three"))
    outer.add(inner)
    outer.connect(three.output(), inner.input())
    assert "block 'sum': expected scalars and signals of one shape" in refused(outer.build)


def test_build_calls_no_function_of_a_user():
    calls = []

    def doubled(u):
        calls.append(u)
        return [2.0 * u[0], 0.0]

    blocks = [Constant(1.0, name="one"), ReduceBlock(1, doubled, name="two"), narrow("k")]
    built = diagram(("one", "two", 0), ("two", "k", 0), blocks=blocks).build()
    assert not calls
    built.create_context()
    assert calls


OUT_OF_RANGE = [1, 7, -1, -2, 2**31, 2**62, 2**70]
"""positions that a block with one port does not have; the fields of a port are public"""
OTHERS = ["out", None, 0.5]


@pytest.mark.parametrize("index", [*OUT_OF_RANGE, *OTHERS])
def test_a_port_that_the_block_does_not_have_is_refused_where_it_is_used(index):
    g, h = Constant(1.0, name="g"), Gain(1.0, name="h")
    builder = diagram(blocks=[g, h])
    from_nowhere, to_nowhere = saltus.OutputPort(g, index), saltus.InputPort(h, index)
    refused(lambda: builder.connect(from_nowhere, h.input()))
    refused(lambda: builder.connect(g.output(), to_nowhere))
    refused(lambda: builder.export_output(from_nowhere))
    refused(lambda: builder.export_output(from_nowhere, "y"))
    refused(lambda: builder.export_input(to_nowhere))
    refused(lambda: builder.export_input(to_nowhere, "u"))
    builder.connect(g.output(), h.input())  # as if nothing had been
    built = builder.build()
    recorded = {"y": saltus.OutputPort(h, index)}
    refused(
        lambda: saltus.simulate(built, built.create_context(), (0, 1), recorded_signals=recorded)
    )
    refused(lambda: built.to_dot(recorded_signals=recorded))


def test_a_port_that_the_block_does_not_have_is_named_with_those_it_has():
    g, h = Constant(1.0, name="g"), Gain(1.0, name="h")
    builder = diagram(blocks=[g, h])
    message = refused(lambda: builder.connect(saltus.OutputPort(g, 1), h.input()))
    assert message == "block 'g' has no output 1: it has 1 ('out')"
    message = refused(lambda: builder.connect(saltus.OutputPort("g", 0), h.input()))
    assert message == "expected the port of a system, found one of 'g'"


@pytest.mark.parametrize("index", OUT_OF_RANGE)
def test_a_port_that_a_diagram_does_not_have_is_refused(index):
    inner = diagram(blocks=[Gain(1.0, name="gain")])
    inner.export_input(inner._children["gain"].input(), "u")
    inner.export_output(inner._children["gain"].output(), "y")
    nested, one = inner.build("nested"), Constant(1.0, name="one")
    outer = diagram(blocks=[nested, one])
    refused(lambda: outer.connect(one.output(), saltus.InputPort(nested, index)))
    refused(lambda: outer.export_output(saltus.OutputPort(nested, index)))


def test_a_control_port_within_a_control_port_needs_another_name():
    with pytest.raises(ModelError) as caught:
        EnabledSubsystem(EnabledSubsystem(Gain(2.0), name="inner"), name="outer")
    said = str(caught.value)
    assert "block 'outer': its system 'inner' has an input 'enable' already" in said
    assert "into a diagram that exports this input by another name" in said
    with pytest.raises(ModelError, match="they see no edges of other signals"):
        TriggeredSubsystem(TriggeredSubsystem(Gain(2.0)))
    leaf = saltus.LeafSystem(name="leaf")
    leaf.declare_input_port("trigger")
    with pytest.raises(ModelError, match="has an input 'trigger' already"):
        TriggeredSubsystem(leaf)
    with pytest.raises(ModelError, match="its system is called 'enable'"):
        EnabledSubsystem(Gain(2.0, name="enable"))


def test_the_remedy_for_it_works():
    builder = saltus.DiagramBuilder()
    inner = builder.add(EnabledSubsystem(Gain(2.0), name="inner"))
    for port in inner.input_names:
        builder.export_input(inner.input(port), f"{port}_inner")
    builder.export_output(inner.output(), "y")
    outer = EnabledSubsystem(builder.build("part"), name="outer")
    assert outer.input_names == ["in_inner", "enable_inner", "enable"]


@pytest.mark.parametrize("kind", [EnabledSubsystem, TriggeredSubsystem])
@pytest.mark.parametrize(
    ("initial", "part"), [(None, "says nothing of it"), ({"out": [1.0, 2.0]}, "says 2")]
)
def test_the_output_of_a_subsystem_before_its_first_execution_has_its_width(kind, initial, part):
    with pytest.raises(ModelError) as caught:
        kind(Constant([1.0, 2.0, 3.0]), initial_outputs=initial, name="part")
    said = str(caught.value)
    assert "block 'part': output 'out' of its system has 3 values, and initial_outputs " in said
    assert part in said and "initial_outputs={'out': [0.0, 0.0, 0.0]}" in said
    assert kind(Constant([1.0, 2.0, 3.0]), initial_outputs={"out": [0.0] * 3}).output_names
