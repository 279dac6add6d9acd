"""The ode of a Python block: what it may give, and what it is refused for."""

import numpy as np
import pytest
import saltus
from declared import Block
from saltus.library import Sine
from systems import flow, run


@pytest.mark.parametrize(
    "give",
    [
        lambda v: np.array([v, -9.81]),
        lambda v: [v, -9.81],
        lambda v: (float(v), -9.81),
        lambda v: np.array([v, -9.81], dtype=np.float32).astype(np.float64),
        lambda v: np.array([[v, -9.81]]),
    ],
)
def test_an_ode_may_give_arrays_lists_and_tuples(give):
    y, v = flow(lambda t, x: give(x[1]), [10.0, 0.0], (0.0, 1.0))
    assert v == pytest.approx(-9.81, rel=1e-7)  # float32 has 7 digits
    assert y == pytest.approx(10.0 - 9.81 / 2, rel=1e-6)


def test_scalar_state():
    def declare(self):
        self.declare_continuous_state((), ode=lambda t, s: 1.0 - s.continuous_state)
        self.declare_continuous_state_output("x")

    results = run(Block(declare), (0.0, 2.0), rtol=1e-10, atol=1e-12)
    assert results.outputs["x"].shape == results.time.shape
    # at most 1e-10 of error a step, and contraction keeps it there: some hundred steps at the most
    np.testing.assert_allclose(results.outputs["x"], 1.0 - np.exp(-results.time), atol=1e-8)


@pytest.mark.parametrize("method", ["dopri5", "adams", "bdf"])
def test_inputs_reach_the_ode(method):
    builder = saltus.DiagramBuilder()

    def declare(self):
        self.declare_input_port("u")
        self.declare_continuous_state(1, ode=lambda t, s, u: [u])
        self.declare_continuous_state_output("x")

    block, sine = builder.add(Block(declare), Sine(name="sine"))
    builder.connect(sine.output(), block.input())
    diagram = builder.build()
    results = saltus.simulate(
        diagram,
        diagram.create_context(),
        (0.0, 3.0),
        recorded_signals={"x": block.output()},
        ode_solver_method=method,
        rtol=1e-9,
        atol=1e-11,
    )
    # rtol holds for each step; BDF and Adams lose two or three digits over a hundred of them
    np.testing.assert_allclose(results.outputs["x"][:, 0], 1.0 - np.cos(results.time), atol=1e-6)


@pytest.mark.parametrize(
    ("ode", "message"),
    [
        (
            lambda t, s: None,
            "block 'flow': ode returned None, expected 2 numbers; is a `return` missing?",
        ),
        (lambda t, s: [1.0], "block 'flow': ode returned 1 numbers, expected 2"),
        (lambda t, s: "no", "block 'flow': ode returned 'no' (str), expected 2 numbers"),
        (
            lambda t, s: [1j, 2],
            "block 'flow': ode returned a list whose entry [0] is 1j (complex), expected 2 numbers",
        ),
    ],
)
@pytest.mark.parametrize("method", ["dopri5", "adams", "bdf"])
def test_bad_results_of_an_ode(ode, message, method):
    class Flow(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="flow")
            self.declare_continuous_state(2, ode=ode)

    system = Flow()
    with pytest.raises(saltus.ModelError) as caught:
        saltus.simulate(system, system.create_context(), (0.0, 1.0), ode_solver_method=method)
    assert str(caught.value) == message
