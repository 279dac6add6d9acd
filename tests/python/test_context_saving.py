"""Contexts saved and loaded: JSON, pickle, copies; runs go on from them to the last bit."""

import copy
import json
import pickle

import numpy as np
import pytest
import saltus
from systems import Ball


@pytest.fixture
def after():
    """A system and the context after some bounces, with numbers that have no short decimal form."""
    ball = Ball(e=0.6)
    context = ball.create_context().with_continuous_state([1 / 3, 1e-300])
    return ball, saltus.simulate(ball, context, (0.1, 1.7), rtol=1e-9, atol=1e-11).context


@pytest.mark.parametrize(
    "save",
    [
        lambda ball, c: ball.context_from_json(c.to_json()),
        lambda ball, c: pickle.loads(pickle.dumps(c)),
        lambda ball, c: copy.deepcopy(c),
    ],
    ids=["json", "pickle", "deepcopy"],
)
def test_a_context_comes_back_and_a_run_goes_on_from_it_bit_for_bit(after, save):
    ball, context = after
    back = save(ball, context)
    assert back == context
    assert back.to_dict() == context.to_dict()
    runs = [saltus.simulate(ball, c, (c.time, 4.0)) for c in (context, back)]
    first, second = runs
    assert [e.time for e in first.events] == [e.time for e in second.events]
    assert np.array_equal(first.context.continuous_state, second.context.continuous_state)


def test_a_context_of_another_system_or_other_text_is_refused(after):
    ball, context = after
    for text, message in [
        ("{", "a context in JSON"),
        ("[]", "expected an object"),
        ("{}", "format"),
        (context.to_json().replace('"block": "', '"block": "x'), "expected block"),
        (json.dumps({**context.to_dict(), "time": "soon"}), "something else than expected"),
    ]:
        with pytest.raises(saltus.ModelError, match=message):
            ball.context_from_json(text)
