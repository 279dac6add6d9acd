"""A name, a mode or a time of another type is refused, and the message says what was expected."""

import pytest
import saltus
from saltus.library import Gain


class Decay(saltus.LeafSystem):
    def __init__(self):
        super().__init__(name="decay")
        self.declare_dynamic_parameter("k", 1.0)
        self.declare_continuous_state([1.0], ode=lambda t, state, k: -k * state.continuous_state)
        self.declare_discrete_state([0.0])
        self.declare_default_mode(0)
        self.declare_continuous_state_output("x")
        self.declare_zero_crossing(lambda t, state, k: state.continuous_state[0] - 0.5, name="half")


def diagram():
    builder = saltus.DiagramBuilder()
    leaf, gain = builder.add(Decay(), Gain(2.0, name="gain"))
    builder.connect(leaf.output("x"), gain.input())
    return builder.build()


def run(**options):
    return saltus.simulate(Decay(), (0.0, 1.0), **options)


def context():
    return Decay().create_context()


CALLS = {
    "with_parameters": (lambda x: context().with_parameters({x: 1.0}), "names of parameters"),
    "with_parameter": (lambda x: context().with_parameter(x, 1.0), "name: str"),
    "with_mode": (lambda x: context().with_mode(x), "mode: typing.SupportsInt"),
    "with_time": (lambda x: context().with_time(x), "time: typing.SupportsFloat"),
    "a state": (lambda x: context().with_continuous_state(x), "continuous state: expected numbers"),
    "a discrete state": (
        lambda x: context().with_discrete_state(x),
        "discrete state: expected numbers",
    ),
    "a part": (lambda x: diagram().create_context()[x], "expected a system or its system_id"),
    "a block": (lambda x: diagram()[x], "expected the name of a block, such as 'gain', found"),
    "a path": (lambda x: diagram().find_system_with_path(x), "expected a path such as"),
    "an output": (lambda x: Decay().output(x), "expected the position or the name of a port"),
    "a signal": (lambda x: run()[x], "expected the name of a recorded signal, found"),
    "an event": (lambda x: run().events.times(x), "expected the name of an event, such as"),
    "signals": (lambda x: run(recorded_signals={x: Decay().output("x")}), "recorded_signals: exp"),
    "sensitivity": (lambda x: run(sensitivity=[x]), "option sensitivity: expected"),
    "an option": (lambda x: run(**{x: 1.0}), "keywords must be strings"),
    "a sweep": (lambda x: saltus.sweep(Decay(), {x: [1.0]}, (0.0, 1.0)), "expected the name of a"),
    "a diagram": (
        lambda x: saltus.DiagramBuilder().build(parameters={x: 1.0}),
        "parameters: expected a name and a Parameter",
    ),
}
NUMBERS_TOO = ("with_mode", "with_time", "a state", "a discrete state", "a part", "an output")


@pytest.mark.parametrize(
    "given", [3, 1.5, ("k",), object()], ids=lambda given: type(given).__name__
)
@pytest.mark.parametrize("what", CALLS)
def test_another_type_is_refused(what, given):
    if what in NUMBERS_TOO and isinstance(given, (int, float)):
        return
    act, words = CALLS[what]
    with pytest.raises((TypeError, saltus.ModelError)) as caught:
        act(given)
    assert words in str(caught.value)


def test_the_key_is_in_the_message():
    with pytest.raises(TypeError, match=r"found the key 3$"):
        context().with_parameters({"k": 2.0, 3: 1.0})
    with pytest.raises(TypeError, match=r"found the key b'k'$"):
        context().with_parameters({b"k": 2.0})


def test_keys_that_are_kinds_of_str_are_names():
    class Name(str):
        pass

    assert context().with_parameters({Name("k"): 2.0}).parameters == {"k": 2.0}
