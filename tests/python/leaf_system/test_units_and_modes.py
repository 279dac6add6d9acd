"""Units of states and names of modes: in results, through diagrams, in files."""

import copy
import pickle

import numpy as np
import pytest
import saltus
from heated_rooms import Room, house, run
from saltus.library import Constant, EnabledSubsystem, StateMachine, Transition
from saltus.scene_files import loads


def test_a_block_alone_records_its_outputs_and_each_state_once():
    results = run()
    assert list(results.outputs) == ["temperature", "wind", "heater"]  # not "all" of them again
    assert results.units == {"temperature": "°C", "wind": "m/s"}
    assert not run(recorded_signals=[]).outputs


def test_a_vector_has_a_unit_for_each_entry_and_a_mode_has_names():
    results = run(recorded_signals={"x": "all", "h": "heater"})
    assert results.units == {"x": ("°C", "m/s")}
    assert results.mode_names == {"h": ("off", "on")}


def test_modes_by_name_are_those_by_number():
    warm, cold = (run().events.times(name) for name in ("warm", "cold"))
    # heated, 40 - T falls from 20 to 19; then T - 10 falls from 11 to 9, and 40 - T from 21 to 19.
    # A temperature of 20 is right to rtol 1e-6, at a slope of 9 K/h or more.
    assert warm[0] == pytest.approx(np.log(20 / 19), abs=1e-5)
    assert cold[0] - warm[0] == pytest.approx(np.log(11 / 9), abs=1e-5)
    assert warm[1] - cold[0] == pytest.approx(np.log(21 / 19), abs=1e-5)


@pytest.mark.parametrize("rest", ["rests", 1])
def test_a_mode_by_its_name_after_infinitely_many_resets(rest):
    """Height 1 m at rest, g = 2 m/s^2 and e = 0.5: it hits at 1 s, and stops bouncing at 3 s."""
    ball = saltus.LeafSystem(name="ball")
    ball.declare_continuous_state(
        [1.0, 0.0], ode=lambda t, s: [s.continuous_state[1], -2.0 * (1 - s.mode)]
    )
    ball.declare_default_mode("flies", names=["flies", "rests"])
    ball.declare_zero_crossing(
        lambda t, s: s.continuous_state[0],
        lambda t, s: s.with_continuous_state([0.0, -0.5 * s.continuous_state[1]]),
        name="hit", direction="falling", start_mode="flies", on_zeno=rest,
    )  # fmt: skip
    assert saltus.simulate(ball, (0.0, 2.9)).context.mode == 0
    assert saltus.simulate(ball, (0.0, 3.1)).context.mode == 1


@pytest.mark.parametrize("depth", [1, 2, 3])
def test_outputs_of_diagrams_show_what_their_blocks_say(depth):
    results = saltus.simulate(house(depth), (0.0, 0.1))
    assert results.units == {"temperature": "°C"}
    assert results.mode_names == {"heater": ("off", "on")}


def test_a_signal_by_its_path_has_its_unit():
    results = saltus.simulate(house(2), (0.0, 0.1), recorded_signals=["level_0.room.temperature"])
    assert results.units == {"level_0.room.temperature": "°C"}


def test_a_simulator_knows_them_too():
    system = Room()
    simulator = saltus.Simulator(system).initialize(system.create_context())
    simulator.advance_to(0.1)
    assert simulator.results.units == {"temperature": "°C", "wind": "m/s"}


@pytest.mark.parametrize("system", [Room(), Room])
def test_the_results_that_a_sweep_reduces_know_them(system):
    def known(results):
        return results.units == {"T": "°C"} and results.mode_names == {"h": ("off", "on")}

    signals = {"T": "temperature", "h": "heater"}
    values = {"temperature": [19.5, 20.5]}
    found = saltus.sweep(system, values, (0.0, 0.1), recorded_signals=signals, reduce=known)
    np.testing.assert_array_equal(found["known"], [True, True])


def test_a_list_of_signals_may_change_after_the_run():
    signals = ["temperature"]
    results = run(recorded_signals=signals)
    signals[:] = ["heater"]
    assert results.units == {"temperature": "°C"}


def test_they_are_in_files_pickles_and_copies(tmp_path):
    results = run(recorded_signals=["all", "heater"])
    results.save(tmp_path / "room.npz")
    for other in (
        saltus.load(tmp_path / "room.npz"),
        pickle.loads(pickle.dumps(results)),
        copy.deepcopy(results),
    ):
        assert other.units == {"all": ("°C", "m/s")}
        assert other.mode_names == {"heater": ("off", "on")}


def test_they_are_in_text_and_tables():
    results = run()
    assert "temperature (" in str(results) and ") [°C], wind" in str(results)
    part = declare(units=["m", ""])
    part.declare_continuous_state_output("x")
    assert "[m, -]" in str(saltus.simulate(part, (0.0, 1.0), recorded_signals=["x"]))
    xarray = pytest.importorskip("xarray")
    assert isinstance(results.to_xarray(), xarray.Dataset)
    assert results.to_xarray()["wind"].attrs == {"units": "m/s"}


@pytest.mark.parametrize("start", ["off", 0])
def test_a_subclass_chooses_another_mode_by_the_names_that_there_are(start):
    class Cold(Room):
        def __init__(self):
            super().__init__()
            self.declare_default_mode(start)

    results = saltus.simulate(Cold(), (0.0, 0.01), recorded_signals=["heater"])
    assert results["heater"][0] == 0
    assert results.mode_names == {"heater": ("off", "on")}


def test_the_outputs_of_a_system_that_is_executed_have_the_units_of_its_own():
    builder = saltus.DiagramBuilder()
    builder.add(EnabledSubsystem(house(), name="house"), Constant(1.0, name="on"))
    builder.connect("on.out", "house.enable")
    builder.export_output("house.temperature", "T")
    builder.export_output("house.heater", "h")
    results = saltus.simulate(builder.build("street"), (0.0, 0.1))
    assert results.units == {"T": "°C"}
    assert results.mode_names == {"h": ("off", "on")}


@pytest.mark.parametrize("name", ["_declared", "_exported", "_says", "units", "modes"])
def test_a_block_may_have_attributes_of_any_such_name(name):
    system = Room()
    setattr(system, name, 3)
    system.declare_continuous_state_output("again")
    results = saltus.simulate(system, (0.0, 0.1), recorded_signals=["temperature", "again"])
    assert results.units == {"temperature": "°C", "again": ("°C", "m/s")}


def test_a_state_machine_names_its_states():
    door = StateMachine(["closed", "open"], [Transition("closed", "open", after=1.0)], name="door")
    results = saltus.simulate(door, (0.0, 2.0), recorded_signals=["state"])
    assert results.mode_names == {"state": ("closed", "open")}


def test_a_scene_file_says_units_and_modes():
    scene = loads(
        'version = 1\nmodes = ["rest", "go"]\n[states]\nway = { rate = "1", unit = "m" }\ny = {}\n'
        '[run]\nuntil = 1.0\nrecord = ["way", "y", "mode"]\n'
    )
    results = scene.simulate()
    assert results.units == {"way": "m"}
    assert results.mode_names == {"mode": ("rest", "go")}


def with_modes(*names):
    system = saltus.LeafSystem(name="ball")
    system.declare_default_mode(0, names=names)
    return system


def declare(**given):
    system = saltus.LeafSystem(name="ball")
    system.declare_continuous_state(2, **given)
    return system


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: declare(units=["m"]), "units: expected 2, one for each state, found 1: 'm'"),
        (lambda: declare(units="m"), r'units: expected \["m", "m/s"\], found \'m\''),
        (lambda: declare(units=[1, 2]), "units: expected"),
        (lambda: declare().declare_default_mode("on"), "unknown mode 'on'; name the modes first"),
        (
            lambda: declare().declare_default_mode("onn", names=["off", "on"]),
            "unknown mode 'onn'; did you mean 'on'",
        ),
        (lambda: declare().declare_default_mode(2, names=["off", "on"]), "a mode from 0 to 1"),
        (lambda: declare().declare_default_mode(0, names=["on", "on"]), "'on' is given twice"),
        (lambda: declare().declare_default_mode(0, names=["on", ""]), "a mode has an empty name"),
        (lambda: declare().declare_default_mode(0, names="on"), "names: expected"),
        (
            lambda: Room().declare_zero_crossing(lambda t, s: 1.0, name="g", start_mode="of"),
            "zero crossing 'g': unknown mode 'of'; did you mean 'off'",
        ),
        (
            lambda: Room().declare_zero_crossing(lambda t, s: 1.0, name="g", on_zeno="of"),
            "zero crossing 'g': unknown on_zeno 'of'; did you mean 'off'",
        ),
        (
            lambda: with_modes("hold", "go").declare_edge_reset(len, 0, name="e", on_zeno="hold"),
            "edge reset 'e': on_zeno: 'hold' is a choice and the name of a mode; .* number, 0",
        ),
        (
            lambda: Room().declare_zero_crossing(lambda t, s: 1.0, name="g", end_mode=2),
            "zero crossing 'g': expected a mode from 0 to 1, which have names, found 2",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(make, words):
    with pytest.raises(saltus.ModelError, match=words):
        make()


@pytest.mark.parametrize(
    "damage",
    [
        {"heater": {"units": [], "modes": [1]}},
        {"nobody": {"units": [], "modes": []}},
        {"all": {"units": ["m"], "modes": []}},
        {"all": 3},
        [],
    ],
)
def test_a_damaged_file_is_refused(tmp_path, monkeypatch, damage):
    from saltus.results.forms import Forms

    results = run(recorded_signals=["all", "heater"])
    monkeypatch.setattr(Forms, "_kind", lambda self: {"kind": "Results", "quantities": damage})
    results.save(tmp_path / "room.npz")
    with pytest.raises(saltus.ModelError, match="damaged"):
        saltus.load(tmp_path / "room.npz")
