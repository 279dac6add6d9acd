"""Records that hold arrays and nan are equal or not: one truth, never an array of them."""

import copy
import pickle

import numpy as np
import pytest
import saltus
from saltus.results import Event


@pytest.fixture(scope="module")
def results():
    return saltus.scene("bouncing-ball").simulate(sensitivity=["e"], dense_output=True)


def test_an_event_is_in_the_log(results):
    events = results.events
    for i in (0, 1, len(events) - 1):
        assert events[i] in events
        assert events.index(events[i]) == i
        assert events.count(events[i]) == 1
        assert events[i] in list(events)
    assert (events[0] == events[0]) is True and (events[0] != events[0]) is False
    assert (events[0] == events[1]) is False and (events[0] != events[1]) is True
    assert "bounce" not in events and events[0] != "bounce" and events[0] is not None
    assert len(set(events)) == len(set(list(events) * 2)) == len(events)


@pytest.mark.parametrize(
    ("field", "value"),
    [("after", np.array([0.0, 1.0])), ("after", np.array([0.0])), ("time", 3.0), ("name", "hit"),
     ("predicted", 1.0), ("rests", (0,))],
)  # fmt: skip
def test_an_event_with_another_value_is_another_event(results, field, value):
    event = results.events[0]
    other = event._replace(**{field: value})
    assert other != event and other not in results.events
    assert event._replace() == event == tuple(event)


def test_events_of_nan_are_equal():
    made = [Event(1.0, 0, "time", 0, "a", "b", np.nan, np.array([np.nan]), np.array([1.0]), 0)
            for _ in range(2)]  # fmt: skip
    assert made[0] == made[1] and hash(made[0]) == hash(made[1])


def test_logs_of_equal_runs_are_equal(results):
    again = saltus.scene("bouncing-ball").simulate(dense_output=True)
    assert results.events == again.events
    assert results.events[:3] == again.events[:3] != again.events[:2]
    assert (results.events == list(results.events)) is False
    assert pickle.loads(pickle.dumps(results)).events == results.events


def test_values_and_sensitivities_are_compared_entry_by_entry(results):
    assert (results([0.1, 0.2]) == results([0.1, 0.2])) is True
    assert (results([0.1, 0.2]) == results([0.1, 0.3])) is False
    copied = pickle.loads(pickle.dumps(results))
    assert (results.sensitivities == copied.sensitivities) is True
    other = saltus.scene("bouncing-ball").simulate(sensitivity=["x[0]"])
    assert (results.sensitivities != other.sensitivities) is True


def test_islands_are_compared():
    def run():
        builder = saltus.DiagramBuilder()
        for name in ("a", "b"):
            block = builder.add(saltus.library.Integrator(1.0, name=name))
            source = builder.add(saltus.library.Constant(1.0, name=f"{name}_in"))
            builder.connect(source.output(), block.input())
            builder.export_output(block.output(), name)
        results = saltus.simulate(builder.build(), (0.0, 1.0), islands=True)
        return results.islands

    first, again = run(), run()
    assert len(first) == 2
    assert (first[0] == first[1]) is False
    assert first[0].time is not again[0].time
    assert [one == one for one in first] == [True, True]


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy])
def test_a_copy_keeps_everything(results, copied):
    made = copied(results)
    assert type(made) is saltus.Results and made is not results
    assert made.dense and made.span == results.span
    assert made(1.0) == results(1.0)
    assert made.events == results.events and made.sensitivities == results.sensitivities
    assert made.statistics == results.statistics and made.context == results.context
    assert made.message == results.message


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy])
def test_a_copy_of_a_solution_keeps_everything(copied):
    solution = saltus.solve(
        lambda t, x: -x, (0, 1), [1.0], dense_output=True, events=lambda t, x: x[0] - 0.5
    )
    made = copied(solution)
    assert type(made) is type(solution) and made.system is solution.system
    assert made.sol(0.5) == solution.sol(0.5)
    assert made.t_events[0] == solution.t_events[0]
    assert (made.status, made.success, made.nfev) == ("reached_end", True, solution.nfev)


def test_a_deep_copy_has_arrays_of_its_own(results):
    made = copy.deepcopy(results)
    assert not np.shares_memory(made.time, results.time)
    assert not np.shares_memory(made.outputs["y"], results.outputs["y"])
    assert np.shares_memory(copy.copy(results).time, results.time)


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy])
def test_a_copy_of_a_failed_run_keeps_the_exception(copied):
    def ode(t, x):
        if t > 0.5:
            raise KeyError("mine")
        return -x

    failed = saltus.solve(ode, (0, 1), [1.0], throw=False)
    made = copied(failed)
    assert made.cause is failed.cause and isinstance(made.cause, KeyError)
    assert made.status == "failed" and "mine" in made.message
