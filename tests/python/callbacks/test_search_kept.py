"""The search for what called functions write is made again when it could find something else, and
only then.
"""

from types import SimpleNamespace

import numpy as np
import pytest
import saltus
from saltus.tracing.effects import writes

RATE = 1.0


def outside(block):
    """A global function that a called one calls."""


def writing(block):
    block.u = block.u + 1.0


class Helper:
    """Writes nothing, before a test changes it."""

    def help(self, block):
        pass


class Block(saltus.LeafSystem):
    """x' = u, traced; each second `tick`, which is called, calls everything it knows."""

    def __init__(self):
        super().__init__(name="block")
        self.u = 1.0
        self.helper = Helper()
        self.plain = SimpleNamespace(run=outside)
        self.listed = [outside]
        self.named = {"run": outside}
        inner = outside

        def closed(block):
            inner(block)

        def rebind(function):
            nonlocal inner
            inner = function

        def defaulted(block, run=outside):
            run(block)

        self.closed, self.rebind, self.defaulted = closed, rebind, defaulted
        self.declare_continuous_state([0.0], ode=self.ode)
        self.declare_continuous_state_output("x")
        self.declare_periodic_update(self.tick, period=1.0, offset=1.0)

    def ode(self, time, state):
        return [self.u]

    def tick(self, time, state):
        if time > 0.0:  # a branch on a value: it is called
            outside(self)
        self.helper.help(self)
        self.plain.run(self)
        for run in (*self.listed, *self.named.values(), self.closed, self.defaulted):
            run(self)
        return state


def patch_global(block, monkeypatch):
    monkeypatch.setitem(globals(), "outside", writing)


def patch_code(block, monkeypatch):
    monkeypatch.setattr(outside, "__code__", writing.__code__)


CHANGES = {
    "a global": patch_global,
    "the code of a function": patch_code,
    "a method": lambda block, patch: patch.setattr(Helper, "help", lambda self, b: writing(b)),
    "a method of the object": lambda block, patch: patch.setattr(block.helper, "help", writing),
    "another object": lambda block, patch: setattr(block, "helper", SimpleNamespace(help=writing)),
    "another class": lambda block, patch: setattr(
        block.helper,
        "__class__",
        type("Other", (Helper,), {"help": lambda self, block: writing(block)}),
    ),
    "an attribute of an object": lambda block, patch: setattr(block.plain, "run", writing),
    "an entry of a list": lambda block, patch: block.listed.__setitem__(0, writing),
    "one more in a list": lambda block, patch: block.listed.append(writing),
    "an entry of a dictionary": lambda block, patch: block.named.update(run=writing),
    "a variable of a closure": lambda block, patch: block.rebind(writing),
    "a default": lambda block, patch: setattr(block.defaulted, "__defaults__", (writing,)),
}


@pytest.fixture
def searches(monkeypatch):
    """One entry for each callback whose writes are searched."""
    made, reach = [], writes.Reach
    monkeypatch.setattr(writes, "Reach", lambda roots: made.append(1) or reach(roots))
    return made


def end(system, **options):
    system.u = 1.0
    context = system.create_context()
    return float(
        saltus.simulate(system, context, (0.0, 3.5), **options).context.continuous_state[0]
    )


def in_pieces(simulator):
    simulator.system.u = 1.0
    simulator.initialize(simulator.system.create_context())
    simulator.advance_to(3.5)
    return float(simulator.context.continuous_state[0])


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES.keys())
def test_a_writer_that_comes_between_two_runs_is_found(change, monkeypatch):
    """After it u is 1, 2, 3, 4 in the four stretches; a list that has one more calls it twice."""
    block = Block()
    simulator = saltus.Simulator(block)
    assert end(block) == in_pieces(simulator) == pytest.approx(3.5, rel=1e-12)
    assert {c.callback: c.runs for c in block.explain()}["ode"] == "traced"
    assert end(block) == in_pieces(simulator) == pytest.approx(3.5, rel=1e-12)
    change(block, monkeypatch)
    found = end(block)
    assert found == in_pieces(simulator) == end(block, python="called")
    assert found > 4.0
    assert {c.callback: c.runs for c in block.explain()}["ode"] == "called"


def test_nothing_is_searched_again_while_nothing_changes(searches):
    block = Block()
    simulator = saltus.Simulator(block)
    end(block), in_pieces(simulator), end(block), in_pieces(simulator)
    done = len(searches)
    assert done > 0
    for _ in range(3):
        assert end(block) == in_pieces(simulator)
        simulator.advance_to(4.0)
    assert len(searches) == done


def test_an_array_of_objects_is_looked_into(monkeypatch):
    block = Block()
    block.listed = np.array([outside], dtype=object)
    assert end(block) == end(block) == pytest.approx(3.5, rel=1e-12)
    block.listed[0] = writing
    assert end(block) == end(block, python="called") > 4.0
