"""Phase portraits, event rasters, Zeno zooms and sections: what they show, whatever the colours."""

import numpy as np
import pytest
import saltus
from saltus import ModelError

plt = pytest.importorskip("matplotlib.pyplot")
E = 0.9


@pytest.fixture(autouse=True)
def close():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def ball():
    return saltus.scene("bouncing-ball", e=E, t_end=12.0).simulate(dense_output=True)


@pytest.fixture(scope="module")
def resting():
    return saltus.scene("bouncing-ball", e=E, t_end=40.0).simulate(dense_output=True)


def dashed(ax):
    """The dashed segments, each from x- to x+."""
    lines = [line.get_xydata() for line in ax.lines if line.get_linestyle() == "--"]
    points = np.vstack(lines) if lines else np.empty((0, 2))
    return np.split(points, np.flatnonzero(np.isnan(points[:, 0])))


def test_a_phase_portrait_has_one_dashed_segment_for_each_jump(ball):
    segments = dashed(ball.plot_phase("y[0]", "y[1]"))
    bounces = ball.events.times("bounce")
    assert len(segments) == len(bounces) == 6
    for t, segment in zip(bounces, segments, strict=True):
        segment = segment[~np.isnan(segment[:, 0])]
        np.testing.assert_array_equal(segment[0], ball(t, side="left")["y"])
        np.testing.assert_array_equal(segment[1], ball(t, side="right")["y"])


def test_the_flow_of_a_phase_portrait_breaks_at_jumps_and_keeps_the_energy(ball):
    """Between two gaps g y + v^2 / 2 is constant; at each gap it falls by e^2."""
    flow = ball.plot_phase().lines[0].get_xydata()
    pieces = np.split(flow, np.flatnonzero(np.isnan(flow[:, 0])))
    assert len(pieces) == 7
    energies = []
    for piece in pieces:
        y, v = piece[~np.isnan(piece[:, 0])].T
        energy = 9.81 * y + 0.5 * v**2
        # rtol = 1e-6 of the scene, a few steps a flight
        np.testing.assert_allclose(energy, energy[0], rtol=1e-5)
        energies.append(energy[0])
    np.testing.assert_allclose(np.divide(energies[1:], energies[:-1]), E**2, rtol=1e-5)


def test_a_smooth_run_has_no_dashed_segment():
    ax = saltus.scene("kepler").simulate(dense_output=True).plot_phase(0, 1)
    assert dashed(ax) == [] or all(len(part) == 0 for part in dashed(ax))
    assert not np.isnan(ax.lines[0].get_ydata()).any()


def test_a_phase_portrait_of_rows_draws_them():
    ball = saltus.scene("bouncing-ball").simulate()
    flow = ball.plot_phase().lines[0].get_xydata()
    np.testing.assert_array_equal(flow[~np.isnan(flow[:, 0])], ball["y"])


def test_the_start_is_marked(ball):
    (start,) = (line for line in ball.plot_phase().lines if line.get_marker() == "s")
    np.testing.assert_array_equal(start.get_xydata(), [[10.0, 0.0]])


def ticks(ax):
    return [line.get_xydata() for line in ax.lines if line.get_marker() == "|"]


def test_a_raster_has_a_tick_for_each_event_in_the_row_of_its_name():
    tanks = saltus.scene("water-tanks", t_end=7.5).simulate()
    ax = tanks.plot_events()
    names = [label.get_text() for label in ax.get_yticklabels()]
    assert names == ["tanks.second_low", "tanks.first_low"]
    for row, name in enumerate(names):
        np.testing.assert_array_equal(ticks(ax)[row][:, 0], tanks.events.times(name))
        assert (ticks(ax)[row][:, 1] == row).all()
    first, second = ax.get_ylim()
    assert first > second  # the first row is at the top
    low, high = ax.get_xlim()
    assert low < 0.0 < 7.5 < high  # the span of the run, not of the events


def test_a_raster_shows_chosen_names_in_their_order_and_holds_as_bars(resting):
    ax = resting.plot_events("bounce")
    assert [label.get_text() for label in ax.get_yticklabels()] == ["bounce"]
    (bar,) = (line.get_xdata() for line in ax.lines if line.get_marker() != "|")
    enter = next(e for e in resting.events if e.kind == "zeno_enter")
    np.testing.assert_array_equal(bar[:2], [enter.time, 40.0])


def test_a_zeno_zoom_of_numbers_is_a_straight_line(resting):
    """t* - t_k falls by the factor e with each bounce, so k over its logarithm has slope 1/ln e."""
    ax = resting.plot_zeno("bounce")
    left, number = ax.lines[0].get_data()
    np.testing.assert_array_equal(number, np.arange(1, 144))
    # the error of t* is 1e-6 of a gap at the hold: the early points are exact
    np.testing.assert_allclose(left[1:60] / left[:59], E, rtol=1e-6)
    assert ax.get_xscale() == "log" and ax.xaxis.get_inverted()


def test_a_zeno_zoom_of_a_height_is_bounded_by_a_parabola(resting):
    """A flight with (t* - t) = s left at its begin has the peak g ((1 - e) s)^2 / 8."""
    ax = resting.plot_zeno(signal="y[0]")
    left, height = ax.lines[0].get_data()
    assert ax.get_yscale() == "log"
    known = ~np.isnan(height)
    assert (height[known] > 0).all() and known.sum() > 1000
    peak = 9.81 * ((1 / E - 1) * left[known] / 1) ** 2 / 8 * 1.12**2  # seen from inside a flight
    late = left[known] < 10.0  # before, the ball was dropped
    assert (height[known][late] <= peak[late] * 1.25).all()


def test_a_section_has_the_values_at_each_event(ball):
    times = ball.events.times("bounce")
    for side in ("left", "right"):
        ax = ball.plot_section("bounce", "y[0]", "y[1]", side=side)
        np.testing.assert_array_equal(ax.lines[0].get_ydata(), ball(times, side=side)["y"][:, 1])
    speeds = ball.plot_section("bounce").lines[0].get_ydata()
    np.testing.assert_allclose(speeds[1:] / speeds[:-1], E, rtol=1e-6)


def test_a_section_of_rows_and_of_dense_output_is_the_same():
    scene = saltus.scene("ball-table")
    few = scene.simulate(dense_output=True, save_steps=False, save_at=[0.0, 7.0])
    all_rows = scene.simulate()
    points = [r.plot_section("bounce").lines[0].get_xydata() for r in (few, all_rows)]
    np.testing.assert_allclose(points[0], points[1], atol=1e-12)


def test_a_plot_goes_into_given_axes_with_a_style(ball):
    _, ax = plt.subplots()
    assert ball.plot_phase(ax=ax, color="black", linewidth=3) is ax
    assert ax.lines[0].get_color() == "black" and ax.lines[0].get_linewidth() == 3
    assert {line.get_color() for line in ax.lines} == {"black"}


@pytest.mark.parametrize(
    ("draw", "says"),
    [
        (lambda r: r.plot_phase("y[0]", "v"), "nothing was recorded under 'v'"),
        (lambda r: r.plot_phase(0, 2), "expected the number of an entry from 0 to 1, found 2"),
        (lambda r: r.plot_events("bonce"), "did you mean 'bounce'"),
        (lambda r: r.plot_zeno(), "no event accumulated in this run"),
        (lambda r: r.plot_zeno("bounce"), "no event 'bounce' accumulated in this run"),
        (lambda r: r.plot_section("bonce"), "did you mean 'bounce'"),
        (lambda r: r.plot_section("bounce", side="up"), "unknown side 'up'"),
        (lambda r: r.plot("y", backend="bokeh"), "backend: unknown 'bokeh'"),
    ],
)
def test_wrong_names_are_named(ball, draw, says):
    with pytest.raises(ModelError, match=says):
        draw(ball)


def test_runs_without_events_or_signals_are_refused():
    smooth = saltus.solve(lambda t, x: -x, (0, 1), [1.0])
    with pytest.raises(ModelError, match="no event happened"):
        smooth.plot_events()
    scene = saltus.scene("bouncing-ball")
    bare = saltus.simulate(scene.system, scene.context, (0, 1), recorded_signals={})
    with pytest.raises(ModelError, match="nothing was recorded"):
        bare.plot_phase()
    still = saltus.scene("bouncing-ball", t_end=1.0).simulate()
    with pytest.raises(ModelError, match="'bounce' never happened"):
        still.plot_section("bounce")
