"""A kept plan is used by several runs at once: of threads, of callbacks, of processes."""

import os
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest
import saltus
from systems import Ball
from whole_runs import SPAN, bits, run


class Inner(saltus.LeafSystem):
    """x' = -x; its derivative runs `inside` once. It is called: it branches on a value."""

    def __init__(self):
        super().__init__(name="inner")
        self.inside = None
        self.declare_continuous_state(default_value=[1.0], ode=self.ode)
        self.declare_continuous_state_output("state")

    def ode(self, time, state):
        if time > 0.3 and self.inside is not None:
            inside, self.inside = self.inside, None
            inside()
        return -state.continuous_state


def test_a_callback_may_run_its_own_system():
    system, found = Inner(), []
    alone = bits(run(system))
    for _ in range(2):
        system.inside = lambda: found.append(bits(run(system)))
        assert bits(run(system)) == alone
    assert found == [alone, alone]


def test_threads_share_a_plan_and_no_run():
    """The two runs are under way at once: each waits for the other."""
    barrier = threading.Barrier(2, timeout=20)

    class Both(Inner):
        def ode(self, time, state):
            if time > 0.3 and threading.get_ident() not in self.met:
                self.met.add(threading.get_ident())
                barrier.wait()
            return -state.continuous_state

    both = Both()
    both.met = {threading.get_ident()}
    expected = bits(run(both))
    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(lambda _: bits(run(both)), range(2))) == [expected] * 2
    assert len(both.met) == 3


@pytest.mark.parametrize("throw", [True, False])
def test_an_exception_leaves_the_plan_as_it_was(throw):
    system = Inner()
    alone = bits(run(system))

    def fail():
        raise RuntimeError("once")

    system.inside = fail
    if throw:
        with pytest.raises(RuntimeError, match="once") as caught:
            run(system)
        results = caught.value.results
    else:
        results = run(system, throw=False)
    assert results.status == "failed"
    assert 0.0 < results.time[-1] < SPAN[1]
    assert bits(run(system)) == alone


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_forked_process_uses_the_plans():
    model = Ball()
    expected = bits(run(model))[0]
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:  # nothing of pytest may run here
        same = False
        try:
            same = bits(run(model))[0] == expected
        finally:
            os.write(writer, b"y" if same else b"n")
            os._exit(0)
    os.close(writer)
    assert os.read(reader, 1) == b"y"
    os.close(reader)
    os.waitpid(child, 0)
    assert bits(run(model))[0] == expected


def test_declaring_more_is_refused_while_a_run_is_under_way():
    system = Inner()
    run(system)
    refused = []

    def declare():
        with pytest.raises(saltus.ModelError, match="in use"):
            system.declare_dynamic_parameter("k", 1.0)
        refused.append(1)

    system.inside = declare
    run(system)
    assert refused
