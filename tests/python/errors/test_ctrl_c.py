"""6.4: Ctrl-C ends a run within 0.2 s with the partial result, whatever the run is doing."""

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
    """Waits a little in one of its callbacks."""

    def __init__(self, where):
        super().__init__(lambda place, t: time.sleep(1e-3) or 0.0 if place == where else 0.0)


def pressed_after(delay, run):
    """What `run` raised and how long after Ctrl-C that was [s]."""
    stamp = []

    def press():
        stamp.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(delay, press)
    timer.start()
    with pytest.raises(KeyboardInterrupt) as caught:
        run()
    took = time.perf_counter() - stamp[0]
    timer.join()
    return caught.value, took


def check_partial(results):
    assert results.status == "interrupted"
    assert results.message.startswith("t = ")
    assert results.cause is None
    assert 0.0 < results.context.time < 1e9
    assert len(results.time) > 0
    assert results.time[0] == 0.0


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("where", ["ode", "guard", "update"])
def test_6_4_ctrl_c_in_a_python_callback(where, method):
    system = Slow(where)
    error, took = pressed_after(0.1, lambda: go(system, end=1e9, method=method))
    assert took < 0.2
    check_partial(error.results)
    check_works(system, method)


@pytest.mark.parametrize("method", METHODS)
def test_6_4_ctrl_c_in_blocks_without_python(method):
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
    context = diagram.create_context()
    error, took = pressed_after(
        0.1, lambda: saltus.simulate(diagram, context, (0.0, 1e9), **options)
    )
    assert took < 0.2
    check_partial(error.results)
    n = len(error.results.events.times("x.reset"))
    assert n > 0
    assert error.results.events.times("x.reset") == pytest.approx(np.arange(1, n + 1), rel=1e-6)
    assert saltus.simulate(diagram, context, (0.0, 1.5), **options).status == "reached_end"


def test_6_4_the_simulator_can_be_initialized_again():
    system = Slow("ode")
    simulator = saltus.Simulator(system, recorded_signals={"y": system.output()})
    simulator.initialize(system.create_context())
    pressed_after(0.1, lambda: simulator.advance_to(1e9))
    check_partial(simulator.results)
    system.trouble = lambda where, t: 0.0
    simulator.initialize(system.create_context())
    assert simulator.advance_to(2.0) == "reached_end"
    assert np.array_equal(simulator.results.outputs["y"], go(Everything()).outputs["y"])
