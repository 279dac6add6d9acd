"""The outputs of a Python block: shape, feedthrough, truth, and how often they are called."""

import numpy as np
import pytest
import saltus
from declared import Block
from saltus.library import Constant, Gain, Integrator


def test_outputs_find_their_shape_by_one_call():
    def declare(self):
        self.declare_input_port("u")
        self.declare_continuous_state(2, ode=lambda t, s, u: [0.0, 0.0])
        self.declare_output_port(lambda t, s, u: 2.0 * np.asarray(u), name="as input")
        self.declare_output_port(
            lambda t, s: s.continuous_state, name="state", requires_inputs=False
        )
        self.declare_output_port(
            lambda t, s: s.continuous_state[0], name="first", requires_inputs=False
        )
        self.declare_output_port(
            lambda t, s: np.ones(3), name="fixed", requires_inputs=False, shape=3
        )
        self.declare_output_port(
            lambda t, s: [t], name="default", requires_inputs=False, default_value=[0.0]
        )

    builder = saltus.DiagramBuilder()
    block, source = builder.add(Block(declare), Constant([1.0, 2.0, 3.0]))
    builder.connect(source.output(), block.input())
    diagram = builder.build()
    recorded = {port.name: port for port in block.output_ports}
    outputs = saltus.simulate(
        diagram, diagram.create_context(), (0.0, 1.0), recorded_signals=recorded
    ).outputs
    widths = {name: array.shape[1:] for name, array in outputs.items()}
    assert widths == {"as input": (3,), "state": (2,), "first": (), "fixed": (3,), "default": (1,)}
    assert outputs["as input"][0].tolist() == [2.0, 4.0, 6.0]


def test_an_output_that_needs_no_input_closes_a_loop():
    """Only declared feedthrough counts: block -> gain -> block is no algebraic loop."""

    def declare(self, requires_inputs):
        self.declare_input_port("u")
        self.declare_continuous_state(default_value=[1.0], ode=lambda t, s, u: [u])
        self.declare_output_port(
            lambda t, s, *u: s.continuous_state[0], name="y", requires_inputs=requires_inputs
        )

    def diagram(requires_inputs):
        builder = saltus.DiagramBuilder()
        block, gain = builder.add(
            Block(lambda self: declare(self, requires_inputs)), Gain(-1.0, name="gain")
        )
        builder.connect(block.output(), gain.input())
        builder.connect(gain.output(), block.input())
        return builder.build()

    good = diagram(False)
    end = saltus.simulate(good, good.create_context(), (0.0, 1.0), rtol=1e-9, atol=1e-11).context
    assert end.continuous_state[0] == pytest.approx(np.exp(-1.0), abs=1e-8)
    with pytest.raises(saltus.ModelError, match="loop"):
        diagram(True)


def test_boolean_output_resets_an_integrator():
    """A sawtooth of period 1: the integrator of 1 falls back when a Python block says it is
    full.
    """

    def declare(self):
        self.declare_input_port("level")
        self.declare_output_port(lambda t, s, level: level >= 1.0, name="full")

    builder = saltus.DiagramBuilder()
    one, tank, full = builder.add(
        Constant(1.0), Integrator(enable_reset=True, name="tank"), Block(declare)
    )
    builder.connect(one.output(), tank.input("in"))
    builder.connect(tank.output(), full.input())
    builder.connect(full.output(), tank.input("reset_trigger"))
    diagram = builder.build()
    results = saltus.simulate(
        diagram, diagram.create_context(), (0.0, 3.5), recorded_signals={"x": tank.output()}
    )
    # located to a hundred roundings of the time; three of them add up
    np.testing.assert_allclose(
        results.events.times("tank.reset"), [1.0, 2.0, 3.0], rtol=0, atol=3e-13
    )
    assert results.outputs["x"][-1] == pytest.approx(0.5, abs=1e-12)


def test_reads_decides_how_often_an_output_is_called():
    def calls(**reads):
        seen = []

        def declare(self):
            self.declare_discrete_state(default_value=[1.0])
            self.declare_output_port(
                lambda t, s: seen.append(t) or s.discrete_state[0], name="u", **reads
            )

        builder = saltus.DiagramBuilder()
        block, plant = builder.add(Block(declare), Integrator(name="plant"))
        builder.connect(block.output(), plant.input())
        diagram = builder.build()
        steps = saltus.simulate(
            diagram, diagram.create_context(), (0.0, 1.0), max_minor_step_size=0.01
        ).statistics.steps
        return len(seen), steps

    often, steps = calls()
    assert often > 5 * steps  # at every stage
    seldom, _ = calls(reads=["discrete_state"])
    assert seldom < 10


@pytest.mark.parametrize("where", ["output", "ode"])
def test_required_inputs_must_be_there(where):
    def declare(self):
        self.declare_input_port()
        if where == "ode":
            self.declare_continuous_state(1, ode=lambda t, s, u: [u], requires_inputs=[1])
        else:
            self.declare_output_port(lambda t, s, u: u, requires_inputs=[1])

    builder = saltus.DiagramBuilder()
    block, source = builder.add(Block(declare), Constant(1.0))
    builder.connect(source.output(), block.input())
    diagram = builder.build()
    with pytest.raises(saltus.ModelError, match="input 1, the block has 1"):
        saltus.simulate(diagram, diagram.create_context(), (0.0, 1.0))
