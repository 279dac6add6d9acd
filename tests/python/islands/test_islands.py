"""Islands that step apart, from Python: rows, errors, pieces, pictures, files."""

import pickle
import threading

import numpy as np
import pytest
import saltus
from parts import Ball
from saltus.library import Adder, Constant, Integrator


def scene(*names):
    heights = {"one": 1.0, "two": 2.0, "three": 1.5}
    builder = saltus.DiagramBuilder()
    for name in names:
        ball = builder.add(Ball(name, heights[name]))
        builder.export_output(ball.output("state"), name)
    return builder.build()


def run(*names, until=2.0, islands=True, **options):
    return saltus.simulate(scene(*names), (0.0, until), islands=islands, **options)


def test_each_island_has_the_bits_of_its_part_alone():
    results = run("one", "two")
    assert [island.name for island in results.islands] == ["one", "two"]
    for name in ("one", "two"):
        alone = run(name)
        assert alone.islands == ()
        assert np.array_equal(results.outputs[name], alone.outputs[name])
        assert np.array_equal(results.time_of(name), alone.time)
        assert np.array_equal(results.jump_of(name), alone.jump)
        assert np.array_equal(
            results.events.times(f"{name}.bounce"), alone.events.times(f"{name}.bounce")
        )


def test_the_event_log_is_one():
    results = run("one", "two", "three")
    times = [event.time for event in results.events]
    assert times == sorted(times)
    assert [event.jump for event in results.events] == list(range(1, len(times) + 1))
    assert results.statistics.events == sum(i.statistics.events for i in results.islands)


@pytest.mark.parametrize("asked", ["time", "jump"])
def test_a_common_time_is_refused_with_the_remedy(asked):
    results = run("one", "two")
    with pytest.raises(saltus.ModelError, match=r"results.time_of\('one'\).*save_at.*event_rows"):
        getattr(results, asked)


def test_tables_are_refused_with_the_remedy(tmp_path):
    results = run("one", "two")
    with pytest.raises(saltus.ModelError, match="save_at"):
        results.to_csv(tmp_path / "rows.csv")
    with pytest.raises(saltus.ModelError, match="save_at"):
        results.save(tmp_path / "run.npz")


def test_a_signal_without_rows_is_named():
    with pytest.raises(saltus.ModelError, match=r"nothing was recorded under 'on'.*one"):
        run("one", "two").time_of("on")


def test_with_save_at_there_is_one_table(tmp_path):
    at = np.linspace(0.0, 2.0, 9)
    results = run("one", "two", save_at=at, event_rows=False)
    assert np.array_equal(results.time, at)
    assert results.outputs["two"].shape == (9, 2)
    assert np.array_equal(results.time_of("two"), at)
    results.to_csv(tmp_path / "rows.csv")
    results.save(tmp_path / "run.npz")
    loaded = saltus.load_results(tmp_path / "run.npz")
    assert np.array_equal(loaded.outputs["one"], results.outputs["one"])
    assert saltus.simulate(scene("one", "two"), loaded.context, (2.0, 2.5), islands=True)


def test_results_are_pickled_and_shown():
    results = run("one", "two")
    again = pickle.loads(pickle.dumps(results))
    assert np.array_equal(again.time_of("two"), results.time_of("two"))
    assert "2 that stepped apart" in repr(results)
    assert "rows" in results._repr_html_()


def test_a_picture_has_the_rows_of_each_island():
    axes = run("one", "two").plot("one", "two")
    assert len(axes) == 2


def test_a_run_in_pieces_and_its_context():
    simulator = saltus.Simulator(scene("one", "two"), islands=True)
    simulator.initialize(simulator.system.create_context())
    for t in (0.5, 1.0, 2.0):
        assert simulator.advance_to(t) == "reached_end"
        assert simulator.results.context.time == t
    whole = run("one", "two")
    pieces = simulator.results
    assert [e.name for e in pieces.events] == [e.name for e in whole.events]
    # parabolas: both methods are exact but for rounding
    np.testing.assert_allclose(
        [e.time for e in pieces.events], [e.time for e in whole.events], rtol=1e-12
    )


def test_a_context_keeps_to_the_option():
    end = run("one", "two").context
    with pytest.raises(saltus.ModelError, match="whose islands stepped apart"):
        saltus.simulate(scene("one", "two"), end, (2.0, 3.0))
    saltus.simulate(scene("one", "two"), end.with_time(2.0), (2.0, 3.0))  # the remedy


def test_describe_says_what_joins():
    builder = saltus.DiagramBuilder()
    pull = builder.add(Constant(1.0, name="pull"))
    total = builder.add(Adder(2, operators="++", name="total"))
    for i in range(2):
        x = builder.add(Integrator(0.0, name=f"x{i}"))
        builder.connect(pull.output(), x.input())
        builder.connect(x.output(), total.input(i))
    builder.export_output(total.output(), "total")
    system = builder.build()
    joined = saltus.Simulator(system, islands=True, recorded_signals=["total"]).describe()
    assert "islands: 1, because of 'total." in joined
    apart = saltus.Simulator(system, islands=True, recorded_signals={}).describe()
    assert "islands: 2, which step apart" in apart


@pytest.mark.parametrize("side", ["left", "right"])
def test_dense_output_is_that_of_each_part_alone(side):
    """Also at the events of either island, where the other one has no step."""
    results = run("one", "two", dense_output=True)
    alone = {name: run(name, dense_output=True) for name in ("one", "two")}
    times = [0.0, *results.events.times(), 0.123, 1.234, 2.0]
    both = results(times, side=side)
    for i, (name, part) in enumerate(alone.items()):
        own = part(times, side=side)
        assert np.array_equal(both[name], own[name])
        states = both.continuous_state[:, 2 * i : 2 * i + 2]
        assert np.array_equal(states, own.continuous_state)
    assert results.span == (0.0, 2.0)
    with pytest.raises(saltus.ModelError, match="outside the run"):
        results(2.5)


def test_dense_output_of_pieces():
    system = scene("one", "two")
    simulator = saltus.Simulator(system, islands=True, dense_output=True)
    simulator.initialize(system.create_context())
    for end in (0.7, 1.5):
        simulator.advance_to(end)
        assert simulator.results.span == (0.0, end)
    assert np.isfinite(simulator.results([0.3, 1.1])["two"]).all()


@pytest.mark.parametrize("at", [[], [0.25, 1.0]])
@pytest.mark.parametrize("workers", [1, 2])
def test_a_sweep_has_the_runs_that_one_would_make_alone(at, workers):
    system, heights = scene("one", "two"), [1.0, 1.5, 4.0]
    found = saltus.sweep(
        system,
        {"one.x[0]": heights},
        (0.0, 1.0),
        save_at=at,
        workers=workers,
        islands=True,
        recorded_signals=["one", "two"],
    )
    for i, height in enumerate(heights):
        context = system.create_context()
        one = system["one"]
        start = context[one].with_continuous_state([height, 0.0])
        rows = {"save_at": at, "event_rows": False} if at else {}
        alone = saltus.simulate(
            system, context.with_subcontext(one, start), (0.0, 1.0), islands=True, **rows
        )
        for name in ("one", "two"):
            expected = alone[name] if at else alone[name][-1]
            assert np.array_equal(np.asarray(found[name][i]), expected)
        assert found["events"][i] == alone.statistics.events


def test_an_exception_of_one_island_ends_all():
    class Breaks(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="breaks")
            self.declare_continuous_state([1.0], ode=self.flow)

        def flow(self, t, state):
            if t > 0.5:
                raise RuntimeError("a fuse blew")
            return -state.continuous_state

    builder = saltus.DiagramBuilder()
    builder.add(Ball("one", 1.0))
    builder.add(Breaks())
    system = builder.build()
    with pytest.raises(RuntimeError, match="a fuse blew"):
        saltus.simulate(system, (0.0, 2.0), islands=True, python="called")
    results = saltus.simulate(system, (0.0, 2.0), islands=True, python="called", throw=False)
    assert results.status == "failed"
    assert results.context.time <= 0.5


def test_progress_and_machine_code():
    seen = []
    options = {"progress": seen.append, "machine_code": "never"}
    assert run("one", "two", "three", **options).status == "reached_end"
    assert seen


def test_threads_change_no_bit():
    names = ("one", "two", "three")
    alone, threads = run(*names), run(*names, island_threads=2)
    assert np.array_equal(alone.events.times(), threads.events.times())
    for name in names:
        assert np.array_equal(alone[name], threads[name])
        assert np.array_equal(alone.time_of(name), threads.time_of(name))
    assert alone.context == threads.context


def test_called_callbacks_run_on_one_thread():
    callers = set()

    def rate(t, state):
        callers.add(threading.get_ident())
        return [-1.0]

    builder = saltus.DiagramBuilder()
    for name in ("a", "b", "c"):
        block = saltus.LeafSystem(name=name)
        block.declare_continuous_state([1.0], ode=rate)
        builder.add(block)
    results = saltus.simulate(builder.build(), (0.0, 1.0), islands=True, island_threads=3)
    assert len(results.islands) == 3
    assert callers == {threading.get_ident()}


def test_threads_need_islands():
    with pytest.raises(saltus.ModelError, match="island_threads: expected 1, because islands is"):
        run("one", "two", islands=False, island_threads=2)


def test_progress_on_threads_is_that_of_the_caller():
    seen = []
    results = run("one", "two", "three", island_threads=2, progress=lambda p: seen.append(p.time))
    assert results.status == "reached_end"
    assert seen[-1] == 2.0
