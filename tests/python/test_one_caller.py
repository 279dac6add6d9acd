"""One caller at a time uses a simulator, and a block in use declares nothing more."""

import threading

import numpy as np
import pytest
import saltus

CALLS = {
    "initialize": lambda simulator, context: simulator.initialize(context),
    "advance_to": lambda simulator, context: simulator.advance_to(1.0),
    "context": lambda simulator, context: simulator.context,
    "results": lambda simulator, context: simulator.results,
    "describe": lambda simulator, context: simulator.describe(),
}
METHODS = ["auto", "dopri5", "dop853", "adams", "bdf", "radau"]


class Decay(saltus.LeafSystem):
    """x' = -x; calls `inside` once, in its derivative after t = 0.3 s."""

    def __init__(self):
        super().__init__(name="decay")
        self.inside = None
        self.declare_continuous_state(default_value=[1.0], ode=self.ode)
        self.declare_continuous_state_output("x")

    def ode(self, time, state):
        if time > 0.3 and self.inside is not None:
            inside, self.inside = self.inside, None
            inside()
        return -state.continuous_state


def started(block, **options):
    simulator = saltus.Simulator(
        block, python="called", recorded_signals={"x": block.output("x")}, **options
    )
    simulator.initialize(block.create_context())
    return simulator


def refusal(act):
    with pytest.raises(saltus.Error) as caught:
        act()
    return str(caught.value)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("call", CALLS)
def test_a_call_from_a_callback_is_an_error_and_changes_nothing(call, method):
    block = Decay()
    plain = started(block, ode_solver_method=method)
    plain.advance_to(1.0)
    simulator, said = started(block, ode_solver_method=method), []
    context = block.create_context()
    block.inside = lambda: said.append(refusal(lambda: CALLS[call](simulator, context)))
    assert simulator.advance_to(1.0) == "reached_end"
    assert f"{call} of a simulator was called by a callback of the run itself" in said[0]
    assert np.array_equal(simulator.results.time, plain.results.time)
    assert simulator.context == plain.context


@pytest.mark.parametrize("call", CALLS)
def test_a_call_from_another_thread_is_an_error_and_changes_nothing(call):
    block = Decay()
    plain = started(block)
    plain.advance_to(1.0)
    simulator, said = started(block), []
    context = block.create_context()

    def elsewhere():
        thread = threading.Thread(
            target=lambda: said.append(refusal(lambda: CALLS[call](simulator, context)))
        )
        thread.start()
        thread.join()  # the run waits until the other thread has called

    block.inside = elsewhere
    simulator.advance_to(1.0)
    assert "while another thread uses it" in said[0]
    assert simulator.context == plain.context


def test_the_time_may_be_read_by_a_callback():
    block, seen = Decay(), []
    simulator = started(block)
    block.inside = lambda: seen.append(simulator.time)
    simulator.advance_to(1.0)
    assert 0.0 <= seen[0] < 0.5


def test_an_exception_of_a_call_from_within_is_that_of_the_run():
    block = Decay()
    simulator = started(block)
    block.inside = lambda: simulator.advance_to(2.0)
    assert "by a callback of the run itself" in refusal(lambda: simulator.advance_to(1.0))
    simulator.initialize(block.create_context())  # free again
    assert simulator.advance_to(1.0) == "reached_end"


def test_another_simulator_may_run_within_a_callback():
    block, other = Decay(), Decay()
    simulator, ends = started(block), []
    block.inside = lambda: ends.append(started(other).advance_to(1.0))
    assert simulator.advance_to(1.0) == "reached_end" and ends == ["reached_end"]


@pytest.mark.parametrize("attempt", range(5))
def test_threads_that_share_a_simulator_get_errors_or_the_right_state(attempt):
    block = Decay()
    simulator = started(block)

    def go():
        for k in range(1, 40):
            try:
                simulator.advance_to(max(simulator.time, 0.25 * k))
            except saltus.Error:
                pass

    threads = [threading.Thread(target=go) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    # The default rtol 1e-6 at |x| <= 1; errors of x' = -x do not grow.
    assert simulator.context.continuous_state[0] == pytest.approx(np.exp(-simulator.time), abs=1e-5)
    assert (np.diff(simulator.results.time) >= 0).all()


DECLARATIONS = {
    "state": lambda b: b.declare_continuous_state(default_value=[1.0]),
    "discrete state": lambda b: b.declare_discrete_state(default_value=[1.0]),
    "mode": lambda b: b.declare_default_mode(1),
    "parameter": lambda b: b.declare_dynamic_parameter("k", 1.0),
    "input": lambda b: b.declare_input_port("u"),
    "output": lambda b: b.declare_output_port(lambda t, s: 1.0, name="more"),
    "view": lambda b: b.declare_continuous_state_output("more"),
    "crossing": lambda b: b.declare_zero_crossing(lambda t, s: 1.0),
    "relation": lambda b: b.declare_relation(lambda t, s: 1.0),
    "edge": lambda b: b.declare_edge_reset(lambda t, s: s, input=0),
    "update": lambda b: b.declare_periodic_update(lambda t, s: s, period=1.0),
    "one shot": lambda b: b.declare_one_shot(None, time=1.0),
}


@pytest.mark.parametrize("python", ["called", "traced"])
@pytest.mark.parametrize("what", DECLARATIONS)
def test_a_block_in_use_declares_nothing_more(what, python):
    def refused():
        with pytest.raises(saltus.ModelError, match="block 'decay' is in use"):
            DECLARATIONS[what](block)

    block = Decay()
    simulator = saltus.Simulator(block, python=python)
    refused()
    simulator.initialize(block.create_context())
    block.inside = refused
    assert simulator.advance_to(1.0) == "reached_end"
    assert simulator.context.continuous_state[0] == pytest.approx(np.exp(-1.0), rel=1e-4)


@pytest.mark.parametrize("what", DECLARATIONS)
def test_a_block_of_a_diagram_declares_nothing_more(what):
    block = Decay()
    builder = saltus.DiagramBuilder()
    builder.add(block)
    block.declare_dynamic_parameter("early", 1.0)  # not built yet
    diagram = builder.build()
    with pytest.raises(saltus.ModelError, match="block 'decay' is in use"):
        DECLARATIONS[what](block)
    del diagram


def test_an_output_that_is_called_for_its_shape_cannot_declare():
    block = saltus.LeafSystem(name="block")
    said = []

    def output(time, state):
        said.append(refusal(lambda: block.declare_dynamic_parameter("k", 1.0)))
        return 1.0

    block.declare_output_port(output, name="y")
    block.create_context()
    assert said and all("is in use" in one for one in said)


def test_a_block_that_nobody_uses_any_more_may_declare():
    block = Decay()
    saltus.simulate(block, block.create_context(), (0, 1))
    block.explain()
    block.declare_dynamic_parameter("k", 1.0)
