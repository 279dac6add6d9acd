"""A scene of a file runs as the same model in Python does, to the last bit; and as its law says."""

import sys

import numpy as np
import pytest
import saltus
from file_models import EXAMPLES, FILES, FOLDER, MODELS, bits, script


def run(name):
    return saltus.load_scene(FOLDER / f"{name}.toml").simulate()


def times(results, event):
    return np.array([e.time for e in results.events if e.name.rpartition(".")[2] == event])


def test_there_are_models_and_the_four_scenes_of_the_tutorial():
    assert len(MODELS) == 22
    assert len(FILES) == 26


@pytest.mark.parametrize("name", MODELS)
def test_a_model_has_the_bits_of_its_script(name):
    assert bits(run(name)) == bits(script(name).run())


@pytest.mark.parametrize("number", [1, 2, 3, 4])
def test_a_scene_of_the_tutorial_has_the_bits_of_the_demo(number, monkeypatch):
    monkeypatch.setattr(sys, "path", [str(EXAMPLES), *sys.path])
    scene = script("demo", EXAMPLES).scenes()[number - 1]
    expected = saltus.simulate(
        scene.system, scene.context, (0.0, scene.end),
        recorded_signals=scene.recorded, **scene.options,
    )  # fmt: skip
    assert bits(run(f"tutorial_{number}")) == bits(expected)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_every_expression_of_an_example_is_traced(file):
    explanation = saltus.load_scene(file).system.explain()
    assert [c for c in explanation if c.runs != "traced"] == []


def test_lotka_volterra_has_an_invariant_between_hunts():
    results = run("lotka_volterra")
    (hunt,) = times(results, "hunt")
    before = results.outputs["invariant"][(results.time < hunt)]
    # 200 steps with errors of 1e-9 of states up to 12, in an invariant of slope about 1
    assert np.ptp(before) < 200 * 12e-9


def test_van_der_pol_jumps_at_half_its_period():
    # Dorodnicyn: T = (3 - 2 ln 2) mu + 7.014 mu^(-1/3) + O(ln mu / mu), here 0.007
    period = (3 - 2 * np.log(2)) * 1000.0 + 7.01432 / 10.0
    gaps = np.diff(times(run("van_der_pol"), "jump"))
    assert gaps == pytest.approx(period / 2, abs=0.01)


def test_the_thermostat_takes_the_same_time_up_and_down():
    results = run("thermostat")
    switches = np.sort(np.append(times(results, "warm"), times(results, "cold")))
    # 35 - T falls from 16 to 14 K while it heats, T - 5 while it does not
    assert np.diff(switches) == pytest.approx(np.log(16 / 14), abs=1e-7)


def test_the_tank_empties_as_torricelli_says():
    results = run("tank")
    full, empty = times(results, "full"), times(results, "empty")
    root = 2 * 2.0 / (0.05 * np.sqrt(2 * 9.81)) * (1.0 - np.sqrt(0.5))
    assert empty[: len(full)] - full[: len(empty)] == pytest.approx(root, abs=1e-7)


def test_the_tanks_end_where_inflow_is_outflow():
    end = {name: rows[-1] for name, rows in run("two_tanks").outputs.items()}
    # the lower tank has a time constant of 2 * 2 sqrt(h) / 0.08 = 94 s: exp(-980 / 94) = 3e-5
    assert end["upper"] == pytest.approx((0.15 / 0.1) ** 2, rel=1e-4)
    assert end["lower"] == pytest.approx((0.15 / 0.08) ** 2, rel=1e-4)


def test_the_block_slips_for_three_quarters_of_a_period_and_sticks_for_a_second():
    # In the plane of k x - 1 N and v it goes from (0.25, 0.25) to (-0.25, 0.25), around 0
    gaps = np.diff(times(run("stick_slip"), "breaks"))
    assert gaps == pytest.approx(0.75 * 2 * np.pi / 2.0 + 1.0, abs=1e-7)


def test_the_neuron_counts_its_spikes_and_is_silent_before_the_current():
    results = run("neuron")
    spikes = times(results, "spike")
    assert len(spikes) == results.outputs["spikes"][-1] > 5
    assert spikes[0] > 50.0


def test_the_cells_spike_as_their_wires_say():
    # The first cell alone fires each tau ln 2 = 13.86 ms. The second tends to 0.9; 2 ms after each
    # spike it has gained 0.6 and fires, and its own spike lowers the first by 0.1 at once.
    results = run("spiking_cells")
    first, second = (
        np.array([e.time for e in results.events if e.block == name])
        for name in ("first", "second")
    )
    assert first[0] == pytest.approx(0.02 * np.log(2.0), abs=1e-9)
    assert len(first) == 4  # the delivery of the last one is due after the run
    assert second == pytest.approx(first[:3] + 0.002, abs=1e-12)
    assert results.outputs["second.spikes"][-1] == 3


def test_the_clock_ticks_each_second():
    results = run("pendulum_clock")
    ticks = times(results, "tick")
    # half a period, with its first correction by the amplitude, 0.06 rad: + 0.06^2 / 16
    half = np.pi * np.sqrt(0.994 / 9.81) * (1 + 0.06**2 / 16)
    assert np.diff(ticks) == pytest.approx(half, abs=1e-4)  # the kick shifts the phase


def test_the_car_has_the_force_that_the_hill_takes():
    results = run("cruise_control")
    force = 150 + 0.4 * 25.0**2 + 1200 * 9.81 * np.sin(0.06)
    assert results.outputs["speed"][-1] == pytest.approx(25.0, abs=0.1)
    assert results.outputs["force"][-1] == pytest.approx(force, rel=0.01)
    assert 0.0 <= results.outputs["force"].min() and results.outputs["force"].max() <= 3000.0


def test_the_strut_turns_in_and_out_by_turns():
    results = run("quarter_car")
    turns = [e.name for e in results.events if e.name.startswith("turns")]
    assert len(turns) > 4
    assert set(turns[::2]) == {"turns_out"} and set(turns[1::2]) == {"turns_in"}
    assert abs(results.outputs["body"][-1]) < 1e-3


def test_the_motor_ends_at_the_voltage_of_its_load():
    results = run("dc_motor")
    current = (1e-4 * 150.0 + 0.05) / 0.05
    assert results.outputs["speed"][-1] == pytest.approx(150.0, abs=0.01)
    assert results.outputs["voltage"][-1] == pytest.approx(current + 0.05 * 150.0, abs=1e-3)
    assert results.outputs["voltage"].max() == 12.0


def test_the_pendulum_stands_and_the_force_changes_at_samples_only():
    results = run("inverted_pendulum")
    assert np.abs(results.outputs["state"][-1]).max() < 0.01
    changes = results.time[1:][np.diff(results.outputs["force"]) != 0.0]
    assert np.abs(changes / 0.02 - np.round(changes / 0.02)).max() < 1e-9


def test_the_brake_is_better_than_a_locked_wheel():
    way = run("abs_brake").outputs["way"][-1]
    grips = 0.9, 0.9 * np.sin(1.5 * np.arctan(12.0))  # the best one, and that of a locked wheel
    best, locked = ((30.0**2 - 1.0) / (2 * grip * 9.81) for grip in grips)
    assert best < way < locked


def test_the_converter_holds_its_voltage_within_the_ripple():
    results = run("buck_converter")
    ripple = 12.0 * 0.5 * 1e-4**2 / (8 * 1e-3 * 1e-4)  # V (1 - D) T^2 / (8 L C)
    late = results.outputs["voltage"][results.time > 0.025]
    assert late == pytest.approx(12.0, abs=2 * ripple)
    assert len(times(results, "blocks")) > 0


def test_the_car_shifts_at_the_speeds_of_its_gears():
    results = run("gear_shift")
    shifts = [times(results, f"to_{gear}")[0] for gear in ("second", "third", "fourth")]
    speed = np.interp(shifts, results.time, results.outputs["speed"])
    assert speed == pytest.approx([550 * 0.3 / (3.8 * ratio) for ratio in (3.6, 2.1, 1.4)])
    assert results.outputs["gear"].tolist() == sorted(results.outputs["gear"])


def test_the_relay_oscillates_near_the_ultimate_period():
    # The describing function of a relay with the hysteresis 0.01 turns by asin(0.01 / amplitude);
    # the third harmonic, which it leaves out, passes 1 / (s + 1)^3 with less than 1/30.
    results = run("relay_tuner")
    amplitude = np.abs(results.outputs["y"][results.time > 30.0]).max()
    frequency = np.tan((np.pi - np.arcsin(0.01 / amplitude)) / 3)
    gaps = np.diff(times(results, "turn_on"))[-5:]
    assert gaps == pytest.approx(2 * np.pi / frequency, rel=1 / 30)


def test_the_loop_locks():
    results = run("pll")
    assert results.outputs["rate"][-1] == pytest.approx(110.0, abs=1e-6)
    assert results.outputs["error"][-1] == pytest.approx(0.0, abs=1e-8)
    assert len(times(results, "our_turn")) == results.outputs["cycles"][-1]


def test_the_battery_gives_what_it_holds():
    results = run("battery")
    # 5 pulses of 1500 As of 9000; 3.65 V - 0.25 V is reached at a charge of 0.4, in the fourth. The begin
    # of each later pulse takes the voltage below 3.4 V again.
    assert results.outputs["charge"][-1] == pytest.approx(1 - 5 * 1500 / 9000, abs=1e-9)
    reached = 1800 + 0.1 * 9000 / 5
    assert times(results, "hit") == pytest.approx([reached, 2400, 3000], abs=1e-5)


def test_the_heater_works_for_whole_minutes():
    results = run("water_heater")
    minutes = results.outputs["energy"][-1] / 3.0 * 60.0
    assert minutes > 10 and minutes == pytest.approx(round(minutes), abs=1e-6)
    assert results.outputs["water"].max() < 61.0


def test_the_elevator_stops_where_it_was_called():
    results = run("elevator")
    assert times(results, "arrives_above")[0] == pytest.approx(1.0 + 12.0 / 1.5, abs=1e-9)
    opened = results.outputs["open"] > 0
    stops = results.outputs["y"][1:][opened[1:] & ~opened[:-1]]
    assert stops == pytest.approx([12.0, 3.0, 6.0], abs=1e-9)


def test_the_drive_with_play_does_not_come_to_rest():
    results = run("backlash_drive")
    motor, load = results.outputs["motor"], results.outputs["load"]
    assert np.abs(motor - load).max() <= 0.1 + 1e-9  # half the width of the play
    # The describing function of the play has its first harmonic balanced at A = 0.133 rad and
    # w = 0.628 rad/s. The loop passes 0.24 of the third harmonic, less than 1/3 of the first.
    periods = np.diff(times(results, "drive_up"))[-3:]
    assert periods == pytest.approx(2 * np.pi / 0.628, rel=0.24 / 3)
    assert np.ptp(motor[results.time > 45.0]) == pytest.approx(2 * 0.133, rel=0.24 / 3)
