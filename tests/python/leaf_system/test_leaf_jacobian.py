"""The Jacobian of a Python block: its places, its values, and the linear solver they lead to."""

import re

import numpy as np
import pytest
import saltus
from declared import Block


def chain(**declared):
    """x_i' = 50 (x_{i-1} - 2 x_i + x_{i+1}), ends at zero."""
    n = 40

    def ode(t, s):
        x = np.concatenate(([0.0], s.continuous_state, [0.0]))
        return 50.0 * (x[:-2] - 2.0 * x[1:-1] + x[2:])

    return Block(
        lambda self: self.declare_continuous_state(
            default_value=np.sin(np.pi * np.arange(1, n + 1) / (n + 1)), ode=ode, **declared
        )
    )


def places_of_chain(n=40):
    return tuple(
        np.array([(i, j) for i in range(n) for j in range(n) if abs(i - j) <= 1]).T.tolist()
    )


@pytest.mark.parametrize("form", ["pair", "array", "values"])
def test_a_sparse_jacobian_gives_the_same_with_fewer_calls(form):
    rows, columns = places_of_chain()
    mask = np.zeros((40, 40))
    mask[rows, columns] = 1
    values = np.where(np.equal(rows, columns), -100.0, 50.0)
    declared = {
        "pair": {"jacobian_sparsity": (rows, columns)},
        "array": {"jacobian_sparsity": mask},
        "values": {
            "jacobian_sparsity": (rows, columns),
            "sparse_jacobian": lambda t, s: values,
        },
    }[form]

    def run(system):  # called: a traced ode knows its Jacobian, declared or not
        return saltus.simulate(
            system,
            system.create_context(),
            (0.0, 1.0),
            ode_solver_method="bdf",
            rtol=1e-7,
            python="called",
        )

    dense, sparse = run(chain()), run(chain(**declared))
    # The first mode decays with 100 (cos(pi / 41) - 1); BDF adds up a hundred errors of 1e-7.
    exact = np.sin(np.pi * np.arange(1, 41) / 41) * np.exp(100.0 * (np.cos(np.pi / 41) - 1.0))
    np.testing.assert_allclose(sparse.context.continuous_state, exact, atol=1e-5)
    assert "dense: n = 40, 1600 places, 40 colours" in dense.statistics.linear_solver
    told = "none by differences" if form == "values" else "3 colours"
    assert sparse.statistics.linear_solver.startswith(f"band: n = 40, 118 places, {told}")
    saved = dense.statistics.right_hand_side_calls - sparse.statistics.right_hand_side_calls
    assert saved > 30


@pytest.mark.parametrize(
    ("declared", "message"),
    [
        ({"jacobian_sparsity": ([0, 1], [0])}, "expected an n by n array, a sparse matrix or"),
        ({"jacobian_sparsity": 3.5}, "expected an n by n array, a sparse matrix or"),
        ({"sparse_jacobian": len}, "sparse_jacobian without jacobian_sparsity; give both"),
    ],
)
def test_a_sparsity_that_is_none_is_refused(declared, message):
    with pytest.raises(saltus.ModelError, match=re.escape(message)):
        chain(**declared)


def test_a_sparsity_outside_the_matrix_is_refused_by_a_stiff_method():
    system = chain(jacobian_sparsity=([0], [40]))
    with pytest.raises(saltus.ModelError, match=re.escape("names entry (0, 40)")):
        saltus.simulate(system, system.create_context(), (0.0, 1.0), ode_solver_method="bdf")


def test_a_linear_solver_can_be_asked_for_and_a_wrong_one_is_refused():
    system = chain()
    results = saltus.simulate(
        system,
        system.create_context(),
        (0.0, 1.0),
        ode_solver_method="bdf",
        linear_solver="gmres",
    )
    assert results.statistics.linear_solver.startswith("gmres: n = 40")
    with pytest.raises(saltus.ModelError, match="did you mean 'band'"):
        saltus.Simulator(system, linear_solver="bnad")


def test_jacobian_is_used_and_read_row_by_row():
    matrix = np.array(
        [[-1.0, 1000.0], [0.0, -1000.0]]
    )  # its transpose would not converge to the same
    calls = []

    def declare(self):
        def jacobian(t, s):
            calls.append(t)
            return matrix

        self.declare_continuous_state(
            default_value=[1.0, 1.0],
            ode=lambda t, s: matrix @ s.continuous_state,
            jacobian=jacobian,
        )

    system = Block(declare)
    results = saltus.simulate(
        system, system.create_context(), (0.0, 1.0), ode_solver_method="bdf", rtol=1e-8, atol=1e-10
    )
    assert results.statistics.jacobian_calls == len(calls) > 0
    # x_1 = exp(-1000 t); x_0 = (1 + c) exp(-t) - c exp(-1000 t), c = 1000/999
    assert results.context.continuous_state[0] == pytest.approx(
        (1 + 1000 / 999) * np.exp(-1.0), rel=1e-5
    )
