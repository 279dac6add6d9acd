"""Step responses by closed forms, and the picture of a linearisation."""

import numpy as np
import pytest
import saltus
from saltus.linearization.step import horizon
from saltus.library import Integrator


class Oscillator(saltus.LeafSystem):
    """x'' + 2 d x' + w^2 x = w^2 u."""

    def __init__(self, d=0.3, w=2.0):
        super().__init__(name="oscillator")
        self.d, self.w = d, w
        self.declare_input_port(name="u")
        self.declare_continuous_state([0.0, 0.0], names=["place", "speed"], ode=self.ode)

    def ode(self, time, state, u):
        x, v = state.continuous_state
        return [v, self.w**2 * (u - x) - 2.0 * self.d * v]


def linear(**values):
    return saltus.linearize(Oscillator(**values), inputs={"u": 0.7})


def test_the_step_of_an_oscillator():
    t = np.linspace(0.0, 9.0, 400)
    found = linear().step(t)
    wd = np.sqrt(2.0**2 - 0.3**2)
    x = 1.0 - np.exp(-0.3 * t) * (np.cos(wd * t) + 0.3 / wd * np.sin(wd * t))
    # 400 products of matrices of norm near 1, each with some ten roundings
    np.testing.assert_allclose(found[:, 0, 0], x, atol=1e-12)
    assert found.shape == (400, 2, 1)


def test_a_singular_matrix_and_times_with_other_steps():
    lin = saltus.linearize(Integrator(0.0), inputs={"in": 0.0})
    np.testing.assert_allclose(lin.step([0.0, 0.0, 0.5, 7.0])[:, 0, 0], [0, 0, 0.5, 7.0])


@pytest.mark.parametrize(
    ("poles", "time"),
    [([-2.0, -10.0], 2.5), ([-2.0, 3.0], 1.0), ([0.0, 0.0], 10.0), ([0.0, -5.0], 1.0)],
)
def test_the_time_of_a_picture(poles, time):
    assert horizon(np.diag(poles)) == pytest.approx(time)


def test_undamped_motion_is_shown_for_four_periods():
    assert horizon(np.array([[0.0, 1.0], [-4.0, 0.0]])) == pytest.approx(4.0 * np.pi)


def test_the_picture_has_the_poles_and_the_response():
    pytest.importorskip("matplotlib")
    lin = linear()
    left, right = lin.plot(outputs=["place"])
    marks = left.get_lines()[-1]
    np.testing.assert_array_equal(marks.get_xdata(), lin.poles().real)
    np.testing.assert_array_equal(marks.get_ydata(), lin.poles().imag)
    curve = right.get_lines()[0]
    assert curve.get_xdata()[-1] == pytest.approx(5.0 / 0.3)
    np.testing.assert_array_equal(curve.get_ydata(), lin.step(curve.get_xdata())[:, 0, 0])
    assert right.get_ylabel() == "place by u"


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda lin: lin.plot(["w"]), "there is no 'w'"),
        (lambda lin: lin.plot(outputs=["y"]), "there is no 'y'"),
        (lambda lin: lin.plot(t_end=-1.0), "t_end: expected a positive time"),
        (lambda lin: lin.step([-1.0]), "expected times of 0 or more"),
        (lambda lin: lin.step([2.0, 1.0]), "do not decrease"),
        (lambda lin: lin.step([np.nan]), "expected times of 0 or more"),
    ],
)
def test_wrong_arguments(call, words):
    with pytest.raises(saltus.ModelError, match=words):
        call(linear())


def test_without_an_input_there_is_no_response():
    with pytest.raises(saltus.ModelError, match="plot: the linearisation has no input"):
        saltus.linearize(saltus.scene("lorenz").system).plot()
