"""Values and options that make no sense are refused before a run."""

import math

import numpy as np
import pytest
import saltus
from saltus import library
from troubles import Everything, check_works


@pytest.fixture
def system():
    return Everything()


def refused(call):
    with pytest.raises(saltus.ModelError) as caught:
        call()
    return str(caught.value)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda c: c.with_continuous_state([1.0, 2.0]),
            "continuous state: expected 1 values, found 2",
        ),
        (lambda c: c.with_discrete_state([]), "discrete state: expected 1 values, found 0"),
        (
            lambda c: c.with_continuous_state([math.nan]),
            "continuous state: entry 0 is nan; give a finite value",
        ),
        (
            lambda c: c.with_discrete_state([math.inf]),
            "discrete state: entry 0 is inf; give a finite value",
        ),
        (lambda c: c.with_time(-math.inf), "time: -inf is not finite"),
        (
            lambda c: c.with_continuous_state("fast"),
            "continuous state: expected numbers, found 'fast' (str)",
        ),
        (
            lambda c: c.with_continuous_state([None]),
            "continuous state: expected numbers, found a list whose entry [0] is None",
        ),
    ],
)
def test_a_context_refuses_wrong_shapes_and_values_that_are_not_finite(system, change, message):
    context = system.create_context()
    assert refused(lambda: change(context)) == message
    assert context == system.create_context()
    check_works(system)


@pytest.mark.parametrize("value", [math.nan, math.inf, [1.0, math.nan]])
def test_a_parameter_that_is_not_finite_is_refused_where_it_is_given(value):
    class Spring(saltus.LeafSystem):
        def __init__(self, k):
            super().__init__(name="spring")
            self.declare_dynamic_parameter("k", k)

    entry, found = np.size(value) - 1, np.ravel(value)[-1]
    message = f"parameter 'k': entry {entry} is {found}; give a finite value"
    assert refused(lambda: Spring(value)) == f"block 'spring': {message}"
    context = Spring(np.ones_like(value)).create_context()
    assert refused(lambda: context.with_parameter("k", value)) == message


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rtol": 0.0}, "option rtol: expected a positive number, found 0"),
        ({"rtol": -1e-6}, "option rtol: expected a positive number, found -1e-06"),
        ({"rtol": math.nan}, "option rtol: expected a positive number, found nan"),
        ({"rtol": 1e-16}, "option rtol: expected at least 1e-15: a double has no more digits"),
        ({"atol": 0}, "option atol: expected a positive number, found 0"),
        ({"atol": math.inf}, "option atol: expected a positive number, found inf"),
        ({"zeno_tolerance": math.nan}, "option zeno_tolerance: expected a time >= 0 s, found nan"),
        ({"event_scan_points": -1}, "option event_scan_points: expected 0 or more, found -1"),
        ({"max_passes": 0}, "option max_passes: expected 1 or more, found 0"),
        ({"max_major_steps": -1}, "option max_major_steps: expected a positive number, or none"),
        ({"max_major_step_length": 0.0}, "option max_major_step_length: expected a time > 0 s"),
        ({"max_minor_step_size": 0.0}, "option max_minor_step_size: expected more than min_minor"),
        ({"min_minor_step_size": -1.0}, "option min_minor_step_size: expected a time >= 0 s"),
        ({"save_at": [0.0, 0.0]}, "option save_at: expected increasing times, found 0"),
        ({"save_at": 1.0}, "option save_at: expected Sequence[float], found 1.0"),
        ({"interrupt": 3}, "option interrupt: expected Callable[[], bool] | None, found 3"),
        ({"throw": "no"}, "option throw: expected bool, found 'no'"),
        ({"rtoll": 1e-6}, "Simulator: unknown option 'rtoll'; did you mean 'rtol'? Known: "),
        (
            {"ode_solver_method": "bdg"},
            "unknown ode_solver_method 'bdg'; did you mean 'bdf'? Known: ",
        ),
    ],
)
def test_an_option_that_makes_no_sense_is_refused(system, options, message):
    run = lambda: saltus.simulate(system, system.create_context(), (0.0, 1.0), **options)  # noqa: E731
    assert refused(run).startswith(message)
    check_works(system)


def test_a_time_to_save_at_that_is_not_finite_is_refused(system):
    refused(
        lambda: saltus.simulate(system, system.create_context(), (0.0, 1.0), save_at=[math.nan])
    )


@pytest.mark.parametrize(
    ("span", "message"),
    [
        ((1.0, 0.0), "expected a span with begin <= end, found 1.0 s to 0.0 s"),
        ((0.0, math.nan), "expected a span with begin <= end, found 0.0 s to nan s"),
        ((math.nan, 1.0), "expected a span with begin <= end, found nan s to 1.0 s"),
        (1.0, "expected a span (begin, end) in seconds, found 1.0; write (0.0, 1.0)"),
        ((0.0, None), "expected a span (begin, end) in seconds, found (0.0, None)"),
        ("01", "expected a span (begin, end) in seconds, found '01'"),
        (("0", 1.0), "expected a span (begin, end) in seconds, found ('0', 1.0)"),
        ((0.0, 1.0, 2.0), "expected a span (begin, end) in seconds, found (0.0, 1.0, 2.0)"),
    ],
)
def test_a_span_that_makes_no_sense_is_refused(system, span, message):
    run = lambda: saltus.simulate(system, system.create_context(), span)  # noqa: E731
    assert refused(run) == f"simulate: {message}"
    check_works(system)


def test_a_run_does_not_go_back(system):
    simulator = saltus.Simulator(system)
    simulator.initialize(system.create_context())
    simulator.advance_to(1.0)
    for time in (0.5, math.nan):
        message = f"cannot run from t = 1 s back to t = {time} s; the end has to be later"
        assert refused(lambda time=time: simulator.advance_to(time)) == message
    assert refused(lambda: simulator.advance_to("soon")) == (
        "advance_to: expected a time in seconds, found 'soon'"
    )
    assert simulator.advance_to(2.0) == "reached_end"
    whole = saltus.simulate(system, system.create_context(), (0.0, 2.0)).context
    assert simulator.context.continuous_state == pytest.approx(whole.continuous_state, rel=1e-4)


def test_a_context_that_is_no_context_or_of_another_system_is_refused(system):
    for context in (3, {}, "x"):
        message = f"expected a context, such as system.create_context(), found {context!r}"
        run = lambda context=context: saltus.simulate(system, context, (0.0, 1.0))  # noqa: E731
        assert refused(run) == message
    other = saltus.LeafSystem(name="other").create_context()
    assert refused(lambda: saltus.simulate(system, other, (0.0, 1.0))) == (
        f"the context is not one of this system: expected block '{system.name}', found 'other'; "
        "create it with system.create_context()"
    )
    check_works(system)


@pytest.mark.parametrize(
    ("declare", "message"),
    [
        (
            lambda s: s.declare_periodic_update(len, "often"),
            "declare_periodic_update: expected callback: Callable[..., _core.State | ArrayLike], "
            "period: float; found callback = <built-in function len>, period = 'often'",
        ),
        (
            lambda s: s.declare_default_mode(1.5),
            "declare_default_mode: expected mode: int | str; found mode = 1.5",
        ),
        (
            lambda s: s.declare_input_port("u", shape=-1),
            "shape: expected () or a number of entries, found -1",
        ),
        (
            lambda s: s.declare_continuous_state([math.nan]),
            "block 'all': the continuous state is declared twice; declare it once, as one vector",
        ),
        (
            lambda s: s.declare_zero_crossing(len, direction="downward"),
            "block 'all': zero crossing 'zero_crossing_1': unknown direction 'downward'; Known: ",
        ),
    ],
)
def test_a_declaration_that_is_refused_leaves_the_block_as_it_was(system, declare, message):
    assert refused(lambda: declare(system)).startswith(message)
    check_works(system)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: library.Pulse(period="often"),
            "Pulse: expected period: float; found period = 'often'",
        ),
        (
            lambda: library.Gain(2.0, name=3),
            "Gain: expected gain: ArrayLike, name: str | None; found gain = 2.0, name = 3",
        ),
        (
            lambda: library.Integrator(initial=1.0),
            "Integrator: unknown option 'initial'; Known: 'initial_state', 'enable_reset', ",
        ),
        (
            lambda: library.Integrator(initial_sate=1.0),
            "Integrator: unknown option 'initial_sate'; did you mean 'initial_state'? Known: ",
        ),
        (
            lambda: library.ReduceBlock(2, max, shap=1),
            "ReduceBlock: unknown option 'shap'; did you mean 'shape'? Known: ",
        ),
        (
            lambda: saltus.LeafSystem(nam="x"),
            "LeafSystem: unknown option 'nam'; did you mean 'name'? Known: 'name'",
        ),
        (lambda: saltus.LeafSystem(3), "LeafSystem: expected name: str | None; found name = 3"),
    ],
)
def test_an_argument_of_a_block_that_makes_no_sense_is_refused(make, message):
    assert refused(make).startswith(message)
