"""A function is traced once, not at each run; what it reads is still followed, and it can go."""

import copy
import functools
import gc
import pickle
import weakref
from types import FunctionType, SimpleNamespace

import numpy as np
import pytest
import saltus
from saltus.tracing import Refused, Traced, trace
from tracing_cases import signature

RATE = 2.0


def decay(t, x):
    return [-RATE * x[0]]


def fresh(f):
    """The same function, of which nothing is known."""
    made = FunctionType(f.__code__, f.__globals__, f.__name__, f.__defaults__, f.__closure__)
    made.__kwdefaults__ = f.__kwdefaults__
    return made


def end(f, x0=(1.0,), **options):
    return saltus.solve(f, (0.0, 1.0), x0, rtol=1e-10, **options).y[:, -1]


def end_anew(f, *arguments, **options):
    return end(fresh(f), *arguments, **options)


def ball():
    guard = lambda t, x: x[0]  # noqa: E731
    bounce = lambda t, x: [0.0, -0.5 * x[1]]  # noqa: E731
    floor = saltus.Guard(guard, reset=bounce, direction="falling", name="floor")
    return lambda t, x: [x[1], -9.81], floor


@pytest.mark.parametrize("method", ["dopri5", "bdf"])
def test_a_second_solve_has_the_same_bits_and_traces_nothing(made, method):
    f, floor = ball()
    runs = [saltus.solve(f, (0.0, 2.0), [1.0, 0.0], events=floor, method=method) for _ in range(3)]
    assert len(made) == 3  # f, guard and reset
    anew = saltus.solve(fresh(f), (0.0, 2.0), [1.0, 0.0], events=floor, method=method)
    assert len(made) == 4
    for run in (*runs[1:], anew):
        assert np.array_equal(run.t, runs[0].t)
        assert np.array_equal(run.y, runs[0].y)
        assert [callback.runs for callback in run.system.explain()] == ["traced"] * 3


def test_it_is_traced_once_for_every_start_and_has_the_bits_of_a_new_trace(made):
    f = fresh(decay)
    for x in (1.0, 2.0, -3.0):
        assert end(f, [x]) == end_anew(decay, [x])
    assert len(made) == 1 + 3


def test_other_sizes_and_arguments_are_traced_for_themselves(made):
    def f(t, x, k):
        return -k * x

    for x0, k in (([1.0], 1.0), ([1.0, 2.0], 1.0), ([1.0], 3.0), ([1.0], 1.0)):
        assert np.array_equal(end(f, x0, args=(k,)), end_anew(f, x0, args=(k,)))
    assert end(f, args=(3.0,)) == pytest.approx([np.exp(-3.0)], rel=1e-8)


def test_changed_globals_closures_defaults_and_attributes_are_seen(monkeypatch):
    k, table, model = 1.0, [1.0], SimpleNamespace(k=1.0)

    def f(t, x, *, factor=1.0):
        return [-RATE * k * table[0] * model.k * factor * x[0]]

    seen = [end(f)[0]]

    def look():
        now = end(f)[0]
        assert now == end_anew(f)[0]
        assert now not in seen
        seen.append(now)

    monkeypatch.setitem(globals(), "RATE", 3.0)
    look()
    k = 1.25
    look()
    table[0] = 1.5
    look()
    model.k = 1.75
    look()
    f.__kwdefaults__["factor"] = 2.0
    look()
    f.__code__ = (lambda t, x, *, factor=1.0: [0.0 * k * table[0] * model.k]).__code__
    assert end(f)[0] == 1.0
    assert seen[-1] == pytest.approx(np.exp(-3.0 * 1.25 * 1.5 * 1.75 * 2.0), rel=1e-7)


def test_arguments_that_change_in_place_are_seen_also_by_an_earlier_solution():
    def f(t, x, k):
        return -k[0] * x

    first, second = np.array([1.0]), np.array([1.0])
    assert end(f, args=(first,)) == end(f, args=(second,))
    solution = saltus.solve(f, (0.0, 1.0), [1.0], args=(second,))
    context = solution.system.create_context()
    before = saltus.simulate(solution.system, context, (0.0, 1.0)).context.continuous_state
    second[0] = 2.0
    after = saltus.simulate(solution.system, context, (0.0, 1.0)).context.continuous_state
    assert after == pytest.approx(before**2, rel=1e-4)  # exp(-2) of exp(-1)
    assert end(f, args=(first,)) == pytest.approx([np.exp(-1.0)], rel=1e-8)
    assert end(f, args=(second,)) == pytest.approx([np.exp(-2.0)], rel=1e-8)


def test_the_check_is_made_again_around_other_values():
    """Around -1e6 the square root is nowhere finite."""

    def root(t, s):
        return np.sqrt(s.continuous_state)

    for x in ([1.0], [-1e6], [4.0]):
        kept, new = trace(signature(root, x)), trace(signature(fresh(root), x))
        assert type(kept) is type(new) is (Refused if x[0] < 0 else Traced)
        if isinstance(new, Refused):
            assert kept.reason == new.reason
        else:
            assert kept.compared == new.compared
            assert kept.tape.to_string() == new.tape.to_string()


def test_a_refusal_is_kept_until_what_it_read_changes(made):
    flag = True

    def f(t, s):
        return s.continuous_state if not flag or t > 0 else 0.0

    assert isinstance(trace(signature(f)), Refused)
    assert isinstance(trace(signature(f)), Refused)
    assert len(made) == 1
    flag = False
    assert isinstance(trace(signature(f)), Traced)


def test_a_function_that_fills_out_is_kept_too(made):
    def f(t, x, out):
        out[0] = -2.0 * x[0]

    assert end(f) == end(f)
    assert len(made) == 1


def test_a_function_that_several_blocks_share_is_traced_once(made):
    def ode(time, state, *, k):
        return -k * state.continuous_state

    class Decay(saltus.LeafSystem):
        def __init__(self, k):
            super().__init__()
            self.declare_dynamic_parameter("k", k)
            self.declare_continuous_state([1.0], ode=ode)

    for k in (1.0, 2.0):
        block = Decay(k)
        x = saltus.simulate(block, block.create_context(), (0.0, 1.0), rtol=1e-10).context
        assert x.continuous_state == pytest.approx([np.exp(-k)], rel=1e-8)
    assert len(made) == 1


def selfish():
    """A function that refers to itself by its closure, as a function that it calls does, and one
    by the globals it stands in.
    """
    model = SimpleNamespace(k=1.0)
    model.self = model

    def inner(x):
        return -model.k * x if inner else x

    def outer(t, x):
        return inner(x) if outer else x

    names = {}
    exec("def own(t, x):\n    return [-x[0], x[1]] if own else x", names)
    return [inner, outer, names["own"]]


def test_functions_go_with_what_they_read():
    f, floor = ball()
    inner, *functions = selfish()
    for one in (f, *functions):
        saltus.solve(one, (0.0, 1.0), [1.0, 0.0], events=floor)
    gone = [weakref.ref(one) for one in (f, *functions, inner, floor.guard, floor.reset)]
    del f, floor, inner, functions, one
    gc.collect()
    assert [one() for one in gone] == [None] * 6


def test_a_method_keeps_no_object_alive():
    class Model:
        k = 1.0

        def f(self, t, x):
            return -self.k * x

    model = Model()
    end(model.f)
    gone = weakref.ref(model)
    del model
    gc.collect()
    assert gone() is None
    assert not vars(Model.f)


def test_a_copy_of_a_function_is_another_one():
    f = fresh(decay)
    end(f)
    for copied in (copy.deepcopy(vars(f)), pickle.loads(pickle.dumps(vars(f)))):
        assert not any(copied.values())

    @functools.wraps(f)
    def twice(t, x):
        return [2.0 * value for value in f(t, x)]

    assert end(twice) == pytest.approx(end(f) ** 2, rel=1e-7)
