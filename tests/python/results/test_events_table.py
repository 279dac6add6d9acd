"""The event log as a table."""

import numpy as np
import pytest
import saltus
from systems import Ball, run


@pytest.fixture(scope="module")
def events():
    ball = Ball(e=0.5)
    return run(ball, (0.0, 6.0), ball.create_context().with_continuous_state([10.0, 0.0])).events


def test_slices_are_logs(events):
    part = events[2:5]
    assert isinstance(part, saltus.EventLog)
    assert len(part) == 3
    assert [e.time for e in part] == [e.time for e in list(events)[2:5]]
    assert part[-1].time == events[4].time
    assert part[1:][0].time == events[3].time
    assert np.array_equal(part.times("bounce"), events.times("bounce")[2:5])
    assert np.array_equal(part.times("ball.bounce"), events.times("bounce")[2:5])
    assert part.times("bounce", kind="zeno_enter").size == 0
    with pytest.raises(saltus.ModelError, match="unknown kind of event 'zero'"):
        part.times("bounce", kind="zero")
    with pytest.raises(IndexError, match="event 3 of 3"):
        part[3]


def test_pandas(events):
    pytest.importorskip("pandas")
    frame = events.to_pandas()
    assert list(frame.columns) == list(saltus.Event._fields)
    assert len(frame) == len(events)
    assert frame.time.tolist() == [e.time for e in events]
    assert (frame.kind == "zeno_enter").sum() == 1


def test_text_and_html(events):
    text, page = repr(events), events._repr_html_()
    assert text.startswith(f"{len(events)} events\n")
    assert f"... and {len(events) - 20} more" in text
    assert repr(events[:1]).startswith("1 event\n")
    assert repr(events[:0]) == "0 events"
    assert page.count("<tr>") == 21  # the head, and twenty
    assert "ball.bounce" in page


def test_names_are_escaped_in_html():
    class Odd(Ball):
        pass

    odd = Odd(name="<b>&")
    log = run(odd, (0.0, 2.0), odd.create_context().with_continuous_state([1.0, 0.0])).events
    assert "<b>&.bounce" not in log._repr_html_()
    assert "&lt;b&gt;&amp;.bounce" in log._repr_html_()


def test_an_event_that_never_fired_has_no_times_and_a_name_that_is_none_is_refused(tmp_path):
    """Also in results that come from a file."""
    ball = Ball()
    high = ball.create_context().with_continuous_state([1e6, 0.0])
    results = run(ball, (0.0, 1.0), high)
    results.save(tmp_path / "high.npz")
    for log in (results.events, saltus.load_results(tmp_path / "high.npz").events):
        assert len(log) == 0
        for name in ("bounce", "ball.bounce"):
            assert log.times(name).size == 0
        with pytest.raises(saltus.ModelError, match="called 'bounces'; did you mean 'bounce'"):
            log.times("bounces")
        with pytest.raises(saltus.ModelError, match=r"did you mean 'ball\.bounce'"):
            log.times("all.bounce")
