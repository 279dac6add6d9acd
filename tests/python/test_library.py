"""Blocks from Python: arguments of every kind arrive, names and ports are as documented."""

import inspect

import numpy as np
import pytest
import saltus
from saltus import library
from saltus.library import *

TRIPLE = [1.0, -2.0, 3.0]


def output_of(block, *inputs, t=0.0, end=None):
    """The output of a block fed by constants, or blocks, at time t; all rows to `end` if that is
    given.
    """
    builder = saltus.DiagramBuilder()
    builder.add(block)
    for i, value in enumerate(inputs):
        source = value if isinstance(value, saltus.System) else Constant(value)
        builder.connect(builder.add(source).output(), block.input(i))
    diagram = builder.build()
    recorded = {port.name: port for port in block.output_ports}
    results = saltus.simulate(
        diagram, diagram.create_context(), (t, t if end is None else end), recorded_signals=recorded
    )
    values = [array[-1] if end is None else array for array in results.outputs.values()]
    return values[0] if len(values) == 1 else values


@pytest.mark.parametrize(
    "value", [2, 2.0, np.float64(2), np.float32(2), np.int32(2), np.array(2.0), np.array(2), True]
)
def test_numbers_of_every_kind(value):
    y = output_of(Constant(value), end=1.0)
    assert y.ndim == 1
    assert y[-1] == float(value)


@pytest.mark.parametrize(
    "value",
    [TRIPLE, tuple(TRIPLE), np.array(TRIPLE), np.array(TRIPLE)[::-1][::-1], np.array([1, -2, 3])],
)
def test_vectors_of_every_kind(value):
    assert output_of(Constant(value)).tolist() == TRIPLE


@pytest.mark.parametrize(
    ("block", "inputs", "expected"),
    [
        (Gain(2.0), [3.0], 6.0),
        (Gain(TRIPLE), [2.0], [2.0, -4.0, 6.0]),
        (Offset(1.0), [TRIPLE], [2.0, -1.0, 4.0]),
        (Adder("+-"), [5.0, 3.0], 2.0),
        (Adder(3), [1.0, 2.0, 3.0], 6.0),
        (Product("*/"), [6.0, 3.0], 2.0),
        (Product(3), [2.0, 3.0, 4.0], 24.0),
        (Abs(), [TRIPLE], [1.0, 2.0, 3.0]),
        (Saturate(-1.0, 2.0), [TRIPLE], [1.0, -1.0, 2.0]),
        (Saturate(upper_limit=0.0), [5.0], 0.0),
        (Comparator("<"), [1.0, 2.0], 1.0),
        (Comparator(">="), [TRIPLE, 1.0], [1.0, 0.0, 1.0]),
        (LogicalOperator("and"), [1.0, 0.0], 0.0),
        (LogicalOperator("xor", 3), [1.0, 1.0, 1.0], 1.0),
        (LogicalOperator("not"), [0.0], 1.0),
        (Switch(), [5.0, 1.0, 7.0], 5.0),
        (Switch(threshold=2.0), [5.0, 1.0, 7.0], 7.0),
        (Multiplexer(2), [1.0, [2.0, 3.0]], [1.0, 2.0, 3.0]),
        (ReduceBlock(2, lambda x: x[0] + 2 * x[1]), [1.0, 2.0], 5.0),
        (ReduceBlock(2, lambda x: x[0] @ x[1]), [TRIPLE, TRIPLE], 14.0),
        (ReduceBlock(2, lambda x: x[0] / x[1]), [1.0, 4.0], 0.25),
        (ReduceBlock(2, lambda x: x[0] < x[1]), [1.0, 4.0], 1.0),
        (ReduceBlock(1, lambda x: np.cumsum(x[0])), [TRIPLE], [1.0, -1.0, 2.0]),
        (FunctionBlock(np.square), [TRIPLE], [1.0, 4.0, 9.0]),
        (FunctionBlock(lambda u: u[1]), [TRIPLE], -2.0),
    ],
    ids=lambda value: value.name if isinstance(value, saltus.System) else "",
)
def test_values(block, inputs, expected):
    assert output_of(block, *inputs).tolist() == expected


def test_demultiplexer():
    a, b = output_of(Demultiplexer(2), [1.0, 2.0, 3.0, 4.0])
    assert (a.tolist(), b.tolist()) == ([1.0, 2.0], [3.0, 4.0])


@pytest.mark.parametrize(
    ("source", "t", "expected"),
    [
        (Step(start_value=1.0, end_value=2.0, step_time=3.0), 2.9, 1.0),
        (Step(1.0, 2.0, 3.0), 3.0, 2.0),
        (Clock(), 1.5, 1.5),
        (Ramp(start_value=1.0, slope=2.0, start_time=0.5), 1.5, 3.0),
        (Pulse(amplitude=3.0, period=2.0, pulse_width=0.25), 2.25, 3.0),
        (Pulse(amplitude=3.0, period=2.0, pulse_width=0.25), 2.75, 0.0),
        (Sine(amplitude=2.0, frequency=np.pi, phase=np.pi / 2, bias=1.0), 1.0, -1.0),
    ],
    ids=lambda value: value.name if isinstance(value, saltus.System) else "",
)
def test_sources(source, t, expected):
    assert output_of(source, t=t) == pytest.approx(expected, abs=1e-15)


def test_unit_delay_and_zero_order_hold():
    assert output_of(UnitDelay(0.5, initial_state=7.0), Clock(), t=0.0) == 7.0
    held = output_of(ZeroOrderHold(0.5), Clock(), end=1.2)
    assert set(held) <= {0.0, 0.5, 1.0}
    assert held[-1] == 1.0


def test_integrator_ports_follow_its_options():
    full = Integrator(enable_reset=True, enable_external_reset=True, enable_hold=True)
    assert full.input_names == ["in", "reset_trigger", "reset_value", "hold_trigger"]
    assert Integrator().input_names == ["in"]


def test_integrator_with_limits_stands_still_at_them():
    x = output_of(Integrator(enable_limits=True, lower_limit=-1.0, upper_limit=0.5), 1.0, end=2.0)
    assert x[-1] == pytest.approx(0.5, abs=1e-12)


def test_integrator_of_a_vector():
    assert output_of(Integrator([1.0, 2.0]), [1.0, -1.0], end=1.0)[-1] == pytest.approx(
        [2.0, 1.0], abs=1e-14
    )


@pytest.mark.parametrize("python", ["called", "traced"])
@pytest.mark.parametrize(
    "function",
    [
        lambda x: x[0] < x[1],
        lambda x: np.less(x[0], x[1]),
        lambda x: bool(x[0] < x[1]),
        lambda x: 1 / (x[1] + 1) < 1 / (x[0] + 1),
    ],
)
def test_a_reduce_block_that_compares_is_located(function, python):
    """A sawtooth that resets where it meets 1. Called, a call before the run shows that it is a
    boolean, which is opaque; traced, it has a smooth guard.
    """
    builder = saltus.DiagramBuilder()
    one, x, full = builder.add(
        Constant(1.0),
        Integrator(enable_reset=True, name="x"),
        ReduceBlock(2, function, name="full"),
    )
    builder.connect(one.output(), x.input("in"))
    builder.connect(one.output(), full.input(0))
    builder.connect(x.output(), full.input(1))
    builder.connect(full.output(), x.input("reset_trigger"))
    diagram = builder.build()
    simulator = saltus.Simulator(diagram, python=python)
    opaque = "block 'full' is an opaque boolean" in simulator.describe()
    assert opaque == (python == "called")
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 2.5), python=python)
    np.testing.assert_allclose(results.events.times("x.reset"), [1.0, 2.0], rtol=0, atol=1e-13)


def test_a_reduce_block_of_vectors_may_be_boolean():
    block = ReduceBlock(2, lambda x: x[0][1] > x[1][0], name="f")
    assert output_of(block, TRIPLE, TRIPLE) == 0.0


def test_default_names():
    gain = Gain(1.0)
    assert gain.name == f"Gain_{gain.system_id}"
    assert Gain(1.0, name="k").name == "k"


def test_all_is_all():
    classes = {name for name, value in vars(library).items() if inspect.isclass(value)}
    assert classes == set(library.__all__)
    for name in library.__all__:
        assert inspect.getdoc(getattr(library, name))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Constant("x", name="c"), "block 'c': value: expected numbers, found 'x' (str)"),
        (
            lambda: Constant([[[1.0]]], name="c"),
            "block 'c': value: expected a number, a vector or a matrix, found an array of 3 "
            "dimensions",
        ),
        (lambda: Gain(None, name="k"), "block 'k': gain: expected numbers, found None"),
        (
            lambda: Gain(float("nan"), name="k"),
            "block 'k': parameter 'gain': entry 0 is nan; give a finite value",
        ),
        (
            lambda: Comparator("=<", name="c"),
            "block 'c': unknown operator '=<'; did you mean '<'? "
            "Known: '<', '<=', '>', '>=', '==', '!='",
        ),
        (
            lambda: Integrator(enable_external_reset=True, name="x"),
            "block 'x': enable_external_reset without enable_reset; "
            "a value to reset to needs a trigger: set both",
        ),
        (lambda: Saturate(name="s"), "block 's': no limit; give lower_limit, upper_limit or both"),
        (
            lambda: Pulse(period=0.0, name="p"),
            "block 'p': period = 0 s; expected a finite time > 0 s",
        ),
        (lambda: ReduceBlock(0, len, name="r"), "block 'r': expected 1 input or more, found 0"),
        (
            lambda: ReduceBlock(2, 3, name="r"),
            "block 'r': output 'out': expected a function, found 3",
        ),
    ],
)
def test_refusals(make, message):
    with pytest.raises(saltus.ModelError) as caught:
        make()
    assert str(caught.value) == message


def test_a_reduce_block_of_another_width_says_so():
    block = ReduceBlock(1, lambda x: x[0] if x[0][0] < 1 else x[0][:1], name="f")
    with pytest.raises(
        saltus.ModelError, match="block 'f': output 'out' returned 1 numbers, expected 2"
    ):
        output_of(block, [5.0, 5.0])


@pytest.mark.parametrize(
    ("make", "inputs", "expected"),
    [
        (lambda: Adder(2, operators="+-"), (5.0, 2.0), 3.0),
        (lambda: Adder(2, "+-"), (5.0, 2.0), 3.0),
        (lambda: Adder(n_in=2, operators="+-"), (5.0, 2.0), 3.0),
        (lambda: Adder(operators="+-"), (5.0, 2.0), 3.0),
        (lambda: Adder("+-"), (5.0, 2.0), 3.0),
        (lambda: Adder(2), (5.0, 2.0), 7.0),
        (lambda: Adder(), (5.0, 2.0), 7.0),
        (lambda: Product(2, operators="*/"), (6.0, 4.0), 1.5),
        (lambda: Product("*/"), (6.0, 4.0), 1.5),
        (lambda: Product(2), (6.0, 4.0), 24.0),
    ],
)
def test_operators_with_and_without_their_number(make, inputs, expected):
    assert output_of(make(), *inputs) == expected


@pytest.mark.parametrize("block", [Adder, Product])
@pytest.mark.parametrize(
    "arguments", [(3, "++"), (2.5,), (True,), (0,), (-1,), ("",), ("++", "+-")]
)
def test_operators_that_do_not_fit_are_refused(block, arguments):
    with pytest.raises(saltus.ModelError, match=r"expected|say them once"):
        block(*arguments)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: ZeroOrderHold(period=0.1), "dt"),
        (lambda: UnitDelay(sample_time=0.1), "dt"),
        (lambda: UnitDelay(0.1, initial_value=1.0), "initial_state"),
        (lambda: Pulse(dt=0.1), "period"),
    ],
)
def test_an_argument_of_another_name_is_told_its_own(make, name):
    with pytest.raises(saltus.ModelError, match=f"it is called {name} here"):
        make()
