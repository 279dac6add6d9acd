"""Values outside of the states that one callback writes and another reads (docs/semantics.md, 6.5).

The law of the file: k = 1 + the number of firings, at 1, 2, 3 and 4 s, and x' = k. So x(4.5) = 1 + 2 +
3 + 4 + 2.5 = 12.5. Between firings x moves on a straight line, of which every method has the rounding
only, once it begins anew at each firing.
"""

import itertools

import numpy as np
import pytest
import saltus
from saltus.library import Constant, FunctionBlock, Integrator, ReduceBlock, SourceBlock

METHODS = ["auto", "dopri5", "dop853", "radau", "bdf", "adams"]  # taylor takes no called derivative
EXPECTED = 12.5
ROUNDING = 1e-9  # five pieces, of which bdf and adams have some roundings a step


class Shared:
    """An attribute of an object that several functions know."""

    def __init__(self):
        self.k = 1.0

    def read(self):
        return self.k

    def write(self):
        self.k = self.k + 1.0


class Entry(Shared):
    """An entry of a dict."""

    def __init__(self):
        self.all = {"k": 1.0}

    def read(self):
        return self.all["k"]

    def write(self):
        self.all["k"] = self.all["k"] + 1.0


class Numbers(Shared):
    """An entry of an array."""

    def __init__(self):
        self.all = np.ones(2)

    def read(self):
        return self.all[1]

    def write(self):
        self.all[1] += 1.0


class Length(Shared):
    """The length of a list."""

    def __init__(self):
        self.all = [0]

    def read(self):
        return 1.0 * len(self.all)

    def write(self):
        self.all.append(0)


class Variable(Shared):
    """A variable of the function around two functions."""

    def __init__(self):
        k = 1.0

        def read():
            return k

        def write():
            nonlocal k
            k = k + 1.0

        self.read, self.write = read, write


PLACES = [Shared, Entry, Numbers, Length, Variable]


def by_update(leaf, shared):
    def tick(t, s):
        shared.write()
        return s

    leaf.declare_periodic_update(tick, period=1.0, offset=1.0)


def by_guard(leaf, shared):
    def hit(t, s):
        shared.write()
        return s

    leaf.declare_zero_crossing(
        lambda t, s: np.sin(np.pi * t), hit, name="hit", direction="both", at_start="ignore"
    )


WRITERS = [by_update, by_guard]


def writer(shared, declare):
    """A block whose callback writes, and leaves its own state as it is."""
    leaf = saltus.LeafSystem(name="writer")
    leaf.declare_continuous_state([0.0], ode=lambda t, s: [1.0])
    declare(leaf, shared)
    return leaf


def in_one_leaf(shared, declare):
    leaf = saltus.LeafSystem(name="leaf")
    leaf.declare_continuous_state([0.0], ode=lambda t, s: [shared.read()])
    declare(leaf, shared)
    return leaf


def in_two_leaves(shared, declare):
    reader = saltus.LeafSystem(name="reader")
    reader.declare_continuous_state([0.0], ode=lambda t, s: [shared.read()])
    builder = saltus.DiagramBuilder()
    builder.add(writer(shared, declare), reader)
    return builder.build()


def behind(make):
    """A block behind a constant, or without an input, before an integrator."""

    def system(shared, declare):
        builder = saltus.DiagramBuilder()
        builder.add(writer(shared, declare))
        block = builder.add(make(shared))
        for port in block.input_ports:
            one = builder.add(Constant(1.0))
            builder.connect(one.output(), port)
        x = builder.add(Integrator(0.0, name="x"))
        builder.connect(block.output(0), x.input())
        return builder.build()

    return system


def twice_called(u, shared):
    """A function that tracing refuses, because it branches."""
    return shared.read() * u if u > 0.5 else 0.0


SYSTEMS = {
    "one leaf": in_one_leaf,
    "two leaves": in_two_leaves,
    "function": behind(lambda shared: FunctionBlock(lambda u: shared.read() * u)),
    "refused": behind(lambda shared: FunctionBlock(lambda u: twice_called(u, shared))),
    "reduced": behind(lambda shared: ReduceBlock(1, lambda u: shared.read() * u[0])),
    "source": behind(lambda shared: SourceBlock(lambda t: shared.read())),
}


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("declare", WRITERS)
@pytest.mark.parametrize("system", SYSTEMS)
def test_a_reader_sees_what_was_written(place, declare, system):
    for method, python in itertools.product(METHODS, ("traced", "called")):
        made = SYSTEMS[system](place(), declare)
        run = saltus.simulate(made, (0, 4.5), ode_solver_method=method, python=python)
        found = run.context.continuous_state[-1]
        assert found == pytest.approx(EXPECTED, abs=ROUNDING), (method, python)


@pytest.mark.parametrize("declare", WRITERS)
def test_readers_and_writers_belong_to_one_island(declare):
    run = saltus.simulate(in_two_leaves(Shared(), declare), (0, 4.5), islands=True)
    assert run.context.continuous_state[-1] == pytest.approx(EXPECTED, abs=ROUNDING)


def test_a_guard_sees_what_was_written():
    """The level follows the number of ticks: x = t passes it at 2.5 s, when it goes from 3.5 to 2.5."""
    shared = Shared()
    leaf = saltus.LeafSystem(name="leaf")
    leaf.declare_continuous_state([0.0], ode=lambda t, s: [1.0])
    leaf.declare_zero_crossing(
        lambda t, s: s.continuous_state[0] - 5.5 + shared.k, lambda t, s: s, name="level"
    )
    by_update(leaf, shared)
    run = saltus.simulate(leaf, (0, 4.5))
    assert run.events.times("level") == pytest.approx([2.5], abs=ROUNDING)


def test_a_triangle_wave_turns_by_an_attribute():
    """The slope is an attribute: x turns at 0.5, 1.5, ... from 0.5, so x(5.25) = 0.25."""

    class Triangle(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="triangle")
            self.slope = 1.0
            self.declare_continuous_state([0.5], ode=lambda t, s: [self.slope])
            for level, slope, direction in ((1.0, -1.0, "rising"), (0.0, 1.0, "falling")):
                self.declare_zero_crossing(
                    lambda t, s, level=level: s.continuous_state[0] - level,
                    lambda t, s, slope=slope: self.turn(s, slope),
                    name=f"turn {level}",
                    direction=direction,
                )

        def turn(self, state, slope):
            self.slope = slope
            return state

    for method, python in itertools.product(METHODS, ("traced", "called")):
        run = saltus.simulate(Triangle(), (0, 5.25), ode_solver_method=method, python=python)
        turns = [event.time for event in run.events]
        assert turns == pytest.approx([0.5, 1.5, 2.5, 3.5, 4.5], abs=1e-9), (method, python)
        assert run.context.continuous_state[0] == pytest.approx(0.25, abs=1e-9), (method, python)


def test_what_nobody_reads_restarts_nothing():
    """A list that an update fills is read by no callback: the steps are those without it."""

    def made(note):
        log = []
        leaf = saltus.LeafSystem(name="leaf")
        leaf.declare_continuous_state([1.0], ode=lambda t, s: [-s.continuous_state[0]])

        def tick(t, s):
            if note:
                log.append(t)
            return s

        leaf.declare_periodic_update(tick, period=1.0)
        return leaf, log

    (plain, _), (noted, log) = made(False), made(True)
    a, b = (saltus.simulate(leaf, (0, 4.5)) for leaf in (plain, noted))
    assert log == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert (a.statistics.steps, a.statistics.restarts) == (
        b.statistics.steps,
        b.statistics.restarts,
    )
    assert list(a.context.continuous_state) == list(b.context.continuous_state)


def test_a_simulator_goes_on_with_written_values():
    shared = Shared()
    system = in_one_leaf(shared, by_update)
    simulator = saltus.Simulator(system)
    simulator.initialize(system.create_context())
    for t in (0.5, 1.0, 2.7, 4.5):
        simulator.advance_to(t)
    assert simulator.context.continuous_state[0] == pytest.approx(EXPECTED, abs=ROUNDING)
