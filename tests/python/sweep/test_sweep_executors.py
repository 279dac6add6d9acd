"""Threads, processes, and executors of others: the same bits from all of them."""

import concurrent.futures
import itertools
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import saltus
from made import Ball, make_ball, make_fatal, peak
from saltus.errors import ModelError

pytest.importorskip("xarray")
GRID = {"e": list(np.linspace(0.0, 1.0, 7)), "x[0]": [5.0, 7.0, 10.0]}
SPAN = (0.0, 3.0)


@pytest.fixture(scope="module")
def ball():
    return saltus.scene("bouncing-ball").system


@pytest.fixture(scope="module")
def expected(ball):
    """Each run made alone."""
    context = ball.create_context()
    states = np.empty((7, 3, 2))
    for i, e in enumerate(GRID["e"]):
        for j, y0 in enumerate(GRID["x[0]"]):
            start = context.with_parameter("e", e).with_continuous_state([y0, 0.0])
            states[i, j] = saltus.simulate(ball, start, SPAN).context.continuous_state
    return states


@pytest.mark.parametrize("workers", [1, 2, 3])
@pytest.mark.parametrize("executor", ["threads", "processes", "serial"])
def test_all_executors_give_the_same_bits(ball, expected, executor, workers):
    found = saltus.sweep(ball, GRID, SPAN, executor=executor, workers=workers)
    assert np.array_equal(found["continuous_state"].values, expected)
    assert found.attrs["executor"] == executor


@pytest.mark.parametrize("workers", [1, 2, 3])
def test_a_factory_gives_the_same_bits(workers):
    grid = {"e": [0.0, 0.5, 0.9], "x[0]": [5.0, 7.0, 10.0]}
    alone = saltus.sweep(make_ball, grid, SPAN, executor="serial")
    found = saltus.sweep(make_ball, grid, SPAN, executor="processes", workers=workers)
    for name in ("continuous_state", "events", "steps", "status"):
        assert np.array_equal(found[name].values, alone[name].values)


def test_an_executor_of_the_standard_library(ball, expected):
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        found = saltus.sweep(ball, GRID, SPAN, executor=pool)
    assert np.array_equal(found["continuous_state"].values, expected)
    assert found.attrs["executor"] == "ThreadPoolExecutor"


def test_a_pool_with_map_only(ball, expected):
    with multiprocessing.get_context("spawn").Pool(1) as pool:

        class Mapping:
            map = pool.map

        found = saltus.sweep(ball, GRID, SPAN, executor=Mapping())
    assert np.array_equal(found["continuous_state"].values, expected)


def test_a_dask_client(ball, expected):
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        client.run(sys.path.insert, 0, os.path.dirname(__file__))  # where `made` is
        found = saltus.sweep(ball, GRID, SPAN, executor=client)
        kept = saltus.sweep(
            lambda e: Ball(e=e), {"e": [0.5, 0.9]}, SPAN, executor=client, reduce=peak
        )
    assert np.array_equal(found["continuous_state"].values, expected)
    alone = saltus.sweep(make_ball, {"e": [0.5, 0.9]}, SPAN, executor="serial")
    assert np.array_equal(kept["state"].values, alone["continuous_state"].values)


def test_traced_functions_run_in_threads_and_called_ones_here():
    leaf = Ball()
    traced = saltus.sweep(leaf, {"g": [1.0, 2.0]}, (0.0, 1.0), workers=2)
    called = saltus.sweep(leaf, {"g": [1.0, 2.0]}, (0.0, 1.0), python="called")
    assert traced.attrs["executor"] == "threads"
    assert called.attrs["executor"] == "serial"
    for found in (traced, called):
        assert found["continuous_state"].values[:, 0] == pytest.approx([9.5, 9.0], abs=1e-9)


def test_a_traced_function_is_never_stale():
    leaf = Ball(e=1.0)
    before = saltus.sweep(leaf, {"g": [9.81, 5.0]}, (0.0, 3.0), executor="threads")
    leaf.e = 0.5
    after = saltus.sweep(leaf, {"g": [9.81, 5.0]}, (0.0, 3.0), executor="threads")
    expected = saltus.sweep(Ball(e=0.5), {"g": [9.81, 5.0]}, (0.0, 3.0), python="called")
    assert not np.allclose(before["continuous_state"], after["continuous_state"])
    # the tape and numpy may round differently: some 1e-15 each, a few flights
    assert after["continuous_state"].values == pytest.approx(
        expected["continuous_state"].values, abs=1e-9
    )


def test_what_cannot_go_to_another_process_says_what_to_do():
    leaf = Ball()
    with pytest.raises(ModelError, match="at the top level of a module"):
        saltus.sweep(leaf, {"g": [1.0, 2.0]}, (0.0, 1.0), executor="processes")
    with pytest.raises(ModelError, match="at the top level of a module"):
        saltus.sweep(lambda e: Ball(e=e), {"e": [0.5]}, (0.0, 1.0), executor="processes")
    with pytest.raises(ModelError, match="no threads share a plan"):
        saltus.sweep(make_ball, {"e": [0.5]}, (0.0, 1.0), executor="threads")


def test_a_process_that_dies_takes_its_runs_with_it():
    found = saltus.sweep(
        make_fatal, {"e": [0.5] * 8 + [0.7]}, (0.0, 0.1), executor="processes", workers=1
    )
    assert found["status"].values[0] == "reached_end"
    assert "the process that made this run ended" in found["message"].values[-1]


@pytest.mark.parametrize(
    ("workers", "executor"), [(None, "serial"), (1, "serial"), (2, "processes")]
)
def test_what_is_asked_for_decides_and_no_clock(monkeypatch, workers, executor):
    """A clock that leaps by an hour at each reading changes nothing."""
    hours = itertools.count(0.0, 3600.0)
    monkeypatch.setattr(time, "perf_counter", lambda: next(hours))
    alone = saltus.sweep(make_ball, {"e": [0.5, 0.6, 0.7]}, (0.0, 1.0), executor="serial")
    found = saltus.sweep(make_ball, {"e": [0.5, 0.6, 0.7]}, (0.0, 1.0), workers=workers)
    assert found.attrs["executor"] == executor
    assert np.array_equal(found["continuous_state"].values, alone["continuous_state"].values)


def test_a_long_sweep_of_a_script_without_guard_runs(tmp_path):
    """Fifty systems are made, each takes 20 ms, and no process is started."""
    (tmp_path / "script.py").write_text(
        "import time, saltus\n"
        "def make(e):\n"
        "    time.sleep(0.02)\n"
        "    return saltus.scene('bouncing-ball', e=e).system\n"
        "grid = {'e': [0.5] * 50}\n"
        "print(saltus.sweep(make, grid, (0, 1), as_dict=True)['status'].tolist())\n"
    )
    done = subprocess.run(
        [sys.executable, "script.py"], capture_output=True, text=True, timeout=120, cwd=tmp_path
    )
    assert done.stdout.count("reached_end") == 50, done.stderr


def test_a_script_without_guard_is_told_so(tmp_path):
    (tmp_path / "made_here.py").write_text(
        "import saltus\ndef make(e):\n    return saltus.scene('bouncing-ball', e=e).system\n"
    )
    script = tmp_path / "script.py"
    script.write_text(
        "import saltus\nfrom made_here import make\n"
        "print(saltus.sweep(make, {'e': [0.5, 0.6]}, (0, 1), executor='processes'))\n"
    )
    done = subprocess.run(
        [sys.executable, script], capture_output=True, text=True, timeout=120, cwd=tmp_path
    )
    assert done.returncode != 0
    assert "if __name__ == '__main__':" in done.stderr.splitlines()[-1]


@pytest.mark.parametrize("workers", [1, 2])
def test_ctrl_c_gives_what_is_done(ball, workers):
    """Twenty thousand runs of 700 bounces take a minute; a second of them is kept."""
    values = {"e": [1.0], "x[0]": np.linspace(9.0, 10.0, 20_000)}
    threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt) as caught:
        saltus.sweep(ball, values, (0.0, 2000.0), workers=workers, as_dict=True)
    status = caught.value.results["status"]
    done = status == "reached_end"
    assert done.any() and (status == "not_run").any()
    assert np.isfinite(caught.value.results["continuous_state"][done]).all()


def test_ctrl_c_in_a_python_function():
    leaf = Ball()
    runs = []

    def reduce(results):
        runs.append(results)
        if len(runs) == 3:
            os.kill(os.getpid(), signal.SIGINT)
        return 1.0

    with pytest.raises(KeyboardInterrupt) as caught:
        saltus.sweep(leaf, {"g": range(1, 400)}, (0.0, 5.0), reduce=reduce, python="called")
    status = caught.value.results["status"].values
    assert status[0] == "reached_end"
    assert status[-1] == "not_run"


def test_progress_counts_the_runs(ball, capsys, monkeypatch):
    saltus.sweep(ball, GRID, SPAN, progress=True)
    assert "21/21" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "tqdm", None)
    saltus.sweep(ball, GRID, SPAN, progress=True)
    assert "21 of 21 runs" in capsys.readouterr().err
    saltus.sweep(ball, GRID, SPAN)
    assert capsys.readouterr().err == ""
