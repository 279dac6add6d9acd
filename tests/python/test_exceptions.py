"""What a callback raises comes out as it was; what Saltus raises says where, when and why."""

import copy
import pickle
import traceback

import numpy as np
import pytest
import saltus
from saltus.library import Constant, Gain, Integrator, ReduceBlock
from systems import Ball, Decay, run

METHODS = ["dopri5", "adams", "bdf", "radau", "auto"]


class Trouble(Exception):
    pass


def failing(error, after=0.3):
    def hook(time, state):
        if time > after:
            raise error

    return hook


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("where", ["ode", "guard", "reset"])
@pytest.mark.parametrize("kind", [Trouble, KeyError, SystemExit, ZeroDivisionError])
def test_the_same_object_comes_out(method, where, kind):
    error = kind("mine")
    system = Decay(failing(error), where)
    with pytest.raises(kind) as caught:
        saltus.simulate(system, system.create_context(), (0.0, 2.0), ode_solver_method=method)
    assert caught.value is error
    names = [frame.name for frame in traceback.extract_tb(caught.value.__traceback__)]
    assert names[-3:] == [where, "at", "hook"]


@pytest.mark.parametrize("method", METHODS)
def test_a_system_works_again_after_its_callback_failed(method):
    armed = [True]

    def hook(time, state):
        if armed[0] and time > 0.3:
            raise Trouble

    system = Decay(hook)
    simulator = saltus.Simulator(
        system, ode_solver_method=method, recorded_signals={"x": system.output()}
    )
    with pytest.raises(Trouble):
        simulator.initialize(system.create_context())
        simulator.advance_to(1.0)
    armed[0] = False
    simulator.initialize(system.create_context())
    assert simulator.advance_to(1.0) == "reached_end"
    assert simulator.results.events.times("half") == pytest.approx([np.log(2.0)], abs=1e-5)
    again = saltus.simulate(
        system,
        system.create_context(),
        (0.0, 1.0),
        ode_solver_method=method,
        recorded_signals={"x": system.output()},
    )
    assert np.array_equal(simulator.results.outputs["x"], again.outputs["x"])


def test_an_output_that_raises():
    builder = saltus.DiagramBuilder()
    source, block, x = builder.add(
        Constant(0.0), ReduceBlock(1, lambda u: 1.0 / u[0], name="inverse"), Integrator(name="x")
    )
    builder.connect(source.output(), block.input())
    builder.connect(block.output(), x.input())
    diagram = builder.build()
    with pytest.raises(ZeroDivisionError):
        saltus.simulate(diagram, diagram.create_context(), (0.0, 1.0))


def test_throw_off_returns_what_was_raised():
    error = Trouble("mine")
    results = run(Decay(failing(error)), (0.0, 2.0), throw=False)
    assert results.status == "failed"
    assert results.cause is error
    assert "mine" in results.message
    assert 0 < results.time[-1] <= 0.31
    assert len(results.outputs["x"]) == len(results.time)


def test_simulation_error_says_where_and_keeps_the_results():
    """dx/dt = x^2 from 1 blows up at t = 1."""

    class Blow(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="blow")
            self.declare_continuous_state(
                default_value=[1.0], ode=lambda t, s: s.continuous_state**2
            )
            self.declare_continuous_state_output("x")

    with np.errstate(over="ignore"), pytest.raises(saltus.SimulationError) as caught:
        run(Blow(), (0.0, 2.0))
    error = caught.value
    assert error.time == pytest.approx(1.0, abs=1e-3)
    assert error.results.status == "failed"
    assert error.results.time[-1] == pytest.approx(1.0, abs=1e-3)
    assert isinstance(error, RuntimeError)
    assert isinstance(error, saltus.Error)


def test_nan_names_the_block():
    class Bad(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="bad")
            self.declare_continuous_state(1, ode=lambda t, s: [float("nan")])

    builder = saltus.DiagramBuilder()
    builder.add(Bad(), Ball())
    diagram = builder.build()
    with pytest.raises(saltus.SimulationError, match="bad") as caught:
        saltus.simulate(diagram, diagram.create_context(), (0.0, 1.0))
    assert caught.value.block == "bad"


def test_step_limit_and_its_results():
    ball = Ball()
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    with pytest.raises(saltus.SimulationError, match="max_major_steps") as caught:
        run(ball, (0.0, 20.0), context, max_major_steps=3)
    results = caught.value.results
    assert results.status == "step_limit"
    assert len(results.events) == 2  # the start is an instant, too
    assert run(ball, (0.0, 20.0), context, max_major_steps=3, throw=False).status == "step_limit"


def test_errors_can_be_copied_and_pickled():
    error = saltus.SimulationError("why", 1.5, "block")
    for other in (copy.copy(error), pickle.loads(pickle.dumps(error))):
        assert (str(other), other.time, other.block, other.results) == ("why", 1.5, "block", None)


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda b: b.build(), "build: the diagram has no block; add one first"),
        (
            lambda b: (b.add(Gain(1.0, name="k")), b.build()),
            "input 'in' of block 'k' is not connected; connect it or export it",
        ),
        (
            lambda b: b.add(Gain(1.0, name="k"), Gain(2.0, name="k")),
            "two blocks are called 'k'; give each block of a diagram its own name",
        ),
        (lambda b: b.add(3), "add: expected a system, found 3"),
        (
            lambda b: b.connect(
                b.add(Constant(1.0, name="c")).output(), Gain(1.0, name="k").input()
            ),
            "block 'k' was not added to this diagram; its blocks: 'c'",
        ),
        (
            lambda b: b.connect(b.add(Constant(1.0, name="c")), b.add(Gain(1.0, name="k")).input()),
            "expected a port, found the block <Constant 'c'>; write block.output()",
        ),
        (
            lambda b: b.add(Gain(1.0, name="k")).input("into"),
            "block 'k' has no input 'into'; did you mean 'in'? Known: 'in'",
        ),
        (
            lambda b: (b.add(Constant(1.0, name="c")), b.build()["d"]),
            "diagram 'root' has no block 'd'; did you mean 'c'? Known: 'c'",
        ),
    ],
)
def test_bad_diagrams(build, message):
    with pytest.raises(saltus.ModelError) as caught:
        build(saltus.DiagramBuilder())
    assert str(caught.value) == message


def test_an_algebraic_loop_is_printed_as_a_path():
    builder = saltus.DiagramBuilder()
    a, b = builder.add(*(ReduceBlock(1, lambda u: u[0], shape=(), name=name) for name in "ab"))
    builder.connect(a.output(), b.input())
    builder.connect(b.output(), a.input())
    with pytest.raises(
        saltus.ModelError, match=r"algebraic loop(.|\n)*'a.out' reads\n *'b.out' reads\n *'a.out'"
    ):
        builder.build()
