"""Heat maps of sweeps: which value is where, and what is refused."""

import numpy as np
import pytest
import saltus
from saltus import ModelError

plt = pytest.importorskip("matplotlib.pyplot")
GRID = {"e": [0.5, 0.7, 0.9], "x[0]": [5.0, 10.0]}


@pytest.fixture(autouse=True)
def close():
    yield
    plt.close("all")


def swept(**options):
    ball = saltus.scene("bouncing-ball").system
    return saltus.sweep(ball, GRID, (0.0, 3.0), executor="serial", **options)


def cells(ax):
    """The values over (y, x)."""
    return np.asarray(ax.collections[0].get_array()).reshape(
        len(np.unique(ax.collections[0].get_coordinates()[:, :, 1])) - 1, -1
    )


def test_each_cell_has_the_value_of_its_run():
    pytest.importorskip("xarray")
    data = swept()
    ax = saltus.plot_sweep(data, "events")
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("e", "x[0]")
    np.testing.assert_array_equal(cells(ax), data["events"].values.T)


def test_axes_can_be_exchanged():
    data = swept(as_dict=True)
    for over in (("e", "x[0]"), ("x[0]", "e")):
        ax = saltus.plot_sweep(data, "events", over)
        assert (ax.get_xlabel(), ax.get_ylabel()) == over
        expected = data["events"].T if over[0] == "e" else data["events"]
        np.testing.assert_array_equal(cells(ax), expected)


def test_values_are_sorted_along_the_axes():
    ball = saltus.scene("bouncing-ball").system
    grid = {"e": [0.9, 0.5, 0.7], "x[0]": [10.0, 5.0]}
    mixed = saltus.sweep(ball, grid, (0.0, 3.0), as_dict=True)
    axes = [saltus.plot_sweep(d, "events", ("e", "x[0]")) for d in (mixed, swept(as_dict=True))]
    np.testing.assert_array_equal(cells(axes[0]), cells(axes[1]))


def test_failed_runs_have_a_cross_and_no_colour():
    def grows(k, start):
        system = saltus.LeafSystem(name="grows")
        system.declare_continuous_state([start], ode=lambda t, s: s.continuous_state**2 * k)
        system.declare_continuous_state_output("x")
        return system

    table = saltus.sweep(  # 1 / (1 / x0 - k t) is infinite at 1 / (k x0)
        grows, {"k": [0.1, 2.0], "start": [0.5, 1.0]}, (0.0, 1.5), recorded_signals=["x"],
        executor="serial", as_dict=True,
    )  # fmt: skip
    ax = saltus.plot_sweep(table, "x", ("k", "start"))
    (crosses,) = (line.get_xydata() for line in ax.lines)
    assert sorted(map(tuple, crosses)) == [(2.0, 0.5), (2.0, 1.0)]
    assert np.ma.getmaskarray(ax.collections[0].get_array()).sum() == 2


@pytest.mark.parametrize(
    ("name", "over", "says"),
    [
        ("evnts", ("e", "x[0]"), "no value 'evnts'; did you mean 'events'"),
        ("events", None, "a dict does not know its dimensions: give over="),
        ("events", ("e", "x"), "over: no 'x'"),
        ("events", ("e", "e"), "over: expected two parameters"),
        ("events", "ex", "over: expected two parameters"),
        ("continuous_state", ("e", "x[0]"), "expected numbers over two parameters"),
        ("status", ("e", "x[0]"), "expected numbers over two parameters"),
    ],
)
def test_what_is_no_map_is_refused(name, over, says):
    with pytest.raises(ModelError, match=says):
        saltus.plot_sweep(swept(as_dict=True), name, over)
