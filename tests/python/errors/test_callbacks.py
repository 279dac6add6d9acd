"""What a callback raises comes out as it was, from every kind of callback, by every method."""

import traceback

import numpy as np
import pytest
import saltus
from saltus.library import Constant, FunctionBlock, Integrator, ReduceBlock
from troubles import CALLBACKS, METHODS, Everything, after, calm, check_kept, check_works, go, say

NAMES = {"output": "output_y"}


class Trouble(Exception):
    def __init__(self, what, n):
        super().__init__(what, n)
        self.n = n


CASES = [(where, method) for where in CALLBACKS for method in METHODS] + [("jacobian", "bdf")]


def check_arrived(raised, error, where):
    assert raised is error
    assert type(raised) is Trouble
    assert raised.args == ("mine", 3)
    assert raised.__cause__ is None
    frames = [frame.name for frame in traceback.extract_tb(raised.__traceback__)]
    assert frames[-4:] == [NAMES.get(where, where), "<lambda>", "<lambda>", "say"]


@pytest.mark.parametrize(("where", "method"), CASES)
def test_what_a_callback_raises_comes_out_as_it_was(where, method):
    error = Trouble("mine", 3)
    system = Everything(after(0.6, where, lambda: say(error)))
    with pytest.raises(Trouble) as caught:
        go(system, method=method)
    check_arrived(caught.value, error, where)
    check_works(system, method)


@pytest.mark.parametrize(("where", "method"), CASES)
def test_with_throw_off_it_is_the_cause_beside_what_was_computed(where, method):
    error = Trouble("mine", 3)
    system = Everything(after(0.6, where, lambda: say(error)))
    results = go(system, method=method, throw=False)
    check_arrived(results.cause, error, where)
    assert results.message.endswith(" s: Trouble: ('mine', 3)")
    check_kept(results, method)
    check_works(system, method)


@pytest.mark.parametrize(("where", "method"), CASES)
def test_a_simulator_shows_what_it_had_and_can_be_initialized_again(where, method):
    error = Trouble("mine", 3)
    system = Everything(after(0.6, where, lambda: say(error)))
    simulator = saltus.Simulator(
        system,
        recorded_signals={"y": system.output()},
        ode_solver_method=method,
        python="called",  # as `go`
    )
    simulator.initialize(system.create_context())
    with pytest.raises(Trouble):
        simulator.advance_to(2.0)
    check_kept(simulator.results, method)
    system.trouble = calm
    simulator.initialize(system.create_context())
    assert simulator.advance_to(2.0) == "reached_end"
    good = go(system, method=method)
    assert np.array_equal(simulator.results.outputs["y"], good.outputs["y"])
    assert simulator.context == good.context


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("where", CALLBACKS)
def test_a_callback_that_raises_at_once_is_called_no_more(where, method):
    """Neither the solver nor the shrinking of its step tries again."""
    calls = []

    def act():
        calls.append(1)
        raise Trouble("mine", 3)

    with pytest.raises(Trouble):
        go(Everything(after(0.6, where, act)), method=method)
    assert len(calls) == 1


@pytest.mark.parametrize("method", METHODS)
def test_an_interrupt_that_raises_ends_the_run_like_a_callback(method):
    """An endless span, so that the 20 ms after which it is asked come."""
    error = Trouble("mine", 3)
    x = Integrator(name="x")
    builder = saltus.DiagramBuilder()
    one, _ = builder.add(Constant(1.0), x)
    builder.connect(one.output(), x.input())
    diagram = builder.build()
    options = {"max_minor_step_size": 0.1, "ode_solver_method": method}
    span = (0.0, 1e12)
    with pytest.raises(Trouble) as caught:
        saltus.simulate(
            diagram, diagram.create_context(), span, interrupt=lambda: say(error), **options
        )
    assert caught.value is error
    good = saltus.simulate(diagram, diagram.create_context(), (0.0, 1.0), **options)
    assert good.context.continuous_state == pytest.approx([1.0], rel=1e-9)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("block", [FunctionBlock, ReduceBlock])
def test_a_function_in_a_diagram_raises_as_it_was(block, method):
    error = Trouble("mine", 3)
    bad = [True]

    def function(u):
        return say(error) if bad[0] and np.max(u) > 0.5 else 1.0

    arguments = (1, function) if block is ReduceBlock else (function,)
    builder = saltus.DiagramBuilder()
    f, x = builder.add(block(*arguments, shape=(), boolean=False, name="f"), Integrator(name="x"))
    builder.connect(x.output(), f.input())
    builder.connect(f.output(), x.input())
    diagram = builder.build()
    with pytest.raises(Trouble) as caught:
        go(diagram, method=method)
    assert caught.value is error
    bad[0] = False
    assert go(diagram, method=method).context.continuous_state == pytest.approx([2.0], rel=1e-5)


def test_a_declaration_before_the_block_is_made_is_refused():
    class Forgotten(saltus.LeafSystem):
        def __init__(self):
            self.declare_dynamic_parameter("g", 1.0)

    with pytest.raises(saltus.ModelError, match=r"call super\(\).__init__\(name=...\) first"):
        Forgotten()


def test_what_a_callback_raises_carries_what_was_computed():
    def f(t, x):
        if t > 1.0:
            raise LookupError("no such time")
        return [1.0]

    with pytest.raises(LookupError, match="no such time") as caught:
        saltus.solve(f, (0.0, 2.0), [0.0])
    results = caught.value.results
    assert results.status == "failed" and len(results.time) > 0
    assert results.message == f"t = {results.context.time} s: LookupError: no such time"
