"""Random scenes: whatever is connected to whatever, a run ends, and its results hold together.

100 scenes, the same each time; `./dev fuzz N` tries N new ones.
"""

import os

import numpy as np
import saltus
from draw_scene import scenes
from hypothesis import HealthCheck, Phase, assume, event, given, note, settings
from hypothesis import strategies as st
from known import is_known
from properties import (
    check_end,
    check_events,
    check_rows,
    check_same_rows,
    check_same_run,
    events_of,
)
from running import run, run_in_pieces
from scene import build

EXAMPLES = os.environ.get("SALTUS_FUZZ_EXAMPLES")
several = settings(
    max_examples=int(EXAMPLES or 100),
    derandomize=EXAMPLES is None,
    deadline=None,
    suppress_health_check=list(HealthCheck),
    print_blob=EXAMPLES is not None,
    phases=set(Phase) - {Phase.explain},
)


def first_run(scene):
    """Its results; scenes that are refused before the run are none."""
    assume(not is_known(scene))
    try:
        blocks = [block.name for block in build(scene).blocks]
        results = run(scene)
    except saltus.ModelError as error:
        event(f"refused: {type(error).__name__}")
        note(str(error))
        assume(False)
    event(results.status)
    note(f"{results!r}\n{results.events!r}")
    return results, blocks


@several
@given(scenes())
def test_any_scene_ends_and_its_rows_and_events_hold_together(scene):
    results, blocks = first_run(scene)
    check_end(scene, results, blocks)
    check_rows(scene, results)
    check_events(results)


def by_block(results):
    """The story of each block without j, which counts the jumps of all."""
    found = {}
    for _, kind, direction, block, name in story(results):
        found.setdefault(block, []).append((kind, direction, name))
    return found


@several
@given(scenes())
def test_islands_step_apart_to_the_same_end(scene):
    fine = {"rtol": 1e-9, "atol": 1e-11}
    first_run(scene)
    results, finer = run(scene, **fine), run(scene, rtol=1e-11, atol=1e-13)
    try:
        apart = run(scene, islands=True, **fine)
    except saltus.ModelError as error:
        assume("with islands = true" not in str(error))
        raise
    event(f"{len(apart.islands)} islands")
    if not apart.islands:
        check_same_run(results, apart)
        return
    assert [e.time for e in apart.events] == sorted(e.time for e in apart.events)
    assume(results.status in ("reached_end", "terminal") and results.status == finer.status)
    assume(by_block(results) == by_block(finer))  # else the scene hangs on a hair
    assert apart.status == results.status
    end = scene.span[1]
    last = [e for r in (results, finer, apart) for e in r.events if e.time > end - 1e-6]
    assume(not last)  # they may as well come after the end
    assert by_block(apart) == by_block(results)
    spread = 1e-6 + 100 * np.max(
        np.abs(finer.context.continuous_state - results.context.continuous_state), initial=0.0
    )
    np.testing.assert_allclose(
        apart.context.continuous_state, results.context.continuous_state, rtol=1e-6, atol=spread
    )


@several
@given(scenes())
def test_what_is_recorded_changes_nothing(scene):
    results, _ = first_run(scene)
    again = run(scene)
    check_same_run(results, again)
    if results.status != "failed":  # the last row may be no row, see test_not_finite.py
        check_same_rows(results, again)
    assert events_of(results) == events_of(again)
    bare = run(scene, record=False)
    if results.status != "failed":  # an output that is not finite is an error only if recorded
        check_same_run(results, bare)
        assert events_of(results) == events_of(bare)
    silent = run(scene, record_events=False)
    if results.status != "chattering":  # its message, see test_found.py
        check_same_run(results, silent)
    if results.status != "failed":
        check_same_rows(results, silent)
    assert len(silent.events) == 0


def story(results):
    return [(e.jump, e.kind, e.direction, e.block, e.name) for e in results.events]


SHARES = st.integers(0, 1000).map(lambda n: n / 1000)  # or it draws 1e-178, see test_found.py


@several
@given(scenes(), st.lists(SHARES, min_size=1, max_size=3).map(sorted))
def test_a_run_in_pieces_is_the_run_at_once(scene, shares):
    begin, end = scene.span
    times = [begin + share * (end - begin) for share in shares]
    fine = {"rtol": 1e-9, "atol": 1e-11}
    _, _ = first_run(scene)
    results, finer = run(scene, **fine), run(scene, rtol=1e-11, atol=1e-13)
    assume(results.status in ("reached_end", "terminal") and results.status == finer.status)
    assume(story(results) == story(finer))  # else the scene hangs on a hair
    pieces = run_in_pieces(scene, times, **fine)
    assert pieces.status == results.status
    last = [e for r in (results, finer, pieces) for e in r.events if e.time > end - 1e-6]
    assume(not last)  # they may as well come after the end
    assert story(pieces) == story(results)
    spread = 1e-6 + 100 * np.max(
        np.abs(finer.context.continuous_state - results.context.continuous_state), initial=0.0
    )
    np.testing.assert_allclose(
        pieces.context.continuous_state, results.context.continuous_state, rtol=1e-6, atol=spread
    )


@several
@given(scenes())
def test_a_diagram_within_a_diagram_is_the_same(scene):
    results, _ = first_run(scene)
    inside = run(scene, nested=True)
    assert results.status == inside.status
    assert np.array_equal(results.time, inside.time)
    assert np.array_equal(results.jump, inside.jump)
    assert np.array_equal(results.context.continuous_state, inside.context.continuous_state)
    assert np.array_equal(results.context.discrete_state, inside.context.discrete_state)
    assert story(inside) == [
        (jump, kind, direction, f"inside.{block}", name)
        for jump, kind, direction, block, name in story(results)
    ]
