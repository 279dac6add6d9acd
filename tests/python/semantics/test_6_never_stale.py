"""A value that one callback writes has its present value wherever another one reads it."""

import ctypes
import threading

import numpy as np
import pytest
import saltus
from places import PLACES
from saltus import Guard, solve

STEP = 0.25  # [s] between two writes
LATER = 0.07  # [s] of a reader after a writer


class Both(saltus.LeafSystem):
    """One callback, one of WRITERS, writes to a place, and one of READERS reads it."""

    def __init__(self, name, place, writer=None, reader=None):
        super().__init__(name=name)
        self.read, self.write = place
        self.declare_discrete_state([0.0])
        self.declare_continuous_state([0.0, 0.0], ode=self.ode)
        self.declare_output_port(self.out, name="y")
        self.writer, self.reader = writer, reader
        if writer == "update":
            self.declare_periodic_update(self.on_update, STEP)
        if writer == "one shot":
            self.declare_one_shot(self.on_update, STEP)
        if writer == "reset map":
            self.declare_zero_crossing(self.clock, self.on_reset, name="w", direction="rising")
        if writer == "guard":
            self.declare_zero_crossing(self.on_guard, name="w", direction="rising")
        if writer == "relation":
            self.declare_relation(self.on_guard, name="r")
        if reader == "update":
            self.declare_periodic_update(self.by_update, STEP, LATER)
        if reader == "guard":
            self.declare_zero_crossing(self.by_guard, self.count, name="g", direction="rising")
        if reader == "reset map":
            self.declare_zero_crossing(self.later, self.by_reset, name="g", direction="rising")

    def value(self, time):
        return 2.0 + np.floor(time / STEP + 0.5)

    def clock(self, time, state):
        return np.sin(2.0 * np.pi * time / STEP - 1.0)

    def later(self, time, state):
        return np.sin(2.0 * np.pi * time / STEP - 3.0)

    def ode(self, time, state):
        if self.writer == "ode":
            self.write(self.value(time))
        if self.writer == "relation":
            _ = state.relations  # otherwise nobody reads it
        return [self.read() if self.reader == "ode" else 1.0, 1.0]

    def out(self, time, state):
        if self.writer == "output":
            self.write(self.value(time))
        return self.read() if self.reader == "output" else 1.0

    def on_update(self, time, state):
        self.write(self.value(time))
        return state

    on_reset = on_update

    def on_guard(self, time, state):
        self.write(self.value(time))
        return self.clock(time, state)

    def by_update(self, time, state):
        return state.with_discrete_state(state.discrete_state + self.read())

    def by_reset(self, time, state):
        x = state.continuous_state
        return state.with_continuous_state(np.array([x[0] + self.read(), x[1]]))

    def by_guard(self, time, state):
        return np.sin(2.0 * np.pi * time / STEP - 0.3 * self.read())

    def count(self, time, state):
        return state.with_discrete_state(state.discrete_state + 1.0)


WRITERS = ("update", "one shot", "reset map", "guard", "relation", "ode", "output")
READERS = ("ode", "guard", "reset map", "update", "output")


def run(system, signal, python):
    options = {"python": python, "max_minor_step_size": 0.03}
    simulator = saltus.Simulator(system, recorded_signals=signal, rtol=1e-10, **options)
    simulator.initialize(system.create_context())
    simulator.advance_to(1.1)
    return simulator.results


def leaf(place, writer, reader, python):
    block = Both("b", PLACES[place](), writer, reader)
    return run(block, {"y": block.output("y")}, python), block


def two_leaves(place, writer, reader, python):
    shared = PLACES[place]()
    builder = saltus.DiagramBuilder()
    one, other = builder.add(Both("one", shared, writer), Both("other", shared, None, reader))
    diagram = builder.build()
    signals = {"y": other.output("y"), "one": one.output("y")}
    return run(diagram, signals, python), diagram


CONTINUOUS = {"guard", "relation", "ode", "output"}  # called at stages and while a root is located


def compare(made, place, writer, reader):
    """The same events and states, whether all functions are called or only some.

    Which steps are taken may differ: a trace tells that the ode reads no discrete state. A writer
    that is called within steps writes up to one step of 0.03 s sooner or later then, and its value
    grows by 1.0 at 5 times.
    """
    expected, _ = made(place, writer, reader, "called")
    found, system = made(place, writer, reader, "traced")
    bound = 5 * 0.03 if writer in CONTINUOUS else 1e-8
    assert [e.name for e in found.events] == [e.name for e in expected.events]
    for one, other in zip(found.events, expected.events, strict=True):
        assert one.time == pytest.approx(other.time, abs=bound)
    ends = [np.ravel(results.context.continuous_state) for results in (found, expected)]
    np.testing.assert_allclose(*ends, rtol=0.0, atol=bound)
    lasts = [results.outputs["y"][-1] for results in (found, expected)]
    np.testing.assert_allclose(*lasts, rtol=0.0, atol=bound)
    return system


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("made", (leaf, two_leaves))
def test_6_5_an_ode_sees_what_an_update_wrote_in_any_place(place, made):
    system = compare(made, place, "update", "ode")
    runs = {(c.block, c.callback): c.runs for c in system.explain()}
    assert runs[min(runs, key=lambda key: (key[1] != "ode", key[0] != "other"))] == "called"


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("writer", WRITERS)
@pytest.mark.parametrize("made", (leaf, two_leaves))
@pytest.mark.parametrize("place", ("attribute", "array_in_place", "object_by_its_method"))
def test_6_5_every_reader_sees_what_every_writer_wrote(place, made, writer, reader):
    compare(made, place, writer, reader)


@pytest.mark.parametrize("place", PLACES)
def test_6_5_the_functions_of_solve_see_what_a_reset_wrote(place):
    def solved(**options):
        read, write = PLACES[place]()

        def reset(t, x):
            write(2.0 + round(t))
            return x

        guard = Guard(lambda t, x: np.sin(np.pi * t), reset=reset, direction="rising", name="w")
        level = Guard(lambda t, x: x[0] - 3.0 * read(), name="level")
        s = solve(lambda t, x: [read()], (0.1, 5.5), [0.0], events=[guard, level], **options)
        return np.concatenate([s.y[0, -1:], *s.t_events])

    np.testing.assert_allclose(solved(), solved(python="called"), rtol=1e-8)


def test_explain_names_the_value_and_its_writer():
    block = Both("b", PLACES["attribute"](), "update", "ode")
    (ode,) = (c for c in block.explain() if c.callback == "ode")
    assert ode.runs == "called"
    assert "reads place.u, which the periodic update 'periodic_0' of 'b' may write" in ode.reason


def test_explain_says_when_it_cannot_know():
    block = Both("b", PLACES["attribute_by_a_computed_name"](), "update", "ode")
    (ode,) = (c for c in block.explain() if c.callback == "ode")
    assert "may write anything, as it uses vars" in ode.reason


def test_a_write_that_no_code_shows_ends_the_run():
    """Another thread is no callback of the run; its write is noticed at the end."""
    block = Both("b", PLACES["attribute"](), None, "ode")
    asked, done = threading.Event(), threading.Event()

    def elsewhere():
        asked.wait()
        block.write(3.0)
        done.set()

    def ask(time, state):
        asked.set()
        done.wait()
        return state

    threading.Thread(target=elsewhere, daemon=True).start()
    block.declare_one_shot(ask, 0.5)
    with pytest.raises(saltus.SimulationError, match=r"is 3\.0: something wrote it") as error:
        saltus.simulate(block, block.create_context(), (0.0, 1.0))
    assert error.value.results.status == "reached_end"


def test_a_progress_function_may_write():
    block = Both("b", PLACES["attribute"](), None, "ode")
    simulator = saltus.Simulator(block, progress=lambda *seen: block.write(2.0))
    simulator.initialize(block.create_context())
    assert simulator._callbacks.explain()[0].runs == "called"
    assert {c.runs for c in block.explain()} == {"traced"}


def test_a_callback_that_is_led_elsewhere_by_what_another_wrote_may_write_too():
    """The ode logs once it is told to; it traces only as long as it is not."""

    def run(python):
        block = saltus.LeafSystem(name="b")
        block.on, block.seen = False, 1.0

        def ode(t, s):
            if block.on:
                block.seen = 2.0
            return [1.0]

        def switch(t, s):
            block.on = True
            return s

        block.declare_continuous_state([0.0], ode=ode)
        block.declare_output_port(lambda t, s: block.seen, name="y")
        block.declare_one_shot(switch, 0.5)
        simulator = saltus.Simulator(block, recorded_signals={"y": block.output()}, python=python)
        simulator.initialize(block.create_context())
        simulator.advance_to(1.0)
        return simulator.results.outputs["y"][-1]

    assert run("traced") == run("called") == 2.0


def test_a_compiled_function_that_is_python_after_all_may_write():
    number, numbers = ctypes.c_double, ctypes.POINTER(ctypes.c_double)
    kind = ctypes.CFUNCTYPE(
        ctypes.c_int, number, numbers, numbers, numbers, numbers, ctypes.c_void_p
    )
    read, write = PLACES["list_entry"]()

    @kind
    def level(t, x, u, p, out, user_data):
        write(2.0)
        out[0] = 1.0
        return 0

    block = saltus.LeafSystem(name="b")
    block.declare_continuous_state([0.0], ode=lambda t, s: [read()])
    block.declare_zero_crossing(level, name="level")
    assert [c.runs for c in block.explain()] == ["called", "compiled"]
