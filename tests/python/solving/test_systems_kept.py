"""A call of `solve` that is the same as one before runs the system of that one: it has the bits of
a new one, whatever changes in between, and traces and plans nothing.
"""

import copy
import functools
import gc
import pickle
import weakref
from types import FunctionType

import numpy as np
import pytest
import saltus
from saltus import _core
from saltus.solving.solved_system import SolvedSystem
from saltus.tracing import tracing

RATE = 2.0
SPAN = (0.0, 1.0)


@pytest.fixture
def made(monkeypatch):
    """One entry for each trace and for each plan."""
    entries, sandbox, plan = [], tracing.Sandbox, _core.Plan
    monkeypatch.setattr(tracing, "Sandbox", lambda: entries.append("trace") or sandbox())
    monkeypatch.setattr(_core, "Plan", lambda *a: entries.append("plan") or plan(*a))
    return entries


def fresh(f):
    """The same function, of which nothing is known."""
    new = FunctionType(f.__code__, f.__globals__, f.__name__, f.__defaults__, f.__closure__)
    new.__kwdefaults__ = f.__kwdefaults__
    return new


def bits(solution):
    """All that a solution says, for comparison."""
    statistics = vars(solution.statistics) | {"wall_time": 0.0}
    events = [(e.time, e.name, e.before.tolist(), e.after.tolist()) for e in solution.events]
    said = solution.status, solution.message, solution.t_events and [*map(str, solution.t_events)]
    return solution.t.tobytes(), solution.y.tobytes(), events, said, statistics


class World:
    """What the functions of a ball read."""

    def __init__(self):
        self.loss = 0.5
        self.wind = np.array([0.0, 0.25])
        self.table = {"drag": 0.1}


def ball():
    """What its functions read, and these."""
    world = World()

    def fall(t, x, *, g=9.81):
        drag = world.table["drag"] * x[1] * RATE
        return [x[1], -g - drag + world.wind[1]]

    def height(t, x):
        return x[0]

    def bounce(t, x):
        return [0.0, -world.loss * x[1]]

    return world, fall, height, bounce


def guard_of(height, bounce, **options):
    return saltus.Guard(height, bounce, **({"direction": "falling", "name": "floor"} | options))


def set_global(world, fall, height, bounce):
    globals()["RATE"] = 3.0


def set_code(world, fall, height, bounce):
    height.__code__ = (lambda t, x: x[0] - 0.1).__code__


CHANGES = {
    "an attribute": lambda world, *f: setattr(world, "loss", 0.7),
    "an entry of a dictionary": lambda world, *f: world.table.update(drag=0.5),
    "an array written in place": lambda world, *f: world.wind.__setitem__(1, -0.5),
    "a global": set_global,
    "a default": lambda world, fall, *f: fall.__kwdefaults__.update(g=1.62),
    "the code of a guard": set_code,
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES.keys())
@pytest.mark.parametrize("method", ["dopri5", "bdf", "radau"])
def test_a_change_between_two_calls_is_seen(change, method, monkeypatch):
    monkeypatch.setitem(globals(), "RATE", 2.0)

    def solved(world, fall, height, bounce):
        events = [guard_of(height, bounce)]
        return bits(saltus.solve(fall, (0.0, 2.0), [1.0, 0.0], events=events, method=method))

    parts, others = ball(), ball()
    before = solved(*parts)
    assert solved(*parts) == before
    change(*parts)
    after = solved(*parts)
    monkeypatch.setitem(globals(), "RATE", 2.0)
    change(*others)
    assert after == solved(*others)
    assert after != before


def test_the_same_call_traces_and_plans_nothing(made):
    _, fall, height, bounce = ball()
    runs = []
    for _ in range(4):
        events = [guard_of(height, bounce)]
        runs.append(saltus.solve(fall, (0.0, 2.0), [1.0, 0.0], events=events))
        made.append("end")
    assert made[made.index("end") :] == ["end"] * 4
    assert made.count("plan") == 1
    assert len({bits(run)[0] for run in runs}) == 1
    assert len({id(run.system) for run in runs}) == 1


def decay(t, x, k=1.0, *more):
    return -k * x


CALLS = {
    "another state": {"x0": [2.0]},
    "another sign of zero": {"x0": [-0.0]},
    "more states": {"x0": [1.0, 2.0]},
    "a complex state": {"x0": [1.0 + 1.0j]},
    "another begin": {"t_span": (0.5, 1.0)},
    "another end": {"t_span": (0.0, 0.5)},
    "backward": {"t_span": (0.0, -1.0)},
    "an argument": {"args": (3.0,)},
    "an integer": {"args": (1,)},
    "a negative zero": {"args": (-0.0,)},
    "an array": {"args": (np.array([2.0]),)},
    "an object": {"args": (2.0, [1.0])},
    "a guard": {"events": saltus.Guard(lambda t, x: x[0] - 0.5)},
    "another name": {"events": saltus.Guard(lambda t, x: x[0] - 0.5, name="half")},
    "terminal": {"events": saltus.Guard(lambda t, x: x[0] - 0.5, terminal=True)},
    "no guards": {"events": []},
    "a jacobian": {"jacobian": lambda t, x, k=1.0, *more: [[-k]], "method": "bdf"},
    "a matrix": {"jacobian": [[-1.0]], "method": "bdf"},
    "columns": {"vectorized": True},
    "a tolerance": {"rtol": 1e-9},
    "times": {"t_eval": [0.25, 0.5]},
    "dense": {"dense_output": True},
    "called": {"python": "called"},
    "a first step": {"first_step": 1e-3},
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS.keys())
def test_each_call_is_its_own(call):
    f, plain = fresh(decay), {"t_span": SPAN, "x0": [1.0]}
    for each in (plain, plain | call, plain, plain | call):
        assert bits(saltus.solve(f, **each)) == bits(saltus.solve(fresh(decay), **each))


def test_a_new_function_of_the_same_code_reads_its_own_variables():
    def solver(k):
        return lambda t, x: -k * x

    for k in (1.0, 2.0, 1.0, 3.0):
        solution = saltus.solve(solver(k), SPAN, [1.0], rtol=1e-10)
        assert solution.y[0, -1] == pytest.approx(np.exp(-k), rel=1e-8)


def test_an_event_with_the_attributes_of_scipy_may_change_them():
    f = fresh(decay)

    def half(t, x):
        return x[0] - 0.5

    for terminal, direction in ((False, 0), (True, 0), (True, 1), (False, -1)):
        half.terminal, half.direction = terminal, direction
        solution = saltus.solve(f, SPAN, [1.0], events=half)
        ends = terminal and direction <= 0
        assert (solution.status == "terminal") == ends
        assert len(solution.t_events[0]) == (direction <= 0)


def test_a_called_function_is_called_as_often_each_time():
    """Its number of calls and its shape are those of a new system."""
    calls, result = [], [[0.0]]

    def f(t, x):
        calls.append(t)
        return result[0]

    counts = []
    for _ in range(3):
        calls.clear()
        saltus.solve(f, SPAN, [1.0])
        counts.append(len(calls))
    assert len(set(counts[1:])) == 1
    result[0] = [1.0, 2.0]
    with pytest.raises(saltus.ModelError, match=r"f\(t, x\) returned shape"):
        saltus.solve(f, SPAN, [1.0])


def test_the_system_of_a_solution_may_declare_more():
    f = fresh(decay)
    solution = saltus.solve(f, SPAN, [1.0])
    before = bits(solution)
    solution.system.declare_zero_crossing(lambda t, s: s.continuous_state[0] - 0.5, name="half")
    assert len(saltus.simulate(solution.system, SPAN).events) == 1
    again = saltus.solve(f, SPAN, [1.0])
    assert bits(again) == before
    assert again.system is not solution.system


def test_functions_go_with_their_systems():
    world, fall, height, bounce = ball()
    for _ in range(2):
        solution = saltus.solve(fall, SPAN, [1.0, 0.0], events=[guard_of(height, bounce)])
    gone = [weakref.ref(one) for one in (fall, height, bounce, world, solution.system)]
    del world, fall, height, bounce, solution
    gc.collect()
    assert [one() for one in gone] == [None] * 5


def test_a_function_of_a_module_keeps_no_closure_alive():
    f = fresh(decay)  # it lives on
    world, fall, height, bounce = ball()
    saltus.solve(f, SPAN, [1.0, 0.0], events=[guard_of(height, bounce)])
    gone = weakref.ref(world), weakref.ref(height)
    del world, fall, height, bounce
    gc.collect()
    assert [one() for one in gone] == [None, None]


def test_few_systems_are_kept():
    gc.collect()
    before = sum(isinstance(one, SolvedSystem) for one in gc.get_objects())
    f = fresh(decay)
    for x in range(50):
        saltus.solve(f, SPAN, [float(x)])
    gc.collect()
    after = sum(isinstance(one, SolvedSystem) for one in gc.get_objects())
    assert after - before <= 4


def test_a_copy_of_a_function_has_no_systems():
    f = fresh(decay)
    saltus.solve(f, SPAN, [1.0])
    for copied in (copy.deepcopy(vars(f)), pickle.loads(pickle.dumps(vars(f)))):
        assert not any(copied.values())

    @functools.wraps(f)
    def twice(t, x):
        return [2.0 * value for value in f(t, x)]

    for _ in range(2):
        assert saltus.solve(twice, SPAN, [1.0], rtol=1e-9).y[0, -1] == pytest.approx(np.exp(-2.0))
        assert saltus.solve(f, SPAN, [1.0], rtol=1e-9).y[0, -1] == pytest.approx(np.exp(-1.0))


def test_a_recursive_call():
    """f solves the same problem once, inside its own run."""
    found = []

    def f(t, x):
        if t > 0.3 and not found:
            found.append(None)
            found[0] = saltus.solve(f, SPAN, [1.0]).y[0, -1]
        return -x

    outer = saltus.solve(f, SPAN, [1.0]).y[0, -1]
    assert outer == found[0] == saltus.solve(f, SPAN, [1.0]).y[0, -1]
