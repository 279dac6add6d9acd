"""Tables of several inputs, buses, and the slew rate limiter: their laws from Python."""

import numpy as np
import pytest
import saltus
from saltus.library import *

response = saltus.response
METHODS = ["dopri5", "dop853", "radau", "bdf", "adams", "auto"]
AXES = ([0.0, 1.0, 3.0], [0.0, 2.0], [-1.0, 1.0], [0.0, 5.0])
TABLE = np.random.default_rng(1).normal(size=(3, 2, 2, 2))


def test_a_table_of_four_inputs_agrees_with_scipy():
    interpolate = pytest.importorskip("scipy.interpolate")
    points = np.random.default_rng(2).uniform([0, 0, -1, 0], [3, 2, 1, 5], (50, 4))
    expected = interpolate.RegularGridInterpolator(AXES, TABLE)(points)
    found = response(LookupTableNd(AXES, TABLE), *points.T)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14)  # sums of 16 numbers near 1


def test_a_table_knows_its_border():
    inside = response(LookupTableNd(AXES, TABLE), 3.0, 2.0, 0.25, 5.0)
    assert response(LookupTableNd(AXES, TABLE), 9.0, 9.0, 0.25, 9.0) == inside
    with pytest.raises(saltus.SimulationError, match=r"LookupTableNd.*not finite"):
        response(LookupTableNd(AXES, TABLE, "error"), 9.0, 1.0, 0.0, 1.0)
    with pytest.raises(saltus.ModelError, match=r"shape \(2, 3\); expected \(3, 2\)"):
        LookupTableNd(AXES[:2], np.zeros((2, 3)))
    with pytest.raises(saltus.ModelError, match="has 5 values; expected 6"):
        LookupTableNd(AXES[:2], np.zeros(5))


@pytest.mark.parametrize("method", METHODS)
def test_the_knots_of_a_table_are_located_where_they_reach_a_derivative(method):
    """A zigzag of three axes along (t, t, t): the integral is 3 times 1/2 times 3."""
    axis, ends = np.linspace(0, 3, 7), np.array([0.0, 3.0])
    zigzag = np.arange(7) % 2
    table = np.add.outer(np.add.outer(zigzag, zigzag), np.array([0.0, 1.0]))
    builder = saltus.DiagramBuilder()
    clock, block, total = builder.add(
        Clock(), LookupTableNd([axis, axis, ends], table), Integrator(0.0)
    )
    for k in range(3):
        builder.connect(clock.output(), block.input(k))
    builder.connect(block.output(), total.input())
    diagram = builder.build()
    results = saltus.simulate(diagram, (0.0, 3.0), rtol=1e-9, ode_solver_method=method)
    # a hundred tolerances of rtol |x|
    assert results.context[total].continuous_state[0] == pytest.approx(4.5, abs=5e-7)
    alone = saltus.DiagramBuilder()
    clock, block = alone.add(Clock(), LookupTableNd([axis, axis, ends], table))
    for k in range(3):
        alone.connect(clock.output(), block.input(k))
    assert (
        len(saltus.simulate(alone.build(), (0.0, 3.0)).events) == 0
    )  # and costs nothing elsewhere


def test_a_bus_in_a_bus():
    imu = BusCreator({"rates": 3, "heat": None})
    whole = BusCreator({"speed": None, "imu": imu})
    assert whole.input_names == ["speed", "imu"]
    assert whole.layout == [("speed", None), ("imu.rates", 3), ("imu.heat", None)]
    choice = BusSelector(whole, ["imu.rates", "imu", "speed"])
    assert choice.output_names == ["imu_rates", "imu", "speed"]
    builder = saltus.DiagramBuilder()
    builder.add(imu, whole, choice)
    sources = builder.add(Constant([1.0, 2.0, 3.0]), Constant(4.0), Constant(5.0))
    builder.connect(sources[0].output(), imu.input("rates"))
    builder.connect(sources[1].output(), imu.input("heat"))
    builder.connect(sources[2].output(), whole.input("speed"))
    builder.connect(imu.output(), whole.input("imu"))
    builder.connect(whole.output(), choice.input())
    diagram = builder.build()
    signals = {name: choice.output(name) for name in choice.output_names}
    outputs = saltus.simulate(diagram, (0.0, 1.0), recorded_signals=signals).outputs
    assert outputs["imu_rates"][-1].tolist() == [1.0, 2.0, 3.0]
    assert outputs["imu"][-1].tolist() == [1.0, 2.0, 3.0, 4.0]
    assert outputs["speed"][-1] == 5.0


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: BusCreator([]), "without signals"),
        (lambda: BusCreator(["a", "a"]), "'a' is in the bus twice"),
        (lambda: BusCreator("ab"), "expected a list of names"),
        (lambda: BusCreator({"a": 0}), "width 0; expected 1 or more"),
        (lambda: BusSelector(["speed"], ["sped"]), "no signal 'sped'.*'speed'"),
        (lambda: BusSelector(["speed"], []), "no signal is chosen"),
    ],
)
def test_a_bus_refuses(make, says):
    with pytest.raises(saltus.ModelError, match=says):
        make()


@pytest.mark.parametrize("method", [*METHODS, "taylor"])
def test_a_slew_rate_limiter_against_its_closed_form(method):
    """To 2 at 1 /s until 1/2 is left, at 1.5 s, then an exponential of the time constant 1/2 s."""
    limiter = SlewRateLimiter(1.0, -1.0, 0.5)
    y = response(limiter, 2.0, t=[1.0, 1.5, 2.5], rtol=1e-9, ode_solver_method=method)
    # a hundred tolerances
    np.testing.assert_allclose(y, [1.0, 1.5, 2 - 0.5 * np.exp(-2)], rtol=0, atol=2e-7)


FILE = """
version = 1
wires = [
  "time -> table.in_0, table.in_1, bus.a", "table -> slow", "slow -> bus.b", "bus -> choice",
]
[blocks]
time = { block = "Clock" }
slow = { block = "SlewRateLimiter", upper_limit = 0.5 }
bus = { block = "BusCreator", signals = ["a", "b"] }
choice = { block = "BusSelector", bus = ["a", "b"], names = ["b"] }
[blocks.table]
block = "LookupTableNd"
input_axes = [[0, 1], [0, 1]]
output_table = [[0, 1], [2, 3]]
[outputs]
y = "choice.b"
[run]
until = 1.0
"""


def test_all_of_them_in_a_file(tmp_path):
    """The table is 3 t, of which the limiter follows the first half per second."""
    file = tmp_path / "scene.toml"
    file.write_text(FILE)
    results = saltus.load_scene(file).simulate()
    assert results.outputs["y"][-1] == pytest.approx(0.5, abs=1e-3)  # within the lag at the start
