"""linearize by the parameters of outputs that are held between ticks."""

import numpy as np
import pytest
import saltus
from saltus.library import Constant, DataSource, Gain, Integrator, Pulse, Ramp, Step, ZeroOrderHold

SOURCES = {
    "Step before": (lambda: Step(2.0, 3.0, 1.0, name="s"), "s.start_value", 0.0, 1.0),
    "Step after": (lambda: Step(2.0, 3.0, 1.0, name="s"), "s.start_value", 1.5, 0.0),
    "Pulse": (lambda: Pulse(2.0, period=1.0, name="s"), "s.amplitude", 0.0, 1.0),
    "DataSource": (
        lambda: DataSource([0.0, 1.0, 2.0], [2.0, 3.0, 4.0], "zero_order_hold", name="s"),
        "s.values[0]",
        0.0,
        1.0,
    ),
    "Constant": (lambda: Constant(2.0, name="s"), "s.value", 0.0, 1.0),
    "Ramp": (lambda: Ramp(2.0, 1.0, 5.0, name="s"), "s.start_value", 0.0, 1.0),
}


def behind(source, *blocks):
    builder = saltus.DiagramBuilder()
    signal = builder.add(source).output()
    for block in (*blocks, Integrator(name="x")):
        builder.connect(signal, builder.add(block).input(0))
        signal = block.output()
    return builder.build()


@pytest.mark.parametrize(("make", "name", "t", "expected"), SOURCES.values(), ids=SOURCES)
def test_a_source_has_the_derivative_of_its_level(make, name, t, expected):
    """x' = 3 s: B is 3 where the parameter is the level at this time, as `sensitivity` says too."""
    diagram = behind(make(), Gain(3.0))
    context = saltus.simulate(diagram, (0.0, t)).context if t > 0.0 else diagram.create_context()
    found = saltus.linearize(diagram, context, inputs=[name])
    # Central differences of a function that is not traced are right to about 1e-10.
    assert found.B == pytest.approx(np.array([[3.0 * expected]]), abs=1e-9)
    run = saltus.simulate(diagram, context.with_time(t), (t, t + 0.25), sensitivity=[name])
    ends = run.sensitivities.continuous_state[-1].ravel() / 0.25
    # One step of a constant slope: some roundings.
    assert ends == pytest.approx([3.0 * expected], abs=1e-12)


def test_trim_moves_a_step():
    diagram = behind(Step(2.0, 3.0, 1.0, name="s"))
    found = saltus.trim(diagram, ["s.start_value"])
    assert found.status == "converged"
    assert found.values == {"s.start_value": pytest.approx(0.0, abs=1e-12)}


def test_a_held_output_stays_where_the_state_moves():
    """A ZeroOrderHold keeps what it read at its last tick, whatever x and the gain before it are now."""
    builder = saltus.DiagramBuilder()
    x, gain = builder.add(Integrator(1.0, name="x")), builder.add(Gain(3.0, name="k"))
    hold = builder.add(ZeroOrderHold(0.1, name="hold"))
    builder.connect(x.output(), gain.input())
    builder.connect(gain.output(), hold.input())
    builder.connect(hold.output(), x.input())
    found = saltus.linearize(builder.build(), inputs=["k.gain"])
    assert found.A.tolist() == [[0.0]]
    assert found.B.tolist() == [[0.0]]
    assert list(found.frozen) == ["hold.z[0]"]
