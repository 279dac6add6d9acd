"""Dense output against rows at the same times, on ready scenes with every kind of event."""

import numpy as np
import pytest
import saltus

SCENES = [
    "bouncing-ball",
    "bouncing-ball-blocks",
    "buck-converter",
    "integrate-and-fire",
    "newtons-cradle",
    "rocking-block",
    "stick-slip",
    "thermostat",
    "van-der-pol",
    "water-tanks",
]


@pytest.mark.parametrize("method", ["auto", "dop853", "bdf"])
@pytest.mark.parametrize("name", SCENES)
def test_it_says_what_a_row_would(name, method):
    scene = saltus.scene(name)
    times = np.sort(np.random.default_rng(3).uniform(*scene.t_span, 100))
    options = {"ode_solver_method": method, "save_at": times, "throw": False}
    rows = scene.simulate(**options)
    dense = scene.simulate(dense_output=True, **options)
    here = np.isin(rows.time, times)
    assert here.any()
    for signal, recorded in rows.outputs.items():
        assert np.array_equal(recorded, dense.outputs[signal])
        found = dense(rows.time[here])[signal]
        # Rounding of values and of times, which moves what is steep by x' eps t: 1e3 eps and more
        # of the largest value, over steps that are much shorter than the span.
        error = np.abs(found - recorded[here]) / (np.max(np.abs(recorded), axis=0) + 1e-300)
        assert np.max(error) < 1e-12
