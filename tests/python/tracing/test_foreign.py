"""The outside world, other libraries, and code that cannot be read."""

import math
import random
import time as clock
import types

import numpy as np
import pytest
from sources import line_of
from tracing_cases import reason


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
    assert "test_foreign.py:" in found
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
    place = f"test_foreign.py:{catches.__code__.co_firstlineno + 2}"
    assert reason(catches).startswith(f"catches exceptions at {place}")
    assert reason(waits).startswith("is a coroutine (async def) at test_foreign.py:")
    assert "expected numbers, found generator" in reason(yields)
