"""Who keeps whom alive: nothing dies in use, nothing stays for ever."""

import gc
import weakref

import numpy as np
import pytest
import saltus
from saltus.library import Constant, Gain, Integrator, ReduceBlock
from systems import Ball, run


@pytest.fixture(autouse=True)
def no_collector():
    """What must go by itself goes without the garbage collector."""
    gc.collect()
    gc.disable()
    yield
    gc.enable()


def test_a_block_with_its_own_methods_goes_at_once():
    ball = Ball()
    run(ball, (0.0, 1.0))
    gone = weakref.ref(ball)
    del ball
    assert gone() is None


def test_a_block_with_lambdas_that_hold_it_is_collected():
    class Closed(saltus.LeafSystem):
        def __init__(self):
            super().__init__()
            self.rate = 1.0
            self.declare_continuous_state(1, ode=lambda t, s: [self.rate])
            self.declare_output_port(lambda t, s: self.rate, requires_inputs=False)

    block = Closed()
    run(block, (0.0, 1.0))
    gone = weakref.ref(block)
    del block
    gc.collect()
    assert gone() is None


def test_a_block_that_holds_its_diagram_is_collected():
    builder = saltus.DiagramBuilder()
    ball = builder.add(Ball())
    ball.diagram = builder.build()
    ball.port = ball.diagram["ball"].output_ports[0]
    gone = weakref.ref(ball), weakref.ref(ball.diagram)
    del ball, builder
    gc.collect()
    assert [one() for one in gone] == [None, None]


def test_a_diagram_keeps_its_blocks_to_any_depth():
    def inner():
        builder = saltus.DiagramBuilder()
        builder.export_output(builder.add(Ball()).output(), "state")
        return builder.build("inner")

    builder = saltus.DiagramBuilder()
    builder.add(inner())
    diagram = builder.build()
    del builder
    gc.collect()
    context = diagram.create_context().with_continuous_state([10.0, 0.0])
    results = saltus.simulate(
        diagram, context, (0.0, 1.0), recorded_signals={"s": diagram["inner"].output()}
    )
    assert results.outputs["s"][-1, 1] == pytest.approx(-9.81)
    assert isinstance(diagram["inner"]["ball"], Ball)


def test_a_simulator_keeps_its_system():
    ball = Ball()
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    simulator = saltus.Simulator(ball, recorded_signals={"s": ball.output()})
    gone = weakref.ref(ball)
    del ball
    gc.collect()
    simulator.initialize(context)
    simulator.advance_to(1.0)
    assert simulator.results.outputs["s"][-1, 1] == pytest.approx(-9.81)
    del simulator
    assert gone() is None


def test_a_port_keeps_its_system():
    port = Ball().output_ports[0]
    gc.collect()
    results = saltus.simulate(
        port.system, port.system.create_context(), (0.0, 0.1), recorded_signals={"s": port}
    )
    assert results.outputs["s"].shape[1] == 2


def test_arrays_outlive_their_results():
    ball = Ball()
    results = run(ball, (0.0, 1.0), ball.create_context().with_continuous_state([10.0, 0.0]))
    time, state = results.time, results.outputs["state"]
    copies = time.copy(), state.copy()
    event = results.events
    del results, ball, event
    gc.collect()
    rubbish = [np.random.default_rng(0).random(len(time)) for _ in range(100)]
    assert np.array_equal(time, copies[0])
    assert np.array_equal(state, copies[1])
    assert len(rubbish) == 100


def test_arrays_are_not_copied():
    results = run(Ball(), (0.0, 1.0))
    for array in (results.time, results.jump, results.outputs["state"]):
        assert not array.flags.owndata
        assert array.flags.c_contiguous


def test_results_go_with_their_last_reference():
    ball = Ball()
    results = run(ball, (0.0, 1.0))
    gone = weakref.ref(results)
    del results
    assert gone() is None


def test_failed_runs_leave_nothing_behind():
    class Held:
        pass

    def fail():
        held = Held()
        error = ValueError(held)

        class Bad(saltus.LeafSystem):
            def __init__(self):
                super().__init__()
                self.declare_continuous_state(1, ode=self.ode)

            def ode(self, time, state):
                raise error

        system = Bad()
        with pytest.raises(ValueError):
            saltus.simulate(system, system.create_context(), (0.0, 1.0))
        return weakref.ref(held)

    gone = fail()
    gc.collect()  # the exception, its traceback and the frames in it make a ring, as always
    assert gone() is None


def test_a_thousand_diagrams_do_not_grow():
    def make():
        builder = saltus.DiagramBuilder()
        c, k, x, f = builder.add(
            Constant([1.0] * 100),
            Gain(2.0),
            Integrator(np.zeros(100)),
            ReduceBlock(1, lambda u: u[0]),
        )
        builder.connect(c.output(), k.input())
        builder.connect(k.output(), x.input())
        builder.connect(x.output(), f.input())
        diagram = builder.build()
        saltus.simulate(
            diagram, diagram.create_context(), (0.0, 1.0), recorded_signals={"x": x.output()}
        )

    def objects():
        gc.collect()
        return len(gc.get_objects())

    make()
    before = objects()
    for _ in range(200):
        make()
    assert objects() - before < 50


def test_the_garbage_collector_may_come_while_a_block_is_made():
    """Of a new class each, for which pybind11 makes objects of its own at the first block."""
    before = gc.get_threshold()
    gc.set_threshold(1)
    gc.enable()
    try:
        for _ in range(100):
            block = type("Block", (saltus.LeafSystem,), {})(name="block")
    finally:
        gc.set_threshold(*before)
    assert block.create_context().time == 0.0
