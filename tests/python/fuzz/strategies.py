"""Random scenes: blocks, wires without algebraic loops, leaf systems, options."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from hypothesis import strategies as st
from scene import Part, Scene

# few and round, so that zeros, ties and equal times are drawn often
NUMBERS = st.sampled_from([0.0, 1.0, -1.0, 0.5, -0.5, 2.0, -2.0, 0.1, 1 / 3, 3.0])
POSITIVE = st.sampled_from([1.0, 0.5, 0.25, 2.0, 0.1, 1 / 3, 0.7])
DIRECTIONS = st.sampled_from(
    ["crosses_zero", "positive_then_non_positive", "negative_then_non_negative", "none"]
)
HALF = {"lower_limit": -1.0, "upper_limit": 1.0}


def options_of(**options: st.SearchStrategy) -> st.SearchStrategy:
    """A dict with some of the keys."""
    return st.fixed_dictionaries({}, optional=options)


GUARD = st.fixed_dictionaries(
    {
        "of": st.sampled_from(["first", "last", "time", "input", "sum", "pair"]),
        "level": NUMBERS,
        "reset": st.sampled_from([None, "set", "scale", "add", "keep", "count", "mode"]),
        "value": NUMBERS,
        "direction": DIRECTIONS,
    },
    optional={
        "start_mode": st.integers(0, 1),
        "end_mode": st.integers(0, 1),
        "terminal": st.booleans(),
        "zeno_tolerance": st.sampled_from([0.0, 1e-6, 1e-2]),
        "at_start": st.sampled_from(["auto", "ignore", "fire"]),
        "on_zeno": st.sampled_from(["hold", "stop", 0, 1]),
    },
)
UPDATE = st.fixed_dictionaries(
    {
        "period": st.sampled_from([0.5, 0.25, 0.1, 1 / 3]),
        "offset": st.sampled_from([0.0, 0.1, 0.5]),
        "what": st.sampled_from(["count", "kick", "sample", "mode"]),
    }
)


@st.composite
def leaf(draw: Any) -> dict[str, Any]:
    n = draw(st.integers(1, 2))
    vector = st.lists(NUMBERS, min_size=n, max_size=n)
    matrix = st.lists(vector, min_size=n, max_size=n)
    return {
        "x0": draw(vector),
        "a": draw(st.lists(matrix, min_size=2, max_size=2)),
        "b": draw(st.lists(vector, min_size=2, max_size=2)),
        "gain": draw(NUMBERS),
        "guards": draw(st.lists(GUARD, max_size=3)),
        "updates": draw(st.lists(UPDATE, max_size=1)),
    }


BALL = st.fixed_dictionaries(
    {"e": st.sampled_from([0.0, 0.5, 0.9, 1.0])},
    optional={
        "x0": st.sampled_from([(1.0, 0.0), (0.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.5, 0.0)]),
        "zeno_tolerance": st.sampled_from([0.0, 1e-6, 1e-2]),
        "on_zeno": st.sampled_from(["hold", "stop"]),
    },
)

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
    arguments = draw(options_of(initial_state=NUMBERS, zeno_tolerance=st.sampled_from([0.0, 1e-2])))
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


@st.composite
def parts(draw: Any, most: int = 8) -> tuple[Part, ...]:
    """Every input is connected to an output before it, or, where no loop can come of it, to any."""
    names = draw(st.lists(st.sampled_from([*KINDS, "Truth"]), min_size=1, max_size=most))
    kinds = [TRUTHS if name == "Truth" else KINDS[name] for name in names]
    arguments = [draw(kind.arguments) for kind in kinds]
    outputs = [
        (i, port, letter, kind.inputs.islower())
        for i, kind in enumerate(kinds)
        for port, letter in enumerate(kind.outputs)
    ]
    result = []
    for i, (name, kind, given) in enumerate(zip(names, kinds, arguments, strict=True)):
        inputs = integrator_inputs(given) if name == "Integrator" else kind.inputs
        sources = []
        for letter in inputs:
            wanted = "b" if letter in "bB" else "rb"
            known = [
                (part, port)
                for part, port, found, feeds in outputs
                if found in wanted and (letter.isupper() or part < i or not feeds)
            ]
            sources.append(draw(st.sampled_from(known)) if known else None)
        result.append(Part("ReduceBlock" if name == "Truth" else name, given, tuple(sources)))
    return tuple(result)


OPTIONS = options_of(
    ode_solver_method=st.sampled_from(["auto", "dopri5", "adams", "bdf"]),
    rtol=st.sampled_from([1e-3, 1e-6, 1e-9]),
    event_scan_points=st.integers(0, 4),
    zeno_tolerance=st.sampled_from([0.0, 1e-6, 1e-3]),
    max_minor_step_size=st.sampled_from([0.1, 1.0]),
    max_major_step_length=st.sampled_from([0.3, 1.0]),
    save_steps=st.booleans(),
)


@st.composite
def scenes(draw: Any) -> Scene:
    begin = draw(st.sampled_from([0.0, 0.0, -1.0, 0.1]))
    length = draw(st.sampled_from([1.0, 2.0, 3.0, 0.0]))
    options = draw(OPTIONS)
    if draw(st.booleans()):
        shares = draw(st.sets(st.integers(0, 8), min_size=1, max_size=5))
        options["save_at"] = [begin + length * share / 8 for share in sorted(shares)]
        if length == 0.0:
            options["save_at"] = [begin]
    return Scene(draw(parts()), (begin, begin + length), options)
