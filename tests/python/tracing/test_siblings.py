"""Functions of one code in one system are traced once, if they read the same values."""

import math
import sys

import numpy as np
import pytest
import saltus
from saltus.tracing import Siblings, Traced
from tracing_cases import signature

COUNT = 60


class Cell(saltus.LeafSystem):
    """An oscillator that another one drives; its callbacks are methods, lambdas and a closure."""

    def __init__(self, name, k, law=np.sin):
        super().__init__(name=name)
        self.k, self.law, self.floor = k, law, -0.5
        self.declare_input_port("u")
        self.declare_continuous_state([1.0, 0.0], ode=self.ode)
        self.declare_output_port(self.position, name="y", requires_inputs=False)
        self.declare_zero_crossing(
            lambda t, s: s.continuous_state[0] - self.floor,
            self.hit,
            name="hit",
            direction="falling",
            requires_inputs=False,
        )

    def ode(self, time, state, u):
        x, v = state.continuous_state
        return np.array([v, -self.k * self.law(x) + 0.01 * u])

    def position(self, time, state):
        return state.continuous_state[0]

    def hit(self, time, state):
        x, v = state.continuous_state
        return state.with_continuous_state(np.array([x, -0.5 * v]))


def ring(cells):
    builder = saltus.DiagramBuilder()
    for cell in cells:
        builder.add(cell)
    for before, cell in zip(cells[-1:] + cells[:-1], cells, strict=True):
        builder.connect(before.output_ports[0], cell.input_ports[0])
    return builder.build()


def end(diagram, **options):
    run = saltus.simulate(diagram, diagram.create_context(), (0.0, 3.0), rtol=1e-10, **options)
    return run.context.continuous_state


def test_equal_blocks_are_traced_once(made):
    diagram = ring([Cell(f"c{i}", 1.0) for i in range(COUNT)])
    assert {c.runs for c in diagram.explain()} == {"traced"}
    assert len(made) == 4


def test_only_functions_that_read_other_values_are_traced_again(made):
    diagram = ring([Cell(f"c{i}", 1.0 + 0.1 * i) for i in range(COUNT)])
    assert {c.runs for c in diagram.explain()} == {"traced"}
    assert len(made) == 3 + COUNT


@pytest.mark.parametrize("laws", [[np.sin], [np.sin, np.cos, math.sin, lambda x: x, np.tanh]])
def test_a_shared_trace_has_the_values_of_its_own_block(laws):
    cells = [Cell(f"c{i}", 1.0 + i % 3, laws[i % len(laws)]) for i in range(7)]
    diagram = ring(cells)
    np.testing.assert_allclose(end(diagram), end(diagram, python="called"), rtol=1e-8, atol=1e-10)


def test_a_change_in_one_block_is_seen_there_alone():
    cells = [Cell(f"c{i}", 1.0) for i in range(5)]
    diagram = ring(cells)
    end(diagram)
    cells[3].k, cells[2].floor = 7.0, 0.25
    found = end(diagram)
    fresh = [Cell(f"c{i}", 7.0 if i == 3 else 1.0) for i in range(5)]
    fresh[2].floor = 0.25
    assert found.tolist() == end(ring(fresh)).tolist()


def test_the_bits_do_not_depend_on_the_neighbours():
    lone, other = ring([Cell("c0", 1.7)]), ring([Cell("c0", 1.7)])
    end(ring([Cell(f"c{i}", 1.7) for i in range(5)]))
    assert end(lone).tolist() == end(other).tolist()


def test_many_functions_of_one_code_that_cannot_be_traced_are_tried_once(made):
    def reset(x, k):
        x = np.array(x, float)
        while x[k] > 0.0:  # branches on a value
            x[k] -= 1.0
        return x

    guards = [
        saltus.Guard(
            lambda t, x, k=k: x[k] - 1.0,
            reset=lambda t, x, k=k: reset(x, k),
            direction="rising",
            name=f"n{k}",
        )
        for k in range(COUNT)
    ]
    solution = saltus.solve(lambda t, x: 1.0 - 0.1 * x, (0, 1e-6), np.zeros(COUNT), events=guards)
    assert len(made) == 1 + COUNT + 1  # the ode, the guards, which differ, and the resets
    resets = [c for c in solution.system.explain() if c.callback.startswith("reset")]
    assert {c.runs for c in resets} == {"called"}
    assert len({c.reason for c in resets}) == 1


def test_a_refusal_is_that_of_other_blocks_only_if_they_do_the_same():
    def branches(x):
        return x if x > 0 else -x

    cells = [Cell(f"c{i}", 1.0, law) for i, law in enumerate((branches, np.abs, branches))]
    runs = [c.runs for c in ring(cells).explain() if c.callback == "ode"]
    assert runs == ["called", "traced", "called"]


def test_a_choice_by_a_truth_of_the_block_is_not_shared():
    class Block:
        def __init__(self, on):
            self.on = on

        def f(self, time, state):
            if self.on:
                return state.continuous_state if state.continuous_state[0] > 0 else 0.0
            return -state.continuous_state

    siblings = Siblings()
    found = [siblings.trace(signature(Block.f, owner=Block(on))) for on in (True, False, True)]
    assert [type(one) is Traced for one in found] == [False, True, False]


def test_the_check_of_one_start_says_nothing_about_another():
    def root(time, state):
        return np.sqrt(state.continuous_state)

    siblings = Siblings()
    found = [siblings.trace(signature(root, [x])) for x in (-1e6, 4.0)]
    assert [type(one) is Traced for one in found] == [False, True]


def calls_until_ready(count):
    """How many Python functions are called until `count` leaves of different numbers can run."""
    cells = [Cell(f"c{i}", 1.0 + 1e-3 * i) for i in range(count)]
    calls = 0

    def note(frame, event, argument):
        nonlocal calls
        calls += event == "call"

    sys.setprofile(note)
    try:
        diagram = ring(cells)
        saltus.Simulator(diagram).initialize(diagram.create_context())
    finally:
        sys.setprofile(None)
    return calls


def test_the_work_until_many_leaves_are_ready_is_linear_in_their_number():
    one, few, some, many = (calls_until_ready(count) for count in (1, 50, 100, 200))
    assert many - some <= 2.1 * (some - few)  # twice as many leaves, and one in twenty more
    assert many <= 200 * one / 2  # a leaf like one before it is compared at fewer points


@pytest.mark.parametrize("shared", [False, True])
def test_the_events_of_a_second_solve_are_those_of_the_first(shared):
    """Wrappers of different functions have one code; a kept trace belongs to one of them."""

    def up(t, x):
        return [x[0] - 1.0]

    def down(t, x):
        return [x[0] + 1.0]

    def go():
        high = saltus.Guard(lambda t, x: x[0] - 0.75, up, "rising", "high")
        low = saltus.Guard(lambda t, x: 0.75 + x[0], down, "falling", "low")
        return [high, low]

    events = go()
    found = []
    for _ in range(3):
        solution = saltus.solve(
            lambda t, x: [1.0], (0, 3), [0.0], events=events if shared else go()
        )
        found.append([times.tolist() for times in solution.t_events])
        assert found[-1][1] == []
        assert len(found[-1][0]) == 3
    assert found[0] == found[1] == found[2]
