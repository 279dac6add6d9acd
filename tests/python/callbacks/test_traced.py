"""Traced functions give what the called ones give, without the interpreter."""

import gc
import threading
import weakref

import numpy as np
import pytest
import saltus
from saltus.library import Constant, FunctionBlock, Integrator, ReduceBlock
from systems import Ball, run

from models import Pendulum, end, leaf


def both(make, span, **options):
    """Results of the same system, called and traced."""
    return [run(make(), span, python=python, **options) for python in ("called", "traced")]


@pytest.mark.parametrize("method", ["dopri5", "dop853", "bdf"])
@pytest.mark.parametrize("make", [Pendulum, lambda: Ball(e=0.8)], ids=["pendulum", "ball"])
def test_same_results(make, method):
    called, traced = both(make, (0.0, 2.0), rtol=1e-9, atol=1e-11, ode_solver_method=method)
    assert len(called.events) == len(traced.events)
    # dopri5 sees values apart by roundings; bdf has other Jacobians, so differs by its tolerance,
    # enlarged by the events
    near = {"rtol": 1e-5, "atol": 1e-6} if method == "bdf" else {"rtol": 1e-10, "atol": 1e-11}
    np.testing.assert_allclose(
        called.context.continuous_state, traced.context.continuous_state, **near
    )


def below(floor=0.0):
    builder = saltus.DiagramBuilder()
    x = builder.add(Integrator(1.0, name="x"))
    fall = builder.add(Constant(-1.0, name="fall"))
    ground = builder.add(Constant(floor, name="ground"))
    compare = builder.add(ReduceBlock(2, lambda u: u[0] < u[1], name="below"))
    y = builder.add(Integrator(0.0, name="y"))
    gain = builder.add(FunctionBlock(lambda u: 2.0 * u, name="gain"))
    for source, target in [
        (fall.output(), x.input()),
        (x.output(), compare.input(0)),
        (ground.output(), compare.input(1)),
        (compare.output(), gain.input()),
        (gain.output(), y.input()),
    ]:
        builder.connect(source, target)
    return builder.build()


def test_a_comparison_is_a_relation():
    traced, called = saltus.Simulator(below()), saltus.Simulator(below(), python="called")
    assert "opaque" in called.describe()
    assert "opaque" not in traced.describe()
    assert "a relation, held between instants" in traced.describe()


def test_a_relation_is_located():
    diagram = below(floor=0.25)
    # x = 1 - t crosses 0.25 at 0.75 s; y rises by 2 per second from then on
    _, y = end(diagram, 1.0)
    assert y == pytest.approx(0.5, abs=1e-12)


def test_logic_over_comparisons_is_no_opaque_boolean():
    builder = saltus.DiagramBuilder()
    clock = builder.add(saltus.library.Clock(name="clock"))
    inside = builder.add(
        FunctionBlock(lambda u: np.logical_and(u > 0.25, u <= 0.75), name="inside")
    )
    y = builder.add(Integrator(0.0, name="y"))
    builder.connect(clock.output(), inside.input())
    builder.connect(inside.output(), y.input())
    diagram = builder.build()
    assert "opaque" not in saltus.Simulator(diagram).describe()
    assert end(diagram)[0] == pytest.approx(0.5, abs=1e-12)


def test_what_is_not_read_is_not_computed():
    def block():
        held = saltus.LeafSystem(name="held")
        held.declare_continuous_state(default_value=[1.0], ode=lambda t, s: [-s.continuous_state])
        held.declare_output_port(lambda t, s: 3.0 * s.mode, name="y")
        return held

    def described(python):
        held = block()
        return saltus.Simulator(
            held, python=python, recorded_signals={"y": held.output()}
        ).describe()

    constant = "constant, computed once: 1 (held.y)"
    assert constant in described("traced")
    assert constant not in described("called")


def test_exact_jacobian_for_a_stiff_method():
    def ode(time, state):
        x, y, z = state.continuous_state
        return np.array([-0.04 * x + 1e4 * y * z, 0.04 * x - 1e4 * y * z - 3e7 * y**2, 3e7 * y**2])

    calls = {}
    for python in ("called", "traced"):
        block = leaf(ode, [1.0, 0.0, 0.0])
        results = saltus.simulate(
            block, block.create_context(), (0.0, 40.0), ode_solver_method="bdf", python=python
        )
        calls[python] = results.statistics.right_hand_side_calls
        assert results.statistics.jacobian_calls > 0
    assert calls["traced"] < calls["called"]  # no differences


def test_a_traced_run_needs_no_interpreter():
    """Another thread computes for all of the run and is never waited for."""
    block = leaf(lambda t, s: [s.continuous_state[1], -s.continuous_state[0]], [1.0, 0.0])
    assert {r.runs for r in block.explain()} == {"traced"}
    count, stop = [0], threading.Event()

    def work():
        while not stop.is_set():
            count[0] += 1

    worker = threading.Thread(target=work)
    worker.start()
    end(block, 50.0, max_minor_step_size=1e-3)
    before = count[0]
    stop.set()
    worker.join()
    assert before > 1000


def test_side_effects_stay():
    seen = []

    def ode(time, state):
        seen.append(time)
        return [-state.continuous_state[0]]

    block = leaf(ode)
    assert block.explain()[0].runs == "called"
    results = saltus.simulate(block, block.create_context(), (0.0, 1.0))
    assert len(seen) == results.statistics.right_hand_side_calls


def test_what_a_function_raises_for_its_values_comes_out():
    block = leaf(lambda t, s: [1.0 / (0.5 - t) ** 2 if False else 1.0 / min(t - 2.0, 0.0)])
    with pytest.raises(ZeroDivisionError):
        end(block, 3.0)


def test_tracing_waits_for_the_plan():
    calls = []

    class Block(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="block")
            self.declare_continuous_state(default_value=[1.0], ode=self.ode)

        def ode(self, time, state):
            calls.append(time)
            return [self.k * state.continuous_state[0]]

    block = Block()  # self.k is not there yet
    assert calls == []
    block.k = -1.0
    assert end(block)[0] == pytest.approx(np.exp(-1.0), rel=1e-4)


def test_traced_blocks_are_collected():
    def go():
        block = leaf(lambda t, s: [-block.k * s.continuous_state[0]])
        block.k = 1.0
        end(block)
        diagram = below()
        end(diagram)
        return weakref.ref(block), weakref.ref(diagram), weakref.ref(diagram["below"])

    gone = go()
    gc.collect()
    assert [one() for one in gone] == [None, None, None]


def test_threads_share_a_system():
    block = Pendulum()
    alone = end(block, 5.0).tolist()
    found, threads = [], []
    for _ in range(8):
        threads.append(threading.Thread(target=lambda: found.append(end(block, 5.0).tolist())))
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [alone] * 8


def test_jax_in_a_callback_is_called():
    jnp = pytest.importorskip("jax.numpy")
    block = leaf(lambda t, s: jnp.array([-s.continuous_state[0]]))
    assert block.explain()[0].runs == "called"
    assert end(block)[0] == pytest.approx(np.exp(-1.0), rel=1e-4)


def test_an_unknown_way_is_refused():
    with pytest.raises(saltus.ModelError, match="option python: unknown 'trace'; did you mean"):
        end(Pendulum(), python="trace")
