"""What a sweep gives back: shapes, times, failures, reductions; with and without xarray."""

import sys

import numpy as np
import pytest
import saltus
from made import Ball, bounces, make_refusing, peak
from saltus.errors import ModelError
from saltus.library import Clock, Integrator, Saturate

xarray = pytest.importorskip("xarray")
GRID = {"e": [0.0, 0.5, 0.9], "x[0]": [5.0, 10.0]}


@pytest.fixture(scope="module")
def ball():
    return saltus.scene("bouncing-ball").system


def test_signals_at_common_times(ball):
    times = [0.0, 0.5, 1.0, 2.0]
    found = saltus.sweep(
        ball, GRID, (0.0, 2.0), recorded_signals={"y": ball.output(0)}, save_at=times, rtol=1e-9
    )
    assert found["y"].dims == ("e", "x[0]", "time", "y_entry")
    assert found["time"].values.tolist() == times
    for e in GRID["e"]:
        for y0 in GRID["x[0]"]:
            alone = saltus.simulate(
                ball,
                ball.create_context().with_parameter("e", e).with_continuous_state([y0, 0.0]),
                (0.0, 2.0),
                recorded_signals={"y": ball.output(0)},
                save_at=times,
                rtol=1e-9,
            )
            rows = np.searchsorted(alone.time, times, side="right") - 1
            swept = found["y"].sel({"e": e, "x[0]": y0}).values
            assert np.array_equal(swept, alone.outputs["y"][rows])


def test_signals_at_the_end_by_their_names(ball):
    found = saltus.sweep(ball, GRID, (0.0, 2.0), recorded_signals={"y": "ball:y"})
    assert found["y"].dims == ("e", "x[0]", "y_entry")
    assert np.array_equal(found["y"].values, found["continuous_state"].values)
    with pytest.raises(ModelError, match="ball:y"):
        saltus.sweep(ball, GRID, (0.0, 2.0), recorded_signals={"y": "ball:z"})


def test_a_signal_has_no_value_after_the_end():
    leaf = Ball()
    leaf.declare_zero_crossing(guard=leaf.guard, terminal=True, name="landed")
    found = saltus.sweep(
        leaf,
        {"x[0]": [1.0, 20.0]},
        (0.0, 2.0),
        recorded_signals={"state": leaf.output("state")},
        save_at=[0.1, 1.9],
    )
    # sqrt(2 / 9.81) = 0.45 s and sqrt(40 / 9.81) = 2.02 s
    assert found["status"].values.tolist() == ["terminal", "reached_end"]
    assert np.isnan(found["state"].values[:, :, 0]).tolist() == [[False, True], [False, False]]
    assert found["end_time"].values[0] == pytest.approx(np.sqrt(2 / 9.81), rel=1e-6)


def test_failures_keep_their_reasons():
    found = saltus.sweep(make_refusing, {"e": [0.5, 0.7, 0.6]}, (0.0, 1.0), executor="serial")
    assert found["status"].values.tolist() == ["reached_end", "failed", "reached_end"]
    assert found["message"].values.tolist() == ["", "ValueError: too lively", ""]
    assert np.isnan(found["continuous_state"].values[1]).all()
    assert not np.isnan(found["continuous_state"].values[[0, 2]]).any()
    assert found.attrs["failures"] == "1 failed (ValueError: too lively)"
    assert "too lively" in repr(found)


def test_values_without_meaning_fail_their_run_only(ball):
    found = saltus.sweep(ball, {"e": [0.5, np.nan, 0.7]}, (0.0, 1.0))
    assert found["status"].values.tolist() == ["reached_end", "failed", "reached_end"]
    assert "'e' is nan" in found["message"].values[1]


def test_the_foot_says_how_it_went(ball):
    attributes = saltus.sweep(ball, GRID, (0.0, 1.0), workers=2).attrs
    assert attributes["runs"] == 6
    assert attributes["failures"] == "none"
    assert attributes["executor"] == "threads"
    assert attributes["workers"] == 2
    assert attributes["runs_per_second"] == pytest.approx(6 / attributes["wall_time"])


@pytest.mark.parametrize("workers", [1, 2])
def test_reduce_to_a_number(ball, workers):
    found = saltus.sweep(ball, GRID, (0.0, 4.0), reduce=bounces, workers=workers)
    assert found["bounces"].dims == ("e", "x[0]")
    assert "continuous_state" not in found
    # without a bounce at rest an ideal ball lands at t1 (1 + 2 e + 2 e^2 + ...), t1 = sqrt(2 y0/g)
    t1 = np.sqrt(2 * 5.0 / 9.81)
    landings = t1 * (1 + 2 * np.cumsum(0.9 ** np.arange(1, 20)))
    assert found["bounces"].sel({"e": 0.9, "x[0]": 5.0}) == 1 + (landings <= 4.0).sum()


def test_reduce_to_a_dict(ball):
    found = saltus.sweep(ball, GRID, (0.0, 2.0), reduce=peak)
    plain = saltus.sweep(ball, GRID, (0.0, 2.0))
    assert found["state"].dims == ("e", "x[0]", "state_0")
    assert np.array_equal(found["state"].values, plain["continuous_state"].values)


def test_an_error_in_reduce_is_one_of_its_run(ball):
    def picky(results):
        if results.context.parameters["e"] == 0.5:
            raise LookupError("no")
        return 1.0

    found = saltus.sweep(ball, {"e": [0.5, 0.6]}, (0.0, 1.0), reduce=picky)
    assert found["status"].values.tolist() == ["failed", "reached_end"]
    assert found["message"].values[0] == "reduce: LookupError: no"
    assert np.isnan(found["picky"].values[0]) and found["picky"].values[1] == 1.0


def test_a_dict_has_the_same_names_and_needs_no_xarray(ball, monkeypatch):
    dataset = saltus.sweep(ball, GRID, (0.0, 1.0))
    monkeypatch.setitem(sys.modules, "xarray", None)
    plain = saltus.sweep(ball, GRID, (0.0, 1.0), as_dict=True)
    assert set(plain) == {*dataset.variables, "attrs"}
    for name in ("continuous_state", "events", "status", "e"):
        assert np.array_equal(plain[name], dataset[name].values)
    with pytest.raises(ImportError, match="as_dict=True"):
        saltus.sweep(ball, GRID, (0.0, 1.0))


def test_it_can_be_saved(ball, tmp_path):
    found = saltus.sweep(ball, GRID, (0.0, 1.0), recorded_signals={"y": ball.output(0)})
    frame = found[["events", "status"]].to_dataframe()
    assert len(frame) == 6


@pytest.mark.parametrize(
    ("how", "says"),
    [
        ({"executor": "thread"}, "did you mean 'threads'"),
        ({"executor": 3}, r"expected an executor with submit\(\) or map\(\)"),
        ({"workers": 0}, "workers: expected 1 or more"),
        ({"rtoll": 1e-3}, "did you mean 'rtol'"),
        ({"rtol": -1.0}, "rtol"),
        ({"throw": True}, "failures are kept"),
        ({"save_steps": True}, "no steps in common"),
        ({"reduce": 3}, "expected a function"),
        ({"context": 3}, "expected a context"),
        ({"recorded_signals": {"status": "ball:y"}}, "this name is taken"),
        ({"recorded_signals": {"e": "ball:y"}}, "this name is taken"),
        ({"recorded_signals": {"y": 3}}, "expected a port, such as"),
    ],
)
def test_arguments_that_cannot_be_meant(ball, how, says):
    with pytest.raises(ModelError, match=says):
        saltus.sweep(ball, GRID, (0.0, 1.0), **how)


@pytest.mark.parametrize("span", [(1.0, 0.0), 3, (0.0, "x")])
def test_spans_that_cannot_be_meant(ball, span):
    with pytest.raises(ModelError, match="expected a span"):
        saltus.sweep(ball, GRID, span)


def test_what_is_no_system():
    with pytest.raises(ModelError, match="expected a system"):
        saltus.sweep(3, GRID, (0.0, 1.0))
    with pytest.raises(ModelError, match="a context is of one system"):
        saltus.sweep(Ball, {"e": [1.0]}, (0.0, 1.0), context=Ball().create_context())
    with pytest.raises(ModelError, match="expected a function that makes a system"):
        saltus.sweep(lambda e: 3, {"e": [1.0]}, (0.0, 1.0))


@pytest.mark.parametrize("islands", [False, True])
@pytest.mark.parametrize("times", [[], [0.5, 1.0]])
def test_a_run_that_cannot_begin_is_a_row_with_its_reason(times, islands):
    """Limits that cross are refused before the run; the other runs keep their values."""
    builder = saltus.DiagramBuilder()
    for name in ("one", "two"):
        clock, limit, total = builder.add(
            Clock(name=f"{name}_clock"),
            Saturate(upper_limit=1.0, lower_limit=0.0, name=f"{name}_limit"),
            Integrator(0.0, name=name),
        )
        builder.connect(clock.output(), limit.input())
        builder.connect(limit.output(), total.input())
        builder.export_output(total.output(), f"{name}_total")
    found = saltus.sweep(
        builder.build(),
        {"one_limit.upper_limit": [1.0, -5.0, 2.0]},
        (0.0, 1.0),
        save_at=times,
        islands=islands,
        recorded_signals=["one_total", "two_total"],
    )
    assert [str(status) for status in found["status"].values] == [
        "reached_end",
        "failed",
        "reached_end",
    ]
    last = np.asarray(found["two_total"]).reshape(3, -1)[:, -1]
    # The integral of t over 1 s, to rtol; the run that was refused has no rows.
    assert np.isnan(last[1]) and np.abs(last[[0, 2]] - 0.5).max() < 1e-6
