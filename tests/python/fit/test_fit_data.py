"""The forms that data may have, and their weights."""

import numpy as np
import pytest
import saltus
from fit_scenes import Decay, Throw, heights

T = np.linspace(0.05, 1.0, 20)
Y = heights(T, 9.81, 0.7)
WANTED = {"e": (0.4, 1.0)}


def fitted(data, **options):
    return saltus.fit(Throw(), data, WANTED, **options)


REFERENCE = fitted({"time": T, "height": Y})


def columns(values):
    """The same numbers in memory of another order."""
    wide = np.zeros((len(values), 3))
    wide[:, 1] = values
    return wide[:, 1]


FORMS = {
    "lists": {"time": T.tolist(), "height": Y.tolist()},
    "tuples": {"time": tuple(T), "height": tuple(Y)},
    "strided": {"time": columns(T), "height": columns(Y)},
    "reversed": {"time": T[::-1], "height": Y[::-1]},
    "read only": {"time": np.frombuffer(T.tobytes()), "height": np.frombuffer(Y.tobytes())},
    "one column": {"time": T, "height": Y[:, None]},
    "an entry": {"time": T, "state[0]": Y},
}


@pytest.mark.parametrize("form", FORMS)
def test_forms_of_a_dict(form):
    found = fitted(FORMS[form])
    assert found.parameters == pytest.approx(REFERENCE.parameters, rel=1e-12)


@pytest.mark.parametrize("order", ["C", "F"])
def test_a_vector_signal(order):
    truth = saltus.simulate(
        Throw(e=0.7), (0.0, 1.0), save_at=T, event_rows=False,
        recorded_signals=["state"], rtol=1e-10, atol=1e-12,
    )  # fmt: skip
    found = fitted({"time": T, "state": np.array(truth["state"], order=order)})
    # rtol = 1e-8 of the runs of the fit, and a factor near 1 of one bounce
    assert found.parameters["e"] == pytest.approx(0.7, rel=1e-7)
    assert found.jacobian.shape == (40, 1)


def test_a_data_frame_by_column_and_by_index():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"time": T, "height": Y})
    assert fitted(frame).parameters == REFERENCE.parameters
    assert fitted(frame.set_index("time")).parameters == REFERENCE.parameters


def test_the_tables_of_results_are_data():
    """Of their rows before and after an event the one after it counts."""
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    run = saltus.simulate(
        Throw(e=0.7), (0.0, 1.0), recorded_signals=["height"], rtol=1e-10, atol=1e-12,
        max_minor_step_size=0.05,
    )  # fmt: skip
    assert len(np.unique(run.time)) < len(run.time)
    for table in (run.to_pandas(), run.to_xarray()):
        found = fitted(table)
        assert found.parameters["e"] == pytest.approx(0.7, rel=1e-7)
        assert len(found.residuals) == len(np.unique(run.time))


def test_a_dataset_with_its_dimensions_in_another_order():
    xarray = pytest.importorskip("xarray")
    truth = saltus.simulate(
        Throw(e=0.7), (0.0, 1.0), save_at=T, event_rows=False,
        recorded_signals=["state"], rtol=1e-10, atol=1e-12,
    )  # fmt: skip
    dataset = xarray.Dataset({"state": (("entry", "time"), truth["state"].T)}, {"time": T})
    assert fitted(dataset).parameters["e"] == pytest.approx(0.7, rel=1e-7)


def test_nan_is_a_missing_value():
    gaps = Y.copy()
    gaps[[3, 7]] = np.nan
    found = fitted({"time": T, "height": gaps})
    without = fitted({"time": np.delete(T, [3, 7]), "height": np.delete(Y, [3, 7])})
    assert found.missing == 2 and without.missing == 0
    assert found.parameters == without.parameters
    assert "18 data (2 missing)" in repr(found)
    times = saltus.EventTimes([np.nan, 0.96])
    assert fitted({"bounce": times}).compared[0].entry.tolist() == [1]


def test_several_values_at_one_time():
    """A mean of two: the fit of y = x(0) exp(-k t) at t = 0 is their mean."""
    data = {"time": [0.0, 0.0, 0.0], "y": [1.0, 2.0, 6.0]}
    found = saltus.fit(Decay(), data, {"x[0]": 1.0})
    assert found.parameters["x[0]"] == pytest.approx(3.0, rel=1e-12)
    assert found.standard_errors["x[0]"] == pytest.approx(np.sqrt(14 / 2 / 3), rel=1e-9)


@pytest.mark.parametrize("form", ["array", "dict", "column"])
def test_weights_are_those_of_the_standard_deviations(form):
    """The weighted mean: sum of y / s² over sum of 1 / s²."""
    y, s = np.array([1.0, 2.0, 6.0]), np.array([0.5, 1.0, 2.0])
    sigma = {"array": {"y": s}, "dict": {"y": s.tolist()}, "column": {"y": s[:, None]}}[form]
    values = y[:, None] if form == "column" else y
    data = {"time": np.zeros(3), "y": values}
    found = saltus.fit(Decay(), data, {"x[0]": 1.0}, sigma=sigma, absolute_sigma=True)
    weight = 1 / s**2
    assert found.parameters["x[0]"] == pytest.approx((y * weight).sum() / weight.sum(), rel=1e-9)
    assert found.standard_errors["x[0]"] == pytest.approx(weight.sum() ** -0.5, rel=1e-9)
    half = 1.959963984540054 * weight.sum() ** -0.5  # the normal quantile
    low, high = found.confidence()["x[0]"]
    assert (high - low) / 2 == pytest.approx(half, rel=1e-9)


def test_signals_have_names_of_the_user():
    ball = Throw()
    data = {"time": T, "h": Y}
    by_path = saltus.fit(ball, data, WANTED, signals={"h": "height"})
    by_port = saltus.fit(ball, data, WANTED, signals={"h": ball.output("height")})
    assert by_path.parameters == by_port.parameters == REFERENCE.parameters


def test_blocks_of_a_diagram_by_path():
    builder = saltus.DiagramBuilder()
    builder.add(Throw())
    diagram = builder.build()
    found = saltus.fit(diagram, {"time": T, "ball.height": Y}, {"ball.e": (0.4, 1.0)})
    # the value of the context is 0.8 here as there
    assert found.values == pytest.approx(REFERENCE.values, rel=1e-12)


def test_a_loss_that_outliers_do_not_move():
    outliers = Y.copy()
    outliers[::7] += 1.0
    plain = fitted({"time": T, "height": outliers})
    robust = fitted({"time": T, "height": outliers}, loss="soft_l1", f_scale=1e-3)
    off = [abs(found.parameters["e"] - 0.7) for found in (plain, robust)]
    # an outlier has the weight 1 / sqrt(1 + 1e6): a thousandth of its influence
    assert off[1] < 0.01 * off[0]
    own = fitted(
        {"time": T, "height": outliers},
        loss=lambda z: np.array([
            2 * (np.sqrt(1 + z) - 1), (1 + z) ** -0.5, -0.5 * (1 + z) ** -1.5,
        ]),
        f_scale=1e-3,
    )  # fmt: skip
    assert own.parameters == pytest.approx(robust.parameters, rel=1e-9)
    assert own.standard_errors == pytest.approx(robust.standard_errors, rel=1e-6)
