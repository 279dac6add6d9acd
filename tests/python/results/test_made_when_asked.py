"""Results are made when they are asked for, once, and what a simulator does later changes none."""

import gc
import weakref

import numpy as np
import pytest
import saltus
from saltus.simulation import simulator as simulators
from systems import Ball, Decay

STARTS = {"low": [1.0, 0.0], "high": [10.0, 0.0], "up": [0.5, 4.0]}


@pytest.fixture
def made(monkeypatch):
    """One entry for each object of results that a simulator makes."""
    entries = []

    class Counted(saltus.Results):
        def __init__(self, *arguments):
            entries.append(1)
            super().__init__(*arguments)

    monkeypatch.setattr(simulators, "Results", Counted)
    return entries


def simulator_of(**options):
    ball = Ball()
    return saltus.Simulator(ball, recorded_signals={"state": ball.output()}, **options)


def begin(simulator, start="low"):
    context = simulator.system.create_context().with_continuous_state(STARTS[start])
    simulator.initialize(context)


def bits(results):
    """All that results say, but the clock."""
    statistics = vars(results.statistics) | {"wall_time": 0.0}
    events = [(e.time, e.name, e.before.tolist(), e.after.tolist()) for e in results.events]
    rows = results.time.tobytes(), results.jump.tobytes(), results.outputs["state"].tobytes()
    x = results.context.continuous_state.tobytes(), results.context.time
    dense = results(results.time).continuous_state.tobytes() if results.dense else b""
    return rows, x, events, statistics, results.status, results.message, dense


def test_advancing_makes_none_and_asking_twice_makes_one(made):
    simulator = simulator_of()
    begin(simulator)
    assert simulator.advance_to(1.0) == "reached_end"
    assert simulator.advance_to(2.0) == "reached_end"
    assert not made
    first = simulator.results
    assert simulator.results is first
    assert first.time is first.time
    assert first.outputs["state"] is first.outputs["state"]
    assert first.statistics is first.statistics
    assert len(made) == 1


def test_they_keep_nothing_that_was_not_asked_for():
    simulator = simulator_of()
    begin(simulator)
    simulator.advance_to(1.0)
    gone = weakref.ref(simulator.results)
    gc.collect()
    assert gone() is None


@pytest.mark.parametrize("dense", [False, True])
def test_the_next_run_changes_no_results_read_or_not(dense):
    """The results of the first run are read after the second: they are those read at once."""
    simulator, expected, unread = simulator_of(dense_output=dense), {}, {}
    for start in STARTS:
        begin(simulator, start)
        simulator.advance_to(3.0)
        expected[start] = bits(simulator.results)
    for start in STARTS:
        begin(simulator, start)
        simulator.advance_to(3.0)
        unread[start] = simulator.results
    assert {start: bits(results) for start, results in unread.items()} == expected


@pytest.mark.parametrize("dense", [False, True])
@pytest.mark.parametrize("looks", ["none", "kept", "dropped", "read", "written"])
def test_looking_changes_nothing_of_a_run_in_pieces(looks, dense):
    """Whatever is done with the results of a piece, the later ones are those of a run nobody
    looked at, and those of the piece stay what they were.
    """
    runs = {}
    for look in ("none", looks):
        simulator, pieces = simulator_of(dense_output=dense), []
        begin(simulator)
        for time in (0.25, 0.5, 1.0, 1.0, 3.0):
            simulator.advance_to(time)
            if look != "none":
                results = simulator.results
                pieces.append((results, bits(results) if look == "read" else None))
            if look == "dropped":
                pieces.clear()
                del results
            if look == "written":
                results.time[:], results.outputs["state"][:] = np.nan, np.nan
        if look == "read":
            assert all(bits(results) == then for results, then in pieces)
        if look == "written":
            del results
            pieces.clear()
            simulator.advance_to(3.0)  # nothing is left to do
        runs[look] = bits(simulator.results)
    assert runs[looks] == runs["none"]


def test_results_of_a_run_that_failed_stay_with_their_cause():
    def fail(t, state):
        if t > 0.5:
            raise RuntimeError("far enough")

    system = Decay(fail)
    simulator = saltus.Simulator(system, throw=False, recorded_signals={"x": system.output()})
    simulator.initialize(system.create_context())
    assert simulator.advance_to(1.0) == "failed"
    results = simulator.results
    assert isinstance(results.cause, RuntimeError)
    assert "far enough" in results.message
    with pytest.raises(saltus.ModelError, match="this run has failed"):
        simulator.advance_to(2.0)
    assert simulator.results is results
    system.hook = lambda t, state: None
    simulator.initialize(results.context)
    assert simulator.advance_to(1.0) == "reached_end"
    assert simulator.results.cause is None
    assert results.status == "failed"


def test_a_context_that_is_refused_leaves_the_results():
    simulator = simulator_of()
    begin(simulator)
    simulator.advance_to(1.0)
    before = bits(simulator.results)
    with pytest.raises(saltus.ModelError):
        simulator.initialize(Decay(lambda t, s: None).create_context())
    assert bits(simulator.results) == before
    simulator.advance_to(2.0)
    assert simulator.results.time[-1] == 2.0


def test_a_time_that_is_refused_leaves_the_results():
    simulator = simulator_of()
    begin(simulator)
    simulator.advance_to(1.0)
    before = bits(simulator.results)
    with pytest.raises(saltus.ModelError, match="cannot run"):
        simulator.advance_to(0.5)
    assert bits(simulator.results) == before
