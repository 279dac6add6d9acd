"""What holds for every run of every scene."""

from __future__ import annotations

import math
from collections import Counter

import numpy as np
import saltus
from running import Hang
from scene import Scene

ENDED_WELL = ("reached_end", "terminal", "zeno_stop")


def check_end(scene: Scene, results: saltus.Results, blocks: list[str]) -> None:
    """One status; a bad one says when and where."""
    begin, end = scene.span
    assert not isinstance(results.cause, Hang)
    assert begin <= results.context.time <= end
    if results.status in ENDED_WELL:
        assert results.message == ""
        assert results.cause is None
        assert results.status != "reached_end" or results.context.time == end
        return
    assert results.status in ("chattering", "failed")
    if "blows up" not in results.message:  # see test_found.py
        assert any(block in results.message for block in blocks), results.message
    if isinstance(results.cause, saltus.ModelError):
        return
    assert "t = " in results.message
    assert results.status == "chattering" or isinstance(results.cause, saltus.SimulationError)


def check_rows(scene: Scene, results: saltus.Results) -> None:
    """Start and end; (t, j) goes up row by row; a pass is two rows of one time; what was asked for
    is there.
    """
    t, j = results.time, results.jump
    if results.status == "failed" and len(t) == 0:
        return  # at the start already
    assert t[0] == scene.span[0]
    assert j[0] == 0
    assert t[-1] == results.context.time or results.status == "failed"
    passes = np.diff(j) == 1
    steps = np.diff(t)
    assert np.all((np.diff(j) == 0) | passes)
    assert np.all(steps[passes] == 0.0)
    assert np.all(steps[~passes] > 0.0)
    wanted = [s for s in scene.options.get("save_at", []) if s <= t[-1]]
    assert set(wanted) <= set(t.tolist())
    for name, column in results.outputs.items():
        assert len(column) == len(t), name
        assert results.status == "failed" or np.all(np.isfinite(column)), name


def check_events(results: saltus.Results) -> None:
    """Sorted; each pass has a cause in the log; each entry belongs to a pass or, of a monitor, lies
    between two; the counts are those of the log.
    """
    events = list(results.events)
    when = [(e.time, e.jump) for e in events]
    assert when == sorted(when)
    rows = list(zip(results.time.tolist(), results.jump.tolist(), strict=True))
    if not rows:
        return
    after = {row for row, one in zip(rows[1:], np.diff(results.jump), strict=True) if one == 1}
    assert after <= set(when), "a pass without a cause"
    first = {jump: time for time, jump in reversed(rows)}
    last = {jump: time for time, jump in rows}
    for e in events:
        if results.status == "failed" and (e.time, e.jump) > rows[-1]:
            continue  # an output of the next row is not finite
        assert e.jump in first, e
        assert first[e.jump] <= e.time <= last[e.jump], e
        assert e.kind == "zeno_enter" or math.isnan(e.predicted)
    kinds = ("zero_crossing", "time", "terminal")
    counts = Counter(f"{e.block}.{e.name}" for e in events if e.kind in kinds)
    assert counts == Counter(results.statistics.events_by_name)


def events_of(results: saltus.Results) -> list[tuple]:
    """The log, comparable bit by bit."""
    return [
        (*e[:6], repr(e.predicted), e.before.tobytes(), e.after.tobytes()) for e in results.events
    ]


def check_same_run(a: saltus.Results, b: saltus.Results) -> None:
    """The same end by the same way, to the last bit."""
    assert (a.status, a.message) == (b.status, b.message)
    assert a.context == b.context
    for name in ("steps", "rejected", "restarts", "instants", "events", "events_by_name"):
        assert getattr(a.statistics, name) == getattr(b.statistics, name), name


def check_same_rows(a: saltus.Results, b: saltus.Results) -> None:
    assert np.array_equal(a.time, b.time)
    assert np.array_equal(a.jump, b.jump)
    for name, column in a.outputs.items():
        assert np.array_equal(column, b.outputs[name], equal_nan=True), name
