"""The shelf seen from Python: every scene runs, and is the one that C++ runs."""

import numpy as np
import pytest
import saltus


@pytest.mark.parametrize("name", saltus.shelf())
def test_a_scene_says_all_that_a_run_of_it_needs(name):
    scene = saltus.scene(name)
    assert scene.name == name
    assert scene.title == saltus.shelf()[name]
    begin, end = scene.t_span
    assert begin < end
    assert scene.methods
    assert scene.growth >= 1
    for port in scene.options.recorded_signals.values():
        assert 0 <= port.index < len(port.system.output_ports)
    context = scene.system.create_context()
    assert context.continuous_state.shape == scene.context.continuous_state.shape


def test_a_run_is_right():
    """Free fall: the first bounce is at sqrt(2 y0 / g); the location error is numerics.md's 100 eps
    of times below 24 s.
    """
    results = saltus.scene("bouncing-ball").simulate()
    first = results.events.times("bounce")[0]
    assert abs(first - np.sqrt(2 * 10.0 / 9.81)) < 100 * 2.3e-16 * 24
    assert results.outputs["y"].shape[1] == 2


def test_options_replace_those_of_the_scene():
    scene = saltus.scene("bouncing-ball")
    results = scene.simulate(ode_solver_method="adams", save_at=[1.0, 2.0], save_steps=False)
    assert results.statistics.method == "adams"
    assert {1.0, 2.0} <= set(results.time)
    with pytest.raises(saltus.ModelError, match="rtol"):
        scene.simulate(rtoll=1e-3)


def test_an_unknown_scene_is_answered_with_those_there_are():
    with pytest.raises(saltus.ModelError, match=r"no scene 'ball'.*bouncing-ball"):
        saltus.scene("ball")


def test_the_system_outlives_its_scene():
    system, context = (lambda s: (s.system, s.context))(saltus.scene("bouncing-ball-blocks"))
    results = saltus.simulate(system, context, (0.0, 2.0))
    assert results.status == "reached_end"


def test_a_shared_system_is_a_system():
    scene = saltus.scene("bouncing-ball")
    builder = saltus.DiagramBuilder()
    builder.add(scene.system)
    diagram = builder.build()
    state = diagram.create_context().with_subcontext(scene.system, scene.context)
    assert np.array_equal(state[scene.system].continuous_state, scene.context.continuous_state)
    signals = {"y": scene.system.output_ports[0]}
    results = saltus.simulate(diagram, state, scene.t_span, scene.options, recorded_signals=signals)
    alone = scene.simulate()
    assert np.array_equal(results.outputs["y"], alone.outputs["y"])


def test_blocks_of_a_shared_diagram():
    scene = saltus.scene("bouncing-ball-blocks")
    block = scene.system["integrator_y"]
    assert block.name in [b.name for b in scene.system.blocks]
    assert scene.context[block].continuous_state.shape == (1,)
    with pytest.raises(saltus.ModelError, match="integrator_y"):
        scene.system["integrator"]
    with pytest.raises(saltus.ModelError, match="no diagram"):
        saltus.scene("bouncing-ball").system["ball"]


def test_another_span():
    scene = saltus.scene("thermostat")
    results = scene.simulate((0.0, 10.0))
    assert results.time[[0, -1]].tolist() == [0.0, 10.0]
    again = scene.simulate(time_span=(0.0, 10.0))
    assert again.context == results.context
    with pytest.raises(saltus.ModelError, match="the span is time_span="):
        scene.simulate(t_span=(0.0, 10.0))


def test_another_span_of_a_file():
    text = "version = 1\nstates = { x = { start = 1.0, rate = '-x' } }\nrun = { until = 1.0 }\n"
    scene = saltus.scene_files.loads(text)
    assert scene.simulate().context.time == 1.0
    assert scene.simulate((0.0, 3.0)).context.time == 3.0
