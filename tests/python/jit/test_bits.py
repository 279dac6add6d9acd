"""Machine code gives the bits of the interpreted tape; only a NaN may have another sign."""

import itertools
import random

import numpy as np
import pytest
from saltus import _core

pytest.importorskip("llvmlite")

NAMES = [
    "neg", "abs", "sqrt", "cbrt", "exp", "exp2", "expm1", "log", "log2", "log10", "log1p", "sin",
    "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh",
    "floor", "ceil", "trunc", "rint", "sign", "logical_not", "add", "sub", "mul", "div", "pow",
    "atan2", "hypot", "copysign", "mod", "fmod", "floor_divide", "minimum", "maximum", "lt", "le",
    "gt", "ge", "eq", "ne", "logical_and", "logical_or", "select",
]  # fmt: skip
SPECIAL = [
    0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 1.5, -2.5, 2.0, 3.0, 0.1, 1e-300, 1e300, -1e300, 5e-324,
    2.0**52 + 0.5, -(2.0**53), 0.49999999999999994, np.pi, np.inf, -np.inf, np.nan,
]  # fmt: skip


def arity(name):
    return 3 if name == "select" else 2 if NAMES.index(name) >= NAMES.index("add") else 1


def bits(values):
    values = np.where(np.isnan(values), np.nan, values)  # one NaN is as good as another
    return values.view(np.uint64)


def compare(tape, states, **world):
    """The values of a tape before and after it is compiled."""

    def values():
        at = {"time": 0.3, "z": [], "mode": 0, "entry": 0, "p": [], "u": []} | world
        with np.errstate(all="ignore"):
            return [
                tape(at["time"], x, at["z"], at["mode"], at["entry"], at["p"], at["u"])
                for x in states
            ]

    before = values()
    assert not tape.is_machine_code
    tape.compile()
    assert tape.is_machine_code
    for x, old, new in zip(states, before, values(), strict=True):
        np.testing.assert_array_equal(bits(new), bits(old), err_msg=f"at {x}")


@pytest.mark.parametrize("name", NAMES)
def test_every_operation_alone_at_special_values(name):
    graph = _core.Graph()
    operands = [graph.continuous_state(k) for k in range(arity(name))]
    tape = graph.tape([graph.apply(name, *operands)])
    compare(tape, [list(x) for x in itertools.product(SPECIAL, repeat=arity(name))])


@pytest.mark.parametrize("rows", [4, 7, 33, 66])  # in lanes, with a rest, in a loop, with a rest
@pytest.mark.parametrize("step", [1, 2])  # of the states that a row reads
def test_every_operation_side_by_side(rows, step):
    graph = _core.Graph()
    outputs = []
    for name in NAMES:
        first = [step * rows * k for k in range(arity(name))]
        outputs += [
            graph.apply(name, *(graph.continuous_state(k + step * i) for k in first))
            for i in range(rows)
        ]
    draw = random.Random(rows)
    size = 3 * step * rows
    states = [[draw.choice(SPECIAL) for _ in range(size)] for _ in range(50)]
    states += [[draw.gauss(0, 3) for _ in range(size)] for _ in range(20)]
    compare(graph.tape(outputs), states)


@pytest.mark.parametrize("exponent", [1.5, 2.5, -0.5, -1.5, -2.0, -3.0, 0.3, 5.0])
@pytest.mark.parametrize("rows", [1, 7, 40])
def test_powers_with_a_constant_exponent(exponent, rows):
    graph = _core.Graph()
    power = graph.constant(exponent)
    outputs = [graph.apply("pow", graph.continuous_state(i), power) for i in range(rows)]
    draw = random.Random(rows)
    states = [[draw.choice([*SPECIAL, draw.gauss(0, 3)]) for _ in range(rows)] for _ in range(60)]
    compare(graph.tape(outputs), states)


def drawn(draw, graph, leaves, steps):
    nodes = list(leaves)
    for _ in range(steps):
        name = draw.choice(NAMES)
        nodes.append(graph.apply(name, *(draw.choice(nodes[-12:]) for _ in range(arity(name)))))
    return nodes[-8:]


@pytest.mark.parametrize("seed", range(40))
def test_random_graphs_of_all_variables(seed):
    draw = random.Random(seed)
    graph = _core.Graph()
    leaves = [graph.continuous_state(i) for i in range(3)]
    leaves += [graph.time(), graph.mode(), graph.entry(), graph.discrete_state(1)]
    leaves += [graph.parameter(0), graph.input(0, 0), graph.input(2, 1), graph.constant(0.1)]
    tape = graph.tape(drawn(draw, graph, leaves, 40))
    states = [[draw.choice([*SPECIAL, draw.gauss(0, 2)]) for _ in range(3)] for _ in range(60)]
    world = {"z": [1.0, -2.5], "mode": 3, "entry": 2, "p": [0.7], "u": [[1.3], [], [0.0, -0.4]]}
    compare(tape, states, **world)


@pytest.mark.parametrize("seed", range(40))
def test_random_rows(seed):
    """Rows of one form: runs, joined by shifted reads as in a rod, and shared loops."""
    draw = random.Random(seed)
    n = draw.choice([4, 5, 8, 31, 32, 33, 40, 67])
    graph = _core.Graph()
    rows = [[graph.continuous_state(k * n + i) for i in range(n)] for k in range(2)]
    rows += [[graph.parameter(0)] * n, [graph.constant(-0.5)] * n, [graph.time()] * n]
    for _ in range(12):
        name = draw.choice(NAMES)
        chosen = [draw.choice(rows[-8:]) for _ in range(arity(name))]
        shift = draw.choice([0, 0, 0, 1, n - 1])
        rows.append(
            [
                graph.apply(name, *(row[(i + shift * k) % n] for k, row in enumerate(chosen)))
                for i in range(n)
            ]
        )
    outputs = [node for row in rows[-3:] for node in row]
    draw.shuffle(outputs) if draw.random() < 0.3 else None
    tape = graph.tape([*outputs, graph.apply("add", rows[-1][0], rows[-2][-1])])
    states = [[draw.choice([*SPECIAL, draw.gauss(0, 2)]) for _ in range(2 * n)] for _ in range(30)]
    compare(tape, states, p=[1.7])


def test_more_inputs_than_fit_on_the_stack():
    graph = _core.Graph()
    total = graph.input(0, 0)
    for k in range(1, 20):
        total = graph.apply("sub", graph.apply("mul", total, graph.input(k, 0)), graph.input(k, 1))
    world = {"u": [[0.1 * k + 1.0, -0.3 * k] for k in range(20)]}
    compare(graph.tape([total]), [[]], **world)


def test_a_tape_of_more_registers_than_fit_on_the_stack():
    graph = _core.Graph()
    n = 500
    squares = [
        graph.apply("mul", graph.continuous_state(i), graph.continuous_state(i)) for i in range(n)
    ]
    roots = [
        graph.apply("sqrt", graph.apply("add", squares[i], squares[i - 7])) for i in range(7, n)
    ]
    outputs = [graph.apply("div", squares[i], roots[n - 8 - i]) for i in range(n - 7)]
    compare(graph.tape(outputs), [np.linspace(-1, 1, n), np.geomspace(1e-200, 1e200, n)])
