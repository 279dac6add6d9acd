"""Ports named by paths, what is recorded by default, rows as text, and blocks by other names."""

import csv

import numpy as np
import pytest
import saltus
from saltus.errors import ModelError
from saltus.library import Clock, Constant, Gain, Integrator, Sine


def road():
    """A car in a diagram: its speed is twice the time, so its way is t squared."""
    builder = saltus.DiagramBuilder()
    _, engine = builder.add(Clock(name="clock"), Gain(2.0, name="engine"))
    builder.connect("clock.out", "engine.in")
    builder.export_output(engine.output(), "speed")
    car = builder.build("car")
    builder = saltus.DiagramBuilder()
    _, way = builder.add(car, Integrator(name="way"))
    builder.connect("car.speed", "way.in")
    builder.export_output(way.output(), "travelled")
    return builder.build("road")


def run(**options):
    diagram = road()
    return saltus.simulate(diagram, diagram.create_context(), (0.0, 3.0), **options)


def test_signals_by_path():
    results = run(recorded_signals={"speed": "car.engine.out", "same": "car.speed"})
    assert np.array_equal(results.outputs["speed"], 2.0 * results.time)
    assert np.array_equal(results.outputs["same"], 2.0 * results.time)


def test_a_list_of_paths_names_each_signal_by_its_path():
    results = run(recorded_signals=["car.clock.out", "way.out"])
    assert list(results.outputs) == ["car.clock.out", "way.out"]
    assert np.array_equal(results.outputs["car.clock.out"], results.time)


def test_a_simulator_takes_paths_too():
    diagram = road()
    simulator = saltus.Simulator(diagram, recorded_signals=["car.clock.out"])
    simulator.initialize(diagram.create_context())
    simulator.advance_to(1.0)
    assert np.array_equal(simulator.results.outputs["car.clock.out"], simulator.results.time)


def test_exported_outputs_are_recorded_by_default():
    results = run()
    # t^2 by a method of order 5, to ten tolerances
    assert results.outputs["travelled"] == pytest.approx(results.time**2, rel=1e-5, abs=1e-7)
    assert list(results.outputs) == ["travelled"]


def test_what_is_recorded_does_not_depend_on_the_run_before():
    diagram = road()
    asked = [None, {}, ["way.out"], None, {"y": "way.out"}, {}, ["way.out"]]
    found = [
        list(saltus.simulate(diagram, (0.0, 1.0), recorded_signals=signals).outputs)
        for signals in asked
    ]
    assert found == [["travelled"], [], ["way.out"], ["travelled"], ["y"], [], ["way.out"]]


def test_paths_into_a_diagram_that_was_made_in_cpp():
    scene = saltus.scene("bouncing-ball-blocks")
    port = scene.system["integrator_v"].output()
    signals = [["integrator_v.out"], {"integrator_v.out": port}]
    by_path, by_port = (
        saltus.simulate(scene.system, scene.context, (0.0, 0.1), recorded_signals=each)
        for each in signals
    )
    found = by_path.outputs["integrator_v.out"]
    assert found.min() < 0.0
    assert np.array_equal(found, by_port.outputs["integrator_v.out"])


def test_sweeps_pictures_and_reports_take_paths():
    diagram = road()
    swept = saltus.sweep(
        diagram,
        {"car.engine.gain": [1.0, 2.0]},
        (0.0, 1.0),
        save_at=[1.0],
        recorded_signals=["car.engine.out"],
    )
    assert list(swept["car.engine.out"].values[:, -1]) == [1.0, 2.0]
    assert "car" in diagram.to_dot(recorded_signals=["car.engine.out"])
    assert "car" in diagram.to_mermaid(recorded_signals={"y": "car.engine.out"})


@pytest.mark.parametrize("signals", [{3: "way.out"}, ["way.out", 3], 3, "way.out"])
def test_impossible_signals_are_refused(signals):
    diagram = road()
    for call in (
        lambda: saltus.simulate(diagram, (0.0, 1.0), recorded_signals=signals),
        lambda: saltus.Simulator(diagram, recorded_signals=signals),
        lambda: saltus.sweep(
            diagram, {"car.engine.gain": [1.0]}, (0.0, 1.0), recorded_signals=signals
        ),
        lambda: diagram.to_dot(recorded_signals=signals),
    ):
        with pytest.raises(ModelError, match="recorded_signals: expected a dict of names"):
            call()


def test_nothing_is_recorded_where_that_is_said():
    assert run(recorded_signals={}).outputs == {}
    assert saltus.simulate(Sine(), (0.0, 1.0), recorded_signals=[]).outputs == {}


def test_a_block_alone_records_its_outputs():
    assert list(saltus.simulate(Sine(), (0.0, 1.0)).outputs) == ["out"]
    system = saltus.system_of(lambda t, x: [x[1], -x[0]], [1.0, 0.0])
    results = saltus.simulate(system, (0.0, 1.0))
    assert list(results.outputs) == ["x"] and results.time[[0, -1]].tolist() == [0.0, 1.0]


@pytest.mark.parametrize(
    "path, message",
    [
        ("car.engin.out", "diagram 'car' has no block 'engin'; did you mean 'engine'"),
        ("car.engine.output", "block 'engine' has no output 'output'; did you mean 'out'"),
        ("way.out.x", "block 'way' is no diagram: it has no block 'out'"),
        ("travelle", "block 'road' has no output 'travelle'; did you mean 'travelled'"),
    ],
)
def test_a_wrong_path_names_the_nearest(path, message):
    with pytest.raises(ModelError, match=message):
        run(recorded_signals={"y": path})


@pytest.mark.parametrize(
    "source, target, message",
    [
        ("clack", "gain.in", "such as 'gain.out', found 'clack'; did you mean 'clock'"),
        ("clack.out", "gain.in", "found 'clack.out'; did you mean 'clock'"),
        ("clock.out", "gain.inn", "block 'gain' has no input 'inn'; did you mean 'in'"),
        ("clock.out", 3, "expected a port, such as block.input_ports"),
        ("clock.x.out", "gain.in", "inside of diagram 'clock'; export it there"),
    ],
)
def test_a_wrong_wire_is_refused(source, target, message):
    builder = saltus.DiagramBuilder()
    builder.add(Clock(name="clock"), Gain(2.0, name="gain"))
    with pytest.raises(ModelError, match=message):
        builder.connect(source, target)


def test_the_parameters_of_a_diagram():
    assert road().parameters["car.engine.gain"] == 2.0


def test_rows_as_text_have_all_digits(tmp_path):
    builder = saltus.DiagramBuilder()
    vector = builder.add(Constant([1.0 / 3.0, -0.0], name="vector"))
    clock = builder.add(Clock(name="clock"))
    builder.export_output(vector.output(), "v")
    builder.export_output(clock.output(), "t")
    diagram = builder.build()
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 1.0), save_at=[0.1, 0.7])
    results.to_csv(tmp_path / "rows.csv")
    with open(tmp_path / "rows.csv", newline="") as file:
        head, *rows = csv.reader(file)
    assert head == ["time", "jump", "v[0]", "v[1]", "t"]
    numbers = np.array(rows, dtype=float)
    assert np.array_equal(numbers[:, 0], results.time)
    assert np.array_equal(numbers[:, 2:4], results.outputs["v"])
    assert np.signbit(numbers[:, 3]).all()


@pytest.mark.parametrize("name", ["time", "jump", "v[0]"])
def test_two_columns_of_one_name_are_refused(tmp_path, name):
    builder = saltus.DiagramBuilder()
    vector, clock = builder.add(Constant([1.0, 2.0]), Clock())
    diagram = builder.build()
    signals = {"v": vector.output(), name: clock.output()}
    results = saltus.simulate(diagram, (0.0, 1.0), recorded_signals=signals)
    with pytest.raises(ModelError, match="two columns would be called"):
        results.to_csv(tmp_path / "rows.csv")
    assert not (tmp_path / "rows.csv").exists()


def test_exports_by_path():
    builder = saltus.DiagramBuilder()
    builder.add(Gain(2.0, name="gain"))
    builder.export_input("gain.in", "u")
    builder.export_output("gain.out", "y")
    assert builder.build().input_names == ["u"]
    with pytest.raises(ModelError, match="export_output: expected the names of a block"):
        saltus.DiagramBuilder().export_output("gain.out")


def test_load_is_load_results(tmp_path):
    results = run()
    results.save(tmp_path / "run.npz")
    assert np.array_equal(saltus.load(tmp_path / "run.npz").time, results.time)


def test_blocks_by_the_names_of_other_tools():
    with pytest.raises(ImportError, match="no 'Sum'; it is called Adder here"):
        from saltus.library import Sum  # noqa: F401
    with pytest.raises(ImportError, match="recorded_signals"):
        _ = saltus.library.Scope
    with pytest.raises(AttributeError, match="no attribute 'Gian'; did you mean 'Gain'"):
        _ = saltus.library.Gian
    assert not hasattr(saltus.library, "__wrapped__")
