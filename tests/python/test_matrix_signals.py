"""Signals of two dimensions: equations of matrices, shapes of results, names of entries."""

import csv

import numpy as np
import pytest
import saltus
from saltus.library import (
    Adder,
    Constant,
    FunctionBlock,
    Gain,
    Integrator,
    MatrixInversion,
    MatrixMultiplication,
    MatrixTransposition,
    Multiplexer,
    Product,
    Saturate,
    SumOfElements,
    Switch,
    Trigonometric,
    UnitDelay,
    ZeroOrderHold,
)

linalg = pytest.importorskip("scipy.linalg")

A = np.array([[0.0, 1.0], [-2.0, -0.5]])
C = np.array([[1.0, 0.0]])
Q = np.array([[0.1, 0.0], [0.0, 0.4]])
R = np.array([[0.25]])
START = np.array([[1.0, 0.2], [0.2, 2.0]])
M = np.arange(6.0).reshape(2, 3) - 2.0


def product(builder, *factors):
    """The output of the product of several outputs."""
    found = factors[0]
    for factor in factors[1:]:
        block = builder.add(MatrixMultiplication())
        builder.connect(found, block.input(0))
        builder.connect(factor, block.input(1))
        found = block.output()
    return found


def of(builder, block, *inputs):
    builder.add(block)
    for k, source in enumerate(inputs):
        builder.connect(source, block.input(k))
    return block.output()


def riccati():
    """P' = A P + P A^T + Q - P C^T R^-1 C P, of blocks."""
    builder = saltus.DiagramBuilder()
    a, c, q, r = (
        builder.add(Constant(value, name=name)).output()
        for name, value in (("A", A), ("C", C), ("Q", Q), ("R", R))
    )
    state = builder.add(Integrator(START, name="P"))
    p = state.output()
    ct, at = of(builder, MatrixTransposition(), c), of(builder, MatrixTransposition(), a)
    lost = product(builder, p, ct, of(builder, MatrixInversion(), r), c, p)
    rate = of(builder, Adder("+++-"), product(builder, a, p), product(builder, p, at), q, lost)
    builder.connect(rate, state.input())
    builder.export_output(p, "P")
    return builder.build()


def covariance(t):
    """P(t) = V U^-1 with [U; V] = exp(H t) [I; P(0)], from the Hamiltonian of the equation."""
    h = np.block([[-A.T, C.T @ np.linalg.inv(R) @ C], [Q, A]])
    u, v = np.split(linalg.expm(h * t) @ np.vstack([np.eye(2), START]), 2)
    return v @ np.linalg.inv(u)


@pytest.mark.parametrize("method", ["dopri5", "dop853", "bdf", "taylor"])
def test_the_riccati_equation_follows_its_closed_form(method):
    results = saltus.simulate(
        riccati(), (0.0, 2.0), ode_solver_method=method, rtol=1e-9, atol=1e-11,
        save_at=[0.5, 1.0, 2.0], save_steps=False, event_rows=False,
    )  # fmt: skip
    assert results["P"].shape == (3, 2, 2)
    expected = [covariance(t) for t in results.time]
    # some 200 steps (bdf), each within 1e-9 of entries up to 2, in a flow that contracts
    np.testing.assert_allclose(results["P"], expected, rtol=0, atol=200 * 2e-9)


def test_the_riccati_equation_ends_at_the_solution_of_the_algebraic_one():
    end = saltus.simulate(riccati(), (0.0, 60.0), rtol=1e-10, atol=1e-12).outputs["P"][-1]
    expected = linalg.solve_continuous_are(A.T, C.T, Q, R)
    # the slowest pole of the filter is below -0.5, so its transient is below e^-30 = 1e-13
    np.testing.assert_allclose(end, expected, rtol=0, atol=1e-9)
    np.testing.assert_array_equal(end, end.T)  # the blocks keep the symmetry to the bit


SPIN = np.array([0.3, -0.5, 0.8])
SKEW = np.array([[0.0, -0.8, -0.5], [0.8, 0.0, -0.3], [0.5, 0.3, 0.0]])


class Attitude(saltus.LeafSystem):
    """R' = R skew(w), the state a matrix, w an input; out: R and the columns of R as rows."""

    def __init__(self, hidden=False):
        super().__init__(name="attitude")
        self.hidden = hidden
        self.declare_input_port("w", shape=(3, 3))
        self.declare_continuous_state(default_value=np.eye(3), ode=self.ode)
        self.declare_continuous_state_output("R")
        self.declare_output_port(self.turned, "turned", requires_inputs=False)

    def ode(self, time, state, w):
        rate = state.continuous_state @ w
        return np.array(rate.tolist()) if self.hidden else rate  # tolist() is not traced

    def turned(self, time, state, *inputs):
        assert state.continuous_state.shape == (3, 3)
        return state.continuous_state.T


@pytest.mark.parametrize("python", ["traced", "called"])
def test_a_rotation_is_the_exponential_of_its_rate(python):
    attitude = Attitude()
    attitude.input(0).fix_value(SKEW)
    results = saltus.simulate(
        attitude, (0.0, 3.0), rtol=1e-10, atol=1e-12, python=python,
        recorded_signals={"R": attitude.output("R"), "turned": attitude.output("turned")},
    )  # fmt: skip
    assert results["R"].shape == results["turned"].shape == (len(results.time), 3, 3)
    # about 40 steps, each within 1e-10 of entries up to 1, in a flow that only turns
    np.testing.assert_allclose(results["R"][-1], linalg.expm(3.0 * SKEW), rtol=0, atol=4e-9)
    np.testing.assert_array_equal(results["turned"], np.swapaxes(results["R"], 1, 2))


def test_traced_and_called_callbacks_agree():
    def run(python):
        attitude = Attitude()
        attitude.input(0).fix_value(SKEW)
        return saltus.simulate(
            attitude, (0.0, 1.0), python=python, max_minor_step_size=0.1, rtol=1e-3,
            recorded_signals={"R": attitude.output("R")},
        )  # fmt: skip

    traced, called = run("traced"), run("called")
    assert "traced" in str(Attitude().explain())
    # the same steps; the sums of a product may be in another order: some roundings a step
    np.testing.assert_allclose(traced["R"], called["R"], rtol=0, atol=1e-13)


@pytest.mark.parametrize(
    ("block", "inputs", "expected"),
    [
        (lambda: Adder("+-"), (M, 2.0 * M), -M),
        (lambda: Adder("++"), (M, 1.0), M + 1.0),
        (lambda: Product("**"), (M, M), M * M),
        (lambda: Gain(M), (2.0,), 2.0 * M),
        (lambda: Saturate(lower_limit=-1.0, upper_limit=2.0), (M,), np.clip(M, -1.0, 2.0)),
        (lambda: Trigonometric("sin"), (M,), np.sin(M)),
        (lambda: Switch(), (M, 0.0, -M), -M),
        (lambda: SumOfElements(), (M,), M.sum()),
        (lambda: Multiplexer(2), (M, 7.0), np.append(M.ravel(), 7.0)),
        (lambda: MatrixMultiplication(), (M, M.T), M @ M.T),
        (lambda: MatrixMultiplication(), (M[:, 0], M), M[:, 0] @ M),
        (lambda: MatrixMultiplication(), (M, M[0]), M @ M[0]),
        (lambda: MatrixMultiplication(), (M[0], M[1]), M[0] @ M[1]),
        (lambda: MatrixTransposition(), (M,), M.T),
        (lambda: MatrixInversion(), (A,), np.linalg.inv(A)),
        (lambda: saltus.library.FunctionBlock(lambda u: u @ u.T), (M,), M @ M.T),
        (lambda: saltus.library.ReduceBlock(2, lambda u: u[0] + u[1]), (M, M), 2.0 * M),
    ],
)
def test_blocks_are_those_of_numpy(block, inputs, expected):
    found = saltus.response(block(), *inputs)
    assert np.shape(found) == np.shape(expected)
    # an inverse of condition 3, a sine: a few roundings of entries up to 9
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14)


@pytest.mark.parametrize("block", [UnitDelay, ZeroOrderHold])
def test_a_matrix_is_held(block):
    hold = block(0.5, M, name="hold")
    hold.input().fix_value(-M)
    results = saltus.simulate(hold, (0.0, 1.2), recorded_signals={"y": hold.output()})
    np.testing.assert_array_equal(results["y"][-1], -M)


def recorded():
    system = riccati()
    return system, saltus.simulate(system, (0.0, 1.0), dense_output=True)


def test_dense_output_and_eval_have_the_shape():
    system, results = recorded()
    assert results(0.5)["P"].shape == (2, 2)
    assert results([0.1, 0.2, 0.3])["P"].shape == (3, 2, 2)
    # an interpolant of order 4 of rtol 1e-6 or so
    np.testing.assert_allclose(results(0.5)["P"], covariance(0.5), atol=1e-4)
    np.testing.assert_array_equal(system.output().eval(system.create_context()), START)


def test_entries_are_called_by_row_and_column(tmp_path):
    system, results = recorded()
    names = ["P[0,0]", "P[0,1]", "P[1,0]", "P[1,1]"]
    results.to_csv(tmp_path / "p.csv")
    with open(tmp_path / "p.csv", newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0] == ["time", "jump", *names]
    assert list(map(float, rows[-1][2:])) == results["P"][-1].ravel().tolist()
    assert list(saltus.linearize(system).outputs) == names
    assert "2 x 2" in system.to_mermaid()
    assert 'label="2 x 2"' in system.to_dot()
    assert f"P ({len(results.time)}, 2, 2)" in str(results)


def test_tables_and_pictures_have_every_entry():
    pytest.importorskip("xarray")
    pytest.importorskip("matplotlib").use("Agg")
    _, results = recorded()
    assert results.to_xarray()["P"].dims == ("time", "P_row", "P_column")
    assert results.to_pandas()["P[1,0]"].tolist() == results["P"][:, 1, 0].tolist()
    (axes,) = np.ravel(results.plot())
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert labels == ["P[0,0]", "P[0,1]", "P[1,0]", "P[1,1]"]
    assert results.plot_phase("P[0,0]", "P[1,1]").get_ylabel() == "P[1,1]"
    assert saltus.drawings.pick(results(0.0), "P[0,1]") == START[0, 1]


def test_saved_results_keep_the_shape(tmp_path):
    _, results = recorded()
    results.save(tmp_path / "p.npz")
    loaded = saltus.load_results(tmp_path / "p.npz")
    np.testing.assert_array_equal(loaded["P"], results["P"])


def test_derivatives_have_the_parameters_last():
    system = riccati()
    results = saltus.simulate(
        system, (0.0, 1.0), sensitivity=["Q.value"], rtol=1e-9, atol=1e-11, save_at=[1.0]
    )
    found = results.sensitivities["P"]
    assert found.shape == (*results["P"].shape, 4)
    step = 1e-4

    def run(delta):
        context = system.create_context().with_parameter("Q.value", Q + np.diag([delta, 0.0]))
        return saltus.simulate(system, context, (0.0, 1.0), rtol=1e-9, atol=1e-11).outputs["P"][-1]

    # central differences: 1e-9 / step of the runs and step^2 of the curvature
    np.testing.assert_allclose(found[-1, :, :, 0], (run(step) - run(-step)) / (2 * step), atol=1e-4)


def test_a_sweep_has_a_matrix_for_each_run():
    xarray = pytest.importorskip("xarray")
    swept = saltus.sweep(
        riccati(), {"Q.value": [Q, 2.0 * Q, 3.0 * Q]}, t_span=(0.0, 1.0),
        recorded_signals=["P"], save_at=[0.5, 1.0],
    )  # fmt: skip
    assert isinstance(swept, xarray.Dataset)
    assert swept["P"].dims == ("Q.value", "time", "P_row", "P_column")
    assert swept["Q.value_values"].shape == (3, 2, 2)
    more = saltus.sweep(
        riccati(), {"P.x[0]": [1.0, 2.0]}, t_span=(0.0, 1.0), recorded_signals=["P"]
    )
    assert more["P"].dims == ("P.x[0]", "P_row", "P_column")


def test_islands_keep_the_shape():
    builder = saltus.DiagramBuilder()
    for name in ("a", "b"):
        x = builder.add(Integrator(M, name=name))
        g = builder.add(Gain(-1.0, name=f"{name} gain"))
        builder.connect(x.output(), g.input())
        builder.connect(g.output(), x.input())
        builder.export_output(x.output(), name)
    results = saltus.simulate(builder.build(), (0.0, 1.0), islands=True, rtol=1e-8, atol=1e-10)
    for name in ("a", "b"):
        assert results[name].shape[1:] == (2, 3)
        # some 20 steps within 1e-8 of entries up to 3
        np.testing.assert_allclose(results[name][-1], np.exp(-1.0) * M, rtol=0, atol=6e-7)


def test_a_fit_finds_an_entry_of_a_matrix():
    system = riccati()
    results = saltus.simulate(
        system, (0.0, 1.0), save_at=np.linspace(0.1, 1.0, 8), save_steps=False
    )
    begin = system.create_context().with_parameter("Q.value", 2.0 * Q)
    data = {"time": results.time, "P": results["P"]}
    one = {"time": results.time, "P[1,1]": results["P"][:, 1, 1]}
    for measured in (data, one):
        fitted = saltus.fit(system, measured, ["Q.value[0]", "Q.value[3]"], context=begin)
        # exact data of a run at rtol 1e-6, and P[1,1] sees Q[0,0] only by the way of P[0,1]
        np.testing.assert_allclose(fitted.values, np.diag(Q), rtol=1e-2)
    with pytest.raises(saltus.ModelError, match=r"the signal has 4 entries, the first is \[0,0\]"):
        saltus.fit(system, {"time": results.time, "P[4]": results["P"][:, 1, 1]}, ["Q.value[0]"])


SCENE = """
version = 1

[blocks]
a = { block = "Constant", value = [[0.0, -1.0], [1.0, 0.0]] }
x = { block = "Integrator", initial_state = [["one", 0.0], [0.0, 1.0]] }
product = { block = "MatrixMultiplication" }

[parameters]
one = 1.0

[run]
until = 1.0
rtol = 1e-9
atol = 1e-11
record = ["X"]
"""
WIRES = ["a -> product.in_0", "x -> product.in_1", "product -> x"]


def test_a_scene_file_has_matrices(tmp_path):
    head, run = SCENE.split("[run]")
    text = f"{head}\n[outputs]\nX = 'x.out'\n\n[run]{run}"
    text = text.replace("[blocks]", f"wires = {WIRES}\n\n[blocks]".replace("'", '"'))
    (tmp_path / "turn.toml").write_text(text)
    scene = saltus.load_scene(tmp_path / "turn.toml")
    end = scene.simulate()["X"][-1]
    c, s = np.cos(1.0), np.sin(1.0)
    np.testing.assert_allclose(end, [[c, -s], [s, c]], rtol=0, atol=4e-8)  # 40 steps of 1e-9


TRANSPOSED = {
    "ode": lambda leaf: leaf.declare_continuous_state(
        np.ones((2, 3)), ode=lambda t, s: s.continuous_state.T
    ),
    "reset": lambda leaf: (
        leaf.declare_continuous_state(np.ones((2, 3)), ode=lambda t, s: 0.0 * s.continuous_state),
        leaf.declare_zero_crossing(
            lambda t, s: t - 0.5,
            reset_map=lambda t, s: s.with_continuous_state(s.continuous_state.T),
        ),
    ),
    "update": lambda leaf: (
        leaf.declare_discrete_state(default_value=np.ones((2, 3))),
        leaf.declare_periodic_update(
            lambda t, s: s.with_discrete_state(s.discrete_state.T), period=0.5
        ),
    ),
    "update in numbers": lambda leaf: (
        leaf.declare_discrete_state(default_value=np.ones((2, 3))),
        leaf.declare_periodic_update(lambda t, s: np.ones((3, 2)), period=0.5),
    ),
}


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize("name", TRANSPOSED)
def test_a_result_of_other_rows_and_columns_is_refused(name, python):
    """Its six numbers would fill the 2 x 3 state in another order."""
    leaf = saltus.LeafSystem(name="leaf")
    TRANSPOSED[name](leaf)
    with pytest.raises(saltus.ModelError, match=r"leaf.*\(3, 2\), expected \(2, 3\)"):
        saltus.simulate(leaf, (0.0, 1.0), python=python)


@pytest.mark.parametrize(
    "function", [np.linalg.inv, lambda u: np.linalg.solve(u, np.eye(2)), np.linalg.cholesky]
)
def test_a_function_that_needs_a_regular_matrix_has_its_shape(function):
    """The shape of its result is found with an identity, because zeros and ones are singular."""
    matrix = np.array([[2.0, 1.0], [1.0, 3.0]])
    result = saltus.response(FunctionBlock(lambda u: function(u)), matrix)
    # one call of the same function with the same numbers
    np.testing.assert_array_equal(np.asarray(result).reshape(2, 2), function(matrix))
