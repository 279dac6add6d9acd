"""Grids, tables, names: which run begins with which values."""

import numpy as np
import pytest
import saltus
from made import make_ball, make_chain
from saltus.errors import ModelError

pandas = pytest.importorskip("pandas")
pytest.importorskip("xarray")


@pytest.fixture(scope="module")
def ball():
    return saltus.scene("bouncing-ball").system


def fallen(g, y0, v0, t):
    """Height and speed before the first bounce."""
    return y0 + v0 * t - g * t**2 / 2, v0 - g * t


def test_a_grid_is_all_combinations(ball):
    found = saltus.sweep(ball, {"g": [1.0, 2.0, 3.0], "x[0]": [50.0, 60.0]}, (0.0, 2.0), rtol=1e-10)
    assert found["continuous_state"].dims == ("g", "x[0]", "continuous_state_entry")
    assert found["continuous_state_entry"].values.tolist() == ["x[0]", "x[1]"]
    for g in (1.0, 2.0, 3.0):
        for y0 in (50.0, 60.0):
            y, v = found["continuous_state"].sel({"g": g, "x[0]": y0}).values
            # dopri5 is exact on parabolas but for rounding, some 60 * 2^-52 for each of few steps
            assert (y, v) == pytest.approx(fallen(g, y0, 0.0, 2.0), abs=1e-12)


def rows_as(kind):
    columns = {"g": [1.0, 2.0, 3.0], "x[1]": [4.0, 5.0, 6.0], "x[0]": [50.0] * 3}
    if kind == "frame":
        return pandas.DataFrame(columns), {}
    if kind == "rows":
        return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values())], {}  # noqa: B905
    if kind == "arrays":
        return {name: np.array(column) for name, column in columns.items()}, {"paired": True}
    return {**columns, "x[0]": 50.0}, {"paired": True}


@pytest.mark.parametrize("kind", ["frame", "rows", "arrays", "one value for all"])
def test_a_table_is_its_rows(ball, kind):
    values, how = rows_as(kind)
    found = saltus.sweep(ball, values, (0.0, 2.0), rtol=1e-10, **how)
    assert found["status"].dims == ("run",)
    assert found["g"].values.tolist() == [1.0, 2.0, 3.0]
    for run, (g, v0) in enumerate(((1.0, 4.0), (2.0, 5.0), (3.0, 6.0))):
        found_y = found["continuous_state"].values[run]
        assert found_y == pytest.approx(fallen(g, 50.0, v0, 2.0), abs=1e-12)


def test_vectors_and_whole_states(ball):
    found = saltus.sweep(ball, {"x": [[50.0, 1.0], [60.0, 2.0]]}, (0.0, 2.0), rtol=1e-10)
    assert found["continuous_state"].values[1] == pytest.approx(
        fallen(9.81, 60.0, 2.0, 2.0), abs=1e-12
    )
    assert found["x_values"].values.tolist() == [[50.0, 1.0], [60.0, 2.0]]


def test_modes_and_discrete_states():
    tanks = saltus.scene("water-tanks")
    found = saltus.sweep(tanks.system, {"mode": [0, 1]}, (0.0, 0.1), context=tanks.context)
    assert found["modes"].dims == ("mode", "modes_block")
    assert not np.array_equal(found["continuous_state"][0], found["continuous_state"][1])
    with pytest.raises(ModelError, match="expected numbers"):
        saltus.sweep(tanks.system, {"mode": ["open"]}, (0.0, 0.1))
    half = saltus.sweep(tanks.system, {"mode": [0.5, 1]}, (0.0, 0.1), context=tanks.context)
    assert half["status"].values.tolist() == ["failed", "reached_end"]
    assert "give an integer" in half["message"].values[0]


def test_names_of_blocks_in_a_diagram():
    diagram = saltus.scene("bouncing-ball-blocks").system
    names = saltus._core.entry_names(diagram.create_context())
    start = next(name for name in names if name.endswith("x[0]"))
    found = saltus.sweep(diagram, {start: [0.5, 0.6]}, (0.0, 0.1))
    assert found["status"].values.tolist() == ["reached_end"] * 2
    with pytest.raises(ModelError, match="did you mean"):
        saltus.sweep(diagram, {start[:-4] + "y[0]": [0.5]}, (0.0, 0.1))


def test_structure_varies_by_a_factory():
    found = saltus.sweep(make_chain, {"n": [1, 2, 4]}, (0.0, 2.0), rtol=1e-10, atol=1e-12)
    ends = found["continuous_state"].values
    assert ends.shape == (3, 4)
    assert np.isnan(ends[0]).tolist() == [False, True, True, True]
    # t^n / n! at 2: a polynomial of degree 4 is exact for dopri5
    assert [ends[0, 0], ends[1, 1], ends[2, 3]] == pytest.approx([2.0, 2.0, 2 / 3], rel=1e-9)


def test_a_factory_takes_its_arguments_and_leaves_the_rest():
    found = saltus.sweep(
        make_ball, {"e": [0.5], "g": [1.0, 2.0], "x[1]": [3.0]}, (0.0, 1.0), rtol=1e-10
    )
    for i, g in enumerate((1.0, 2.0)):
        assert found["continuous_state"].values[0, i, 0] == pytest.approx(
            fallen(g, 10.0, 3.0, 1.0), abs=1e-12
        )


@pytest.mark.parametrize(
    ("values", "how", "says"),
    [
        ({"gg": [1.0]}, {}, r"unknown parameter or state 'gg'; did you mean 'g'\?"),
        ({"x[2]": [1.0]}, {}, "has 2 entries"),
        ({"g": [1.0, 2.0], "e": [1.0]}, {"paired": True}, "same length, found 'g' 2, 'e' 1"),
        ({"g": []}, {}, "'g' has no values"),
        ([], {}, "no rows"),
        ([{"g": 1.0}, {"e": 1.0}], {}, "row 1 names other values"),
        ([1.0, 2.0], {}, "expected a dict of names and values as row 0"),
        ("g", {}, "expected a dict of names"),
        (7, {}, "expected a dict of names"),
        ({1: [2.0]}, {}, "expected the name of a parameter"),
        ({"g": ["heavy"]}, {}, "'g': expected numbers, found 'heavy'"),
        ({"x": [[1.0, 0.0]], "x[0]": [2.0]}, {}, "are the same values"),
        ({"x": [1.0]}, {}, r"expected 2 values, found 1; one entry is 'x\[0\]'"),
    ],
)
def test_values_that_cannot_be_meant(ball, values, how, says):
    with pytest.raises(ModelError, match=says):
        saltus.sweep(ball, values, (0.0, 1.0), **how)


def test_unknown_names_of_a_factory():
    with pytest.raises(ModelError, match="did you mean 'y0'"):
        saltus.sweep(make_ball, {"yO": [1.0]}, (0.0, 1.0))


def derivative(t, x, k):
    return -k * x


@pytest.mark.parametrize("executor", [None, "serial", "processes"])
@pytest.mark.parametrize("function", [derivative, lambda t, x, *, k: -k * x, lambda e, /: None])
def test_a_function_that_needs_more_than_the_values_is_no_factory(function, executor):
    with pytest.raises(ModelError, match="which the values do not have; expected a system"):
        saltus.sweep(function, {"k": [1.0, 2.0]}, (0.0, 1.0), executor=executor)


def not_a_system(k):
    return [-k]


@pytest.mark.parametrize("executor", [None, "serial", "processes"])
def test_a_function_that_makes_no_system_is_no_factory(executor):
    with pytest.raises(
        ModelError, match=r"not_a_system returned \[-1.0\]; expected a function that"
    ):
        saltus.sweep(not_a_system, {"k": [1.0, 2.0]}, (0.0, 1.0), executor=executor)
