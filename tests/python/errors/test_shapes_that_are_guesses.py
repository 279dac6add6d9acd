"""An output without a shape is called to find it. What it raises there reaches the user."""

import numpy as np
import pytest
import saltus
from saltus.library import Adder, Constant, Demultiplexer, Gain, Integrator


class Broken(Exception):
    pass


class Odd(ValueError):
    """Its text is not its only argument."""

    def __init__(self, place, value):
        super().__init__(place, value)
        self.place, self.value = place, value


ERRORS = [Broken("no oil"), Odd("valve", 3), ZeroDivisionError("by hand")]


def pump(error):
    """Its output is three numbers where it does not fail; at zeros and at ones it fails."""
    leaf = saltus.LeafSystem(name="pump")
    leaf.declare_input_port("u")

    def out(time, state, u):
        if np.ravel(u)[0] != 5.0:
            raise error
        return [1.0, 2.0, 3.0]

    leaf.declare_output_port(out, name="y")
    return leaf


def behind(kind):
    """A block whose shape does not fit one number."""
    if kind == "a state":
        return Integrator([0.0, 0.0, 0.0], name="sum")
    if kind == "parts":
        return Demultiplexer(3, name="parts")
    return Gain(2.0, name="twice")


def diagram(leaf, kind):
    builder = saltus.DiagramBuilder()
    source, next_ = Constant(5.0, name="five"), behind(kind)
    builder.add(source, leaf, next_)
    builder.connect(source.output(), leaf.input("u"))
    builder.connect(leaf.output("y"), next_.input())
    builder.export_output(next_.output(0), "out")
    return builder.build()


@pytest.mark.parametrize("error", ERRORS, ids=lambda error: type(error).__name__)
@pytest.mark.parametrize("kind", ["a state", "parts", "a number of numbers"])
@pytest.mark.parametrize("python", ["traced", "called"])
def test_the_exception_is_the_cause(error, kind, python):
    system = diagram(pump(error), kind)
    with pytest.raises(saltus.ModelError) as caught:
        saltus.simulate(system, (0.0, 1.0), python=python)
    assert caught.value.__cause__ is error
    message = str(caught.value)
    for words in (
        "block 'pump': output 'y' was called with zeros and with ones in place of its inputs, to find",
        f"at first {type(error).__name__}: {error}; so it counts as one number",
        "declare it with shape=",
    ):
        assert words in message


@pytest.mark.parametrize("python", ["traced", "called"])
def test_a_declared_shape_is_no_guess(python):
    leaf = saltus.LeafSystem(name="pump")
    leaf.declare_input_port("u")
    leaf.declare_output_port(lambda time, state, u: [1.0, 2.0], name="y", shape=(2,))
    with pytest.raises(saltus.ModelError) as caught:
        saltus.simulate(diagram(leaf, "a state"), (0.0, 1.0), python=python)
    assert caught.value.__cause__ is None
    assert "was called" not in str(caught.value)


@pytest.mark.parametrize("python", ["traced", "called"])
def test_a_number_that_raises_at_zeros_and_ones_runs(python):
    leaf = saltus.LeafSystem(name="pump")
    leaf.declare_input_port("u")

    def out(time, state, u):
        if float(u) != 5.0:
            raise Broken
        return 2.0 * u

    leaf.declare_output_port(out, name="y")
    results = saltus.simulate(diagram(leaf, "a number"), (0.0, 1.0), python=python)
    assert np.all(results["out"] == 20.0)


@pytest.mark.parametrize("kind", ["a state", "parts", "a number of numbers"])
def test_ctrl_c_in_such_a_call_ends_it(kind):
    system = diagram(pump(KeyboardInterrupt()), kind)
    with pytest.raises(KeyboardInterrupt):
        saltus.simulate(system, (0.0, 1.0))


class Everything(saltus.LeafSystem):
    """One of its functions raises."""

    def __init__(self, where, error):
        super().__init__(name="all")

        def of(name, value):
            def function(time, state, *inputs):
                if name == where:
                    raise error
                return value(state)

            return function

        self.declare_input_port("u", shape=())
        self.declare_continuous_state([1.0], ode=of("ode", lambda state: [1.0]))
        self.declare_discrete_state([0.0])
        self.declare_output_port(of("output", lambda state: [1.0]), name="y")
        self.declare_zero_crossing(
            of("guard", lambda state: state.continuous_state[0] - 1.5),
            of("reset", lambda state: state.with_discrete_state([1.0])),
            name="event",
        )
        self.declare_periodic_update(
            of("update", lambda state: state.with_discrete_state([2.0])), period=0.25
        )


@pytest.mark.parametrize("error", [*ERRORS, KeyboardInterrupt()], ids=lambda e: type(e).__name__)
@pytest.mark.parametrize("where", ["ode", "output", "guard", "reset", "update"])
@pytest.mark.parametrize("python", ["traced", "called"])
def test_what_any_function_raises_is_raised_by_the_run(where, error, python):
    builder = saltus.DiagramBuilder()
    source, leaf, sum_ = builder.add(
        Constant(0.0), Everything(where, error), Adder("++", name="sum")
    )
    builder.connect(source.output(), leaf.input("u"))
    for i in range(2):
        builder.connect(leaf.output("y"), sum_.input(i))
    builder.export_output(sum_.output(), "out")
    with pytest.raises(type(error)) as caught:
        saltus.simulate(builder.build(), (0.0, 1.0), python=python)
    assert caught.value is error
