"""Ctrl-C ends a run at once with the partial result, whatever the run is doing."""

import os
import signal
import threading
import time

import numpy as np
import pytest
import saltus
from saltus.library import Comparator, Constant, Integrator
from troubles import METHODS, Everything, check_works, go


class Slow(Everything):
    """Waits 1 ms in each call of one of its callbacks, and says when the run is under way."""

    def __init__(self, where):
        self.where, self.calls, self.begun = where, 0, threading.Event()
        super().__init__(self.wait)

    def wait(self, place, t):
        if place == self.where:
            time.sleep(1e-3)
            self.calls += 1
            if self.calls == 50:
                self.begun.set()
        return 0.0


def pressed(begun, run):
    """What `run` raised after a Ctrl-C that comes once it has begun."""

    def press():
        begun.wait()
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    with pytest.raises(KeyboardInterrupt) as caught:
        run()
    thread.join()
    return caught.value


def check_partial(results):
    assert results.status == "interrupted"
    assert results.message.startswith("t = ")
    assert results.cause is None
    assert 0.0 < results.context.time < 1e9
    assert len(results.time) > 0
    assert results.time[0] == 0.0


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("where", ["ode", "guard", "update"])
def test_ctrl_c_in_a_python_callback(where, method):
    system = Slow(where)
    error = pressed(system.begun, lambda: go(system, end=1e9, method=method))
    assert system.calls < 50 + 200  # 0.2 s of calls at most
    check_partial(error.results)
    check_works(system, method)


@pytest.mark.parametrize("method", METHODS)
def test_ctrl_c_in_blocks_without_python(method):
    """x rises to 1 and is set back to 0, for ever."""
    builder = saltus.DiagramBuilder()
    one, x, full = builder.add(
        Constant(1.0), Integrator(name="x", enable_reset=True), Comparator(">=")
    )
    builder.connect(one.output(), x.input())
    builder.connect(x.output(), full.input(0))
    builder.connect(one.output(), full.input(1))
    builder.connect(full.output(), x.input("reset_trigger"))
    diagram = builder.build()
    options = {"recorded_signals": {"x": x.output()}, "ode_solver_method": method}
    context, begun = diagram.create_context(), threading.Event()
    error = pressed(
        begun,
        lambda: saltus.simulate(diagram, context, (0.0, 1e9), interrupt=begun.set, **options),
    )
    check_partial(error.results)
    n = len(error.results.events.times("x.reset"))
    assert n > 0
    assert error.results.events.times("x.reset") == pytest.approx(np.arange(1, n + 1), rel=1e-6)
    assert saltus.simulate(diagram, context, (0.0, 1.5), **options).status == "reached_end"


def test_the_simulator_can_be_initialized_again():
    system = Slow("ode")
    simulator = saltus.Simulator(system, recorded_signals={"y": system.output()})
    simulator.initialize(system.create_context())
    pressed(system.begun, lambda: simulator.advance_to(1e9))
    check_partial(simulator.results)
    system.trouble = lambda where, t: 0.0
    simulator.initialize(system.create_context())
    assert simulator.advance_to(2.0) == "reached_end"
    assert np.array_equal(simulator.results.outputs["y"], go(Everything()).outputs["y"])
