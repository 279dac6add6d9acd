"""What a function would change is found before it is called."""

import itertools

import numpy as np
import pytest
from tracing_cases import reason

COUNT = 0
SEEN = []
MEMORY = {"last": 0.0}
BUFFER = np.zeros(3)


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

    def class_of_self(self, time, state):
        type(self).total = 3
        return time

    def class_of_self_too(self, time, state):
        self.__class__.total = 3
        return time

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


def append_by_type(time, state):
    list.append(SEEN, time)
    return time


TICKS = itertools.count()


def next_of_outside(time, state):
    return next(TICKS) + time


def class_attribute(time, state):
    Counter.total = 3
    return time


EFFECTS = {
    append_by_type: "writes to SEEN",
    next_of_outside: "uses TICKS, which cannot be traced",
    class_attribute: "writes Counter.total",
    write_global: "writes global variables: COUNT",
    append_global: "writes to the list SEEN",
    write_dictionary: "writes to the dictionary MEMORY",
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
    Counter.remembers: "writes to the dictionary self.memory",
    Counter.buffers: "writes to self.buffer",
    Counter.buffers_all: "writes to self.buffer",
    Counter.class_of_self: "writes Counter.total",
    Counter.class_of_self_too: "writes Counter.total",
    Counter.sets: "uses setattr, which cannot be traced",
}


@pytest.mark.parametrize("function", EFFECTS)
def test_an_effect_is_found_before_it_happens(function):
    owner = Counter() if "." in function.__qualname__ else None
    before = (COUNT, list(SEEN), dict(MEMORY), BUFFER.copy())
    found = reason(function, owner=owner)
    assert EFFECTS[function] in found
    assert (COUNT, SEEN, MEMORY) == before[:3]
    assert not hasattr(Counter, "total")
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
