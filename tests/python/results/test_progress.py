"""progress=True and progress=function; Ctrl-C."""

import os
import signal
import subprocess
import sys
import textwrap
import threading

import pytest
import saltus
from saltus import Progress
from systems import Ball, run


def long_run(**options):
    """A ball with e = 1 that bounces for about half a second of wall time."""
    ball = Ball(e=1.0)
    context = ball.create_context().with_continuous_state([1e-4, 0.0])
    return saltus.simulate(ball, context, (0.0, 150.0), record_events=False, **options)


def test_a_function_is_told_now_and_then():
    seen = []
    results = long_run(progress=seen.append)
    assert all(isinstance(now, Progress) for now in seen)
    assert seen[-1].time == seen[-1].end == 150.0
    assert seen[-1].fraction == 1.0
    assert seen[-1].events == results.statistics.events > 0
    assert [now.time for now in seen] == sorted(now.time for now in seen)
    assert len(seen) < results.statistics.events / 10


def test_the_trajectory_is_the_same():
    assert long_run(progress=lambda now: None).context == long_run().context


def test_what_the_function_raises_comes_out_as_it_was():
    class Enough(Exception):
        pass

    def stop(now):
        raise Enough("of this")

    with pytest.raises(Enough, match="of this"):
        long_run(progress=stop)


def test_a_bar_by_tqdm(capfd):
    pytest.importorskip("tqdm")
    long_run(progress=True)
    shown = capfd.readouterr()
    assert shown.out == ""
    assert "150/150 s" in shown.err
    assert "events" in shown.err and "s/s" in shown.err


def test_a_plain_line_without_tqdm(capfd, monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm", None)
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    long_run(progress=True)
    shown = capfd.readouterr()
    assert shown.out == ""
    assert "t = 150 of 150 s (100 %)" in shown.err
    assert shown.err.endswith("\n") and shown.err.rstrip().endswith("events")


def test_nothing_is_shown_unasked(capfd):
    long_run()
    assert capfd.readouterr() == ("", "")


def test_without_it_tqdm_is_not_imported():
    code = "import saltus, sys; saltus.scene('kepler').simulate(); print('tqdm' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_anything_else_is_refused():
    with pytest.raises(saltus.ModelError, match="option progress: expected True, False or a func"):
        long_run(progress="yes")


def test_a_run_in_pieces_and_one_that_ends_early():
    seen = []
    ball = Ball()
    simulator = saltus.Simulator(ball, progress=seen.append)
    simulator.initialize(ball.create_context().with_continuous_state([1.0, 0.0]))
    simulator.advance_to(0.5)
    simulator.advance_to(1.0)
    assert [(now.begin, now.time, now.end) for now in seen] == [(0, 0.5, 0.5), (0.5, 1.0, 1.0)]
    stopped = []
    run(Ball(on_zeno="stop", e=0.1), (0.0, 9.0), progress=stopped.append)
    assert stopped[-1].time < 9.0


def test_threads_each_have_their_own():
    seen = {k: [] for k in range(4)}

    def work(k):
        ball = Ball(e=1.0)
        context = ball.create_context().with_continuous_state([1e-4, 0.0])
        saltus.simulate(ball, context, (0.0, 10.0 + k), progress=seen[k].append)

    threads = [threading.Thread(target=work, args=(k,)) for k in seen]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    for k, told in seen.items():
        assert told[-1].time == told[-1].end == 10.0 + k


def test_progress_in_words():
    now = Progress(time=3.0, begin=0.0, end=12.0, events=5, wall_time=2.0)
    assert str(now) == "t = 3 of 12 s (25 %), 1.5 s/s, 5 events"
    endless = Progress(time=3.0, begin=0.0, end=float("inf"), events=5, wall_time=0.0)
    assert (endless.fraction, endless.rate) == (0.0, 0.0)
    assert str(endless).startswith("t = 3 of inf s, ")


SCRIPT = """
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
import saltus
floor = saltus.Guard(lambda t, x: x[0], lambda t, x: [0, -x[1]], "falling", name="floor")
said = []
def fall(t, x):
    if t > 0.01 and not said:  # the run is on its way
        said.append(True)
        print("ready", flush=True)
    return [x[1], -9.81]
try:
    got = saltus.solve(fall, (0, 1e9), [1e-3, 0], events=floor,
                       record_events=False, {options})
except KeyboardInterrupt as interrupt:
    got = interrupt.results
    print("raised" if "its attribute results has" in str(interrupt) else "silent")
print(type(got).__name__, got.status, 0 < got.t[-1] < 1e9, got.y.shape[1] == len(got.t))
print(got.message)
"""


@pytest.mark.skipif(os.name != "posix", reason="sends SIGINT")
@pytest.mark.parametrize(
    "options", ["", "throw=False", "progress=True", "progress=True, throw=False"]
)
def test_ctrl_c_gives_what_there_is(options):
    """As with SciPy it raises KeyboardInterrupt; with throw=False it returns."""
    script = textwrap.dedent(SCRIPT).replace("{options}", options)
    with subprocess.Popen(
        [sys.executable, "-c", script],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as process:
        assert process.stdout.readline() == "ready\n"
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=20)
    assert process.returncode == 0, err
    expected = [] if "throw=False" in options else ["raised"]
    assert out.splitlines()[:-1] == [*expected, "Solution interrupted True True"]
    assert "interrupted" in out.splitlines()[-1]
    assert ("%" in err) == ("progress" in options)
