"""What a traced function read from outside, and is different now, shows in the next run."""

import numpy as np
import pytest
import saltus
from systems import Ball

from models import Pendulum, end, leaf

RATE = 1.0


def by_global(time, state):
    return [-RATE * state.continuous_state[0]]


def traced(system):
    """All of it traced, or the tests below would show nothing."""
    assert {r.runs for r in system.explain()} == {"traced"}
    return system


def test_an_attribute():
    ball = traced(Ball(e=0.9))
    for e in (0.9, 0.5, 0.9):
        ball.e = e
        fresh = Ball(e=e)
        for run_of in (ball, fresh):
            context = run_of.create_context().with_continuous_state([1.0, 0.0])
            run_of.x = saltus.simulate(run_of, context, (0.0, 1.0)).context.continuous_state
        assert ball.x.tolist() == fresh.x.tolist()


def test_a_variable_of_a_closure():
    rate = 1.0
    block = traced(leaf(lambda t, s: [-rate * s.continuous_state[0]]))
    assert end(block)[0] == pytest.approx(np.exp(-1.0), rel=1e-4)
    rate = 2.0
    assert end(block)[0] == pytest.approx(np.exp(-2.0), rel=1e-4)


def test_a_global(monkeypatch):
    block = traced(leaf(by_global))
    assert end(block)[0] == pytest.approx(np.exp(-1.0), rel=1e-4)
    monkeypatch.setitem(globals(), "RATE", 2.0)
    assert end(block)[0] == pytest.approx(np.exp(-2.0), rel=1e-4)


def test_an_array_changed_in_place():
    block = saltus.LeafSystem(name="block")
    block.rates = np.array([1.0, 1.0])
    block.declare_continuous_state(
        default_value=[1.0, 1.0], ode=lambda t, s: -block.rates * s.continuous_state
    )
    traced(block)
    end(block)
    block.rates[1] = 2.0
    np.testing.assert_allclose(end(block), np.exp([-1.0, -2.0]), rtol=1e-4)


def test_a_function_that_is_called():
    class Block(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="block")
            self.declare_continuous_state(default_value=[1.0], ode=self.ode)

        def ode(self, time, state):
            return [-self.rate() * state.continuous_state[0]]

        def rate(self):
            return 1.0

    block = traced(Block())
    end(block)
    block.rate = lambda: 2.0
    assert end(block)[0] == pytest.approx(np.exp(-2.0), rel=1e-4)


def test_a_dynamic_parameter():
    block = traced(leaf(lambda t, s, *, k: [-k * s.continuous_state[0]], k=1.0))
    for k in (1.0, 2.0):
        context = block.create_context().with_parameter("k", k)
        x = saltus.simulate(block, context, (0.0, 1.0)).context.continuous_state
        assert x[0] == pytest.approx(np.exp(-k), rel=1e-4)


class Absent(saltus.LeafSystem):
    """x' = -drag x, where the attribute `drag` may be missing, and a table of numbers."""

    def __init__(self, read):
        super().__init__(name="absent")
        self.table = [1]
        self.declare_continuous_state([1.0], ode=lambda t, s: -read(self) * s.continuous_state)


@pytest.mark.parametrize(
    ("read", "change", "rate"),
    [
        (lambda o: getattr(o, "drag", 0.5), lambda o: setattr(o, "drag", 3.0), 3.0),
        (lambda o: 2.0 if hasattr(o, "drag") else 0.5, lambda o: setattr(o, "drag", 3.0), 2.0),
        (lambda o: 2.0 if o.table[0] is True else 0.5, lambda o: setattr(o, "table", [True]), 2.0),
        (lambda o: 2.0 if o.table[0] is True else 0.5, lambda o: o.table.__setitem__(0, True), 2.0),
    ],
)
def test_what_was_missing_or_equal_before_a_run(read, change, rate):
    system = Absent(read)
    for expected in (0.5, rate):
        x = saltus.simulate(system, (0.0, 1.0), rtol=1e-9).context.continuous_state[0]
        assert x == pytest.approx(np.exp(-expected), rel=1e-7)
        change(system)


def test_between_two_pieces_of_a_run():
    pendulum, simulators = Pendulum(damping=0.0), []
    for python in ("traced", "called"):
        pendulum.damping = 0.0
        simulator = saltus.Simulator(pendulum, python=python)
        simulator.initialize(pendulum.create_context())
        simulator.advance_to(0.5)
        pendulum.damping = 2.0
        simulator.advance_to(1.0)
        simulators.append(np.array(simulator.context.continuous_state))
    np.testing.assert_allclose(*simulators, rtol=1e-9)


def test_another_ode_between_two_pieces():
    """It reads the time in place of the state; how it runs does not show."""
    block, found = leaf(lambda t, s: [block.f(t, s.continuous_state[0])]), []
    for python in ("traced", "called"):
        block.f = lambda t, x: -x
        simulator = saltus.Simulator(block, rtol=1e-10, ode_solver_method="dopri5", python=python)
        simulator.initialize(block.create_context())
        simulator.advance_to(0.5)
        block.f = lambda t, x: -t
        simulator.advance_to(1.0)
        found.append(float(simulator.context.continuous_state[0]))
    assert found[0] == pytest.approx(found[1], rel=1e-13)
    # the first stage of the first step still has the old slope, 0.1 off, for a small part of a step
    assert found[0] == pytest.approx(np.exp(-0.5) - 0.5 * (1.0 - 0.25), rel=1e-4)


def test_an_output_that_reads_more_between_two_pieces_is_refused():
    """The plan computes it at events only."""
    block = leaf(lambda t, s: -s.continuous_state)
    block.f = lambda t: 1.0
    block.declare_output_port(lambda t, s: block.f(t), name="y")
    simulator = saltus.Simulator(block, recorded_signals={"y": block.output()})
    simulator.initialize(block.create_context())
    simulator.advance_to(0.5)
    block.f = lambda t: t
    with pytest.raises(saltus.ModelError, match="initialize again"):
        simulator.advance_to(1.0)
    simulator.initialize(block.create_context())
    simulator.advance_to(1.0)
    assert simulator.results.outputs["y"][-1] == 1.0


def test_two_simulators_of_one_system():
    block = leaf(lambda t, s: [-block.k * s.continuous_state[0]])
    block.k = 1.0
    simulators = [saltus.Simulator(block), saltus.Simulator(block)]
    block.k = 2.0
    for simulator in simulators:
        simulator.initialize(block.create_context())
        simulator.advance_to(1.0)
        assert simulator.context.continuous_state[0] == pytest.approx(np.exp(-2.0), rel=1e-4)


def test_what_became_traceable():
    block = leaf(lambda t, s: [-1.0 if block.plain else -s.continuous_state[0] * block.k(t)])
    block.plain, block.k = False, lambda t: float(int(t * 0) + 1)
    end(block)
    block.k = lambda t: 1.0
    traced(block)


def test_declared_after_a_run():
    block = leaf(lambda t, s: [-s.continuous_state[0]])
    end(block)
    block.declare_zero_crossing(lambda t, s: s.continuous_state[0] - 0.5, name="half")
    results = saltus.simulate(block, block.create_context(), (0.0, 1.0))
    assert len(results.events) == 1
