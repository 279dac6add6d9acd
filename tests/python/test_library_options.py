"""The hysteresis of Quantizer and the velocity limits of SecondOrderIntegrator, from Python."""

import numpy as np
import pytest
import saltus
from saltus.library import *

response = saltus.response
FILE = """
version = 1
wires = ["push -> body", "body.dx -> level"]
[blocks]
push = { block = "Step", start_value = 2.0, end_value = -1.0, step_time = 3.0 }
body = { block = "SecondOrderIntegrator", upper_velocity_limit = 3.0 }
level = { block = "Quantizer", interval = 1.0, hysteresis = 0.5 }
[outputs]
v = "body.dx"
level = "level"
[run]
until = 4.0
"""


def events_of(block, ripple):
    builder = saltus.DiagramBuilder()
    source, quantizer, total = builder.add(ripple, block, Integrator(0.0))
    builder.connect(source.output(), quantizer.input())
    builder.connect(quantizer.output(), total.input())
    return len(saltus.simulate(builder.build(), (0.0, 2.0)).events)


def test_a_level_is_left_half_an_interval_and_half_a_hysteresis_away():
    """u = 2 sin t with h = 0.5: up at 0.75 and 1.75, down at 1.25 and 0.25."""
    builder = saltus.DiagramBuilder()
    source, block = builder.add(Sine(amplitude=2.0), Quantizer(1.0, hysteresis=0.5))
    builder.connect(source.output(), block.input())
    events = saltus.simulate(builder.build(), (0.0, np.pi)).events
    up, down = np.arcsin([0.375, 0.875]), np.pi - np.arcsin([0.625, 0.125])
    # the guard has slope >= 0.5 at its roots, so the time is located to a few rounding errors
    np.testing.assert_allclose([e.time for e in events], [*up, *down], rtol=0, atol=1e-12)


def test_a_ripple_below_the_hysteresis_changes_no_level():
    def ripple():
        return Sine(amplitude=0.2, frequency=50.0, bias=0.5)

    assert events_of(Quantizer(1.0, hysteresis=0.5), ripple()) == 0
    assert events_of(Quantizer(1.0), ripple()) > 10  # the trap that the option is for


def test_a_velocity_stops_at_its_limit_and_leaves_it():
    """Pushed by 1 from rest to v = 0.5: x = 1/8 at 0.5 s, then x = 1/8 + (t - 0.5) / 2."""
    body = SecondOrderIntegrator(upper_velocity_limit=0.5)
    x, v = response(body, 1.0, t=[0.25, 2.5])
    np.testing.assert_allclose(v, [0.25, 0.5], rtol=0, atol=1e-12)
    np.testing.assert_allclose(x, [0.03125, 1.125], rtol=0, atol=1e-12)


def test_options_that_do_not_fit_are_refused():
    with pytest.raises(saltus.ModelError, match="hysteresis = 1; expected 0, or less than"):
        Quantizer(1.0, hysteresis=1.0)
    with pytest.raises(saltus.ModelError, match="initial_velocity 2 is outside the limits"):
        SecondOrderIntegrator(0.0, 2.0, upper_velocity_limit=1.0)


def test_both_in_a_file(tmp_path):
    """v = 2 t up to 3, and from 3 s on 3 - (t - 3): 2 at 4 s. The level 3 is left for 2 where v
    passes 2.25, at 3.75 s."""
    file = tmp_path / "scene.toml"
    file.write_text(FILE)
    results = saltus.load_scene(file).simulate()
    assert results.outputs["v"][-1] == pytest.approx(2.0, abs=1e-9)
    assert results.outputs["level"][-1] == 2.0


BEYOND = [
    # limits, the state at the start, and what the error says
    (dict(upper_limit=0.5), [0.6, 0.0], "x.0. = 0.6 is above upper_limit 0.5"),
    (dict(lower_limit=0.5), [0.4, 0.0], "x.0. = 0.4 is below lower_limit 0.5"),
    (dict(upper_velocity_limit=2.0), [0.0, 3.0], "dx.0. = 3 is above upper_velocity_limit 2"),
    (dict(lower_velocity_limit=-1.0), [0.0, -3.0], "dx.0. = -3 is below lower_velocity_limit -1"),
]


@pytest.mark.parametrize(("limits", "start", "says"), BEYOND)
def test_a_run_does_not_begin_beyond_a_limit(limits, start, says):
    builder = saltus.DiagramBuilder()
    force = builder.add(Constant(1.0))
    body = builder.add(SecondOrderIntegrator(initial_position=0.5, name="body", **limits))
    builder.connect(force.output(), body.input())
    diagram = builder.build()
    context = diagram.create_context().with_time(3.0).with_continuous_state(start)
    with pytest.raises(saltus.ModelError, match=rf"block 'body': .*t = 3 s, {says}"):
        saltus.simulate(diagram, context, (3.0, 4.0))
