"""A store of a sweep: resumed bit for bit, refused for another sweep, with lost rows named."""

import concurrent.futures
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import saltus
from made import make_ball
from saltus.errors import ModelError

GRID = {"e": [0.5, 0.6, 0.7, 0.8, 0.9, 1.0]}


def counted(e, log=""):
    with open(log, "a") as file:
        file.write(f"{e}\n")
    time.sleep(0.1)
    return make_ball(e=e)


def deadly(e, flag=""):
    if e == 0.7 and not os.path.exists(flag):
        if flag:
            open(flag, "w").close()
        os._exit(9)
    return make_ball(e=e)


def swept(path, make=make_ball, grid=None, **more):
    return saltus.sweep(make, grid or GRID, (0.0, 5.0), as_dict=True, store=path, **more)


def equal(a, b):
    for name in ("continuous_state", "status", "events", "steps", "end_time"):
        np.testing.assert_array_equal(a[name], b[name])


def test_a_killed_sweep_goes_on_with_the_missing_chunks(tmp_path):
    log, path = tmp_path / "log", tmp_path / "store"
    code = (
        "import sys; sys.path.insert(0, sys.argv[1])\n"
        "from test_sweep_store import *\n"
        "swept(sys.argv[2], counted, GRID | {'log': sys.argv[3]}, chunk=1)\n"
    )
    here = os.path.dirname(__file__)
    process = subprocess.Popen([sys.executable, "-c", code, here, str(path), str(log)])
    while not (path / "chunk-000001.pickle").exists():
        assert process.poll() is None
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    process.wait()
    finished = len(list(path.glob("chunk-*.pickle")))
    assert 2 <= finished < 6
    before = len(log.read_text().split())
    resumed = swept(path, counted, GRID | {"log": str(log)}, chunk=1)
    # the missing rows, and one that is run again as a check of the store
    assert len(log.read_text().split()) - before == 6 - finished + 1
    equal(resumed, saltus.sweep(make_ball, GRID, (0.0, 5.0), as_dict=True))


def test_a_damaged_chunk_is_run_again(tmp_path):
    whole = swept(tmp_path, chunk=2)
    file = tmp_path / "chunk-000001.pickle"
    good = file.read_bytes()
    for bad in (b"", good[:40], good[:-1] + bytes([good[-1] ^ 1])):
        file.write_bytes(bad)
        equal(swept(tmp_path), whole)
        assert file.read_bytes() != bad


def test_a_store_of_another_sweep_is_refused(tmp_path):
    ball = make_ball()
    grid = {"g": [9.0, 9.8]}
    swept(tmp_path, ball, grid)
    for name, make, values, more in (
        ("values", ball, {"g": [9.0, 9.81]}, {}),
        ("options", ball, grid, {"rtol": 1e-9}),
        ("chunk", ball, grid, {"chunk": 2}),
        ("system", make_ball(e=0.5), grid, {}),
    ):
        with pytest.raises(ModelError, match=f"another sweep, with other {name};"):
            swept(tmp_path, make, values, **more)


def of_file(e, path=""):
    with open(path) as file:
        return make_ball(e=e, y0=float(file.read()))


@pytest.mark.parametrize("executor", ["serial", "processes"])
def test_what_no_fingerprint_sees_is_found_by_a_row_that_is_run_again(tmp_path, executor):
    file, path = tmp_path / "height", tmp_path / "store"
    grid = {"e": [0.5, 0.6], "path": str(file)}
    file.write_text("10.0")
    first = swept(path, of_file, grid, executor=executor, workers=1)
    equal(swept(path, of_file, grid, executor=executor, workers=1), first)
    file.write_text("5.0")
    with pytest.raises(ModelError, match=r"run 0 has .* now, and .* in the store"):
        swept(path, of_file, grid, executor=executor, workers=1)


RATES = {"rate": -1.0}


def decaying(rate):
    return saltus.system_of(lambda t, x: rate * x, [1.0])


def by_global():
    return saltus.system_of(lambda t, x: RATES["rate"] * x, [1.0])


def test_values_that_a_function_reads_belong_to_the_fingerprint(tmp_path, monkeypatch):
    grid = {"x[0]": [1.0, 2.0]}
    swept(tmp_path / "closure", decaying(-1.0), grid)
    swept(tmp_path / "global", by_global(), grid)
    swept(tmp_path / "closure", decaying(-1.0), grid)
    swept(tmp_path / "global", by_global(), grid)
    with pytest.raises(ModelError, match="with other system;"):
        swept(tmp_path / "closure", decaying(-2.0), grid)
    monkeypatch.setitem(RATES, "rate", -2.0)
    with pytest.raises(ModelError, match="with other system;"):
        swept(tmp_path / "global", by_global(), grid)


@pytest.mark.parametrize("executor", ["serial", "threads"])
def test_compiled_systems(tmp_path, executor):
    ball = saltus.scene("bouncing-ball").system
    plain = saltus.sweep(ball, GRID, (0.0, 5.0), as_dict=True)
    equal(swept(tmp_path, ball, executor=executor, chunk=4), plain)
    equal(swept(tmp_path, ball, executor=executor), plain)


def test_an_executor_of_the_user(tmp_path):
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        found = swept(tmp_path, executor=pool, chunk=1)
    equal(found, saltus.sweep(make_ball, GRID, (0.0, 5.0), as_dict=True))


def test_a_chunk_whose_worker_died_is_submitted_again(tmp_path):
    grid = GRID | {"flag": str(tmp_path / "flag")}
    found = swept(tmp_path / "s", deadly, grid, executor="processes", workers=1, chunk=1, retries=1)
    equal(found, saltus.sweep(make_ball, GRID, (0.0, 5.0), as_dict=True))


def test_lost_rows_are_named(tmp_path):
    found = swept(tmp_path, deadly, GRID, executor="processes", workers=1, chunk=1, retries=1)
    assert found["status"][2] == "failed"
    assert "chunk of this run was lost: BrokenProcessPool" in found["message"][2]
    assert not (tmp_path / "chunk-000002.pickle").exists()


def test_a_killed_worker_of_dask(tmp_path):
    distributed = pytest.importorskip("distributed")
    grid = GRID | {"flag": str(tmp_path / "flag")}
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        found = swept(tmp_path / "s", deadly, grid, executor=client, chunk=1, retries=2)
    assert (tmp_path / "flag").exists()
    equal(found, saltus.sweep(make_ball, GRID, (0.0, 5.0), as_dict=True))


@pytest.mark.parametrize("bad", [{"chunk": 0}, {"retries": -1}, {"chunk": 1.5}])
def test_impossible_numbers(tmp_path, bad):
    with pytest.raises(ModelError, match="or more, found"):
        swept(tmp_path, **bad)
    with pytest.raises(ModelError, match="needs a store"):
        saltus.sweep(make_ball, GRID, (0.0, 5.0), chunk=2)


def test_what_is_no_store_is_refused_and_left_alone(tmp_path):
    file, folder = tmp_path / "file", tmp_path / "folder"
    file.write_text("mine")
    folder.mkdir()
    (folder / "notes.txt").write_text("mine")
    for path, words in [
        (5, "expected the path of a directory, found 5"),
        (file, "expected a directory, found the file"),
        (folder, "so it is no store; take an empty directory"),
    ]:
        with pytest.raises(ModelError, match=words):
            swept(path)
    assert file.read_text() == (folder / "notes.txt").read_text() == "mine"
    assert os.listdir(folder) == ["notes.txt"]
