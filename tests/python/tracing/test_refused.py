"""What has to be called: the reason names what was met, where, and what to do."""

import functools
import math
import random
import time as clock
import types

import numpy as np
import pytest
from saltus.tracing import Refused, Signature, trace
from tracing_cases import reason, traced

COUNT = 0
SEEN = []
MEMORY = {"last": 0.0}
BUFFER = np.zeros(3)


def line_of(function, text):
    """The file and line where the text stands in a function, as reasons say it."""
    import inspect

    lines, first = inspect.getsourcelines(function)
    for i, line in enumerate(lines):
        if text in line:
            return f"test_refused.py:{first + i} (`{line.strip()}`)"
    raise AssertionError(text)


def branch_if(time, state):
    _, v = state.continuous_state
    if v > 0:
        return np.array([v, -1.0])
    return np.array([v, 1.0])


def branch_while(time, state):
    n = 0
    while state.continuous_state[0] > n:
        n += 1
    return n


def branch_ternary(time, state):
    return 1.0 if time < 3.0 else 2.0


def branch_and(time, state):
    return state.continuous_state[0] > 0 and time > 1.0


def branch_chained(time, state):
    return 0.0 < state.continuous_state[0] < 1.0


def branch_not(time, state):
    return not state.continuous_state[0] > 0


def branch_mode(time, state):
    if state.mode == 1:
        return 1.0
    return 2.0


def branch_array(time, state):
    if (state.continuous_state[:1] > 0).any():
        return 1.0
    return 2.0


def branch_sorted(time, state):
    return sorted(state.continuous_state)[0]


def branch_match(time, state):
    match state.mode:
        case 0:
            return 1.0
        case _:
            return 2.0


BRANCHES = {
    branch_if: "if v > 0:",
    branch_while: "while state",
    branch_ternary: "return",
    branch_and: "return",
    branch_chained: "return",
    branch_not: "return",
    branch_mode: "if state.mode",
    branch_array: "if (state",
    branch_sorted: "return",
    branch_match: "case 0",
}


@pytest.mark.parametrize("function", BRANCHES)
def test_a_branch_on_a_value(function):
    place = line_of(function, BRANCHES[function])
    assert reason(function) == (
        f"branches on a value at {place}; use np.where, np.minimum, `&` and `|`, or modes with "
        "zero crossings"
    )


def test_a_branch_on_what_is_fixed_is_none():
    flag = True

    def function(time, state):
        if flag and len(state.continuous_state) == 2 and np.array([1.0])[0] > 0:
            return time
        return print("never")

    assert traced(function).watch.changed() is None
    flag = False
    assert "flag was True, is False" in function_watch(function, lambda: None)


def function_watch(function, change):
    """What changed for a function whose closure has changed already."""
    del change
    outcome = trace(Signature(function=function, state_shape=(2,)))
    assert isinstance(outcome, Refused)
    cell = dict(zip(function.__code__.co_freevars, function.__closure__, strict=True))["flag"]
    cell.cell_contents = True
    first = trace(Signature(function=function, state_shape=(2,)))
    cell.cell_contents = False
    return first.watch.changed()


class Counter:
    def __init__(self):
        self.count = 0
        self.seen = []
        self.memory = {}
        self.buffer = np.zeros(2)

    def counts(self, time, state):
        self.count += 1
        return state.continuous_state

    def deletes(self, time, state):
        del self.count
        return state.continuous_state

    def appends(self, time, state):
        self.seen.append(time)
        return state.continuous_state

    def remembers(self, time, state):
        self.memory["last"] = time
        return state.continuous_state

    def buffers(self, time, state):
        self.buffer[0] = 1.0
        return state.continuous_state

    def buffers_all(self, time, state):
        np.multiply(state.continuous_state, 2.0, out=self.buffer)
        return self.buffer

    def sets(self, time, state):
        setattr(self, "count", 3)  # noqa: B010
        return state.continuous_state


def write_global(time, state):
    global COUNT
    COUNT += 1
    return time


def append_global(time, state):
    SEEN.append(time)
    return time


def write_dictionary(time, state):
    MEMORY["last"] = time
    return time


def write_array(time, state):
    BUFFER[0] += 1.0
    return BUFFER[0]


def write_slice(time, state):
    part = BUFFER[1:]
    part[:] = 3.0
    return time


def write_state(time, state):
    x = state.continuous_state
    x[0] = 3.0
    return x


def in_place_state(time, state):
    x = state.continuous_state
    x += 3.0
    return x


def write_function(time, state):
    write_function.count = 1
    return time


def use_default(time, state, seen=[]):  # noqa: B006
    seen.append(time)
    return time


def fill_diagonal(time, state):
    matrix = np.eye(2)
    np.fill_diagonal(matrix, 3.0)
    return matrix @ state.continuous_state


EFFECTS = {
    write_global: "writes global variables: COUNT",
    append_global: "writes to the list SEEN",
    write_dictionary: "does not support item assignment",
    write_array: "writes to BUFFER",
    write_slice: "writes to BUFFER",
    write_state: "writes to the continuous state",
    in_place_state: "writes to the continuous state",
    write_function: "writes attributes of write_function: count",
    use_default: "writes to the list a default of use_default",
    fill_diagonal: "calls np.fill_diagonal, which changes something",
    Counter.counts: "writes self.count",
    Counter.deletes: "deletes self.count",
    Counter.appends: "writes to the list self.seen",
    Counter.remembers: "does not support item assignment",
    Counter.buffers: "writes to self.buffer",
    Counter.buffers_all: "writes to self.buffer",
    Counter.sets: "uses setattr, which cannot be traced",
}


@pytest.mark.parametrize("function", EFFECTS)
def test_an_effect_is_found_before_it_happens(function):
    owner = Counter() if "." in function.__qualname__ else None
    before = (COUNT, list(SEEN), dict(MEMORY), BUFFER.copy())
    found = reason(function, owner=owner)
    assert EFFECTS[function] in found
    assert (COUNT, SEEN, MEMORY) == before[:3]
    np.testing.assert_array_equal(BUFFER, before[3])
    if owner is not None:
        assert (owner.count, owner.seen, owner.memory) == (0, [], {})
        assert not owner.buffer.any()


def test_a_nonlocal_is_an_effect():
    calls = 0

    def function(time, state):
        nonlocal calls
        calls = calls + 1
        return time

    assert "writes the variable calls of the function around it" in reason(function)
    assert calls == 0


def prints(time, state):
    print("here")
    return time


def opens(time, state):
    with open("/dev/null") as file:
        file.read()
    return time


def draws(time, state):
    return random.random()


def draws_numpy(time, state):
    return np.random.rand()  # noqa: NPY002


def looks_at_the_clock(time, state):
    return clock.time()


def evaluates(time, state):
    return eval("time")


WORLD = {
    prints: "uses print, which cannot be traced (it prints)",
    opens: "uses open, which cannot be traced (it opens a file)",
    draws: "uses random.random, which cannot be traced (it differs from call to call)",
    draws_numpy: "uses np.random.rand, which cannot be traced (random numbers differ",
    looks_at_the_clock: "uses time.time, which cannot be traced (it differs from call to call)",
    evaluates: "uses eval, which cannot be traced",
}


@pytest.mark.parametrize("function", WORLD)
def test_the_outside_world(function, capsys):
    found = reason(function)
    assert WORLD[function] in found
    assert "test_refused.py:" in found
    assert found.endswith("functions of numpy and math, and plain Python ones, can be")
    assert capsys.readouterr().out == ""


def foreign_module(name):
    module = types.ModuleType(name)
    module.array = lambda values: np.array(values)
    module.array.__module__ = name
    return module


@pytest.mark.parametrize("name", ["jax.numpy", "torch", "scipy.special"])
def test_a_foreign_library(name):
    jnp = foreign_module(name)

    def function(time, state):
        return jnp.array([time, 1.0])

    assert reason(function) == (
        f"uses {name}.array, which cannot be traced (it does not take symbols) at "
        f"{line_of(function, 'return')}; functions of numpy and math, and plain Python ones, "
        "can be"
    )
    array = jnp.array

    def by_name(time, state):
        return array([time, 1.0])

    assert f"uses {name}." in reason(by_name)


class Opaque:
    """Takes symbols for numbers."""

    def __init__(self):
        self.function = np.vectorize(math.sin)


def test_an_object_that_cannot_be_read():
    opaque, interpolator = Opaque(), memoryview(b"12")
    assert "uses opaque.function, which cannot be traced" in reason(lambda t, s: opaque.function(t))
    found = reason(lambda t, s: interpolator[0])
    assert "uses interpolator, which cannot be traced (a memoryview: no Python code" in found


def catches(time, state):
    try:
        return 1.0 / time
    except ZeroDivisionError:
        return 0.0


async def waits(time, state):
    return time


def yields(time, state):
    yield time


def test_code_that_cannot_be_traced():
    place = f"test_refused.py:{catches.__code__.co_firstlineno + 2}"
    assert reason(catches).startswith(f"catches exceptions at {place}")
    assert reason(waits).startswith("is a coroutine (async def) at test_refused.py:")
    assert "expected numbers, found generator" in reason(yields)
    assert "uses BuiltIn, which" not in reason(functools.lru_cache(lambda t, s: t))
    assert "no Python code" in reason(functools.lru_cache(lambda t, s: t))


def no_return(time, state):
    state.continuous_state  # noqa: B018


def text(time, state):
    return "up"


def wrong_number(time, state):
    return [time]


def ragged(time, state):
    return np.array([state.continuous_state, 1.0])


def fails(time, state):
    raise ValueError("too cold")


def misspelt(time, state):
    return state.continous_state


def test_what_is_wrong_when_called_too():
    assert "returns None" in reason(no_return)
    assert "is a `return` missing?" in reason(no_return)
    assert "expected numbers, found str" in reason(text)
    assert reason(wrong_number, result_size=2) == "returns 1 numbers, expected 2"
    assert "inhomogeneous shape" in reason(ragged)
    assert "raised ValueError: too cold at test_refused.py:" in reason(fails)
    assert "no attribute 'continous_state'" in reason(misspelt)
    assert "returns no state" in reason(lambda t, s: 3.0, kind="reset")
    wrong = "continuous state: expected 2 numbers, found 3"
    assert wrong in reason(lambda t, s: s.with_continuous_state([1, 2, 3]), kind="reset")
    assert "sets the mode to a real number" in reason(lambda t, s: s.with_mode(t), kind="reset")


NO_FORM = {
    "np.fft.fft(x)": "uses np.fft.fft, which cannot be traced",
    "np.argmax(x)": "calls np.argmax, which has no symbolic form",
    "np.median(x)": "calls np.median, which has no symbolic form",
    "np.sort(x)": "calls np.sort, which has no symbolic form",
    "np.unique(x)": "calls np.unique, which has no symbolic form",
    "np.gamma(x)": "has no attribute 'gamma'",
    "math.gamma(x[0])": "calls math.gamma, which has no symbolic form",
    "math.factorial(int(x[0]))": "calls math.factorial, which has no symbolic form",
    "np.linalg.eigvals(np.outer(x, x))": "calls np.eigvals, which has no symbolic form",
    "[1.0, 2.0][int(x[0])]": "uses a value as an index or a count",
    "MATRIX[int(x[0])]": "uses a value as an index or a count",
    "x[x > 0]": "uses values as indices",
    "list(range(int(x[0])))": "uses a value as an index or a count",
    "{0: 1.0}[mode]": "looks up a value, in a dictionary or a set",
    "x[0] + 1j": "unsupported operand",
    "np.array([1j]) * x": "expected numbers, found complex",
    "x.astype(complex)": "computes with complex128",
    "x.astype(np.float32)": "computes with float32",
    "round(x[0], 2)": "rounds to decimal places",
    "(mode & 1) * x": "computes bitwise (and) with integers or reals",
    "np.where(x > 0)": "calls np.where with a condition alone",
    "np.add(x, 1, where=x > 0)": "calls np.add with where",
    "type(x[0])(3)": "asks for the type of a value",
    "'%d' % x[0]": "turns a value into a fixed integer",
}


@pytest.mark.parametrize("expression", NO_FORM)
def test_no_symbolic_form(expression):
    source = (
        "def f(time, state):\n"
        "    x, mode = state.continuous_state, state.mode\n"
        f"    return {expression}\n"
    )
    exec(source, {"np": np, "math": math, "MATRIX": np.eye(2)}, made := {})
    assert NO_FORM[expression] in reason(made["f"])


def test_too_large():
    def grows(time, state):
        total = time
        while True:
            total = total * time + 1.0
        return total

    assert "has more than 200000 operations" in reason(grows)


def test_too_large_to_watch():
    table = np.zeros(100_000)
    assert "more than 10000 entries are not watched" in reason(lambda t, s: table[3] * t)


def test_nowhere_defined():
    assert reason(lambda t, s: math.sqrt(-1.0 - t * t)) == (
        "could be compared at 0 of 12 points only, as the function raises or is not finite at the "
        "others; start the block where it is defined"
    )


def test_the_check_finds_what_the_tracer_does_not_know():
    def function(time, state):
        return time + getattr(state.continuous_state[0], "nbytes", 0)  # a symbol has none

    assert reason(function) == (
        "the check failed: at t = 0, x = [0.7, -0.4] entry 0 of the result is 8.0 called and 0.0 "
        "traced"
    )


def test_keyboard_interrupts_pass():
    def function(time, state):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        trace(Signature(function=function))
