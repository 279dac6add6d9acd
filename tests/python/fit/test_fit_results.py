"""What a fit returns, shows and draws."""

import pickle

import numpy as np
import pytest
import saltus
from fit_scenes import Throw, heights, impacts

T = np.linspace(0.05, 1.2, 24)
DATA = {"time": T, "height": heights(T), "bounce": saltus.EventTimes(impacts(2), sigma=0.01)}


@pytest.fixture(scope="module")
def found():
    data = {**DATA, "height": DATA["height"] + 0.01 * np.sin(50 * T)}
    return saltus.fit(Throw(), data, {"g": 9.0, "e": (0.1, 1.0)}, sigma={"height": 0.01})


def test_the_parts_of_a_result(found):
    assert found.names == ("g", "e")
    assert found.values.tolist() == list(found.parameters.values())
    assert found.residuals.shape == (26,) and found.jacobian.shape == (26, 2)
    assert found.cost == pytest.approx(found.residuals @ found.residuals / 2)
    assert found.jacobian.T @ found.residuals == pytest.approx(
        np.zeros(2), abs=1e-3 * np.linalg.norm(found.residuals) * np.linalg.norm(found.jacobian)
    )
    assert found.evaluations >= 2 and found.wall_time > 0.0


def test_the_jacobian_is_the_derivative_of_the_residuals(found):
    """Central differences of the closed form with the step 1e-5: an error of h² times the third
    derivative, which is of order 100 here, and of rounding 1e-16 / h, both over sigma = 0.01.
    """
    h = 1e-5
    for k, name in enumerate(found.names):
        left, right = (
            closed_form({**found.parameters, name: found.parameters[name] + side})
            for side in (-h, h)
        )
        slope = (right - left) / (2 * h)
        # the runs have rtol = 1e-8, which is 1e-6 over sigma, and the scale of slopes is 1 to 100
        assert found.jacobian[:, k] == pytest.approx(slope, rel=1e-5, abs=1e-4), name


def closed_form(values):
    """The model over sigma, in the order of the data."""
    return np.concatenate([heights(T, **values), impacts(2, **values)]) / 0.01


def test_the_runs_are_those_of_the_fitted_values(found):
    (run,) = found.runs
    assert run.dense and run.status == "reached_end"
    hits = impacts(2, **found.parameters)
    assert run.events.times("bounce")[:2] == pytest.approx(hits, rel=1e-7)
    again = found.contexts[0].parameters
    assert {name: again[name] for name in found.names} == found.parameters


def test_text_and_html(found):
    lines = repr(found).splitlines()
    assert lines[0].startswith("fit: converged after") and "26 data" in lines[0]
    assert lines[1].split() == ["parameter", "value", "standard", "error", "95", "%", "confidence"]
    assert [line.split()[0] for line in lines[2:4]] == ["g", "e"]
    assert "<table>" in found._repr_html_()


def test_a_table_of_data_and_model(found):
    pytest.importorskip("pandas")
    frame = found.to_pandas()
    assert len(frame) == 26 and set(frame["name"]) == {"height", "bounce"}
    assert frame["residual"].to_numpy() == pytest.approx(found.residuals)
    difference = (frame["model"] - frame["data"]) / 0.01
    assert difference.to_numpy() == pytest.approx(found.residuals, abs=1e-9)


def test_a_plot_of_fit_and_residuals(found):
    plt = pytest.importorskip("matplotlib.pyplot")
    axes = found.plot()
    assert axes.shape == (2, 2)
    assert axes[0, 0].get_ylabel() == "height" and axes[1, 0].get_xlabel() == "time [s]"
    points = axes[0, 0].lines[0]
    assert points.get_xdata() == pytest.approx(T)
    assert axes[1, 0].lines[0].get_ydata() == pytest.approx(found.residuals[:24])
    assert axes[0, 1].get_ylabel() == "bounce: time [s]"
    assert found.plot("height").shape == (2, 1)
    with pytest.raises(saltus.ModelError, match="did you mean 'height'"):
        found.plot("heigth")
    plt.close("all")


def test_progress_is_shown(capsys):
    seen = []
    found = saltus.fit(Throw(), DATA, {"g": 9.0, "e": (0.1, 1.0)}, progress=seen.append)
    assert seen[-1].evaluations == found.evaluations and seen[-1].failures == 0
    assert seen[-1].parameters == pytest.approx(found.parameters, rel=1e-6)
    saltus.fit(Throw(), DATA, {"e": (0.1, 1.0)}, progress=True)
    assert "evaluations" in capsys.readouterr().err


def test_a_level_that_makes_no_sense(found):
    for level in (0.0, 1.0, 95):
        with pytest.raises(saltus.ModelError, match="between 0 and 1"):
            found.confidence(level)


def test_what_a_user_gives_can_be_pickled():
    for thing in (saltus.Free(1.0, 0.5, 2.0, True), saltus.EventTimes([1.0, 2.0])):
        assert repr(pickle.loads(pickle.dumps(thing))) == repr(thing)
