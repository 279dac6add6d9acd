"""What `trim` and `equilibria` refuse, by name."""

import numpy as np
import pytest
import saltus
from saltus.library import TransportDelay
from test_trim import Pendulum, tank


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"free": ["angel"], "hold": {"torque": 0.0}}, "did you mean 'angle'"),
        ({"free": ["thrust"], "hold": {"torque": 0.0}}, "open inputs; Known: 'torque'"),
        ({"free": ["angle", "angle"], "hold": {"torque": 0.0}}, "named twice"),
        ({"free": ["angle", "x[0]"], "hold": {"torque": 0.0}}, "are one value"),
        ({"free": ["angle"], "hold": {"angle": 1.0, "torque": 0.0}}, "is free and held"),
        ({"free": ["angle"]}, "is open and has no value"),
        ({"free": ["mode"], "hold": {"torque": 0.0}}, "'mode' is a mode"),
        ({"free": {"torque": (3.0, 1.0)}}, "expected a lower bound below the upper bound"),
        ({"free": {"torque": saltus.Free(1.0, log=True)}}, "log=True belongs to fit"),
        ({"free": ["torque[0]"]}, "expected the vector of the open input"),
        ({"free": [], "hold": {"torque": 0.0}}, "has 0 free values and 2 equations"),
        ({"hold": {"torqe": 0.0}}, "did you mean 'torque'"),
        ({"hold": {"torque": np.nan}}, "expected finite numbers"),
        ({"hold": {"torque": "much"}}, "expected numbers, found 'much'"),
        ({"hold": {"torque": 0.0}, "derivatives": {"damping": 0.0}}, "is no continuous state"),
        ({"hold": {"torque": 0.0}, "derivatives": {"angle": np.nan}}, "expected a finite number"),
        ({"hold": {"torque": 0.0}, "outputs": {"angl": 1.0}}, "did you mean 'angle'"),
        ({"hold": {"torque": 0.0}, "outputs": {"angle": [1.0, 2.0]}}, "has 1 entries, found 2"),
        ({"hold": {"torque": 0.0}, "tolerance": 0.0}, "tolerance: expected a number"),
        ({"hold": {"torque": 0.0}, "max_nfev": 0}, "max_nfev: expected an integer"),
        ({"hold": {"torque": 0.0}, "python": "tracd"}, "did you mean 'traced'"),
    ],
)
def test_an_argument_that_makes_no_sense(arguments, words):
    with pytest.raises(saltus.ModelError, match=words.replace("[", r"\[")):
        saltus.trim(Pendulum(), **arguments)


def test_a_discrete_state_is_not_free():
    class Leaf(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="leaf")
            self.declare_continuous_state([0.0], ode=lambda t, s: s.discrete_state)
            self.declare_discrete_state([2.0])

    with pytest.raises(saltus.ModelError, match=r"'z\[0\]' is a discrete state"):
        saltus.trim(Leaf(), ["z[0]"])


def test_a_start_that_is_not_finite():
    with pytest.raises(saltus.ModelError, match=r"trim: at the start values: t = 0 s: .*nan"):
        saltus.trim(tank(), {"x[0]": -1.0})


def test_a_ball_at_rest_and_a_history():
    ball = saltus.scene("bouncing-ball")
    done = saltus.simulate(ball.system, ball.context, (0.0, 60.0))
    with pytest.raises(saltus.ModelError, match="block 'ball' is at rest"):
        saltus.trim(ball.system, context=done.context)
    delay = TransportDelay(1.0)
    with pytest.raises(saltus.ModelError, match="keeps a history"):
        saltus.trim(delay, [delay.input_names[0]], outputs={delay.output_names[0]: 1.0})
    with pytest.raises(saltus.ModelError, match="expected a system, found 3"):
        saltus.trim(3)


@pytest.mark.parametrize(
    ("starts", "arguments", "words"),
    [
        ({"angle": (0.0, np.inf)}, {}, "expected finite bounds"),
        ({"angle": 1.0}, {}, "expected finite bounds"),
        ({"angle": (0.0, 1.0)}, {"count": 0}, "count: expected 1 or more"),
        ({"angle": (0.0, 1.0)}, {"seed": "a"}, "seed: expected an integer"),
        ([], {}, "expected a box or a list of starts"),
        ([{"angle": 1.0}, {"rate": 1.0}], {}, "expected dicts with the same names"),
        ({"angel": (0.0, 1.0)}, {}, "did you mean 'angle'"),
    ],
)
def test_starts_that_make_no_sense(starts, arguments, words):
    with pytest.raises(saltus.ModelError, match=words):
        saltus.equilibria(Pendulum(), starts, hold={"torque": 0.0}, **arguments)
