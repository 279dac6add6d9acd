"""Methods, attributes, classes, modules: what a function reads from outside."""

import enum
import functools
import types
from collections import namedtuple
from types import SimpleNamespace

import numpy as np
from tracing_cases import assert_agrees, evaluate, traced
from world import helper


class Damper:
    gain = 3.0

    def __init__(self):
        self.rate = 0.5
        self.weights = np.array([1.0, 2.0])
        self.inner = SimpleNamespace(deep=[0.25, {"k": 4.0}])

    @property
    def double(self):
        return 2.0 * self.rate

    @functools.cached_property
    def triple(self):
        return 3.0 * self.rate

    @staticmethod
    def squared(a):
        return a * a

    @classmethod
    def scaled(cls, a):
        return cls.gain * a

    def force(self, time, state):
        y, v = state.continuous_state
        return (
            np.array([self.scaled(y) + self.squared(v), self.double * self.inner.deep[0]])
            + self.weights * self.inner.deep[1]["k"] * self.triple
        )

    def __call__(self, time, state):
        return self.force(time, state) * self.gain


def test_methods_attributes_properties_and_callable_objects():
    damper = Damper()
    assert_agrees(damper.force)
    assert_agrees(damper)
    assert "triple" in vars(damper)  # by the call that checks, as any call would
    assert_agrees(functools.partial(helper_of_three, 2.0, extra=np.ones(2)))


def helper_of_three(factor, time, state, extra):
    return factor * state.continuous_state + extra


def test_an_owner_goes_first():
    damper = Damper()
    outcome = traced(Damper.force, owner=damper)
    expected = damper.force(0.0, SimpleNamespace(continuous_state=np.array([0.3, 0.2])))
    np.testing.assert_allclose(evaluate(outcome, [0.3, 0.2]), expected, rtol=1e-15)


class Mode(enum.IntEnum):
    FREE = 0
    STUCK = 1


class Plain(enum.Enum):
    GAIN = 2.5


class Base:
    """Has what Derived builds on."""

    level = 2.0

    def force(self, a):
        return self.level * a

    @property
    def offset(self):
        return 0.5


class Derived(Base):
    level = 3.0

    def force(self, a):
        return super().force(a) + super().offset + Base.level + type(self).level

    def ode(self, time, state):
        stuck = state.mode == Mode.STUCK
        scale = 1.0 if isinstance(self, Base) and not isinstance(self, Damper) else 0.0
        return np.where(stuck, 0.0, self.force(state.continuous_state)) * scale * Plain.GAIN.value


def test_super_class_attributes_and_enumerations():
    derived = Derived()
    outcome = assert_agrees(derived.ode)
    assert_agrees(derived.ode, mode=1)
    assert outcome.dependencies.changed() is None


class Slotted:
    __slots__ = ("gain",)

    def __init__(self):
        self.gain = 2.0


def test_slots_modules_and_named_tuples():
    slotted = Slotted()
    module = types.ModuleType("mine")
    exec("K = 3.0\ndef scale(a):\n    return K * a\n", vars(module))
    pair = namedtuple("Pair", "a b")(1.0, np.array([2.0, 3.0]))

    def function(time, state):
        return module.scale(state.continuous_state) * slotted.gain + pair.a * pair.b + module.K

    outcome = assert_agrees(function)
    module.K = 4.0
    assert outcome.dependencies.changed() == "K was 3.0, is 4.0"
    module.K = 3.0
    slotted.gain = 5.0
    assert outcome.dependencies.changed() == "slotted.gain was 2.0, is 5.0"


def test_caches_and_compiled_functions_are_looked_into():
    class CPUDispatcher:  # as numba's
        def __init__(self, function):
            self.py_func = function

        def __call__(self, *arguments):
            return self.py_func(*arguments)

    cached, jitted = functools.lru_cache(lambda t: 2.0 * t), CPUDispatcher(helper)
    assert_agrees(lambda t, s: cached(t) + jitted(t, s.continuous_state[0]))
