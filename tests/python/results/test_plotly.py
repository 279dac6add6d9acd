"""The plots by plotly: lines break at jumps, and the data are those of matplotlib's."""

import subprocess
import sys

import numpy as np
import pytest
import saltus
from saltus import ModelError

objects = pytest.importorskip("plotly.graph_objects")


@pytest.fixture(scope="module")
def ball():
    return saltus.scene("bouncing-ball", t_end=40.0).simulate(dense_output=True)


def lines(figure):
    return [trace for trace in figure.data if trace.mode == "lines"]


def test_lines_break_at_jumps(ball):
    """A row of nan at the time of each jump, and plotly is told to leave gaps."""
    figure = ball.plot("y", backend="plotly")
    assert isinstance(figure, objects.Figure)
    height, velocity = lines(figure)
    assert (height.name, velocity.name) == ("y[0]", "y[1]")
    gaps = velocity.x[np.isnan(velocity.y)]
    assert set(ball.events.times("bounce")[:40]) <= set(gaps)
    assert not np.isnan(height.y).any()
    assert all(trace.connectgaps is False for trace in figure.data)


def test_the_curve_is_that_of_matplotlib(ball):
    plt = pytest.importorskip("matplotlib.pyplot")
    ours = lines(ball.plot("y[1]", backend="plotly"))[0]
    theirs = ball.plot("y[1]").lines[0]
    np.testing.assert_array_equal(ours.x, theirs.get_xdata())
    np.testing.assert_array_equal(ours.y, theirs.get_ydata())
    plt.close("all")


def test_holds_are_shaded(ball):
    (hold,) = ball.plot("y[0]", backend="plotly").layout.shapes
    enter = next(e for e in ball.events if e.kind == "zeno_enter")
    assert (hold.x0, hold.x1) == (enter.time, 40.0)


def test_each_signal_has_a_panel_over_one_time_axis():
    figure = saltus.scene("bouncing-ball-blocks").simulate().plot(backend="plotly")
    titles = [figure.layout[axis].title.text for axis in ("yaxis", "yaxis2")]
    assert titles == ["y", "v"]
    assert {trace.xaxis for trace in figure.data} == {"x"}
    assert {trace.yaxis for trace in figure.data} == {"y1", "y2"} or {
        trace.yaxis for trace in figure.data
    } == {"y", "y2"}
    assert figure.layout.yaxis.domain[0] > figure.layout.yaxis2.domain[1]  # the first on top


def test_a_phase_portrait_has_a_dashed_segment_for_each_jump(ball):
    dashed = [trace for trace in ball.plot_phase(backend="plotly").data if trace.line.dash]
    (jumps,) = dashed
    assert np.isnan(jumps.x).sum() + 1 == len(ball.events.times("bounce"))


def test_the_other_plots_are_figures_too(ball):
    zeno = ball.plot_zeno(backend="plotly")
    assert zeno.layout.xaxis.type == "log" and zeno.layout.xaxis.autorange == "reversed"
    raster = ball.plot_events(backend="plotly")
    assert raster.layout.yaxis.ticktext == ("ball.bounce",)
    section = ball.plot_section("bounce", backend="plotly")
    assert len(section.data[0].x) == len(ball.events.times("bounce"))
    table = saltus.sweep(
        saltus.scene("bouncing-ball").system, {"e": [0.5, 0.7], "x[0]": [1.0, 2.0, 3.0]}, (0, 3),
        as_dict=True,
    )  # fmt: skip
    heat = saltus.plot_sweep(table, "events", over=("e", "x[0]"), backend="plotly")
    np.testing.assert_array_equal(heat.data[0].z, table["events"].T)


def test_a_style_is_passed_on(ball):
    figure = ball.plot_phase(backend="plotly", color="black", opacity=0.5)
    assert lines(figure)[0].line.color == "black" and lines(figure)[0].opacity == 0.5


def test_a_figure_becomes_a_page_of_its_own(ball):
    assert "y[0]" in ball.plot("y[0]", backend="plotly").to_html(include_plotlyjs=False)


def test_axes_of_matplotlib_are_refused(ball):
    with pytest.raises(ModelError, match="these are axes of matplotlib"):
        ball.plot("y", ax=object(), backend="plotly")


def test_without_plotly_the_message_names_the_extra():
    code = (
        "import sys; sys.modules['plotly'] = sys.modules['plotly.graph_objects'] = None\n"
        "import saltus\n"
        "run = saltus.scene('two-walls', t_end=1.0).simulate()\n"
        "for draw in (run.plot, run.plot_phase):\n"
        "    try: draw(backend='plotly')\n"
        "    except ImportError as error: print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    said = "backend='plotly' needs plotly, which is not installed: pip install plotly"
    lines = done.stdout.splitlines()
    assert len(lines) == 2
    assert all(line.startswith(said) and "[plotly]" in line for line in lines)
