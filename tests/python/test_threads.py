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


def other_thread_counts_while(action):
    """How often another Python thread ran while `action` did, and how long that was [s]."""
    stop, count = threading.Event(), [0]

    def work():
        while not stop.is_set():
            count[0] += 1
            time.sleep(0)  # gives the lock away, so that only a run that holds it can stop us

    worker = threading.Thread(target=work)
    worker.start()
    start, before = time.perf_counter(), count[0]
    action()
    took, counted = time.perf_counter() - start, count[0] - before
    stop.set()
    worker.join()
    return counted, took


def test_another_thread_goes_on():
    diagram = oscillator()
    context = diagram.create_context()
    # some 3e5 minor steps: a tenth of a second in which nobody gives the lock away if it is held
    counted, took = other_thread_counts_while(lambda: saltus.simulate(diagram, context, (0.0, 2e5)))
    assert counted > 100 * took


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


@pytest.mark.parametrize("make", [oscillator, ticks_only, python_leaf])
def test_ctrl_c(make):
    system = make()
    stamp = []

    def press():
        stamp.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(0.3, press)
    timer.start()
    with pytest.raises(KeyboardInterrupt) as caught:
        saltus.simulate(
            system,
            system.create_context(),
            (0.0, 1e9),
            recorded_signals={"y": system.output()} if system.output_names else None,
            record_events=False,
            save_at=[1e9],
        )
    assert time.perf_counter() - stamp[0] < 0.2
    results = caught.value.results
    assert results.status == "interrupted"
    assert 0.0 < results.context.time < 1e9
    assert results.cause is None
    timer.join()


def test_ctrl_c_with_throw_off_returns_the_results():
    diagram = oscillator()
    timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 1e9), throw=False)
    assert results.status == "interrupted"
    timer.join()


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
        asked.append(time.perf_counter())
        return len(asked) == 3

    with pytest.raises(saltus.SimulationError, match="interrupted") as caught:
        saltus.simulate(diagram, diagram.create_context(), (0.0, 1e9), interrupt=stop)
    assert caught.value.results.status == "interrupted"
    assert min(np.diff(asked)) > 0.015  # about every 20 ms
