"""Names of continuous states: outputs, columns, values of a context, sweeps."""

import numpy as np
import pytest
import saltus


class Ball(saltus.LeafSystem):
    def __init__(self, name="ball", names=("height", "velocity")):
        super().__init__(name=name)
        self.declare_continuous_state(default_value=[10.0, 0.0], ode=self.fall, names=names)
        self.declare_zero_crossing(
            lambda time, state: state.continuous_state[0],
            lambda time, state: state.with_continuous_state(
                [0.0, -0.5 * state.continuous_state[1]]
            ),
            direction="positive_then_non_positive",
        )

    def fall(self, time, state):
        return [state.continuous_state[1], -10.0]


def test_each_name_is_an_output_that_shows_its_entry():
    ball = Ball()
    ball.declare_continuous_state_output(name="both")
    results = saltus.simulate(
        ball, ball.create_context(), (0, 3), recorded_signals=["height", "velocity", "both"]
    )
    np.testing.assert_array_equal(results["height"], results["both"][:, 0])
    np.testing.assert_array_equal(results["velocity"], results["both"][:, 1])


def test_named_states_are_wired_and_recorded_by_path():
    builder = saltus.DiagramBuilder()
    ball = builder.add(Ball())
    twice = builder.add(saltus.library.Gain(2.0, name="twice"))
    builder.connect("ball.height", "twice.in")
    del ball, twice
    diagram = builder.build(name="scene")
    results = saltus.simulate(
        diagram,
        diagram.create_context(),
        (0, 1),
        recorded_signals=["ball.height", "twice.out"],
    )
    np.testing.assert_array_equal(results["twice.out"], 2.0 * results["ball.height"])


def test_a_sweep_and_a_table_speak_of_names():
    ball = Ball()
    runs = saltus.sweep(ball, {"height": [5.0, 20.0]}, (0, 1), as_dict=True, rtol=1e-9)
    np.testing.assert_allclose(runs["continuous_state"][1], [15.0, -10.0])
    results = saltus.simulate(
        ball, ball.create_context(), (0, 1), recorded_signals=["height", "velocity"]
    )
    assert list(results.to_pandas().columns) == ["height", "velocity"]


def test_unknown_names_are_answered_with_the_names():
    with pytest.raises(saltus.ModelError, match="did you mean 'height'"):
        saltus.sweep(Ball(), {"hight": [1.0]}, (0, 1))


@pytest.mark.parametrize(
    ("names", "message"),
    [
        (["height"], "expected 2 names, one for each state, found 1"),
        (["height", "height"], "'height' is given twice"),
        (["x", "v"], "'x' cannot be the name of a state"),
        (["a.b", "v"], "'a.b' cannot be the name of a state"),
        (["a[0]", "v"], "cannot be the name of a state"),
        (["", "v"], "cannot be the name of a state"),
        ("hv", "names: expected"),
        ([1, 2], "names: expected"),
    ],
)
def test_names_that_make_no_sense_are_refused(names, message):
    with pytest.raises(saltus.ModelError) as raised:
        Ball(names=names)
    assert message in str(raised.value)


def test_a_name_that_a_parameter_has_too_is_refused_where_it_is_used():
    ball = Ball()
    ball.declare_dynamic_parameter("height", 1.0)
    with pytest.raises(saltus.ModelError, match="rename the parameter"):
        saltus.sweep(ball, {"height": [1.0]}, (0, 1))


def test_an_output_cannot_have_the_name_of_a_state():
    ball = Ball()
    with pytest.raises(saltus.ModelError, match="'height' is declared twice"):
        ball.declare_output_port(lambda time, state: 0.0, name="height")
