"""A callback that does not take what it is called with: the message says what it is called with."""

import functools
import re

import pytest
import saltus
from saltus.library import Constant, FunctionBlock, ReduceBlock

HERE = r" at test_signatures\.py:\d+"


class Ball(saltus.LeafSystem):
    """A ball with a parameter, whose callbacks a test chooses."""

    def __init__(self, **callbacks):
        super().__init__(name="ball")
        fall = lambda time, state, *, e: [state.continuous_state[1], -9.81]  # noqa: E731
        self.declare_dynamic_parameter("e", 0.8)
        self.declare_continuous_state([1.0, 0.0], ode=callbacks.get("ode", fall))
        self.declare_zero_crossing(
            callbacks.get("guard", lambda time, state, *, e: state.continuous_state[0]),
            callbacks.get("reset", lambda time, state, **parameters: state),
            name="bounce",
            direction="falling",
        )


def go(system, **options):
    return saltus.simulate(system, system.create_context(), (0.0, 0.5), **options)


def refused(system, **options):
    with pytest.raises(saltus.ModelError) as caught:
        go(system, **options)
    assert type(caught.value.__cause__) is TypeError
    return str(caught.value)


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize("where", ["ode", "guard", "reset"])
def test_a_parameter_that_is_not_in_the_signature_is_named(where, python):
    def careless(time, state):
        return [0.0, 0.0]

    what = {"ode": "ode", "guard": "guard of 'bounce'", "reset": "reset map of 'bounce'"}[where]
    message = refused(Ball(**{where: careless}), python=python)
    assert re.fullmatch(
        rf"block 'ball': {what}: expected careless\(time, state, \*, e\), found "
        rf"careless\(time, state\){HERE}; it gets every parameter of the block by keyword: take "
        r"'e' by name, or all of them as \*\*parameters",
        message,
    )


def test_the_line_is_that_of_the_function():
    careless = lambda time, state: [0.0, 0.0]  # noqa: E731
    line = careless.__code__.co_firstlineno
    for function in (careless, functools.partial(careless)):
        assert f"test_signatures.py:{line};" in refused(Ball(ode=function))


def test_a_method_shows_its_self():
    class Own(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="own")
            self.declare_dynamic_parameter("g", 9.81)
            self.declare_dynamic_parameter("e", 0.8)
            self.declare_continuous_state([1.0], ode=self.ode)

        def ode(self, time, state, *, g):
            return [-g]

    message = refused(Own())
    assert "expected ode(self, time, state, *, g, e), found ode(self, time, state, *, g)" in message
    assert "take 'e' by name" in message


def test_a_parameter_that_is_not_declared_is_named():
    message = refused(Ball(ode=lambda time, state, *, e, g: [0.0, -g]))
    assert "the block declares no parameter 'g': declare_dynamic_parameter" in message


def test_inputs_are_named_by_their_ports():
    class Pushed(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="pushed")
            self.declare_input_port("force")
            self.declare_continuous_state([1.0], ode=lambda time, state: [0.0])

    builder = saltus.DiagramBuilder()
    pushed, force = builder.add(Pushed(), Constant(1.0))
    builder.connect(force.output(), pushed.input())
    message = refused(builder.build())
    assert "expected <lambda>(time, state, force), found <lambda>(time, state)" in message
    assert "inputs come by position, those that requires_inputs names" in message


@pytest.mark.parametrize(
    ("block", "expected"),
    [
        (FunctionBlock(lambda: 1.0, name="f"), "<lambda>(in), found <lambda>()"),
        (ReduceBlock(1, lambda: 1.0, name="f"), "<lambda>(inputs), found <lambda>()"),
    ],
)
def test_functions_of_inputs_alone(block, expected):
    builder = saltus.DiagramBuilder()
    f, one = builder.add(block, Constant(1.0))
    builder.connect(one.output(), f.input())
    message = refused(builder.build(), recorded_signals={"y": f.output()})
    assert message.startswith("block 'f': output 'out': expected " + expected)


def test_a_type_error_from_within_the_function_comes_out_as_it_was():
    def inner():
        return 1.0

    for wrong in (lambda time, state, *, e: inner(2), lambda time, state, *, e: 1 + "x"):
        with pytest.raises(TypeError) as caught:
            go(Ball(ode=wrong))
        assert caught.value.__cause__ is None
