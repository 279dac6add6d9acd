"""The kinds of block that random scenes are made of, and their arguments."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from draw_leaf import BALL, NUMBERS, POSITIVE, ZENO, leaf, options_of
from hypothesis import strategies as st

HALF = {"lower_limit": -1.0, "upper_limit": 1.0}
NOTHING = st.just({})


@dataclass(frozen=True)
class Kind:
    """`inputs` has a letter for each input: r a real signal, b a boolean or held one; capital
    letters for inputs no output depends on at the same time, so that they may close a loop.
    `outputs` likewise: v is a vector, which no input of these takes.
    """

    inputs: str
    outputs: str
    arguments: st.SearchStrategy = NOTHING


@st.composite
def integrator(draw: Any) -> dict[str, Any]:
    arguments = draw(options_of(initial_state=NUMBERS, zeno_tolerance=ZENO))
    if draw(st.booleans()):
        arguments["enable_reset"] = True
        arguments["enable_external_reset"] = draw(st.booleans())
    arguments["enable_hold"] = draw(st.booleans())
    if draw(st.booleans()):
        arguments |= {"enable_limits": True, **HALF}
    return arguments


def integrator_inputs(arguments: dict[str, Any]) -> str:
    optional = {"enable_reset": "B", "enable_external_reset": "R", "enable_hold": "B"}
    return "R" + "".join(letter for key, letter in optional.items() if arguments.get(key))


def one_of(key: str, values: list[Any]) -> st.SearchStrategy:
    return st.fixed_dictionaries({key: st.sampled_from(values)})


KINDS = {
    "Integrator": Kind("R", "r", integrator()),
    "Leaf": Kind("R", "vvbrb", leaf()),
    "Ball": Kind("r", "vr", BALL),
    "UnitDelay": Kind("R", "b", options_of(initial_state=NUMBERS).map(lambda a: a | {"dt": 0.3})),
    "ZeroOrderHold": Kind("R", "b", one_of("dt", [0.25, 0.5, 1 / 3])),
    "Constant": Kind("", "r", st.fixed_dictionaries({"value": NUMBERS})),
    "Clock": Kind("", "r"),
    "Step": Kind("", "b", options_of(start_value=NUMBERS, end_value=NUMBERS, step_time=POSITIVE)),
    "Sine": Kind("", "r", options_of(amplitude=NUMBERS, frequency=POSITIVE, phase=NUMBERS)),
    "Ramp": Kind("", "r", options_of(start_value=NUMBERS, slope=NUMBERS, start_time=POSITIVE)),
    "Pulse": Kind("", "b", options_of(period=POSITIVE, phase_delay=POSITIVE, amplitude=NUMBERS)),
    "Gain": Kind("r", "r", st.fixed_dictionaries({"gain": NUMBERS})),
    "Offset": Kind("r", "r", st.fixed_dictionaries({"offset": NUMBERS})),
    "Adder": Kind("rr", "r", one_of("operators", ["++", "+-", "-+", "--"])),
    "Product": Kind("rr", "r", one_of("operators", ["**", "**", "**", "*/"])),
    "Abs": Kind("r", "r"),
    "Saturate": Kind("r", "r", st.just(HALF)),
    "Comparator": Kind("rr", "b", one_of("operator", ["<", "<=", ">", ">="])),
    "LogicalOperator": Kind("bb", "b", one_of("function", ["or", "and", "nor", "nand", "xor"])),
    "Switch": Kind("rbr", "r"),
    "ReduceBlock": Kind("rr", "r", one_of("function", ["larger", "sum"])),
    "FunctionBlock": Kind("r", "r", one_of("function", ["sine"])),
}
TRUTHS = Kind("rr", "b", one_of("function", ["less", "both"]))  # of a ReduceBlock
OFTEN = ["Integrator", "Leaf", "Ball", "Comparator", "Truth", "Switch", "Sine"]
NAMES = st.sampled_from([*OFTEN, *OFTEN, *KINDS])


def kind_of(name: str) -> Kind:
    return TRUTHS if name == "Truth" else KINDS[name]


def inputs_of(name: str, arguments: dict[str, Any]) -> str:
    return integrator_inputs(arguments) if name == "Integrator" else kind_of(name).inputs
