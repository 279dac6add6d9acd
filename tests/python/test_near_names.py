"""A name that an object does not have is answered with the nearest one, or with what is here."""

import copy
import pickle

import pytest
import saltus
from saltus.scene_files import loads


def results():
    return saltus.scene("bouncing-ball").simulate()


def solution():
    return saltus.solve(lambda t, x: -x, (0, 1), [1.0])


def scene_file():
    return loads("version = 1\n[states]\ny = { start = 1.0, rate = '-y' }\n[run]\nuntil = 1.0\n")


NAMES = [
    (results, "times", "the times of the rows are results.time"),
    (results, "t", "the times of the rows are results.time"),
    (results, "tiem", "did you mean 'time'"),
    (results, "evnts", "did you mean 'events'"),
    (results, "states", "the final state results.context.continuous_state"),
    (results, "y", "the recorded signal is results['y']"),
    (results, "success", "results.status == 'reached_end'"),
    (results, "nfev", "results.statistics.right_hand_side_calls"),
    (results, "to_dataframe", "results.to_pandas()"),
    (results, "sol", "dense_output=True"),
    (solution, "times", "the times of the rows are solution.t"),
    (solution, "states", "the states are solution.y"),
    (solution, "sucess", "did you mean 'success'"),
    (lambda: results().events, "time", "events.times('name')"),
    (lambda: results().events[0], "t", "it is event.time"),
    (lambda: results().events[0], "state", "event.before and event.after"),
    (lambda: results().events[0], "tiem", "did you mean 'time'"),
    (saltus.DiagramBuilder, "add_block", "builder.add(block)"),
    (saltus.DiagramBuilder, "conect", "did you mean 'connect'"),
    (lambda: saltus.Simulator(saltus.scene("bouncing-ball").system), "run", "advance_to("),
    (lambda: saltus.Simulator(saltus.scene("bouncing-ball").system), "sytem", "mean 'system'"),
    (lambda: saltus.scene("bouncing-ball"), "run", "scene.simulate()"),
    (lambda: saltus.scene("bouncing-ball"), "paramters", "did you mean 'parameters'"),
    (scene_file, "run", "scene.simulate()"),
    (scene_file, "contxt", "did you mean 'context'"),
    (lambda: saltus, "Integrator", "it is saltus.library.Integrator"),
    (lambda: saltus, "simulte", "did you mean 'simulate'"),
]


@pytest.mark.parametrize(("make", "name", "part"), NAMES)
def test_a_name_that_is_not_there(make, name, part):
    owner = make()
    with pytest.raises(AttributeError) as caught:
        getattr(owner, name)
    assert f"has no attribute '{name}'" in str(caught.value) and part in str(caught.value)
    assert not hasattr(owner, name) and getattr(owner, name, 5) == 5


@pytest.mark.parametrize("make", list(dict.fromkeys(make for make, _, _ in NAMES)))
def test_private_names_have_no_advice(make):
    for name in ("_nothing", "__deepcopy_it__", "_ipython_display_"):
        with pytest.raises(AttributeError) as caught:
            getattr(make(), name)
        assert str(caught.value).endswith(f"has no attribute '{name}'")


def test_an_attribute_error_within_a_property_is_shown(monkeypatch):
    def inside(self):
        return self.context.no_such_thing

    monkeypatch.setattr(saltus.Results, "status", property(inside))
    with pytest.raises(AttributeError, match="no_such_thing"):
        results().status  # noqa: B018


def test_copies_and_pickles_do_without():
    for made in (results(), solution()):
        assert copy.deepcopy(made).status == pickle.loads(pickle.dumps(made)).status == made.status
    event = results().events[0]
    assert copy.copy(event) == copy.deepcopy(event) == pickle.loads(pickle.dumps(event)) == event
