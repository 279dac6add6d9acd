"""Units of states and names of modes in plots, and modes in pictures."""

import numpy as np
import pytest
import saltus
from heated_rooms import Room, run
from saltus.library import StateMachine, Transition
from saltus.results.charts.signals import MANY


def test_labels_have_units_and_a_mode_has_its_names_on_the_axis():
    pytest.importorskip("matplotlib")
    results = run(recorded_signals=["temperature", "all", "heater"])
    one, many, mode = results.plot()
    assert one.get_ylabel() == "temperature [°C]" and many.get_ylabel() == "all"
    legend = [text.get_text() for text in many.get_legend().get_texts()]
    assert legend == ["all[0] [°C]", "all[1] [m/s]"]
    assert [tick.get_text() for tick in mode.get_yticklabels()] == ["off", "on"]
    portrait = results.plot_phase("temperature", "all[1]")
    assert (portrait.get_xlabel(), portrait.get_ylabel()) == ("temperature [°C]", "all[1] [m/s]")


def test_several_signals_in_one_axes_have_their_units():
    plt = pytest.importorskip("matplotlib.pyplot")
    _, axes = plt.subplots()
    run(recorded_signals=["temperature", "heater"]).plot(ax=axes)
    legend = [text.get_text() for text in axes.get_legend().get_texts()]
    assert legend == ["temperature [°C]", "heater"]


def test_names_of_modes_do_not_replace_the_numbers_of_another_curve():
    plt = pytest.importorskip("matplotlib.pyplot")
    _, axes = plt.subplots()
    results = run(recorded_signals=["temperature", "heater"])
    results.plot("temperature", ax=axes)
    results.plot("heater", ax=axes)
    assert "on" not in [tick.get_text() for tick in axes.get_yticklabels()]


def test_a_signal_with_the_name_of_an_entry_has_its_own_unit():
    pytest.importorskip("matplotlib")
    results = run(recorded_signals={"all": "all", "all[0]": "wind"})
    assert results.plot("all[0]").get_ylabel() == "all[0] [m/s]"


def test_plotly_has_them_too():
    pytest.importorskip("plotly")
    drawn = run(recorded_signals=["temperature", "heater"]).plot(backend="plotly")
    assert drawn.layout.yaxis.title.text == "temperature [°C]"
    assert list(drawn.layout.yaxis2.ticktext) == ["off", "on"]


def test_the_picture_of_the_modes_has_their_names():
    text = Room().to_mermaid("modes")
    assert 'state "off" as m0' in text and 'state "on" as m1' in text


def test_each_mode_of_the_picture_has_its_own_name():
    """One name is the text that the picture has for another mode."""
    system = saltus.LeafSystem(name="ball")
    system.declare_default_mode(0, names=["mode 1", "mode 0"])
    system.declare_zero_crossing(lambda t, s: t - 1.0, name="g", start_mode=0, end_mode=1)
    text = system.to_mermaid("modes")
    assert 'state "mode 1" as m0' in text and 'state "mode 0" as m1' in text


def test_the_picture_of_a_state_machine_has_its_states_and_where_its_transitions_lead():
    door = StateMachine(
        ["closed", "open", "locked"],
        [Transition("closed", "open", after=1.0), Transition("open", "locked", after=1.0)],
        initial="open",
    )
    assert door.to_mermaid("modes").splitlines() == [
        "stateDiagram-v2",
        '  state "closed" as m0',
        '  state "open" as m1',
        '  state "locked" as m2',
        "  [*] --> m1",
        "  m0 --> m1 : closed_to_open",
        "  m1 --> m2 : open_to_locked",
    ]


def test_signs_that_mermaid_reads_are_entities_in_the_name_of_a_mode():
    system = saltus.LeafSystem(name="ball")
    system.declare_default_mode(0, names=['a"b', "<i>;#\n°"])
    system.declare_zero_crossing(lambda t, s: t - 1.0, name="g", start_mode=0, end_mode=1)
    lines = system.to_mermaid("modes").splitlines()
    assert lines[1:3] == ['  state "a#34;b" as m0', '  state "#60;i#62;#59;#35; °" as m1']


def test_ticks_are_for_guards_and_not_for_clocks():
    pytest.importorskip("matplotlib")
    system = Room()
    system.declare_periodic_update(None, period=0.001, name="clock")  # more ticks than are drawn
    results = saltus.simulate(system, (0.0, 1.0))
    axes = results.plot("temperature")
    (ticks,) = axes.collections
    times = sorted(e.time for e in results.events if e.kind == "zero_crossing")
    assert len(results.events) > 1000 > MANY > len(times) > 3
    np.testing.assert_array_equal([s[0][0] for s in ticks.get_segments()], times)
