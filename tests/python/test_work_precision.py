"""The work-precision report from Python: of the shelf, and of systems in Python."""

import csv
import json
import math
import signal
import subprocess
import sys

import numpy as np
import pytest
import saltus

QUICK = {"least_time": 0.0, "most_repeats": 1}


class Oscillator(saltus.LeafSystem):
    """x'' = -x from (1, 0): x = cos t; `wall` is met where x falls through 0."""

    def __init__(self, ode=None):
        super().__init__(name="oscillator")
        self.declare_continuous_state(default_value=np.array([1.0, 0.0]), ode=ode or self.flow)
        self.declare_continuous_state_output(name="x")
        self.declare_zero_crossing(
            guard=lambda time, state: state.continuous_state[0],
            name="zero",
            direction="positive_then_non_positive",
        )

    def flow(self, time, state):
        x, v = state.continuous_state
        return np.array([v, -x])


def swing(t):
    return [math.cos(t), -math.sin(t)]


def energy(t, row):
    return 0.5 * (row[0] ** 2 + row[1] ** 2)


def report(**given):
    system = given.pop("system", None) or Oscillator()
    given = {"methods": ["dopri5", "dop853"], "rtols": (1e-5, 1e-8), **QUICK, **given}
    return saltus.work_precision(system, system.create_context(), (0.0, 10.0), **given)


def test_against_an_exact_answer():
    table = report(exact=swing, invariants={"energy": energy}, gap=lambda t, row: row[0] + 0.5)
    assert len(table) == 4
    assert table.reference["kind"] == "exact"
    for row in table:
        # ten times the local tolerance, times the growth: a wrong frequency adds up over 10 s
        allowed = 10 * (row["rtol"] + row["atol"]) * 10
        assert row["status"] == "reached_end"
        assert row["error"] < allowed
        assert row["event_mismatch"] == 0
        assert row["invariant_drift"] < 2 * allowed
        assert row["drift of energy"] == row["invariant_drift"]
        # rows are at steps too: the lowest of them lies within a step of x = -1
        assert 0.3 < row["penetration"] <= 0.5 + allowed
    assert table[1]["error"] < table[0]["error"]


def test_event_times_come_from_runs_where_they_are_not_given():
    given = report(exact=swing, event_times={"zero": [math.pi / 2, math.pi * 2.5]})
    found = report(exact=swing)
    assert found.reference["event_bound"] < 1e-8
    for a, b in zip(given, found, strict=True):
        assert a["event_mismatch"] == b["event_mismatch"] == 0
        assert abs(a["event_error"] - b["event_error"]) <= found.reference["event_bound"]


def test_a_wrong_number_of_events_is_shown():
    table = report(exact=swing, event_times={"zero": [math.pi / 2]})
    assert [row["event_mismatch"] for row in table] == [1, 1, 1, 1]


def test_against_runs_where_nothing_is_known():
    known, unknown = report(exact=swing), report()
    assert unknown.reference["kind"] == "run"
    assert "rtol 1e-10" in unknown.reference["provenance"]
    assert unknown.reference["bound"] < 1e-7
    for row, truth in zip(unknown, known, strict=True):
        assert row["against"] != row["method"]
        assert abs(row["error"] - truth["error"]) <= unknown.reference["bound"]


def test_against_rows_given():
    times = np.linspace(1, 10, 10)
    table = report(reference=(times, [swing(t) for t in times]), provenance="cosine table")
    assert table.reference["kind"] == "stored"
    assert "cosine table" in table.reference["provenance"]
    assert all(row["error"] < 1e-2 for row in table)
    system = Oscillator()
    signals = {"x": system.output_ports[0]}
    better = saltus.simulate(
        system, system.create_context(), (0.0, 10.0), recorded_signals=signals,
        save_at=times, rtol=1e-12, atol=1e-14,
    )  # fmt: skip
    again = report(reference=better)
    for a, b in zip(table, again, strict=True):
        assert abs(a["error"] - b["error"]) < 1e-10
        assert b["event_mismatch"] == 0


def test_a_run_that_fails_is_a_row_with_its_reason():
    def breaks(time, state):
        if time > 5:
            raise ValueError("the spring broke")
        return np.array([0.0, 0.0])

    table = report(system=Oscillator(breaks), exact=swing, methods=["dopri5"], rtols=[1e-5])
    (row,) = table
    assert row["status"] == "failed"
    assert "the spring broke" in row["message"]
    assert math.isnan(row["seconds"])
    assert "the spring broke" in repr(table)
    assert "the spring broke" in table._repr_html_()
    refused = report(exact=swing, rtols=[1e-16], event_times={})
    assert "rtol" in refused[0]["message"]


def test_bad_input_is_refused():
    scene = saltus.scene("bouncing-ball")
    for wrong, says in (
        (lambda: report(methods=["euler"]), "euler"),
        (lambda: report(exact=swing, reference=([1.0], [[1.0, 0.0]])), "one of them"),
        (lambda: report(exact=lambda t: [1.0]), "expected 2 numbers"),
        (lambda: saltus.work_precision(scene, exact=swing), "brings"),
        (lambda: saltus.work_precision(7, None, (0.0, 1.0)), "expected a system"),
        (lambda: saltus.work_precision(Oscillator(), None, (0.0, 1.0)), "context"),
        (
            lambda: saltus.work_precision(Oscillator(), Oscillator().create_context(), 3.0),
            "span",
        ),
        (lambda: report(rtoll=1e-3), "rtoll"),
    ):
        with pytest.raises(saltus.ModelError, match=says):
            wrong()


def test_what_a_function_of_the_known_answer_raises_comes_out():
    def broken(t, row):
        raise KeyError("no such thing")

    with pytest.raises(KeyError, match="no such thing"):
        report(invariants={"broken": broken})


def test_a_scene_of_the_shelf():
    scene = saltus.scene("bouncing-ball")
    table = saltus.work_precision(scene, methods=["dopri5", "bdf"], rtols=[1e-6], **QUICK)
    assert table.scene == "bouncing-ball"
    assert table.title == scene.title
    assert table.cold == "system, plan and first run"
    assert all(row["cold_seconds"] > 0 for row in table)
    assert table.methods == ["dopri5", "bdf"]
    assert table[0]["event_error"] < table[1]["event_error"]
    assert [row["event_mismatch"] for row in table] == [0, 0]


@pytest.fixture(scope="module")
def table():
    return report(exact=swing, rtols=(1e-4, 1e-16, 1e-8), invariants={"energy": energy})


def same(a, b):
    return a == b or (a != a and b != b)


def test_json_gives_the_same_table_back(table, tmp_path):
    table.to_json(tmp_path / "swing.json")
    again = saltus.WorkPrecision.from_json(tmp_path / "swing.json")
    assert len(again) == len(table)
    for a, b in zip(table, again, strict=True):
        assert a.keys() == b.keys()
        assert all(same(a[key], b[key]) for key in a)
    assert repr(again) == repr(table)
    with pytest.raises(saltus.ModelError, match="format"):
        saltus.WorkPrecision.from_json('{"format": "other"}')
    with pytest.raises(saltus.ModelError, match="JSON"):
        saltus.WorkPrecision.from_json("{")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda data: data.pop("scene"), "expected 'scene', a text; found none"),
        (lambda data: data.update(growth="x"), "'growth': expected a number, found 'x'"),
        (lambda data: data["rows"].append(7), "row 6: expected an object, found 7"),
        (lambda data: data["rows"][1].pop("rtol"), "row 1: expected 'rtol', a number; found none"),
        (lambda data: data["rows"][0].update(steps=10**400), "row 0: 'steps': expected a number"),
        (lambda data: data["orders"].update(dopri5=[]), "orders: 'dopri5': expected a number"),
        (lambda data: data["reference"].pop("kind"), "reference: expected 'kind'"),
    ],
)
def test_a_report_with_a_wrong_field_is_refused_by_its_name(table, tmp_path, change, message):
    table.to_json(tmp_path / "swing.json")
    data = json.loads((tmp_path / "swing.json").read_text())
    change(data)
    with pytest.raises(saltus.ModelError, match=f"a report in JSON: {message}"):
        saltus.WorkPrecision.from_json(json.dumps(data))


def test_a_report_that_is_no_text_is_refused(tmp_path):
    (tmp_path / "bytes.json").write_bytes(b'{"format": "\xff"}')
    with pytest.raises(saltus.ModelError, match=r"a report in JSON: .*utf-8"):
        saltus.WorkPrecision.from_json(tmp_path / "bytes.json")
    with pytest.raises(saltus.ModelError, match="a report in JSON"):
        saltus.WorkPrecision.from_json('{"format": ' + "[" * 100_000)


def test_csv_gives_the_same_numbers_back(table, tmp_path):
    table.to_csv(tmp_path / "swing.csv")
    text = (tmp_path / "swing.csv").read_text()
    assert text.startswith("# scene: oscillator\n")
    assert '# sundials: "' in text
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    again = list(csv.DictReader(lines))
    assert len(again) == len(table)
    for found, row in zip(again, table, strict=True):
        assert found.keys() == row.keys()
        for key, value in row.items():
            if isinstance(value, str):
                assert found[key] == value
            else:
                assert same(float(found[key] or "nan"), value)


def test_pandas_reads_it(table, tmp_path):
    pandas = pytest.importorskip("pandas")
    table.to_csv(tmp_path / "swing.csv")
    read, made = pandas.read_csv(tmp_path / "swing.csv", comment="#"), table.to_pandas()
    assert list(read.columns) == list(made.columns)
    assert list(read["steps"]) == list(made["steps"])


def test_a_chart_shows_all_methods_and_failures(table, tmp_path):
    pytest.importorskip("matplotlib")
    figure = table.plot(tmp_path / "swing.svg")
    svg = (tmp_path / "swing.svg").read_text()
    assert svg.startswith("<?xml")
    assert len(figure.axes) == 2  # states, and event times
    words = [text.get_text() for text in figure.findobj(lambda artist: hasattr(artist, "get_text"))]
    for expected in ("dopri5", "dop853", "rtol 1e-04", "failed", "the function swing", "SUNDIALS"):
        assert any(expected in word for word in words), expected
    table.plot(tmp_path / "again.svg")
    assert (tmp_path / "again.svg").read_text() == svg


def test_charts_of_files(table, tmp_path):
    pytest.importorskip("matplotlib")
    table.to_json(tmp_path / "swing.json")
    command = [sys.executable, "-W", "error", "-m", "saltus.report"]
    files = [tmp_path / "swing.json", "--out", tmp_path / "charts", "--format", "png"]
    subprocess.run([*command, *files], check=True, timeout=60)
    assert (tmp_path / "charts" / "swing.png").read_bytes().startswith(b"\x89PNG")
    (tmp_path / "other.json").write_text(json.dumps({}))
    done = subprocess.run([*command, tmp_path / "other.json"], capture_output=True, text=True)
    assert done.returncode == 2
    assert "expected format" in done.stderr


def test_ctrl_c_ends_a_report():
    def pressed(time, state):
        if time > 1:
            signal.raise_signal(signal.SIGINT)
        return np.array([0.0, 0.0])

    with pytest.raises(KeyboardInterrupt):
        report(system=Oscillator(pressed))


def calls_while_measured(python):
    """How often the interpreter enters the ode of a decay, and the row of its one run."""

    def ode(time, state):
        return -state.continuous_state

    decay = saltus.LeafSystem(name="decay")
    decay.declare_continuous_state(np.array([1.0]), ode=ode)
    decay.declare_continuous_state_output(name="x")
    calls = 0

    def count(frame, event, argument):
        nonlocal calls
        calls += event == "call" and frame.f_code is ode.__code__

    sys.setprofile(count)
    try:
        table = saltus.work_precision(
            decay, decay.create_context(), (0.0, 1.0), methods=["dopri5"], rtols=[1e-8],
            exact=lambda t: np.exp(-t), least_time=0.0, python=python,
        )  # fmt: skip
    finally:
        sys.setprofile(None)
    return calls, table[0]


def test_a_python_system_is_measured_as_it_runs():
    """Traced, the function is entered to be traced and checked, and not by any run."""
    traced, row = calls_while_measured("traced")
    called, same = calls_while_measured("called")
    assert row["steps"] == same["steps"] and row["scaled_error"] < 10.0
    assert traced < 30 < 6 * same["steps"] < called  # once to trace, at most a dozen points
