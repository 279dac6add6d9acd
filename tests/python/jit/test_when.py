"""When tapes become machine code, and that nothing else changes."""

import dataclasses
import gc
import weakref

import numpy as np
import pytest
import saltus
from saltus.jit import disk, library

pytest.importorskip("llvmlite")

compiler = pytest.importorskip("saltus.jit.compiler")


class Oscillator(saltus.LeafSystem):
    """x'' = -k x - x^3, with a located zero of x; `k` makes another tape of each."""

    def __init__(self, k):
        super().__init__(name="oscillator")
        self.k = k
        self.declare_continuous_state([1.0, 0.0], ode=self.ode)
        self.declare_continuous_state_output("x")
        self.declare_dynamic_parameter("drag", 0.01)
        self.declare_zero_crossing(guard=self.middle, reset_map=self.push, name="middle")

    def ode(self, time, state, *, drag):
        x, v = state.continuous_state
        return np.array([v, -self.k * x - x * x * x - drag * v])

    def middle(self, time, state, *, drag):
        return state.continuous_state[0]

    def push(self, time, state, *, drag):
        return state.with_continuous_state(state.continuous_state * 0.99)


def runs_as(simulator):
    line = simulator.describe().splitlines()[-1]
    assert line.startswith("tapes: "), line
    return line.split(", ", 1)[1]


def facts(results):
    """All of a run, except how long it took."""
    statistics = dataclasses.replace(results.statistics, wall_time=0.0)
    return results.time.tobytes(), results.outputs["x"].tobytes(), statistics, str(results.events)


def run(k, end=20.0, **options):
    system = Oscillator(k)
    simulator = saltus.Simulator(system, recorded_signals={"x": system.output("x")}, **options)
    simulator.initialize(system.create_context())
    simulator.advance_to(end)
    return simulator


@pytest.mark.parametrize("method", ["dopri5", "dop853", "adams", "bdf", "radau", "taylor", "auto"])
def test_always_and_never_are_the_same_run(method):
    always = run(1.0, machine_code="always", ode_solver_method=method)
    never = run(1.0, machine_code="never", ode_solver_method=method)
    assert runs_as(always) == "run as machine code"
    assert facts(always.results) == facts(never.results)


def test_never_stays_interpreted():
    assert runs_as(run(1.1, machine_code="never")) == "interpreted"


def test_a_short_run_stays_interpreted():
    assert runs_as(run(1.2)) == "interpreted"


def test_explain_says_what_became_machine_code():
    simulator = run(1.3, machine_code="always")
    explanation = simulator.system.explain()
    assert [callback.machine_code for callback in explanation] == [True, True, True]
    assert str(explanation).splitlines()[0] == (
        "oscillator: ode                    traced, machine code"
    )
    assert not any(callback.machine_code for callback in Oscillator(1.4).explain())


def test_it_becomes_machine_code_when_enough_was_interpreted():
    """After 5 ms and 60 us an instruction, at 1 ns for each that was interpreted: the tapes have
    fewer than 50, so less than 8 million are enough, at 6 or more in a call of the derivative.
    """
    run(1.0, machine_code="always")  # the compiler is loaded
    system = Oscillator(1.5)
    simulator = saltus.Simulator(system, recorded_signals={"x": system.output("x")}, rtol=1e-10)
    calls, before = 0, None
    while runs_as(simulator) == "interpreted":
        simulator.initialize(system.create_context())
        simulator.advance_to(2000.0)
        now = facts(simulator.results)
        assert before is None or now == before
        before = now
        calls += simulator.results.statistics.right_hand_side_calls
        assert calls < 8e6 / 6 + 1e6  # and the run in which it happened
    assert runs_as(simulator) == "run as machine code"
    simulator.initialize(system.create_context())
    simulator.advance_to(2000.0)
    assert facts(simulator.results) == before
    again = run(1.5)  # an equal system of its own has not shown that it pays
    assert runs_as(again) == "interpreted"


@pytest.mark.parametrize("method", ["auto", "taylor"])
@pytest.mark.parametrize("threads", [1, 2])
def test_sweeps(threads, method):
    def sweep(when):
        done = saltus.sweep(
            Oscillator(1.0),
            {"drag": np.linspace(0.0, 0.1, 50)},
            (0.0, 10.0),
            executor="threads" if threads > 1 else "serial",
            machine_code=when,
            ode_solver_method=method,
            as_dict=True,
        )
        del done["wall_time"], done["attrs"]
        return {key: np.asarray(column).tolist() for key, column in done.items()}

    assert sweep("always") == sweep("never")


def test_library_blocks_in_a_diagram_are_compiled_too():
    scene = saltus.scene("bouncing-ball-blocks")
    ends = []
    for when in ("always", "never"):
        simulator = saltus.Simulator(scene.system, scene.options, machine_code=when)
        simulator.initialize(scene.context)
        simulator.advance_to(3.0)
        ends.append(simulator.context.continuous_state.tobytes())
        assert runs_as(simulator) == ("run as machine code" if when == "always" else "interpreted")
    assert ends[0] == ends[1]


def test_a_changed_attribute_gets_machine_code_of_its_own():
    simulator = run(2.0, end=1.0, machine_code="always")
    simulator.system.k = 3.0
    simulator.advance_to(2.0)
    expected = run(2.0, end=1.0, machine_code="never")
    expected.system.k = 3.0
    expected.advance_to(2.0)
    assert facts(simulator.results) == facts(expected.results)
    assert runs_as(simulator) == "run as machine code"


def test_an_unknown_word():
    with pytest.raises(
        saltus.ModelError, match=r"option machine_code: unknown 'alway'; did you mean 'always'"
    ):
        run(1.0, machine_code="alway")


def test_always_without_llvmlite(monkeypatch):
    monkeypatch.setattr(library, "is_installed", lambda: False)
    with pytest.raises(saltus.ModelError) as raised:
        run(1.0, machine_code="always")
    assert str(raised.value) == (
        "option machine_code='always' needs llvmlite, which is not installed: "
        'pip install "saltus[jit]"'
    )


def test_a_compiler_that_fails_is_an_error_only_where_it_is_required(monkeypatch):
    def broken(module):
        raise RuntimeError("no such processor")

    monkeypatch.setattr(compiler, "compiled", broken)
    with pytest.raises(RuntimeError, match="no such processor"):
        run(1.61, machine_code="always")
    system = Oscillator(1.62)
    simulator = saltus.Simulator(system, rtol=1e-10)
    for _ in range(12):
        simulator.initialize(system.create_context())
        assert simulator.advance_to(2000.0) == "reached_end"
    assert runs_as(simulator) == "interpreted"


def test_what_is_required_is_an_error_each_time(monkeypatch):
    """Also where a plan is kept: it does not run without machine code afterwards."""
    system, failing = Oscillator(1.63), True
    compiled = compiler.compiled

    def broken(module):
        if failing:
            raise RuntimeError("no such processor")
        return compiled(module)

    monkeypatch.setattr(compiler, "compiled", broken)
    for _ in range(3):
        with pytest.raises(RuntimeError, match="no such processor"):
            saltus.simulate(system, (0.0, 1.0), machine_code="always")
    failing = False
    saltus.simulate(system, (0.0, 1.0), machine_code="always")
    assert system.explain()[0].machine_code


def test_short_runs_of_changed_systems_are_not_compiled_each():
    """What one long run has interpreted is paid for by one compilation."""
    system = Oscillator(1.64)
    for _ in range(12):
        saltus.simulate(system, (0.0, 2000.0), rtol=1e-10)
    before = len(library._libraries)
    for k in range(20):
        system.k = 1.0 + 0.01 * k
        saltus.simulate(system, (0.0, 0.1))
    assert len(library._libraries) <= before + 1


def test_equal_systems_share_a_library():
    a, b = run(1.7, machine_code="always"), run(1.7, machine_code="always")
    before = len(library._libraries)
    c = run(1.7, machine_code="always")
    assert len(library._libraries) == before
    assert runs_as(a) == runs_as(b) == runs_as(c) == "run as machine code"


def test_code_is_released_with_its_last_user(monkeypatch):
    monkeypatch.setattr(library, "KEPT", 0)
    made = []
    linked = compiler.linked

    def noted(*arguments):
        made.append(weakref.ref(result := linked(*arguments)))
        return result

    monkeypatch.setattr(compiler, "linked", noted)
    simulator = run(1.8, machine_code="always")
    assert made and all(reference() is not None for reference in made)
    del simulator
    gc.collect()
    assert all(reference() is None for reference in made)


class TestDisk:
    @pytest.fixture(autouse=True)
    def directory(self, tmp_path, monkeypatch):
        monkeypatch.setattr(library, "_libraries", type(library._libraries)())
        saltus.jit.cache_directory(tmp_path / "code")
        yield
        saltus.jit.cache_directory(None)

    def files(self, tmp_path):
        return sorted((tmp_path / "code").iterdir())

    def test_the_next_process_does_not_compile(self, tmp_path, monkeypatch):
        expected = facts(run(1.9, machine_code="always").results)
        assert len(self.files(tmp_path)) == 1
        library._libraries.clear()  # as in another process
        monkeypatch.delattr(compiler, "compiled")
        again = run(1.9, machine_code="always")
        assert runs_as(again) == "run as machine code"
        assert facts(again.results) == expected

    @pytest.mark.parametrize("damage", ["cut", "changed", "empty"])
    def test_a_damaged_file_is_written_anew(self, tmp_path, damage):
        expected = facts(run(1.9, machine_code="always").results)
        (file,) = self.files(tmp_path)
        whole = file.read_bytes()
        middle = len(whole) // 2
        flipped = whole[:middle] + bytes([whole[middle] ^ 1]) + whole[middle + 1 :]
        file.write_bytes({"cut": whole[:-10], "changed": flipped, "empty": b""}[damage])
        library._libraries.clear()
        assert facts(run(1.9, machine_code="always").results) == expected
        assert file.read_bytes() == whole

    def test_a_directory_that_cannot_be_written_keeps_nothing(self, tmp_path):
        (tmp_path / "file").write_text("")
        saltus.jit.cache_directory(tmp_path / "file" / "code")
        assert runs_as(run(1.95, machine_code="always")) == "run as machine code"

    def test_the_environment_names_the_directory(self, monkeypatch):
        import importlib

        monkeypatch.setenv(disk.VARIABLE, "/somewhere")
        try:
            assert str(importlib.reload(disk)._directory) == "/somewhere"
        finally:
            monkeypatch.undo()
            importlib.reload(disk)
