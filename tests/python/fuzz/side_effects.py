"""Callbacks with side effects have one answer: a run of a story, traced and called.

    python tests/python/fuzz/side_effects.py COUNT [SEED]

tries COUNT new stories, in batches of their own seeds: Hypothesis keeps what it has drawn.
"""

import sys
from pathlib import Path

import numpy as np
import saltus

sys.path.append(str(Path(__file__).parents[1]))  # where `places` is, if no pytest says so

from draw_effects import build, stories
from hypothesis import HealthCheck, given, note, seed, settings

# The steps may differ where the engine knows from a trace what a function reads. 1.3 s of a flow
# with rates near 1 keeps the errors of both at some 100 steps of the tolerance 1e-9.
BOUND = 1e-6
BATCH = 100  # Hypothesis keeps the choices of all examples of a call: 300 MB for 500 stories


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


def check_one_answer(story) -> None:
    """AssertionError where the traced run and the called one differ."""
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


def try_stories(count: int, first_seed: int = 0) -> int:
    """Tries `count` stories; returns how many ran. AssertionError where one fails."""
    ran = 0

    def check(story):
        nonlocal ran
        check_one_answer(story)
        ran += 1

    for begin in range(0, count, BATCH):
        batch = settings(
            max_examples=min(BATCH, count - begin),
            database=None,
            deadline=None,
            suppress_health_check=list(HealthCheck),
        )
        seed(first_seed * 1_000_003 + begin)(batch(given(stories())(check)))()
        print(f"{ran} of {count} stories: one answer each", flush=True)
    return ran


if __name__ == "__main__":
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    try_stories(number, int(sys.argv[2]) if len(sys.argv) > 2 else 0)
