"""Pictures: what is drawn, seen from matplotlib's side."""

import subprocess
import sys

import numpy as np
import pytest
import saltus
from saltus import Guard
from systems import Ball, run

plt = pytest.importorskip("matplotlib.pyplot")


@pytest.fixture(autouse=True)
def close():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def ball():
    return saltus.solve(
        lambda t, x: [x[1], -10.0],
        (0.0, 4.0),
        [5.0, 0.0],
        events=Guard(lambda t, x: x[0], lambda t, x: [0, -0.5 * x[1]], "falling", name="bounce"),
        dense_output=True,
    )


def markers(ax):
    """(hollow, filled) points of the jumps."""
    lines = [line for line in ax.lines if line.get_marker() == "o"]
    hollow = [line for line in lines if line.get_markerfacecolor() == "white"]
    filled = [line for line in lines if line.get_markerfacecolor() != "white"]
    return [line.get_xydata() for line in hollow], [line.get_xydata() for line in filled]


def test_jumps_are_gaps_with_markers(ball):
    ax = ball.plot("x[1]")
    (before,), (after,) = markers(ax)
    np.testing.assert_allclose(before[:3], [[1, -10], [2, -5], [2.5, -2.5]], atol=1e-12)
    np.testing.assert_allclose(after[:3], [[1, 5], [2, 2.5], [2.5, 1.25]], atol=1e-12)
    time, value = ax.lines[0].get_data()
    gaps = time[np.isnan(value)]
    assert set(before[:, 0]) <= set(gaps)
    assert ax.get_ylabel() == "x[1]" and ax.get_xlabel() == "time [s]"
    assert ax.get_legend() is None


def test_a_height_has_no_jumps(ball):
    ax = ball.plot("x[0]")
    assert markers(ax) == ([], [])
    assert not np.isnan(ax.lines[0].get_ydata()).any()


def test_dense_output_is_drawn(ball):
    """Between bounces the curve is the parabola, not the chord."""
    time, value = ball.plot("x[0]").lines[0].get_data()
    first = time < 1.0
    assert np.count_nonzero(first) > 20
    np.testing.assert_allclose(value[first], 5.0 - 5.0 * time[first] ** 2, atol=1e-12)


def test_rows_alone_are_drawn_without_it():
    results = run(Ball(), (0.0, 1.0))
    ax = results.plot("state[0]")
    assert np.array_equal(ax.lines[0].get_xdata(), results.time)


def test_steps_between_far_rows_are_drawn():
    solution = saltus.solve(
        lambda t, x: [np.cos(t)], (0, 20), [0.0], t_eval=[0.0, 10.0, 20.0], dense_output=True
    )
    time, value = solution.plot().lines[0].get_data()
    np.testing.assert_allclose(value, np.sin(time), atol=1e-4)
    assert np.max(value) > 0.99


def test_holds_are_shaded_and_events_ticked(ball):
    ax = ball.plot("x[0]")
    (shade,) = ax.patches
    assert shade.get_x() == pytest.approx(3.0, abs=1e-4)
    assert shade.get_x() + shade.get_width() == 4.0
    (ticks,) = ax.collections
    drawn = [path[0, 0] for path in ticks.get_segments()]
    assert set(drawn) == {event.time for event in ball.events}


def test_a_released_hold_ends_there():
    ax = saltus.scene("bouncing-ball-blocks").simulate().plot("y")
    (shade,) = ax.patches
    assert shade.get_x() + shade.get_width() == pytest.approx(1.0)


def test_one_axes_for_each_signal():
    results = saltus.scene("bouncing-ball-blocks").simulate()
    axes = results.plot()
    assert [ax.get_ylabel() for ax in axes] == ["y", "v"]
    assert axes[0].get_xlabel() == "" and axes[1].get_xlabel() == "time [s]"
    assert axes[0].get_shared_x_axes().joined(*axes)


def test_a_legend_only_for_several_curves(ball):
    ax = ball.plot()
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["x[0]", "x[1]"]
    assert ball.plot("x[0]").get_legend() is None


def test_axes_of_the_user_and_style(ball):
    _, ax = plt.subplots()
    assert ball.plot("x[0]", "x[1]", ax=ax, color="k", linewidth=3) is ax
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["x[0]", "x[1]"]
    assert ax.lines[0].get_color() == "k" and ax.lines[0].get_linewidth() == 3


def test_errors(ball):
    with pytest.raises(saltus.ModelError, match="nothing was recorded under 'xx'; did you mean"):
        ball.plot("xx")
    system = Ball()
    with pytest.raises(saltus.ModelError, match="give recorded_signals"):
        saltus.simulate(system, (0, 1), recorded_signals=[]).plot()


def test_a_run_of_one_row_and_one_that_failed():
    run(Ball(), (1.0, 1.0), dense_output=True).plot()
    saltus.solve(lambda t, x: x**2, (0, 2), [1.0], throw=False, dense_output=True).plot()


def test_matplotlib_is_imported_only_when_used():
    code = "import saltus, sys; repr(saltus.scene('kepler').simulate());"
    code += "print('matplotlib' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
