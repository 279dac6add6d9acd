"""What `simulate` takes: the context may be left out, in each form of the call."""

import pytest
import saltus
from saltus.library import Constant, Integrator


def ramp():
    builder = saltus.DiagramBuilder()
    one, x = builder.add(Constant(2.0, name="one"), Integrator(1.0, name="x"))
    builder.connect(one.output(), x.input())
    return builder.build()


FORMS = {
    "context": lambda s: saltus.simulate(s, s.create_context(), (0.5, 2.0)),
    "none": lambda s: saltus.simulate(s, None, (0.5, 2.0)),
    "span": lambda s: saltus.simulate(s, (0.5, 2.0)),
    "list": lambda s: saltus.simulate(s, [0.5, 2.0]),
    "keyword": lambda s: saltus.simulate(s, time_span=(0.5, 2.0)),
    "keywords": lambda s: saltus.simulate(s, time_span=(0.5, 2.0), context=s.create_context()),
    "options": lambda s: saltus.simulate(s, (0.5, 2.0), rtol=1e-6),
}


@pytest.mark.parametrize("form", FORMS)
def test_a_run_without_a_context_begins_with_the_values_of_the_system(form):
    results = FORMS[form](ramp())
    assert results.context.time == 2.0
    # the derivative is the constant 2 and every number here is a short binary one, but steps round
    assert results.context.continuous_state == pytest.approx([4.0], rel=1e-14)


@pytest.mark.parametrize(
    "call",
    [
        lambda s: saltus.simulate(s),
        lambda s: saltus.simulate(s, s.create_context()),
        lambda s: saltus.simulate(s, 5.0),
        lambda s: saltus.simulate(s, "ab"),
        lambda s: saltus.simulate(s, (0.0, 1.0, 2.0)),
    ],
)
def test_a_call_without_a_span_says_what_is_expected(call):
    with pytest.raises(saltus.ModelError, match=r"simulate: expected a span \(begin, end\)"):
        call(ramp())


@pytest.mark.parametrize("context", [(0.0, 1.0), 3, "x"])
def test_something_else_in_the_place_of_the_context_is_refused(context):
    with pytest.raises(saltus.ModelError, match="expected a context"):
        saltus.simulate(ramp(), context, (0.0, 1.0))
