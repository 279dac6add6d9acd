"""Python callbacks that a plan may compute together with those of their neighbours."""

import numpy as np
import pytest
import saltus
from saltus.library import FunctionBlock, Integrator, ReduceBlock


class Spring(saltus.LeafSystem):
    """State (y [m], v [m/s]); a force that another block computes from it."""

    def __init__(self, formula):
        super().__init__(name="spring")
        self.declare_continuous_state([1.0, 0.0], ode=self.ode, formula=formula)
        self.declare_dynamic_parameter("mass", 1.3)
        self.declare_input_port("force")
        self.declare_output_port(
            self.stretch, name="stretch", shape=(), requires_inputs=False, formula=formula
        )
        self.declare_continuous_state_output("x")
        self.declare_zero_crossing(
            self.height,
            self.bounce,
            name="bounce",
            requires_inputs=[0],
            direction="falling",
            formula=formula,
        )
        self.above = self.declare_relation(self.level, name="above", formula=formula)

    def ode(self, time, state, force, *, mass):
        v = state.continuous_state[1]
        return [v, force / mass - 0.01 * v * np.cos(time)]

    def stretch(self, time, state, *, mass):
        return np.exp(-0.1 * time) + state.continuous_state[0] ** 3

    def height(self, time, state, force, *, mass):
        return state.continuous_state[0] + 0.25 + 0.001 * force

    def bounce(self, time, state, force, *, mass):
        return state.with_continuous_state(
            [state.continuous_state[0], -0.9 * state.continuous_state[1]]
        )

    def level(self, time, state, force, *, mass):
        return state.continuous_state[0] - 0.5


def loop(formula):
    """The spring, and a force of two function blocks: -(2 s + sin(s))."""
    builder = saltus.DiagramBuilder()
    spring, wave, total = builder.add(
        Spring(formula),
        FunctionBlock(lambda s: np.sin(s), name="wave", formula=formula),
        ReduceBlock(2, lambda u: -(2.0 * u[0] + u[1]), name="total", formula=formula),
    )
    builder.connect(spring.output("stretch"), wave.input())
    builder.connect(spring.output("stretch"), total.input(0))
    builder.connect(wave.output(), total.input(1))
    builder.connect(total.output(), spring.input())
    return builder.build(), spring


def run(formula, method, **options):
    diagram, spring = loop(formula)
    return saltus.simulate(
        diagram,
        (0.0, 9.0),
        recorded_signals={"x": spring.output("x")},
        ode_solver_method=method,
        rtol=1e-8,
        atol=1e-10,
        **options,
    )


@pytest.mark.parametrize("method", ["dopri5", "dop853", "adams", "bdf"])
def test_the_bits_are_those_of_single_calls(method):
    fused, single = run(True, method), run(False, method)
    assert fused.time.tobytes() == single.time.tobytes()
    assert fused.outputs["x"].tobytes() == single.outputs["x"].tobytes()
    assert fused.context == single.context
    assert len(fused.events) == len(single.events) > 3
    assert fused.statistics.steps == single.statistics.steps


def fused_line(diagram):
    lines = saltus.Simulator(diagram).describe().splitlines()
    return [line for line in lines if "fused" in line]


def test_the_plan_says_what_is_fused():
    assert any("3 (" in line for line in fused_line(loop(True)[0])), fused_line(loop(True)[0])
    assert not fused_line(loop(False)[0])


@pytest.mark.parametrize(
    "callback",
    [
        lambda time, state: state.discrete_state[0] + state.continuous_state[0],
        lambda time, state: state.continuous_state[0] * float(state.mode),
        lambda time, state: [float(state.continuous_state[0] > 0.5)] * 17,
        lambda time, state: 1.0 if state.continuous_state[0] > 2.0 else time,  # called, not traced
    ],
    ids=["discrete", "mode", "wide", "called"],
)
def test_what_no_formula_can_be_remains_a_call(callback):
    class Block(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="block")
            self.declare_continuous_state([1.0], ode=lambda t, s, u: [np.sum(u)])
            self.declare_discrete_state([2.0])
            self.declare_default_mode(1)
            self.declare_input_port("u")
            self.declare_output_port(callback, name="y", requires_inputs=False, formula=True)

    builder = saltus.DiagramBuilder()
    block = builder.add(Block())
    builder.connect(block.output("y"), block.input())
    diagram = builder.build()
    assert not fused_line(diagram)
    assert saltus.simulate(diagram, (0.0, 1.0)).status == "reached_end"


def test_an_attribute_that_changes_between_two_pieces_is_refused():
    class Decay(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="decay")
            self.rate = 1.0
            self.declare_continuous_state([1.0], ode=self.ode, formula=True)

        def ode(self, time, state):
            return -self.rate * state.continuous_state

    decay = Decay()
    simulator = saltus.Simulator(decay)
    simulator.initialize(decay.create_context())
    simulator.advance_to(1.0)
    decay.rate = 2.0
    with pytest.raises(saltus.ModelError, match="depends on more"):
        simulator.advance_to(2.0)
    simulator.initialize(decay.create_context())
    simulator.advance_to(1.0)
    assert simulator.context.continuous_state[0] == pytest.approx(np.exp(-2.0), rel=1e-5)


def test_a_number_that_is_not_finite_is_traced_to_the_function_that_raises():
    """The search for it calls each function alone."""
    builder = saltus.DiagramBuilder()
    x, inverse, shift = builder.add(
        Integrator(1.0, name="x"),
        FunctionBlock(lambda u: 1.0 / u, name="inverse", formula=True),
        FunctionBlock(lambda u: u - 1.0, name="shift", formula=True),
    )
    builder.connect(x.output(), shift.input())
    builder.connect(shift.output(), inverse.input())
    builder.connect(inverse.output(), x.input())
    diagram = builder.build()
    with pytest.raises(ZeroDivisionError):
        saltus.simulate(diagram, (0.0, 1.0))
