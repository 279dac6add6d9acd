"""The blocks of everyday models from Python: their law, and the trap of each."""

import numpy as np
import pytest
import saltus
from saltus.errors import ModelError
from saltus.library import *

response = saltus.response


@pytest.mark.parametrize(
    ("block", "inputs", "expected"),
    [
        (Power(3.0), [[2.0, -2.0]], [8.0, -8.0]),
        (Power([1.0, 2.0]), [3.0], [3.0, 9.0]),
        (SquareRoot(), [[4.0, 0.25]], [2.0, 0.5]),
        (Reciprocal(), [4.0], 0.25),
        (Exponent(), [1.0], np.e),
        (Exponent("2"), [3.0], 8.0),
        (Logarithm(), [np.e], 1.0),
        (Logarithm("10"), [1000.0], 3.0),
        (Logarithm("2"), [8.0], 3.0),
        (Trigonometric("atanh"), [0.5], np.arctanh(0.5)),
        (Sign(), [[-2.0, 0.0, 3.0]], [-1.0, 0.0, 1.0]),
        (MinMax("min", 3), [[1.0, 5.0], 3.0, 2.0], [1.0, 2.0]),
        (MinMax("max"), [[1.0, 5.0], 3.0], [3.0, 5.0]),
        (DeadZone(1.0), [[-3.0, 0.5, 3.0]], [-3.0, 0.0, 3.0]),
        (DeadZone(1.0, shifted=True), [[-3.0, 0.5, 3.0]], [-2.0, 0.0, 2.0]),
        (Quantizer(0.5), [[0.2, 0.7, -1.4]], [0.0, 0.5, -1.5]),
        (SumOfElements(), [[1.0, 2.0, 4.0]], 7.0),
        (ProductOfElements(), [[2.0, 3.0, -4.0]], -24.0),
        (DotProduct(), [[1.0, 2.0], [3.0, 4.0]], 11.0),
        (CrossProduct(), [[1.0, 2.0, 3.0], [-4.0, 5.0, 6.0]], [-3.0, -18.0, 13.0]),
        (ScalarBroadcast(2), [7.0], [7.0, 7.0]),
        (
            MatrixMultiplication((2, 2), (2, 1)),
            [[1.0, 2.0, 3.0, 4.0], [5.0, 6.0]],
            [[17.0], [39.0]],
        ),
        (MatrixTransposition([1, 2]), [[1.0, 2.0]], [[1.0], [2.0]]),
        (MatrixConcatenation(2), [[1.0, 2.0], [3.0, 4.0]], [[1.0, 2.0], [3.0, 4.0]]),
        (MatrixConcatenation(2, 1), [[1.0, 2.0], [3.0, 4.0]], [[1.0, 3.0], [2.0, 4.0]]),
        (Reshape((2, 1)), [[1.0, 2.0]], [[1.0], [2.0]]),
        (Reshape(()), [[[5.0]]], 5.0),
        (MatrixInversion(2), [[0.0, 2.0, 4.0, 0.0]], [[0.0, 0.25], [0.5, 0.0]]),
        (TransferFunction([3.0], [2.0]), [4.0], 6.0),
        (LTISystem(-1, 1, 2, 5), [1.0], 5.0),
        (Derivative(10.0), [2.0], 20.0),
        (PID(2.0, kd=0.5, n=4.0), [3.0], 12.0),
    ],
    ids=lambda value: type(value).__name__ if isinstance(value, saltus.System) else "",
)
def test_values(block, inputs, expected):
    assert response(block, *inputs) == pytest.approx(np.array(expected), abs=1e-15)


@pytest.mark.parametrize(
    "entries",
    [0, -1, [0, 2], [-1], slice(1, 3), slice(None, None, -1), slice(-2, None), slice(3, 0, -2)],
)
@pytest.mark.parametrize("as_text", [False, True])
def test_a_slice_chooses_as_an_array_does(entries, as_text):
    u = np.array([10.0, 11.0, 12.0, 13.0])
    expected = u[entries]
    if as_text and isinstance(entries, slice):
        parts = [entries.start, entries.stop, entries.step]
        entries = ":".join("" if part is None else str(part) for part in parts)
    elif as_text:
        entries = str(entries)
    np.testing.assert_array_equal(response(Slice(entries), u), expected)


@pytest.mark.parametrize("entries", ["a", "1:b", 1.5, True, None, "1:2:3:4", [0, "b"], ""])
def test_other_entries_are_refused(entries):
    with pytest.raises(saltus.ModelError, match="expected a whole number, a list of them or a"):
        Slice(entries)


def test_a_kink_is_located_only_where_it_reaches_a_derivative():
    builder = saltus.DiagramBuilder()
    sine, sign, x = builder.add(Sine(name="sine"), Sign(name="sign"), Integrator(name="x"))
    builder.connect(sine.output(), sign.input())
    builder.connect(sign.output(), x.input())
    diagram = builder.build()
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 10.0), rtol=1e-10)
    roots = results.events.times("sign.positive")
    np.testing.assert_allclose(roots[-3:], [np.pi, 2 * np.pi, 3 * np.pi], rtol=0, atol=1e-12)
    assert "no root-finding" in saltus.Simulator(_behind_a_sine(Sign())).describe()


def _behind_a_sine(block):
    builder = saltus.DiagramBuilder()
    sine = builder.add(Sine())
    builder.add(block)
    builder.connect(sine.output(), block.input())
    builder.export_output(block.output(), "y")
    return builder.build()


def test_the_parameters_of_a_transfer_function_are_those_of_the_context():
    diagram = _behind_a_sine(TransferFunction([1.0], [1.0, 1.0], name="g"))
    context = diagram.create_context().with_parameter("g.denominator", [2.0, 1.0])
    end = saltus.simulate(diagram, context, (0.0, 1.0), rtol=1e-10, atol=1e-12).context
    # 2 v' + v = sin t from 0: v = (sin t - 2 cos t + 2 exp(-t / 2)) / 5, and the state is 2 v
    v = (np.sin(1.0) - 2 * np.cos(1.0) + 2 * np.exp(-0.5)) / 5
    assert end.continuous_state[0] * diagram["g"].scales[0] == pytest.approx(2 * v, abs=1e-9)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: TransferFunction([1, 0, 0], [1, 1], name="g"), "the degree 2 in s"),
        (lambda: Derivative(0.0), "expected a finite number > 0"),
        (lambda: PID(1.0, n=np.inf), "give a finite value"),
        (lambda: LTISystem([[1, 2]], 1, 1), "A is 1 x 2"),
        (lambda: LTISystem([1, 2], 1, 1), "expected a matrix, found an array of 1 dimensions"),
        (lambda: MinMax("mean"), "unknown operator 'mean'"),
        (lambda: Trigonometric("sine"), "did you mean 'sin'"),
        (lambda: DeadZone(-1.0), "half_range = -1; expected a number >= 0"),
        (lambda: Quantizer(0.0), "interval = 0; expected a finite number > 0"),
    ],
)
def test_refusals(make, message):
    with pytest.raises(saltus.ModelError, match=message.replace("(", r"\(")):
        make()


def test_a_second_order_integrator_stops_and_leaves():
    block = SecondOrderIntegrator(lower_limit=-10.0, upper_limit=0.5)
    push = Step(1.0, -1.0, step_time=3.0)
    x, v = response(block, push, t=[0.5, 2.0, 4.0], rtol=1e-10)
    np.testing.assert_allclose(x, [0.125, 0.5, 0.0], rtol=0, atol=1e-12)
    np.testing.assert_allclose(v, [0.5, 0.0, -1.0], rtol=0, atol=1e-12)


def test_a_controller_does_not_wind_up():
    turn = Step(1.0, -1.0, step_time=4.0)
    block = PID(1.0, ki=1.0, lower_limit=-2.0, upper_limit=2.0)
    y = response(block, turn, t=[0.5, 3.9, 4.5, 5.5], rtol=1e-10)
    np.testing.assert_allclose(y, [1.5, 2.0, -0.5, -1.5], rtol=0, atol=1e-12)


class TestResponse:
    def test_one_source_may_feed_two_inputs(self):
        t = Clock()
        assert response(Adder("+-"), t, t, t=3.0) == 0.0

    def test_times_may_stand_in_any_order(self):
        assert response(Clock(), t=[2.0, 0.0, 1.0, 2.0]).tolist() == [2.0, 0.0, 1.0, 2.0]

    def test_of_a_vector_at_several_times(self):
        assert response(Gain([1.0, 2.0]), Clock(), t=[1.0, 2.0]).tolist() == [[1, 2], [2, 4]]

    def test_after_what_happens_at_a_time(self):
        assert response(Step(step_time=1.0), t=1.0) == 1.0

    def test_before_time_zero(self):
        assert response(Clock(), t=[-1.0, 1.0]).tolist() == [-1.0, 1.0]

    def test_another_number_of_inputs_is_refused(self):
        with pytest.raises(saltus.ModelError, match=r"has 2 inputs \(in_0, in_1\), found 1"):
            response(Adder(2), 1.0)


@pytest.mark.parametrize(
    ("block", "inputs", "expected"),
    [
        (IfThenElse(), [1.0, [5.0, 6.0], 0.0], [5.0, 6.0]),
        (MultiportSwitch(3), [1.4, 10.0, 20.0, 30.0], 20.0),
        (MultiportSwitch(2), [-7.0, 10.0, 20.0], 10.0),
        (Relay(1.0, 0.0, on_value=3.0), [1.5], 3.0),
        (Relay(1.0, 0.0, initially_on=True), [-0.5], 0.0),
        (Relay(1.0, 0.0, initially_on=True), [0.5], 1.0),
        (LookupTable1d([0, 1, 3], [0, 2, 1]), [[-1.0, 0.5, 2.0, 9.0]], [0.0, 1.0, 1.5, 1.0]),
        (LookupTable1d([0, 1], [0, 2], extrapolation="linear"), [2.0], 4.0),
        (LookupTable1d([0, 1], [0, 2], "nearest"), [0.4], 0.0),
    ],
    ids=lambda value: type(value).__name__ if isinstance(value, saltus.System) else "",
)
def test_choices(block, inputs, expected):
    assert response(block, *inputs) == pytest.approx(np.array(expected), abs=1e-15)


def test_a_table_that_has_no_value_ends_the_run():
    table = LookupTable1d([0.0, 1.0], [0.0, 2.0], extrapolation="error", name="table")
    with pytest.raises(saltus.SimulationError, match="table"):
        response(table, Clock(), t=2.0)


def test_a_relay_in_a_loop_oscillates_between_its_thresholds():
    """x' = -1 while on, 1 while off: a triangle of period 2 (on - off), after a start at 0."""
    builder = saltus.DiagramBuilder()
    relay = builder.add(Relay(0.5, -0.5, on_value=-1.0, off_value=1.0, name="relay"))
    x = builder.add(Integrator(name="x"))
    builder.connect(x.output(), relay.input())
    builder.connect(relay.output(), x.input())
    diagram = builder.build()
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 6.0))
    np.testing.assert_allclose(results.events.times("relay.turn_on"), [0.5, 2.5, 4.5], atol=1e-12)
    np.testing.assert_allclose(results.events.times("relay.turn_off"), [1.5, 3.5, 5.5], atol=1e-12)


def test_a_counter_counts_edges():
    block = Counter("either", limit=3)
    pulse = Pulse(period=2.0, phase_delay=1.0)
    assert response(block, pulse, t=[0.5, 1.5, 2.5, 3.5]).tolist() == [0.0, 1.0, 2.0, 0.0]


def test_a_rate_limiter_starts_at_its_input():
    block = RateLimiter(0.25, upper_limit=1.0, lower_limit=-2.0)
    y = response(block, Step(4.0, 0.0), t=[0.1, 1.1, 1.3, 9.0])
    assert y.tolist() == [4.0, 3.5, 3.0, 0.0]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Relay(0.0, 1.0), "off_threshold 1 is not below on_threshold 0"),
        (lambda: LookupTable1d([0, 1], [1]), "input_array has 2 values, output_array has 1"),
        (lambda: LookupTable1d([1, 0], [1, 2]), "expected points that increase"),
        (lambda: LookupTable1d([0, 1], [1, 2], "cubic"), "unknown interpolation 'cubic'"),
        (lambda: Counter("raising"), "did you mean 'rising'"),
        (lambda: HitCrossing(0.0, "rising"), "unknown direction 'rising'"),
        (lambda: RateLimiter(-1.0), "dt = -1 s"),
        (lambda: MultiportSwitch(0), "expected 1 input or more"),
    ],
)
def test_refusals_of_choices(make, message):
    with pytest.raises(saltus.ModelError, match=message):
        make()


TABLE = ([-1.0, 0.0, 0.4, 1.0], [0.0, 2.0, 1.0, 5.0])
BEHIND_A_SINE = [
    lambda: Power(2.0),
    lambda: Exponent(),
    lambda: Trigonometric("cosh"),
    lambda: Sign(),
    lambda: DeadZone(0.5),
    lambda: DeadZone(0.5, shifted=True),
    lambda: Quantizer(0.3),
    lambda: LookupTable1d(*TABLE),
    lambda: LookupTable1d(*TABLE, interpolation="flat"),
    lambda: TransferFunction([1.0, 3.0], [1.0, 2.0, 5.0]),
    lambda: LTISystem([[0, 1], [-1, -0.1]], [[0], [1]], [[1, 0]]),
    lambda: Derivative(20.0),
    lambda: PID(2.0, ki=1.0, kd=0.1, upper_limit=1.0, lower_limit=-0.5),
    lambda: Relay(0.5, -0.5),
]


def integral_by(method, make):
    """Of the output of a block behind a sine, from 0 to 7 s."""
    builder = saltus.DiagramBuilder()
    sine, block, x = builder.add(Sine(frequency=1.3, phase=0.2), make(), Integrator(name="x"))
    builder.connect(sine.output(), block.input())
    builder.connect(block.output(), x.input())
    diagram = builder.build()
    options = {"ode_solver_method": method, "rtol": 1e-10, "atol": 1e-12}
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 7.0), **options)
    return results.context[x].continuous_state[0]


@pytest.mark.parametrize("make", BEHIND_A_SINE, ids=lambda make: type(make()).__name__)
@pytest.mark.parametrize("method", ["taylor", "radau"])
def test_the_methods_agree(method, make):
    """The error of each is below 100 (rtol abs(x) + atol), with x < 20 in all scenes: 2e-7."""
    if method == "taylor" and type(make()) in (Quantizer, LookupTable1d):
        with pytest.raises(saltus.ModelError, match="'taylor': a derivative uses"):
            integral_by(method, make)
        return
    assert integral_by(method, make) == pytest.approx(integral_by("dopri5", make), abs=2e-7)


def three_levels(block, *levels):
    """A diagram in which an input is one level after the other, for a second each."""
    builder = saltus.DiagramBuilder()
    builder.add(block)
    total = builder.add(Adder(len(levels)))
    for k, level in enumerate(levels):
        before = levels[k - 1] if k else 0.0
        step = builder.add(Step(0.0, level - before, step_time=float(k)))
        builder.connect(step.output(), total.input(k))
    builder.connect(total.output(), block.input())
    return builder.build()


SOLVERS = ["dopri5", "dop853", "taylor", "radau", "bdf", "adams", "auto"]


@pytest.mark.parametrize("method", SOLVERS)
@pytest.mark.parametrize("between", [0.0, 1e-9, -1e-9, 0.5])
@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_a_body_at_rest_leaves_when_it_is_pushed_away(method, between, restitution):
    """However it was pushed before, also not at all: x = -t^2 / 2 after the push turns."""
    body = SecondOrderIntegrator(upper_limit=0.0, restitution=restitution)
    diagram = three_levels(body, 1.0, between, -1.0)
    end = saltus.simulate(diagram, (0.0, 3.0), ode_solver_method=method).context[body]
    early = min(between, 0.0)  # a push of -1e-9 for a second
    exact = [-0.5 + early, -1.0 + early]
    assert end.continuous_state == pytest.approx(exact, abs=1e-5)  # ten tolerances


@pytest.mark.parametrize("method", SOLVERS)
def test_an_error_of_zero_does_not_undo_the_clamp(method):
    """v = i grows to its limit 1 in the first second, and stays there."""
    pid = PID(0.0, 1.0, upper_limit=1.0)
    pulse = Pulse(amplitude=1.0, period=4.0)
    builder = saltus.DiagramBuilder()
    builder.add(pid, pulse)
    builder.connect(pulse.output(), pid.input())
    diagram = builder.build()
    end = saltus.simulate(diagram, (0.0, 20.0), ode_solver_method=method).context[pid]
    assert end.continuous_state[0] == pytest.approx(1.0, abs=1e-5)


def test_the_integral_waits_while_the_error_is_zero_and_falls_with_it():
    pid = PID(1.0, 1.0, upper_limit=1.0, initial_state=5.0)
    diagram = three_levels(pid, 0.0, 2.0, 0.0, -1.0)
    end = saltus.simulate(diagram, (0.0, 4.0)).context[pid]
    assert end.continuous_state[0] == pytest.approx(4.0, abs=1e-5)


def test_a_relay_of_one_threshold_has_one_parameter():
    assert "off_threshold" not in Relay(1.0, 1.0).create_context().parameters
    assert "off_threshold" in Relay(1.0, 0.5).create_context().parameters


@pytest.mark.parametrize(
    "make, message",
    [
        (lambda: LookupTable1d([0.0, 1.0, np.inf], [0.0, 1.0, 2.0]), "finite points"),
        (lambda: Counter(limit=3, initial_state=7), "expected 0 to limit - 1"),
        (lambda: Counter(limit=3, initial_state=-2), "expected 0 to limit - 1"),
    ],
)
def test_impossible_tables_and_counts_are_refused(make, message):
    with pytest.raises(ModelError, match=message):
        make()


def test_blocks_with_one_seed_are_named():
    def described(*seeds):
        builder = saltus.DiagramBuilder()
        first, second, third = seeds
        builder.add(RandomNumber(0.1, seed=first, name="first"))
        builder.add(RandomNumber(0.2, distribution="uniform", seed=second, name="second"))
        builder.add(WhiteNoise(0.1, seed=third, name="third"))
        return saltus.Simulator(builder.build()).describe()

    assert "random numbers" not in described(1, 2, 3)
    assert "random numbers of 2 blocks" in described(1, 2, 1)
    assert "have the seed 1: 'first', 'third'" in described(1, 2, 1)
    assert "'first', 'second', 'third'" in described(0, 0, 0)
