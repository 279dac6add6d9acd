"""What a callback of a Python block gets: time, state, inputs, parameters."""

import numpy as np
import pytest
import saltus
from declared import Block
from saltus.library import Constant
from systems import Ball, flow


def seen_by(declare, connect=(), **options):
    """What an ode of a block gets: the arguments of its first call."""
    calls = []

    def ode(time, state, *inputs, **params):
        calls.append((time, state, inputs, params))
        return np.zeros_like(state.continuous_state)

    builder = saltus.DiagramBuilder()
    block = builder.add(Block(lambda self: declare(self, ode)))
    for i, source in enumerate(connect):
        builder.connect(builder.add(source).output(), block.input(i))
    diagram = builder.build()
    saltus.simulate(diagram, diagram.create_context(), (0.0, 1.0), **options)
    return calls[0]


def test_time_and_state():
    def declare(self, ode):
        self.declare_continuous_state(default_value=np.arange(6.0).reshape(2, 3), ode=ode)
        self.declare_discrete_state(default_value=[7.0])
        self.declare_default_mode(4)

    time, state, inputs, params = seen_by(declare)
    assert type(time) is float
    assert time == 0.0
    assert state.continuous_state.tolist() == [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]]
    assert state.discrete_state.tolist() == [7.0]
    assert state.mode == 4
    assert inputs == ()
    assert params == {}


def test_inputs_are_floats_or_arrays():
    def declare(self, ode):
        for shape in (None, None, 1):
            self.declare_input_port(shape=shape)
        self.declare_continuous_state(1, ode=ode)

    _, _, (scalar, vector, one), _ = seen_by(
        declare, [Constant(2.5), Constant([1.0, 2.0]), Constant([3.0])]
    )
    assert type(scalar) is float
    assert scalar == 2.5
    assert vector.tolist() == [1.0, 2.0]
    assert one.tolist() == [3.0]


@pytest.mark.parametrize(
    ("requires_inputs", "expected"),
    [(True, (1.0, 2.0, 3.0)), (False, ()), ([2, 0], (3.0, 1.0)), ([], ())],
)
def test_requires_inputs(requires_inputs, expected):
    def declare(self, ode):
        for _ in range(3):
            self.declare_input_port()
        self.declare_continuous_state(1, ode=ode, requires_inputs=requires_inputs)

    _, _, inputs, _ = seen_by(declare, [Constant(1.0), Constant(2.0), Constant(3.0)])
    assert inputs == expected


def test_parameters_come_by_keyword():
    def declare(self, ode):
        self.declare_dynamic_parameter("k", 2)
        self.declare_dynamic_parameter("matrix", [[1, 2], [3, 4]])
        self.declare_continuous_state(1, ode=ode)

    _, _, _, params = seen_by(declare)
    assert type(params["k"]) is float
    assert params["k"] == 2.0
    assert params["matrix"].tolist() == [[1.0, 2.0], [3.0, 4.0]]


def test_parameters_are_those_of_the_context():
    ball = Ball(e=1.0)
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    for g in (9.81, 1.62, 9.81):
        results = saltus.simulate(ball, context.with_parameter("g", g), (0.0, 1.0))
        assert results.context.continuous_state[1] == pytest.approx(-g)


def test_nothing_that_a_callback_gets_can_be_written_to():
    def declare(self, ode):
        self.declare_input_port()
        self.declare_dynamic_parameter("p", [1.0, 2.0])
        self.declare_continuous_state(2, ode=ode)

    _, state, (u,), params = seen_by(declare, [Constant([1.0, 2.0])])
    for array in (state.continuous_state, state.discrete_state, u, params["p"]):
        assert not array.flags.writeable
    with pytest.raises(saltus.ModelError, match=r"return state\.with_mode"):
        state.mode = 3


def test_arrays_may_be_kept():
    """Each keeps the value it had, however many calls follow, and after the block is gone."""
    kept = []

    def ode(t, x):
        kept.append((t, x, x[:1]))
        return [1.0]

    assert flow(ode, [0.0], (0.0, 1.0)) == pytest.approx(1.0)
    assert len(kept) > 10
    for t, x, view in kept:
        # every stage of an explicit method is exact for dx/dt = 1, to the rounding of its few sums
        assert x[0] == view[0] == pytest.approx(t, abs=1e-14)


def test_states_are_values():
    def declare(self, ode):
        self.declare_continuous_state(2, ode=ode)
        self.declare_discrete_state(default_value=[1.0])

    _, state, _, _ = seen_by(declare)
    given = np.array([3.0, 4.0])
    other = state.with_continuous_state(given).with_mode(2)
    given[:] = 0.0
    assert other.continuous_state.tolist() == [3.0, 4.0]
    assert (other.mode, state.mode) == (2, 0)
    assert state.continuous_state.tolist() == [0.0, 0.0]
    assert repr(other) == "State(continuous_state=[3. 4.], discrete_state=[1.], mode=2)"
    with pytest.raises(
        saltus.ModelError, match="block 'block': continuous state: expected 2 numbers, found 3"
    ):
        state.with_continuous_state([1.0, 2.0, 3.0])
