"""A function with an argument `out` fills it and returns nothing."""

import numpy as np
import pytest
import saltus

from models import end, leaf

CALLED = {"python": "called"}


def test_an_ode_fills_out():
    def ode(time, state, out):
        out[0] = state.continuous_state[1]
        out[1] = -state.continuous_state[0]

    x = end(leaf(ode, [1.0, 0.0]), rtol=1e-10, atol=1e-12, **CALLED)
    # error per unit time near rtol; a few hundred of it in reserve
    np.testing.assert_allclose(x, [np.cos(1.0), -np.sin(1.0)], atol=1e-8)


def test_by_keyword_alone_after_inputs_and_parameters():
    block = saltus.LeafSystem(name="block")
    u = block.declare_input_port(shape=2)
    block.declare_dynamic_parameter("k", 3.0)

    def output(time, state, u, *, k, out):
        out[:] = k * u

    block.declare_output_port(output, name="y", shape=2)
    builder = saltus.DiagramBuilder()
    source = builder.add(saltus.library.Constant([1.0, 2.0]))
    builder.add(block)
    builder.connect(source.output(), block.input(u))
    diagram = builder.build()
    results = saltus.simulate(
        diagram,
        diagram.create_context(),
        (0.0, 1.0),
        recorded_signals={"y": block.output("y")},
        **CALLED,
    )
    assert results.outputs["y"][-1].tolist() == [3.0, 6.0]


def test_guard_and_jacobian_fill_out():
    shapes = []

    def jacobian(time, state, out):
        shapes.append(out.shape)
        out[:] = [[-2.0, 1.0], [0.0, -1e4]]

    block = saltus.LeafSystem(name="block")
    block.declare_continuous_state(
        default_value=[1.0, 1.0],
        ode=lambda t, s: [[-2.0, 1.0], [0.0, -1e4]] @ s.continuous_state,
        jacobian=jacobian,
    )

    def guard(time, state, out):
        out[0] = state.continuous_state[0] - 0.5

    block.declare_zero_crossing(guard, name="half")
    results = saltus.simulate(
        block, block.create_context(), (0.0, 1.0), ode_solver_method="bdf", **CALLED
    )
    assert len(results.events) == 1
    assert set(shapes) == {(2, 2)}


def test_the_shape_of_the_state_is_that_of_out():
    def ode(time, state, out):
        assert out.shape == (2, 2)
        out[:] = -state.continuous_state

    block = saltus.LeafSystem(name="block")
    block.declare_continuous_state(default_value=np.ones((2, 2)), ode=ode)
    assert end(block, **CALLED).size == 4


def test_a_kept_array_is_left_alone():
    kept = []

    def ode(time, state, out):
        out[0] = time
        kept.append(out)

    end(leaf(ode), **CALLED)
    assert len({float(out[0]) for out in kept}) > 3


@pytest.mark.parametrize("python", ["called", "traced"])
def test_what_was_not_written_is_refused(python):
    def ode(time, state, out):
        out[0] = 1.0

    with pytest.raises(saltus.ModelError, match=r"'block'.*ode did not write entry 1 of 2"):
        end(leaf(ode, [0.0, 0.0]), python=python)


def test_a_nan_that_was_written_is_none_of_ours():
    def ode(time, state, out):
        out[0] = np.nan

    with pytest.raises(saltus.SimulationError, match="not finite"):
        end(leaf(ode), **CALLED)


@pytest.mark.parametrize("python", ["called", "traced"])
def test_returning_as_well_is_refused(python):
    def ode(time, state, out):
        out[0] = 1.0
        return out

    with pytest.raises(saltus.ModelError, match=r"fills `out` and returned .* as well"):
        end(leaf(ode), python=python)


def test_an_output_says_its_shape():
    def output(time, state, out):
        out[0] = 1.0

    block = saltus.LeafSystem(name="block")
    with pytest.raises(saltus.ModelError, match=r"output 'out_0'.*say how much: shape="):
        block.declare_output_port(output)


def test_a_parameter_called_out_is_a_parameter():
    block = leaf(lambda time, state, out: [-out * state.continuous_state[0]], out=2.0)
    assert end(block)[0] == pytest.approx(np.exp(-2.0), rel=1e-4)


def test_functions_of_numpy_have_out_and_return():
    block = saltus.library.FunctionBlock(np.sin, name="sine")
    assert [r.callback for r in block.explain()] == ["output 'out'"]
    assert block.explain()[0].runs == "traced"


def test_traced_in_place():
    def ode(time, state, out):
        out[:] = -2.0 * state.continuous_state

    block = leaf(ode)
    assert block.explain()[0].runs == "traced"
    assert end(block)[0] == pytest.approx(end(block, **CALLED)[0], rel=1e-12)
