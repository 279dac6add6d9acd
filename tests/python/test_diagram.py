"""Diagrams in Python: nesting, exports, Python and C++ blocks side by side."""

import numpy as np
import pytest
import saltus
from saltus.library import Adder, Clock, Constant, Gain, Integrator
from systems import Ball


class Spring(saltus.LeafSystem):
    """Force of a spring from an extension: feedthrough, no state."""

    def __init__(self, k=4.0, **kwargs):
        super().__init__(**kwargs)
        self.declare_dynamic_parameter("k", k)
        self.declare_input_port("extension")
        self.declare_output_port(lambda t, s, x, k: -k * x, name="force", reads=["inputs"])


def oscillator(name="root"):
    builder = saltus.DiagramBuilder()
    x, v, spring = builder.add(
        Integrator(1.0, name="x"), Integrator(name="v"), Spring(name="spring")
    )
    builder.connect(v.output(), x.input())
    builder.connect(x.output(), spring.input("extension"))
    builder.connect(spring.output("force"), v.input())
    assert builder.export_output(x.output(), "x") == 0
    return builder.build(name=name)


def test_python_and_cpp_blocks_in_a_loop():
    diagram = oscillator()
    results = saltus.simulate(
        diagram,
        diagram.create_context(),
        (0.0, 5.0),
        recorded_signals={"x": diagram.output("x")},
        rtol=1e-10,
        atol=1e-12,
    )
    # rtol a step, some hundred steps of an equation that keeps what is there
    np.testing.assert_allclose(results.outputs["x"], np.cos(2 * results.time), atol=1e-7)


def test_a_diagram_within_a_diagram():
    builder = saltus.DiagramBuilder()
    inner, gain = builder.add(oscillator("inner"), Gain(2.0, name="gain"))
    builder.connect(inner.output(), gain.input())
    outer = builder.build()
    assert outer["inner"] is inner
    assert outer["inner"]["spring"].name == "spring"
    assert outer.blocks == (inner, gain)
    context = outer.create_context()
    assert context.parameters["inner.spring.k"] == 4.0
    slower = context.with_parameter("inner.spring.k", 1.0)
    results = saltus.simulate(
        outer, slower, (0.0, np.pi), recorded_signals={"y": gain.output()}, rtol=1e-10, atol=1e-12
    )
    assert results.outputs["y"][-1] == pytest.approx(-2.0, abs=1e-7)


def test_an_exported_input_is_connected_outside():
    builder = saltus.DiagramBuilder()
    total = builder.add(Adder(name="total"))
    builder.export_input(total.input(0), "a")
    builder.export_input(total.input(1))
    builder.export_output(total.output())
    inner = builder.build("inner")
    assert inner.input_names == ["a", "total_in_1"]
    assert inner.output_names == ["total_out"]
    builder = saltus.DiagramBuilder()
    inner, one, two = builder.add(inner, Constant(1.0), Constant(2.0))
    builder.connect(one.output(), inner.input("a"))
    builder.connect(two.output(), inner.input(1))
    outer = builder.build()
    results = saltus.simulate(
        outer, outer.create_context(), (0.0, 0.0), recorded_signals={"y": inner.output()}
    )
    assert results.outputs["y"].tolist() == [3.0]


def test_ports():
    diagram = oscillator()
    spring = diagram["spring"]
    assert [port.name for port in spring.input_ports] == ["extension"]
    assert spring.output_ports[0] == spring.output("force") == spring.output()
    assert repr(spring.output()) == "<output 'force' of 'spring'>"
    assert repr(diagram) == "<Diagram 'root'>"
    with pytest.raises(IndexError):
        spring.output_ports[1]


def test_add_returns_what_it_got():
    builder = saltus.DiagramBuilder()
    ball, gain = Ball(), Gain(1.0)
    assert builder.add(ball) is ball
    assert builder.add(gain, other := Gain(1.0)) == (gain, other)


def test_a_builder_is_spent_by_build():
    builder = saltus.DiagramBuilder()
    builder.add(Constant(1.0))
    builder.build()
    with pytest.raises(saltus.ModelError, match="spent by build"):
        builder.add(Constant(1.0))


def test_one_block_in_two_diagrams():
    """Structure only: what runs is the context."""
    ball = Ball()
    diagrams = []
    for _ in range(2):
        builder = saltus.DiagramBuilder()
        builder.add(ball)
        diagrams.append(builder.build())
    ends = [
        saltus.simulate(
            d, d.create_context().with_continuous_state([h, 0.0]), (0.0, 1.0)
        ).context.continuous_state[0]
        for d, h in zip(diagrams, (10.0, 20.0), strict=True)
    ]
    assert ends[1] - ends[0] == pytest.approx(10.0)


@pytest.mark.parametrize(
    ("second", "words"),
    [
        (lambda first: Gain(2.0, name="g"), "two blocks are called 'g'"),
        (lambda first: first, "'g' is added twice"),
        (lambda first: 3.0, "expected a system, found 3.0"),
    ],
)
def test_add_of_several_adds_all_or_none(second, words):
    first, builder = Gain(1.0, name="g"), saltus.DiagramBuilder()
    with pytest.raises(saltus.ModelError, match=words):
        builder.add(first, second(first))
    builder.add(first)  # none of them was added
    with pytest.raises(saltus.ModelError, match="is added twice"):
        builder.add(Clock(name="clock"), first)
    clock = builder.add(Clock(name="clock"))
    builder.connect(clock.output(), first.input())
    assert [block.name for block in builder.build().blocks] == ["g", "clock"]
