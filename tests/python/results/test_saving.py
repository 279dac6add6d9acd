"""Results in files, and in other processes."""

import copy
import json
import multiprocessing
import pickle
import zipfile
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
import saltus
from systems import Ball, Decay, run


def ball_run(span=(0.0, 6.0), **options):
    ball = Ball(e=0.5)
    return ball, run(ball, span, ball.create_context().with_continuous_state([10.0, 0]), **options)


def same(a, b):
    assert type(a) is type(b)
    assert np.array_equal(a.time, b.time) and np.array_equal(a.jump, b.jump)
    assert a.jump.dtype == b.jump.dtype
    assert list(a.outputs) == list(b.outputs)
    for name in a.outputs:
        assert a.outputs[name].shape == b.outputs[name].shape
        assert a.outputs[name].tobytes() == b.outputs[name].tobytes()
    assert (a.status, a.message, a.block) == (b.status, b.message, b.block)
    assert a.statistics == b.statistics
    assert a.context == b.context
    assert len(a.events) == len(b.events)
    for p, q in zip(a.events, b.events, strict=True):
        assert p[:6] == q[:6] and p.entry == q.entry
        assert np.array_equal(p.predicted, q.predicted, equal_nan=True)
        assert np.array_equal(p.before, q.before) and np.array_equal(p.after, q.after)


@pytest.mark.parametrize("way", ["file", "pickle"])
@pytest.mark.parametrize("scene", ["bouncing-ball-blocks", "van-der-pol", "water-tanks"])
def test_everything_comes_back(way, scene, tmp_path):
    results = saltus.scene(scene).simulate()
    if way == "file":
        results.save(tmp_path / "run.npz")
        again = saltus.load_results(tmp_path / "run.npz")
    else:
        again = pickle.loads(pickle.dumps(results))
    same(results, again)
    assert repr(again) == repr(results)


def test_a_solution_comes_back_as_one(tmp_path):
    solution = saltus.solve(
        lambda t, x: [x[1], -10.0],
        (0.0, 2.0),
        [1.0, 0.0],
        events=[saltus.Guard(lambda t, x: x[0], lambda t, x: [0, -x[1]], "falling", name="floor")],
    )
    solution.save(tmp_path / "a b.dat")  # any name, as it is given
    for again in (saltus.load_results(tmp_path / "a b.dat"), pickle.loads(pickle.dumps(solution))):
        same(solution, again)
        assert np.array_equal(again.t_events[0], solution.t_events[0])
        assert np.array_equal(again.y, solution.y)


def test_what_was_loaded_does_what_results_do(tmp_path):
    pytest.importorskip("pandas"), pytest.importorskip("matplotlib")
    _, results = ball_run()
    results.save(tmp_path / "ball.npz")
    again = saltus.load_results(str(tmp_path / "ball.npz"))
    assert again.to_pandas().equals(results.to_pandas())
    assert np.array_equal(again.events.times("ball.bounce"), results.events.times("bounce"))
    with pytest.raises(saltus.ModelError, match="unknown kind of event 'zero'"):
        again.events.times("bounce", kind="zero")
    again.plot()
    again.save(tmp_path / "twice.npz")
    same(saltus.load_results(tmp_path / "twice.npz"), results)


def test_a_run_goes_on_from_a_loaded_context(tmp_path):
    ball, whole = ball_run()
    _, half = ball_run(span=(0.0, 3.0))
    half.save(tmp_path / "half.npz")
    rest = run(ball, (3.0, 6.0), saltus.load_results(tmp_path / "half.npz").context)
    straight = run(ball, (3.0, 6.0), half.context)
    assert np.array_equal(rest.outputs["state"], straight.outputs["state"])
    assert len(half.events) + len(rest.events) == len(whole.events)


def test_a_failed_run_and_its_error():
    def fail(time, state):
        if time > 0.5:
            raise ArithmeticError("no more")

    results = run(Decay(fail), (0.0, 2.0), throw=False)
    again = pickle.loads(pickle.dumps(results))
    assert again.status == "failed"
    assert isinstance(again.cause, ArithmeticError)
    with pytest.raises(saltus.SimulationError) as caught:
        ball_run(max_major_steps=2)
    copy = pickle.loads(pickle.dumps(caught.value))
    assert copy.results.status == "step_limit"
    same(copy.results, caught.value.results)


def test_dense_output_is_said_to_be_missing(tmp_path):
    _, results = ball_run(dense_output=True)
    results.save(tmp_path / "ball.npz")
    again = saltus.load_results(tmp_path / "ball.npz")
    assert not again.dense
    with pytest.raises(saltus.ModelError, match="keep no dense output"):
        again(1.0)


def test_foreign_and_damaged_files(tmp_path):
    _, results = ball_run()
    path = tmp_path / "ball.npz"
    results.save(path)
    good = path.read_bytes()
    np.savez(tmp_path / "foreign.npz", a=np.zeros(3))
    (tmp_path / "text.npz").write_text("time,y\n0,1\n")
    (tmp_path / "empty.npz").write_bytes(b"")
    (tmp_path / "short.npz").write_bytes(good[: len(good) // 2])
    (tmp_path / "pickled.npz").write_bytes(pickle.dumps({"time": 1}))
    np.save(tmp_path / "array.npz", np.zeros(3))
    for file in sorted(tmp_path.glob("*.npz")):
        if file == path:
            continue
        with pytest.raises(saltus.ModelError, match=r"expected a file of Results\.save"):
            saltus.load_results(file)
    with pytest.raises(FileNotFoundError):
        saltus.load_results(tmp_path / "none.npz")


def test_every_flipped_byte_is_noticed_or_harmless(tmp_path):
    """The parts of a zip carry checksums; what is not under one changes nothing we read."""
    _, results = ball_run(span=(0.0, 2.0))
    path = tmp_path / "ball.npz"
    results.save(path)
    good = path.read_bytes()
    random = np.random.default_rng(1)
    for at in random.integers(0, len(good), 120):
        path.write_bytes(good[:at] + bytes([good[at] ^ 0x10]) + good[at + 1 :])
        try:
            again = saltus.load_results(path)
        except saltus.ModelError:
            continue
        same(again, results)


def test_columns_of_other_lengths_are_refused(tmp_path):
    _, results = ball_run()
    path, cut = tmp_path / "ball.npz", tmp_path / "cut.npz"
    results.save(path)
    with np.load(path) as file:
        arrays = {name: file[name] for name in file.files}
    np.savez(cut, **(arrays | {"jump": arrays["jump"][:-1]}))
    with pytest.raises(saltus.ModelError, match="'jump' has"):
        saltus.load_results(cut)
    assert zipfile.is_zipfile(path)


@pytest.mark.parametrize(
    "suffix", [".csv", ".CSV", ".txt", ".json", ".parquet", ".nc", ".pkl", ".npy"]
)
def test_a_suffix_of_another_format_is_refused_and_nothing_is_written(suffix, tmp_path):
    path = tmp_path / f"run{suffix}"
    with pytest.raises(saltus.ModelError, match=r"expected a name that ends in '\.npz'"):
        saltus.solve(lambda t, x: -x, (0, 1), [1.0]).save(path)
    assert not path.exists()


@pytest.mark.parametrize("name", ["run", "run.npz", "run_0.5", "run.saved"])
def test_any_other_name_is_taken_as_it_is(name, tmp_path):
    solution = saltus.solve(lambda t, x: -x, (0, 1), [1.0])
    solution.save(tmp_path / name)
    same(saltus.load_results(tmp_path / name), solution)


def blow_up(t, x):
    return x**2


@pytest.mark.parametrize("copied", [lambda e: pickle.loads(pickle.dumps(e)), copy.deepcopy])
def test_an_error_that_is_the_cause_in_its_own_results(copied):
    with pytest.raises(saltus.SimulationError) as caught:
        saltus.solve(blow_up, (0, 2), [1.0])
    error = caught.value
    assert error.results.cause is error
    again = copied(error)
    assert (str(again), again.time, again.block) == (str(error), error.time, error.block)
    assert again.results.cause is again  # one error, as before
    same(again.results, error.results)
    results = copied(error.results)
    assert results.cause.results is results
    assert results.message == error.results.message


def test_a_process_pool_hands_an_error_over():
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        with pytest.raises(saltus.SimulationError) as caught:
            pool.submit(saltus.solve, blow_up, (0, 2), [1.0]).result()
    assert caught.value.results.status == "failed"
    assert caught.value.results.cause is caught.value


def forged(path, tmp_path, change):
    with np.load(path) as parts:
        arrays = {name: parts[name] for name in parts.files}
    header = json.loads(arrays["header"].tobytes())
    change(header)
    arrays["header"] = np.frombuffer(json.dumps(header).encode(), dtype=np.uint8)
    np.savez(tmp_path / "forged.npz", **arrays)
    with pytest.raises(saltus.ModelError, match=r"expected a file of Results\.save"):
        saltus.load_results(tmp_path / "forged.npz")


@pytest.mark.parametrize("value", [2147483647, 5, 1, -1, 2**62, -(2**62), 2**63, 1e300, "0", None])
@pytest.mark.parametrize("entry", [1, 2, 3, 4, 5, 6])
def test_no_offset_or_size_of_a_file_is_used_unchecked(entry, value, tmp_path):
    _, results = ball_run()
    results.save(tmp_path / "ball.npz")
    if results.context.__getstate__()[0][0][0][entry] == value:
        return

    def change(header):
        header["context"]["layout"][0][0][entry] = value

    forged(tmp_path / "ball.npz", tmp_path, change)


@pytest.mark.parametrize(
    "change",
    [
        lambda h: h["context"]["layout"][0][0][7][0].__setitem__(1, 9),  # place of a parameter
        lambda h: h["context"]["layout"][0][0][7][0].__setitem__(2, -1),  # size of a parameter
        lambda h: h["context"]["layout"][1][0].__setitem__(2, 5),  # first block of a system
        lambda h: h["context"]["layout"][1][0].__setitem__(3, 2**40),  # last block of a system
        lambda h: h["context"]["layout"][0].append(h["context"]["layout"][0][0]),
        lambda h: h["context"]["values"]["blocks"].clear(),
        lambda h: h["context"]["values"]["continuation"].__setitem__("counts", [-1]),
        lambda h: h["context"]["values"]["continuation"]["guards"][0].__setitem__(0, 5),
        lambda h: h.__setitem__("status", "fine"),
        lambda h: h.__setitem__("message", 1),
        lambda h: h.__setitem__("outputs", {"state": 0}),
        lambda h: h["outputs"].append("state"),
        lambda h: h["events"][0].__setitem__(6, -1),
        lambda h: h["events"][0].__setitem__(6, 2**70),
        lambda h: h["events"][0].__setitem__(1, "bang"),
        lambda h: h["events"][0].__setitem__(2, 40),
        lambda h: h["events"].pop(),
        lambda h: h["statistics"].pop("steps"),
        lambda h: h["statistics"].__setitem__("steps", "many"),
        lambda h: h["statistics"].__setitem__("stretches", [1]),
        lambda h: h.__setitem__("kind", "Solution"),
        lambda h: h.__setitem__("kind", ["Results"]),
    ],
)
def test_a_forged_field_of_a_file_is_refused(change, tmp_path):
    _, results = ball_run()
    results.save(tmp_path / "ball.npz")
    forged(tmp_path / "ball.npz", tmp_path, change)


@pytest.mark.parametrize("kind", [zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_a_damaged_stream_of_any_compression_is_refused(kind, tmp_path):
    path = tmp_path / "run.npz"
    saltus.solve(lambda t, x: -x, (0, 1), [1.0]).save(path)
    with zipfile.ZipFile(path) as parts:
        contents = {name: parts.read(name) for name in parts.namelist()}
    with zipfile.ZipFile(path, "w", kind) as parts:
        for name, content in contents.items():
            parts.writestr(name, content)
    assert saltus.load_results(path).status == "reached_end"  # it is sound before
    damaged = bytearray(path.read_bytes())
    begin = 30 + len(next(iter(contents))) + 8  # of the first stream, after its header
    damaged[begin : begin + 12] = bytes(range(200, 212))
    path.write_bytes(damaged)
    with pytest.raises(saltus.ModelError, match=r"expected a file of Results\.save"):
        saltus.load_results(path)
