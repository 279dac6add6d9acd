"""What traces: each function is compared with what it gives when it is called."""

# The expressions below are text: ruff does not see what they use.
import enum
import functools
import math
import operator  # noqa: F401
import types
from collections import namedtuple
from functools import reduce  # noqa: F401
from math import atan2, hypot  # noqa: F401
from types import SimpleNamespace

import numpy as np
import pytest
from numpy import array, cos  # noqa: F401
from tracing_cases import assert_agrees, evaluate, traced

MATRIX = np.array([[0.0, 1.0], [-4.0, -0.5]])
TABLE = {"k": 2.0, "gains": [1.0, 3.0]}
SPRING = SimpleNamespace(k=4.0, c=np.array([0.1, 0.2]))


def helper(a, b):
    return np.sin(a) * abs(b)


def recursive(n, a):
    return a if n == 0 else a * recursive(n - 1, a)


def over_state(expression):
    """A function of (time, state) from the source of an expression in x, t and mode."""
    source = (
        "def f(time, state):\n"
        "    x, t, mode = state.continuous_state, time, state.mode\n"
        f"    return {expression}\n"
    )
    exec(source, globals(), made := {})
    return made["f"]


UNARY = """
    sin cos tan arctan sinh cosh tanh arcsinh exp exp2 expm1 cbrt abs absolute fabs floor ceil trunc
    rint sign negative square reciprocal positive deg2rad rad2deg degrees radians sinc isnan isinf
    isfinite signbit logical_not fix round nan_to_num
""".split()
BINARY = """
    add subtract multiply divide true_divide arctan2 hypot maximum minimum fmax fmin copysign mod
    remainder fmod floor_divide less less_equal greater greater_equal equal not_equal logical_and
    logical_or logical_xor logaddexp heaviside
""".split()


@pytest.mark.parametrize("name", UNARY)
def test_function_of_one(name):
    assert_agrees(over_state(f"np.{name}(x)"))
    assert_agrees(over_state(f"np.{name}(x[0])"))


@pytest.mark.parametrize("name", ["sqrt", "log", "log2", "log10", "log1p", "arccosh"])
def test_function_of_a_positive_number(name):
    assert_agrees(over_state(f"np.{name}(np.abs(x) + 1.0)"))


@pytest.mark.parametrize("name", ["arcsin", "arccos", "arctanh"])
def test_function_of_a_number_below_one(name):
    assert_agrees(over_state(f"np.{name}(0.5 * np.tanh(x))"))


@pytest.mark.parametrize("name", BINARY)
def test_function_of_two(name):
    assert_agrees(over_state(f"np.{name}(x, x[::-1])"))
    assert_agrees(over_state(f"np.{name}(x[0], 0.25)"))
    assert_agrees(over_state(f"np.{name}(0.25, x)"))


EXPRESSIONS = """
    x + 1
    2 - x
    x * x[0]
    x / 4
    1 / (2.0 + x**2)
    x // 0.3
    x % 0.3
    divmod(x[0], 0.3)
    x**2
    x**3
    x**4
    np.abs(x)**0.5
    np.abs(x)**1.5
    2.0**x
    -x
    +x
    abs(x)
    round(x[0])
    x < 0.1
    x <= x[::-1]
    x > 0
    x >= t
    x == x[0]
    x != 0.5
    ~(x < 0.1)
    (x < 0.5) & (x > -0.5)
    (x < 0.5) | (x[::-1] > 0)
    (x < 0.5) ^ (x[::-1] > 0)
    (x < 0.5) + (x > 0.1)
    (x < 0.5) * 3.0
    (t < 0.5) + (t > 0.1)
    np.float64(2.0) * x[0]
    np.float64(0.3) < x[0]
    np.array([1.0, 2.0]) * x[1]
    MATRIX[0] + x
    np.array([x[1], -x[0]])
    array([x[1], t])
    np.array([x, 2 * x])
    np.array([[x[0], 0], [0, x[1]]])
    np.asarray(x)
    np.asarray([x[0], 1], dtype=float)
    np.array(x, dtype=int)
    x.astype(bool)
    [x[0], x[1]]
    (x[0], 1.0)
    x[0]
    x[:1]
    x[-1]
    x[::-1]
    x[[1, 0, 1]]
    x[np.arange(2)]
    x[np.array([True, False])]
    x[None, :]
    x[..., 0]
    np.where(x > 0, x, -x)
    np.where(x[0] > 0, 1, 0.5)
    np.where(x > 0, 1, 0)
    np.where([True, False], x, 3)
    np.clip(x, -0.5, 0.5)
    np.clip(x[0], None, 0.5)
    x.clip(0, 1)
    np.select([x > 0.5, x > 0], [x, 2 * x], 7.0)
    np.dot(x, x)
    x.dot(MATRIX)
    x @ x
    MATRIX @ x
    x @ MATRIX
    MATRIX @ np.diag(x) @ MATRIX
    np.outer(x, x)
    np.inner(x, [1.0, 2.0])
    np.vdot(x, x)
    np.cross([x[0], x[1], 0.0], [0.0, 0.0, 1.0])
    np.kron(x, np.eye(2))
    np.einsum('ij,j->i', MATRIX, x)
    np.tensordot(MATRIX, x, 1)
    np.trace(np.outer(x, x))
    np.linalg.norm(x)
    np.linalg.norm(x, 1)
    np.linalg.norm(x, np.inf)
    np.linalg.solve(np.array([[4.0 + x[0], 1.0], [1.0, 5.0]]), x)
    np.linalg.solve(np.array([[1e-3, 1.0], [1.0, x[0]**2]]), x)
    np.linalg.det(np.array([[2.0, x[0]], [x[1], 3.0]]))
    np.linalg.inv(np.array([[3.0, x[0]], [0.0, 3.0]]))
    np.linalg.inv(MATRIX) @ x
    np.sum(x)
    sum(x)
    x.sum()
    np.sum([x, x], axis=0)
    np.sum(np.outer(x, x), axis=1, keepdims=True)
    np.prod(x)
    np.mean(x)
    np.mean([x, 2 * x], axis=0)
    np.var(x)
    np.std([x[0], 1.0, 2.0])
    np.cumsum(x)
    np.cumprod(x)
    np.diff(x)
    np.ediff1d(x)
    np.roll(x, 1)
    np.flip(x)
    np.concatenate([x, x])
    np.concatenate((x, [t, 1]))
    np.stack([x, 2 * x])
    np.stack([x, 2 * x], axis=1)
    np.vstack([x, x])
    np.hstack([x, 3.0])
    np.column_stack([x, x])
    np.append(x, 1.0)
    np.insert(x, 1, 0.5)
    np.delete(x, 0)
    np.repeat(x, 2)
    np.tile(x, 2)
    np.pad(x, 1)
    np.diag(x)
    np.eye(2) * x
    np.triu(np.outer(x, x))
    np.reshape(x, (2, 1))
    x.reshape(1, 2)
    x.reshape(-1)
    x.ravel()
    x.flatten()
    x.T
    np.outer(x, x).T
    np.transpose(np.outer(x, [1, 2, 3]))
    np.expand_dims(x, 0)
    np.squeeze(x.reshape(1, 2))
    np.atleast_2d(x)
    np.broadcast_to(x, (2, 2))
    np.swapaxes(x.reshape(1, 2), 0, 1)
    np.moveaxis(x.reshape(1, 2), 0, 1)
    np.full(2, t)
    np.full_like(x, 2.0)
    np.zeros_like(x) + x[0]
    np.ones(2) * x
    np.linspace(0, 1, 2) * x
    np.linspace(x[0], 1.0, 4)
    np.arange(2) * x
    np.polyval([1.0, 2.0, 3.0], x)
    np.trapezoid([x[0], x[1], 1.0], dx=0.5)
    np.convolve(x, [1.0, -1.0])
    np.interp(x[0], [-1.0, 0.0, 2.0], [3.0, 1.0, 2.0])
    np.interp(x, [-0.5, 0.5], [3.0, 1.0], left=-9.0)
    np.max(x)
    np.min([x[0], t])
    x.max()
    np.ptp(x)
    np.any(x > 0.5)
    (x > 0).all()
    np.count_nonzero(x > 0)
    np.round(x, 2)
    np.isclose(x, 0.7)
    np.allclose(x, x)
    np.add.reduce(x)
    np.add.accumulate(x)
    np.multiply.outer(x, x)
    np.maximum.reduce([x[0], x[1], 0.1])
    np.square(x, dtype=float)
    np.modf(x[0])
    np.float64(x[0])
    float(x[0])
    int(x[0] * 10)
    bool(x[0] > 0)
    min(x[0], x[1])
    max(x[0], 0.0, t)
    min([x[0], 0.25])
    max(x)
    abs(x[0])
    pow(x[0], 2)
    math.sin(x[0])
    math.exp(t) * x[0]
    math.atan2(x[0], x[1])
    atan2(x[0], 1.0)
    hypot(x[0], x[1], t)
    math.sqrt(x[0]**2)
    math.floor(x[0] * 10)
    math.log(2.0 + x[0]**2, 3.0)
    math.pow(abs(x[0]), 1.5)
    math.fsum([x[0], x[1]])
    math.prod(x)
    math.dist(x, [0.0, 1.0])
    math.copysign(1.0, x[0])
    math.degrees(x[0])
    math.pi * x
    np.pi * x
    cos(x)
    helper(x[0], x[1])
    recursive(3, x[0])
    TABLE['k'] * x
    TABLE['gains'][1] * x
    SPRING.k * x + SPRING.c
    reduce(operator.add, x)
    operator.mul(x, 2)
    sum(x[i] * x[i] for i in range(len(x)))
    sum([a * b for a, b in zip(x, MATRIX[1])])
    np.array([v * i for i, v in enumerate(x)])
    list(map(lambda v: v + 1, x))
    (lambda a: a * a)(x)
    (lambda a, k=3.0: a * k)(x)
    [*x, 1.0]
    {'a': x[0]}['a']
    x.shape[0] * x
    x.size + x.ndim + len(x) + x
    x if x.shape == (2,) else 0 * x
    x if isinstance(x, np.ndarray) else 0 * x
    x if isinstance(t, float) else 0 * x
    x if isinstance(x[0], np.floating) else 0 * x
    x.copy()
    x.tolist()
    x[0].item()
    x.item(1)
    x.real
    mode * x
    (mode == 1) * x
    np.where(mode == 1, x, -x)
    np.array([3.0, 4.0, 5.0])[mode] * x
    mode / 2
    mode // 2
    3.0
    np.zeros(2)
    np.random is None
""".strip().splitlines()


@pytest.mark.parametrize("expression", [line.strip() for line in EXPRESSIONS])
def test_expression(expression):
    assert_agrees(over_state(expression), ulps=16, mode=1)


def test_one_element_arrays_broadcast():
    outcome = assert_agrees(lambda t, s: s.continuous_state * s.continuous_state[0], x=[0.7])
    assert outcome.shape == (1,)
    assert assert_agrees(lambda t, s: s.continuous_state[0], x=[0.7]).shape == ()
    assert assert_agrees(lambda t, s: s.continuous_state * 2.0, x=0.7).shape == ()


def test_a_matrix_state():
    assert_agrees(lambda t, s: s.continuous_state.T @ MATRIX, x=[[0.5, 0.25], [1.5, 2.0]])
    assert_agrees(lambda t, s: s.continuous_state[1] - s.continuous_state[:, 0], x=MATRIX + 0.1)


def test_item_assignment():
    def chain(time, state):
        x = state.continuous_state
        dx = np.zeros_like(x)
        dx[0] = -x[0]
        dx[1:-1] = x[:-2] - 2 * x[1:-1] + x[2:]
        dx[-1] += x[0]
        dx[[0, 1]] *= 2
        return dx

    assert_agrees(chain, x=np.linspace(0.1, 1.0, 6))


def test_views_share_entries():
    def function(time, state):
        matrix = np.empty((2, 2))
        row = matrix[0]
        row[:] = state.continuous_state
        matrix.T[1] = 3.0
        flat = np.reshape(matrix, -1)
        flat[2] = time
        copied = matrix.copy()
        copied[0, 0] = 99.0
        return matrix

    assert_agrees(function)


def test_in_place_operators_keep_the_type_of_the_array():
    def function(time, state):
        counts = np.zeros(2, dtype=int)
        counts[0] = 3.9 * state.continuous_state[0]  # numpy cuts it off
        y = state.continuous_state[0]
        y += 1.0  # a number: the state stays as it is
        return np.array([counts[0], y, state.continuous_state[0]])

    assert_agrees(function)


def test_loops_inner_functions_and_unpacking():
    def function(time, state):
        y, v = state.continuous_state
        (a, *rest) = np.array([y, v, time])
        total = 0.0

        def grow(by):
            nonlocal total
            total = total + by * by

        for i in range(3):
            if i % 2 == 0:
                grow(y * i)
        while i > 0:
            i -= 1
            total *= 1.5
        return [total, a, sum(rest)]

    assert_agrees(function)


def test_imports_inside_the_function():
    def function(time, state):
        import math

        import numpy
        from numpy.linalg import norm

        return numpy.array([math.sin(time), norm(state.continuous_state)])

    assert_agrees(function)


def test_errstate_and_with():
    def function(time, state):
        with np.errstate(all="ignore"):
            return state.continuous_state / 3.0

    assert_agrees(function)


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


def test_parameters_inputs_and_keywords():
    def function(time, state, force, wind, *, g, drag):
        _, v = state.continuous_state
        return np.array([v + wind[1], force - g - drag @ wind])

    def by_dictionary(time, state, force, wind, **params):
        return function(time, state, force, wind, **params)

    for f in (function, by_dictionary):
        outcome = traced(f, parameters={"g": 9.81, "drag": [0.5, 0.25]}, input_shapes=[(), (2,)])
        found = evaluate(outcome, [1.0, 2.0], p=[9.0, 0.5, 0.25], u=[[3.0], [0.125, 4.0]])
        np.testing.assert_array_equal(found, [6.0, 3.0 - 9.0 - 0.0625 - 1.0])


def test_only_some_inputs_are_passed():
    def f(time, state, second):
        return second * 2.0

    outcome = traced(f, input_shapes=[(), (), ()], inputs=[1])
    assert evaluate(outcome, [0.0, 0.0], u=[[1.0], [5.0], [9.0]]) == 10.0
    assert [outcome.tape.reads_input(k) for k in range(3)] == [False, True, False]


def test_conventions():
    outcome = traced(lambda u: u[0] * u[1][1], convention="inputs", input_shapes=[(), (2,)])
    assert evaluate(outcome, [], u=[[3.0], [0.0, 4.0]]) == 12.0
    outcome = traced(lambda u: u.sum(), convention="input", input_shapes=[(3,)])
    assert evaluate(outcome, [], u=[[3.0, 1.0, 4.0]]) == 8.0
    outcome = traced(lambda t, x: [x[1], -x[0]], convention="vector")
    np.testing.assert_array_equal(evaluate(outcome, [1.0, 2.0]), [2.0, -1.0])


def test_the_in_place_form():
    def fill(time, state, out, k):
        y, v = state.continuous_state
        out[:] = v, -k * y

    outcome = traced(fill, out=True, result_size=2, parameters={"k": 4.0})
    np.testing.assert_array_equal(evaluate(outcome, [1.0, 2.0], p=[4.0]), [2.0, -4.0])


def test_a_reset_map_says_what_it_wrote():
    def bounce(time, state):
        y, v = state.continuous_state
        return state.with_continuous_state([abs(y), -0.9 * v]).with_mode(state.mode + 1)

    outcome = traced(bounce, kind="reset")
    assert (outcome.wrote_x, outcome.wrote_z, outcome.wrote_mode) == (True, False, True)
    np.testing.assert_allclose(evaluate(outcome, [-1e-9, -2.0], mode=3), [1e-9, 1.8, 4.0])

    outcome = traced(lambda t, s: s, kind="reset")
    assert not (outcome.wrote_x or outcome.wrote_z or outcome.wrote_mode)
    assert outcome.tape.size == 0


def test_a_reset_map_reads_its_entry_and_what_it_has_written():
    def kick(time, state):
        changed = state.with_discrete_state(state.discrete_state + 1)
        x = changed.continuous_state + changed.discrete_state[0] + state.entry
        return changed.with_continuous_state(x).with_mode(np.where(x[0] > 0, 1, 2))

    outcome = traced(kick, kind="reset", discrete_shape=(1,))
    found = evaluate(outcome, [1.0, -9.0], z=[5.0], entry=2)
    np.testing.assert_array_equal(found, [9.0, -1.0, 6.0, 1.0])


def test_an_update_may_return_the_discrete_state_alone():
    outcome = traced(lambda t, s: s.discrete_state * 2, kind="update", discrete_shape=(2,))
    assert (outcome.wrote_x, outcome.wrote_z, outcome.wrote_mode) == (False, True, False)
    np.testing.assert_array_equal(evaluate(outcome, [0.0, 0.0], z=[1.0, 2.0]), [2.0, 4.0])


def test_a_matrix_is_row_by_row():
    outcome = traced(lambda t, s: [[0.0, 1.0], [-s.continuous_state[0], 0.0]], kind="matrix")
    np.testing.assert_array_equal(evaluate(outcome, [3.0, 0.0]), [[0.0, 1.0], [-3.0, 0.0]])


def test_a_python_pole_is_infinite_or_nan():
    outcome = traced(lambda t, s: 1.0 / t + math.sqrt(s.continuous_state[0] + 2.0))
    assert not np.isfinite(evaluate(outcome, [-3.0, 0.0], time=0.0))


def test_a_matrix_keeps_its_sparsity():
    n = 12
    heat = np.diag(np.full(n, -2.0)) + np.diag(np.ones(n - 1), 1) + np.diag(np.ones(n - 1), -1)
    outcome = assert_agrees(lambda t, s: heat @ s.continuous_state, x=1.7 ** np.arange(n))
    rows, columns, _ = outcome.tape.jacobian()
    assert sorted(zip(rows, columns, strict=True)) == sorted(
        zip(*(places.tolist() for places in heat.nonzero()), strict=True)
    )


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
    assert outcome.watch.changed() is None


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
    assert outcome.watch.changed() == "K was 3.0, is 4.0"
    module.K = 3.0
    slotted.gain = 5.0
    assert outcome.watch.changed() == "slotted.gain was 2.0, is 5.0"
