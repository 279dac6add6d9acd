"""What somebody who comes from another tool types first is answered with what to write here."""

import pytest
import saltus
from saltus.library import Adder, Clock, Constant, Gain, Integrator, Pulse, Sine, StateMachine


class Plant(saltus.LeafSystem):
    def __init__(self, ode=None, name="plant"):
        super().__init__(name=name)
        ode = ode or (lambda time, state: [-state.continuous_state[0]])
        self.declare_continuous_state([1.0], ode=ode)
        self.declare_continuous_state_output("x")


def context():
    return Plant().create_context()


def with_blocks(*blocks):
    builder = saltus.DiagramBuilder()
    builder.add(*blocks)
    return builder


def set_in_place(name, value):
    made = context()
    setattr(made, name, value)


def connected(source, target):
    a, b = Constant(1.0, name="a"), Gain(2.0, name="b")
    with_blocks(a, b).connect(
        *(each(a, b) if callable(each) else each for each in (source, target))
    )


def recorded():
    builder = with_blocks(Clock(name="clock"), Gain(2.0, name="twice"))
    builder.connect("clock", "twice")
    saltus.simulate(builder.build(), (0.0, 1.0), recorded_signals=["twice"])


ANSWERS = {
    "a number as the span": (lambda: saltus.simulate(Plant(), 10), "write (0.0, 10.0)"),
    "t_span": (lambda: saltus.simulate(Plant(), t_span=(0, 1)), "time_span=(begin, end)"),
    "stop_time": (lambda: saltus.simulate(Plant(), stop_time=1), "time_span=(begin, end)"),
    "no span": (lambda: saltus.simulate(Plant()), "expected a span (begin, end)"),
    "context last": (
        lambda: saltus.simulate(Plant(), (0, 1), context()),
        "simulate(system, context, (begin, end))",
    ),
    "options in place of the span": (
        lambda: saltus.simulate(Plant(), context(), saltus.SimulatorOptions()),
        "write options=...",
    ),
    "method": (lambda: saltus.simulate(Plant(), (0, 1), method="RK45"), "ode_solver_method="),
    "max_step": (lambda: saltus.simulate(Plant(), (0, 1), max_step=0.1), "max_minor_step_size"),
    "t_eval": (lambda: saltus.simulate(Plant(), (0, 1), t_eval=[1.0]), "save_at=[...]"),
    "x0": (lambda: saltus.simulate(Plant(), (0, 1), x0=[1.0]), "with_continuous_state"),
    "the state first": (
        lambda: saltus.solve(lambda x, t: -x, (0, 1), [1.0]), "write (t, x), as in scipy",
    ),
    "the state first in a guard": (
        lambda: saltus.solve(lambda t, y: -y, (0, 1), [1.0], events=[lambda y, t: y[0] - 0.5]),
        "write (t, y), as in scipy",
    ),
    "guards": (
        lambda: saltus.solve(lambda t, x: -x, (0, 1), [1.0], guards=[]), "it is called events here",
    ),
    "dt": (lambda: saltus.simulate(Plant(), (0, 1), dt=0.1), "rtol and atol choose"),
    "k of a gain": (lambda: Gain(k=2.0), "it is called gain here"),
    "initial condition": (lambda: Integrator(initial_condition=1.0), "called initial_state here"),
    "amplitude": (lambda: Sine(amp=2.0), "it is called amplitude here"),
    "signs of a sum": (lambda: Adder(signs="+-"), "it is called operators here"),
    "a block as a source": (
        lambda: connected(lambda a, b: a, lambda a, b: b.input()), "write block.output()",
    ),
    "a block as a target": (
        lambda: connected(lambda a, b: a.output(), lambda a, b: b), "write block.input()",
    ),
    "a source without outputs": (
        lambda: with_blocks(saltus.LeafSystem(name="leaf"), Gain(1.0, name="g")).connect("leaf", "g"),
        "block 'leaf' has no output",
    ),
    "one of two inputs": (
        lambda: with_blocks(Clock(name="t"), Adder("+-", name="sum")).connect("t", "sum"),
        "block 'sum' has 2 inputs; say which: 'sum.in_0', 'sum.in_1'",
    ),
    "one of two events": (
        lambda: with_blocks(Pulse(name="p"), Plant()).connect_event("p", "plant"),
        "block 'p' has 2 event outputs; say which: 'p.rise', 'p.fall'",
    ),
    "an unknown block": (
        lambda: with_blocks(Clock(name="clock"), Gain(1.0, name="g")).connect("clok", "g"),
        "did you mean 'clock'",
    ),
    "a block as a signal": (recorded, "'twice' is a block; say which output: 'twice.out'"),
    "a tuple as a transition": (
        lambda: StateMachine(["off", "on"], [("off", "on")]), "expected Transition('closed', 'open'",
    ),
    "an open input": (
        lambda: saltus.linearize(Gain(2.0, name="g")), "linearize(..., inputs={'in': 0.0})",
    ),
    "no signal": (lambda: saltus.simulate(Plant(), (0, 1), recorded_signals=[])["x"], "give the run recorded_signals"),
}  # fmt: skip


@pytest.mark.parametrize("what", ANSWERS)
def test_the_answer(what):
    act, words = ANSWERS[what]
    with pytest.raises(saltus.ModelError) as caught:
        act()
    assert words in str(caught.value)


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize(
    "ode",
    [
        lambda time, x: [-x[0]],
        lambda time, x: [-value for value in x],
        lambda time, x: [-sum(x)],
    ],
)
def test_a_state_that_is_taken_for_an_array(ode, python):
    with pytest.raises(TypeError, match="its numbers are state.continuous_state"):
        saltus.simulate(Plant(ode), (0.0, 1.0), python=python)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("continuous_state", "write context = context.with_continuous_state"),
        ("discrete_state", "write context = context.with_discrete_state"),
        ("time", "write context = context.with_time"),
        ("mode", "write context = context.with_mode"),
        ("parameters", "write context = context.with_parameters"),
        ("continous_state", "did you mean 'continuous_state'"),
    ],
)
def test_a_context_that_is_set_in_place(name, words):
    with pytest.raises(AttributeError, match=words):
        set_in_place(name, 1.0)


def test_a_block_with_one_port_of_the_kind_needs_no_name():
    by_name, by_port = (saltus.DiagramBuilder() for _ in range(2))
    for builder in (by_name, by_port):
        builder.add(Clock(name="clock"), Gain(2.0, name="twice"))
        builder.export_output("twice.out", "y")
    by_name.connect("clock", "twice")
    by_port.connect("clock.out", "twice.in")
    ends = [saltus.simulate(b.build(), (0.0, 1.0))["y"].tobytes() for b in (by_name, by_port)]
    assert ends[0] == ends[1]


def test_a_block_with_one_event_needs_no_name():
    bell, counter = saltus.LeafSystem(name="bell"), saltus.LeafSystem(name="counter")
    bell.declare_periodic_update(None, period=1.0, name="rings")
    counter.declare_discrete_state([0.0])
    counter.declare_event_input(
        lambda t, s, weight: s.with_discrete_state(s.discrete_state + weight), name="count"
    )
    builder = with_blocks(bell, counter)
    builder.connect_event("bell", "counter", weight=2.0)
    end = saltus.simulate(builder.build(), time_span=(0.0, 2.5)).context
    assert end.discrete_state[0] == 6.0
