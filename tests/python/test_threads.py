"""The lock of the interpreter is free during a run, and Ctrl-C ends one."""

import os
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import saltus
from saltus.library import Integrator, Pulse, Sine
from systems import Ball, Decay, run


def oscillator():
    """All C++: no callback takes the lock."""
    builder = saltus.DiagramBuilder()
    sine, x = builder.add(Sine(name="sine"), Integrator(name="x"))
    builder.connect(sine.output(), x.input())
    return builder.build()


def ticks_only():
    return Pulse(period=1e-3, name="pulse")


def python_leaf():
    def slow(t, state):
        time.sleep(0.001)

    return Decay(slow)


def test_another_thread_goes_on():
    """The run ends because another thread has counted, which a held lock would prevent."""
    diagram, counted = oscillator(), threading.Event()

    def count():
        for _ in range(1000):
            time.sleep(0)  # gives the lock away, so that only a run that holds it can stop us
        counted.set()

    worker = threading.Thread(target=count)
    asked = []

    def stop():
        if not asked:
            worker.start()
        asked.append(counted.is_set())
        return asked[-1]

    options = {"interrupt": stop, "record_events": False, "throw": False}
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 1e9), **options)
    worker.join()
    assert results.status == "interrupted"
    assert len(asked) < 100


def test_two_runs_at_once_are_both_inside():
    """Each run waits in a callback for the other: possible only if both are under way at once."""
    barrier = threading.Barrier(2, timeout=20)
    met = []

    def meet(t, state):
        if t > 0.3 and threading.get_ident() not in met:
            met.append(threading.get_ident())
            barrier.wait()

    def one():
        system = Decay(meet)
        return saltus.simulate(system, system.create_context(), (0.0, 0.6)).status

    with ThreadPoolExecutor(2) as pool:
        assert [task.result() for task in [pool.submit(one), pool.submit(one)]] == [
            "reached_end"
        ] * 2
    assert len(met) == 2


def test_many_runs_of_one_system_give_the_bits_of_one():
    ball = Ball()
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    heights = [5.0 + i for i in range(4)]

    def one(height):
        return run(
            ball,
            (0.0, 12.0),
            context.with_continuous_state([height, 0.0]).with_parameter("g", height),
        )

    alone = [one(height) for height in heights]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(one, heights * 4))
    for i, results in enumerate(together):
        assert np.array_equal(results.outputs["state"], alone[i % 4].outputs["state"])


def press_after(begun):
    """Ctrl-C, once the event is set."""
    begun.wait()
    os.kill(os.getpid(), signal.SIGINT)


@pytest.mark.parametrize("make", [oscillator, ticks_only, python_leaf])
def test_ctrl_c(make):
    system, begun = make(), threading.Event()
    thread = threading.Thread(target=press_after, args=(begun,))
    thread.start()
    with pytest.raises(KeyboardInterrupt) as caught:
        saltus.simulate(
            system,
            system.create_context(),
            (0.0, 1e9),
            recorded_signals={"y": system.output()} if system.output_names else None,
            record_events=False,
            save_at=[1e9],
            interrupt=begun.set,  # asked when the run is under way; answers None
        )
    results = caught.value.results
    assert results.status == "interrupted"
    assert 0.0 < results.context.time < 1e9
    assert results.cause is None
    thread.join()


def test_ctrl_c_with_throw_off_returns_the_results():
    diagram, begun = oscillator(), threading.Event()
    thread = threading.Thread(target=press_after, args=(begun,))
    thread.start()
    options = {"throw": False, "interrupt": begun.set}
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 1e9), **options)
    assert results.status == "interrupted"
    thread.join()


def test_another_signal_handler_may_raise():
    class Alarm(Exception):
        pass

    def ring(number, frame):
        raise Alarm

    before = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    diagram = oscillator()
    try:
        with pytest.raises(Alarm):
            saltus.simulate(diagram, diagram.create_context(), (0.0, 1e9))
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def test_interrupt_option():
    diagram = oscillator()
    asked = []

    def stop():
        asked.append(True)
        return len(asked) == 3

    with pytest.raises(saltus.SimulationError, match="interrupted") as caught:
        saltus.simulate(diagram, diagram.create_context(), (0.0, 1e9), interrupt=stop)
    assert caught.value.results.status == "interrupted"
    assert caught.value.results.statistics.steps > 100 * len(asked)
