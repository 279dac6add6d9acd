"""What is no number is refused, and the message says which entry it is and what."""

import re

import numpy as np
import pytest
import saltus


class Spring(saltus.LeafSystem):
    """dx/dt = what `give(k)` returns."""

    def __init__(self, give):
        super().__init__(name="spring")
        self.declare_dynamic_parameter("k", [1.0, 2.0])
        self.declare_continuous_state([1.0, 0.0], ode=lambda time, state, *, k: give(k))


LIST = "a list whose entry "
NONE_OF_THEM = [
    ("0.8", "'0.8' (str)"),
    (b"0.8", "b'0.8' (bytes)"),
    (1j, "1j (complex)"),
    ({"k": 1.0}, "{'k': 1.0} (dict)"),
    (["0.8", 1.0], LIST + "[0] is '0.8' (str)"),
    ([1.0, None], LIST + "[1] is None"),
    ((1.0, 2j), "a tuple whose entry [1] is 2j (complex)"),
    ([[1.0, 2.0], [3.0, "x"]], LIST + "[1][1] is 'x' (str)"),
    ([1.0, np.str_("2")], LIST + "[1] is "),
    ([[1.0, 2.0], [3.0]], "a list of entries of different lengths"),
    (np.array(["0.8", "1"]), "an array of <U3"),
    (np.array([1j, 0.0]), "an array of complex128"),
    (np.complex128(1j), "np.complex128(1j) (numpy.complex128)"),
    ([0.0, np.complex64(0.0)], LIST + "[1] is np.complex64(0j) (numpy.complex64)"),
    (np.ma.array([1.0, 2.0], mask=[True, False]), "an array with masked entries"),
    (np.array([1, 2], dtype="timedelta64[s]"), "an array of timedelta64[s]"),
]


@pytest.mark.parametrize(("value", "found"), NONE_OF_THEM)
def test_a_parameter_that_is_no_number_is_refused(value, found):
    context = Spring(lambda k: k).create_context()
    message = re.escape(f"parameter 'k': expected numbers, found {found}")
    for change in (
        lambda: context.with_parameter("k", value),
        lambda: context.with_parameters({"k": value}),
    ):
        with pytest.raises(saltus.ModelError, match=f"^{message}"):
            change()
    assert context == Spring(lambda k: k).create_context()


@pytest.mark.parametrize(("value", "found"), NONE_OF_THEM)
def test_a_callback_that_returns_no_numbers_is_told_which_entry(value, found):
    spring = Spring(lambda k: value)
    message = re.escape(f"block 'spring': ode returned {found}")
    with pytest.raises(saltus.ModelError, match=f"^{message}.*, expected 2 numbers$"):
        saltus.simulate(spring, spring.create_context(), (0.0, 1.0))


@pytest.mark.parametrize(
    "value",
    [
        [1, 2.0],
        (np.float32(1), True + 1),
        np.array([1, 2]),
        [np.array(1.0), np.int8(2)],
        np.ma.array([1.0, 2.0], mask=[False, False]),
    ],
)
def test_numbers_of_every_kind_are_numbers(value):
    context = Spring(lambda k: k).create_context()
    assert context.with_parameter("k", value).parameters["k"].tolist() == [1.0, 2.0]
    spring = Spring(lambda k: value)
    end = saltus.simulate(spring, spring.create_context(), (0.0, 1.0)).context
    assert end.continuous_state == pytest.approx([2.0, 2.0], rel=1e-12)  # a constant rate: exact


def test_a_list_that_holds_itself_is_no_number():
    endless = [1.0]
    endless.append(endless)
    with pytest.raises(saltus.ModelError, match="expected numbers, found a list"):
        Spring(lambda k: k).create_context().with_parameter("k", endless)


@pytest.mark.parametrize(
    "period, offset, begin",
    [
        (1.0, -1e300, 0.0),
        (0.3, 0.0, 2.0**63),
        (1e-300, -1.0, 0.0),
        (1.0, -1e308, 1e308),
        (1e-20, 0.0, 1.0),
    ],
)
def test_ticks_that_cannot_be_told_apart_are_refused(period, offset, begin):
    block = saltus.LeafSystem(name="block")
    block.declare_discrete_state(default_value=[0.0])
    block.declare_periodic_update(lambda t, s: s.discrete_state + 1, period=period, offset=offset)
    with pytest.raises(saltus.ModelError, match="cannot be told apart"):
        saltus.simulate(block, block.create_context(), (begin, begin + 1.0))
    late = block.context_from_json(block.create_context(begin).to_json())
    with pytest.raises(saltus.ModelError, match="cannot be told apart"):
        saltus.Simulator(block).initialize(late)


def test_a_pulse_that_began_too_long_ago_is_refused():
    from saltus.library import Pulse

    pulse = Pulse(period=1.0, phase_delay=-1e308)
    with pytest.raises(saltus.ModelError, match="cannot be told apart"):
        saltus.simulate(pulse, pulse.create_context(), (0, 1))
