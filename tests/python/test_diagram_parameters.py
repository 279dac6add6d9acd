"""Parameters of a diagram: the parameters of its blocks follow."""

import copy
import json
import pickle

import numpy as np
import pytest
import saltus
from saltus import Parameter
from saltus.library import Constant, EnabledSubsystem, Gain, Integrator, Saturate, Sine

END = {"time_span": (0.0, 1.0)}


class Spring(saltus.LeafSystem):
    """x'' = -k x, from x = 1."""

    def __init__(self, k):
        super().__init__(name="spring")
        self.declare_dynamic_parameter("k", k)
        self.declare_continuous_state(
            default_value=[1.0, 0.0],
            ode=lambda t, s, k: [s.continuous_state[1], -k * s.continuous_state[0]],
        )


def chain(value, parameters):
    """x' = value, from 0."""
    builder = saltus.DiagramBuilder()
    rate = builder.add(Constant(value, name="rate"))
    start = 0.0 * rate.create_context().parameters["value"]
    x = builder.add(Integrator(start, name="x"))
    builder.connect(rate.output(), x.input())
    return builder.build(parameters=parameters)


def rate_of(diagram, **values):
    context = diagram.create_context().with_parameters(values)
    return context.parameters["rate.value"]


m = Parameter("m", 2.0)
k = Parameter("k", [1.0, 3.0])


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        (m, lambda m, k: m),
        (-m, lambda m, k: -m),
        (3 * m + 1, lambda m, k: 3 * m + 1),
        (1 - m / 4, lambda m, k: 1 - m / 4),
        (2**m, lambda m, k: 2**m),
        (m**2 // 3, lambda m, k: m**2 // 3),
        (7.5 % m, lambda m, k: 7.5 % m),
        (abs(-m), lambda m, k: abs(m)),
        (np.sqrt(m) * np.sin(m), lambda m, k: np.sqrt(m) * np.sin(m)),
        (np.hypot(m, k[1]), lambda m, k: np.hypot(m, k[1])),
        (np.array(2.5) * m, lambda m, k: 2.5 * m),
        (np.float64(2.5) * m, lambda m, k: 2.5 * m),
        (5 * (m > 2.5), lambda m, k: 5 * (m > 2.5)),
        (np.where(m == 3, m, 1 / m), lambda m, k: np.where(m == 3, m, 1 / m)),
        (np.dot([1.0, 2.0], k), lambda m, k: np.dot([1.0, 2.0], k)),
        (m * k, lambda m, k: m * k),
        ([m, 2 * m, 3.0], lambda m, k: np.array([m, 2 * m, 3.0])),
        (Parameter("n", 10 * m), lambda m, k: 10 * m),
    ],
)
def test_an_expression_has_the_value_that_numpy_gives(expression, expected):
    diagram = chain(expression, {"m": m, "k": k})
    for mass in (2.0, 3.0):
        for stiffness in ([1.0, 3.0], [0.5, 5.0]):
            found = rate_of(diagram, m=mass, k=stiffness)
            # The same operations on the same numbers: to the last bit, but powers.
            assert found == pytest.approx(expected(mass, np.array(stiffness)), rel=1e-15)
    end = saltus.simulate(diagram, diagram.create_context().with_parameter("m", 3.0), **END)
    assert end.context.continuous_state == pytest.approx(
        np.ravel(expected(3.0, np.array([1.0, 3.0])))
    )


def test_an_expression_that_many_read_is_computed_once():
    """Without that, 2^100 calls."""
    expression = m
    for _ in range(100):
        expression = expression + expression
    assert rate_of(chain(expression, {"m": m}), m=3.0) == 3.0 * 2.0**100


def test_one_parameter_sets_blocks_in_any_depth():
    stiffness = Parameter("stiffness", 4.0)
    inner = saltus.DiagramBuilder()
    inner.add(Spring(stiffness))
    builder = saltus.DiagramBuilder()
    builder.add(inner.build("car"), Gain(2 * stiffness, name="gain"))
    builder.export_input("gain.in", "u")
    diagram = builder.build(parameters={"stiffness": stiffness})
    context = diagram.create_context()
    assert context.parameters == {"car.spring.k": 4.0, "gain.gain": 8.0, "stiffness": 4.0}
    other = context.with_parameter("stiffness", 9.0)
    assert other.parameters == {"car.spring.k": 9.0, "gain.gain": 18.0, "stiffness": 9.0}
    assert context.parameters["gain.gain"] == 8.0
    assert diagram.parameters == context.parameters
    diagram.input("u").fix_value(0.0)
    for python in ("called", "traced"):
        end = saltus.simulate(diagram, other, **END, python=python, rtol=1e-10, atol=1e-12)
        assert end.context.continuous_state[0] == pytest.approx(np.cos(3.0), abs=1e-8)


def test_a_diagram_in_a_diagram_has_parameters_of_its_own():
    k = Parameter("k", 4.0)
    inner = saltus.DiagramBuilder()
    inner.add(Spring(k))
    car = inner.build("car", parameters={"k": k})
    assert car.create_context().with_parameter("k", 5.0).parameters == {"spring.k": 5.0, "k": 5.0}
    builder = saltus.DiagramBuilder()
    builder.add(car, Constant(1.0, name="one"))
    context = builder.build().create_context().with_parameter("car.k", 9.0)
    assert context.parameters["car.spring.k"] == 9.0
    assert context[car].parameters == {"spring.k": 9.0, "k": 9.0}


def test_the_context_of_a_diagram_in_its_own_context_has_the_same_names():
    k = Parameter("k", 4.0)
    inner = saltus.DiagramBuilder()
    inner.add(Spring(k))
    builder = saltus.DiagramBuilder()
    builder.add(inner.build("car", parameters={"k": k}), Constant(1.0, name="one"))
    diagram = builder.build("car")
    context = diagram.create_context()
    assert context[diagram].parameters == context.parameters
    assert context.with_subcontext(diagram, context[diagram]) == context


def test_a_diagram_computes_the_parameters_of_a_diagram_in_it():
    m = Parameter("m", 2.0)
    k = Parameter("k", 2 * m)
    inner = saltus.DiagramBuilder()
    inner.add(Spring(k + 1))
    builder = saltus.DiagramBuilder()
    builder.add(inner.build("car", parameters={"k": k}), Constant(m, name="mass"))
    diagram = builder.build(parameters={"m": m})
    context = diagram.create_context().with_parameter("m", 5.0)
    assert context.parameters == {"car.spring.k": 11.0, "car.k": 10.0, "mass.value": 5.0, "m": 5.0}
    with pytest.raises(saltus.ModelError, match=r"'car.k' is computed from the parameters of a"):
        context.with_parameter("car.k", 1.0)


def test_a_parameter_that_an_inner_diagram_does_not_pass_on_is_refused():
    m, k = Parameter("m", 2.0), Parameter("k", 1.0)
    inner = saltus.DiagramBuilder()
    inner.add(Spring(m * k))
    builder = saltus.DiagramBuilder()
    builder.add(inner.build("car", parameters={"k": k}))
    with pytest.raises(saltus.ModelError, match=r"'car.spring.k' is computed in an inner diagram"):
        builder.build(parameters={"m": m})
    assert builder.build().parameters == {"car.spring.k": 2.0, "car.k": 1.0}


def test_a_subsystem_passes_its_parameters_on():
    g = Parameter("g", 3.0)
    builder = saltus.DiagramBuilder()
    part = builder.add(EnabledSubsystem(Gain(g, name="gain"), name="sub"))
    one = builder.add(Constant(1.0, name="one"))
    for i in range(2):
        builder.connect(one.output(), part.input(i))
    context = builder.build(parameters={"g": g}).create_context().with_parameter("g", 4.0)
    assert [v for name, v in context.parameters.items() if name.endswith("gain.gain")] == [4.0]


def test_a_sweep_varies_it_and_tables_name_it():
    diagram = chain(3 * m, {"m": m})
    table = saltus.sweep(diagram, {"m": [1.0, 2.0, 4.0]}, (0.0, 1.0))
    assert list(table["m"]) == [1.0, 2.0, 4.0]
    assert np.ravel(table.continuous_state) == pytest.approx([3.0, 6.0, 12.0])


@pytest.mark.parametrize("islands", [False, True])
def test_a_parameter_works_with_islands(islands):
    speed = Parameter("speed", 1.0)
    builder = saltus.DiagramBuilder()
    for i in (1, 2):
        rate, x = builder.add(Constant(i * speed, name=f"rate{i}"), Integrator(name=f"x{i}"))
        builder.connect(rate.output(), x.input())
    diagram = builder.build(parameters={"speed": speed})
    context = diagram.create_context().with_parameter("speed", 5.0)
    results = saltus.simulate(diagram, context, **END, islands=islands)
    assert results.context.continuous_state == pytest.approx([5.0, 10.0])
    assert results.context.parameters == context.parameters


def test_a_saved_context_has_it():
    diagram = chain(3 * m, {"m": m})
    context = diagram.create_context().with_parameter("m", 5.0)
    for saved in (pickle.loads(pickle.dumps(context)), copy.deepcopy(context)):
        assert saved == context
        assert saved.parameters == context.parameters
        again = saltus.simulate(diagram, saved.with_parameter("m", 6.0), **END)
        assert again.context.continuous_state == pytest.approx([18.0])
    assert json.loads(context.to_json())
    assert saltus.simulate(diagram, context, **END).context.parameters == context.parameters


def test_a_context_that_was_pickled_refuses_what_is_computed():
    saved = pickle.loads(pickle.dumps(chain(3 * m, {"m": m}).create_context()))
    with pytest.raises(saltus.ModelError, match=r"'rate.value' is computed"):
        saved.with_parameter("rate.value", 1.0)


def test_the_state_names_are_in_a_pickled_context():
    class Ball(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="ball")
            self.declare_continuous_state(
                default_value=[1.0, 0.0], ode=lambda t, s: [0.0, 0.0], names=["height", "speed"]
            )

    saved = pickle.loads(pickle.dumps(Ball().create_context()))
    assert saltus._core.find_entry(saved, "height") == 1


def test_what_is_computed_cannot_be_set():
    context = chain(3 * m, {"m": m}).create_context()
    with pytest.raises(saltus.ModelError, match=r"'rate.value' is computed from the parameters"):
        context.with_parameter("rate.value", 1.0)
    with pytest.raises(saltus.ModelError, match=r"'rate.value' is computed from the parameters"):
        saltus.sweep(chain(3 * m, {"m": m}), {"rate.value": [1.0]}, (0.0, 1.0))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Parameter(2.0), r"name: expected a text, found 2.0"),
        (lambda: Parameter("m"), r"give its value"),
        (lambda: Parameter("m", "heavy"), r"'m': expected numbers, found 'heavy'"),
        (lambda: Parameter("m", np.nan), r"'m': expected a finite number"),
        (lambda: Parameter("m", [[1.0]]), r"'m': expected a finite number or a vector"),
        (lambda: float(m), r"m \(a Parameter\) is used where a number is needed"),
        (lambda: np.array([1.0, 2.0]) if m > 1 else None, r"a number is needed"),
        (lambda: chain(m, {"m": 2.0}), r"expected a name and a Parameter, found 'm': 2.0"),
        (lambda: chain(m, {1: m}), r"expected a name and a Parameter, found 1"),
        (lambda: chain(m, [m]), r"expected names and parameters, such as {'mass': m}"),
        (lambda: chain(m, {"a": m, "b": m}), r"'b' is declared by another name already"),
        (lambda: np.concatenate([m, m]), r"concatenate with options, or of a list"),
        (lambda: chain(m, {"a.b": m}), r"a\.b"),
        (lambda: Integrator(m), r"'initial_state' is a start value"),
        (lambda: Integrator(lower_limit=m), r"lower_limit"),
        (lambda: Sine(frequency=m, phase="x"), r"phase"),
        (lambda: np.add.reduce(m), r"add.reduce"),
    ],
)
def test_a_mistake_is_a_model_error(make, message):
    with pytest.raises(saltus.ModelError, match=message):
        make()


def test_a_value_that_is_not_finite_names_what_it_computes():
    diagram = chain(1 / m, {"m": m})
    with pytest.raises(saltus.ModelError, match=r"'rate.value', which the diagram computes"):
        diagram.create_context().with_parameter("m", 0.0)


def test_a_check_of_a_block_sees_the_computed_value():
    builder = saltus.DiagramBuilder()
    upper = Parameter("upper", 1.0)
    sine, limit = builder.add(Sine(), Saturate(upper_limit=upper, lower_limit=0.0, name="limit"))
    builder.connect(sine.output(), limit.input())
    diagram = builder.build(parameters={"upper": upper})
    context = diagram.create_context().with_parameter("upper", -1.0)
    with pytest.raises(saltus.ModelError, match="limit"):
        saltus.simulate(diagram, context, **END)


def test_derivatives_are_by_what_is_computed_too():
    diagram = chain(3 * m, {"m": m})
    context = diagram.create_context().with_parameter("m", 4.0)
    for start in (context, pickle.loads(pickle.dumps(context))):
        results = saltus.simulate(diagram, start, **END, sensitivity=["rate.value"])
        assert results.context.continuous_state == pytest.approx([12.0])
        by = results.sensitivities.continuous_state
        assert np.ravel(by) == pytest.approx([1.0])
        assert saltus.linearize(diagram, start, inputs=["rate.value"]).B == pytest.approx(1.0)


def test_a_failed_build_leaves_the_builder_as_it_was():
    builder = saltus.DiagramBuilder()
    builder.add(Constant(m, name="rate"))
    with pytest.raises(saltus.ModelError):
        builder.build(parameters={"m": m, "n": 1.0})
    assert builder.build(parameters={"m": m}).parameters == {"rate.value": 2.0, "m": 2.0}
