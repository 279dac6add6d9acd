"""Callbacks that read and write outside the state: traced or called, a run has one answer."""

import numpy as np
import saltus
from draw_effects import build, stories
from hypothesis import given, note
from test_fuzz import several

# The steps may differ where the engine knows from a trace what a function reads. 1.3 s of a flow
# with rates near 1 keeps the errors of both at some 100 steps of the tolerance 1e-9.
BOUND = 1e-6


def run(story, python):
    diagram, signals = build(story)
    simulator = saltus.Simulator(
        diagram,
        recorded_signals=signals,
        python=python,
        rtol=1e-9,
        atol=1e-11,
        throw=False,  # a reset map that changes what it reads may chatter: both have to say so
    )
    simulator.initialize(diagram.create_context())
    simulator.advance_to(1.3)
    if python == "traced":
        note(str(diagram.explain()))
    return simulator.results


@several
@given(stories())
def test_a_run_has_one_answer_traced_and_called(story):
    found, expected = (run(story, python) for python in ("traced", "called"))
    assert found.status == expected.status
    names = [[(event.block, event.name) for event in r.events] for r in (found, expected)]
    assert names[0] == names[1]
    for one, other in zip(found.events, expected.events, strict=True):
        assert abs(one.time - other.time) < BOUND
    ends = [np.ravel(r.context.continuous_state) for r in (found, expected)]
    np.testing.assert_allclose(*ends, rtol=0.0, atol=BOUND)
    for signal in found.outputs:
        lasts = [r.outputs[signal][-1] for r in (found, expected)]
        np.testing.assert_allclose(*lasts, rtol=0.0, atol=BOUND)
