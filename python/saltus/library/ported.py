"""Arguments of the blocks of pycollimator: their names here, or what to do in their place.

Imported when a block is given an argument that it does not have, not before.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from saltus.errors import BlockParameterError

__all__ = ["as_here"]

INPUTS = {"n_in": "n_inputs"}
STATES = {"initialize_states": "initial_state"}
CALLED = {
    "Demultiplexer": {"n_out": "n_outputs"},
    "EdgeDetection": {"edge_detection": "edge"},
    "FunctionBlock": {"func": "function"},
    "LTISystem": STATES,
    "LTISystemDiscrete": STATES,
    "LookupTable2d": {
        "input_x_array": "input_x",
        "input_y_array": "input_y",
        "output_table_array": "output_table",
    },
    "MatrixConcatenation": INPUTS,
    "MinMax": INPUTS,
    "Multiplexer": INPUTS,
    "PIDDiscrete": {"filter_coefficient": "n"},
    "ReduceBlock": INPUTS | {"op": "function"},
    "RigidBody": {
        "gravity_vector": "gravity",
        "inertia_matrix": "inertia",
        "initial_angular_velocity": "initial_rates",
    },
    "ScalarBroadcast": {"m": "n"},
    "Slice": {"slice_": "entries"},
    "SourceBlock": {"func": "function"},
    "TransferFunctionDiscrete": STATES,
}
"""block -> its argument there -> the same here"""

LIMIT = "limit the signal by a MinMax block with the limit as an input"
LIMITED = "RateLimiter Saturate"
OFF: dict[str, tuple[str, tuple[Any, ...], str]] = {
    "denominator_limit": ("Product", (None,), "keep the denominator from zero by a Saturate block"),
    "divide_by_zero_behavior": (
        "Product", (None,), "a quotient by zero is infinite, and ends a run",
    ),
    "dtype": (
        "Clock DiscreteClock Integrator IntegratorDiscrete RandomNumber WhiteNoise",
        (None, float, "float64", np.float64, np.dtype(float)),
        "every value is a double; leave it out",
    ),
    "enable_dynamic_lower_limit": (LIMITED, (False,), LIMIT),
    "enable_dynamic_upper_limit": (LIMITED, (False,), LIMIT),
    "enable_external_inertia_matrix": (
        "RigidBody", (False,), "a rigid body has a constant inertia here",
    ),
    "enable_external_initial_state": (
        "PID PIDDiscrete", (False,), "give the number initial_state",
    ),
    "enable_external_mass": ("RigidBody", (False,), "a rigid body has a constant mass here"),
    "enable_output_state_derivatives": ("RigidBody", (False,), "compute them from its inputs"),
    "parameters": (
        "FunctionBlock ReduceBlock", (None, {}), "parameters belong to a LeafSystem of your own",
    ),
    "shape": (
        "RandomNumber WhiteNoise", (None, ()),
        "give an argument of this shape, such as mean=[0.0, 0.0]",
    ),
    "start_time": ("DiscreteClock", (0, 0.0, None), "add an Offset behind it"),
    "ui_id": ("", (None,), "leave it out"),
}  # fmt: skip
"""argument -> the blocks that have it there, '' for all; values with which it means nothing; what
to do for others
"""
GONE = {
    "Comparator": dict.fromkeys(
        ("atol", "rtol"), "a comparison is exact; compare the Abs of a difference with a number"
    ),
    "DataSource": dict.fromkeys(
        ("file_name", "data_columns", "header_as_first_row", "sampling_interval", "time_column",
         "time_samples_as_column"),
        "read a file with DataSource.from_csv(path)",
    ),
    "Integrator": {
        "reset_on_enter_zeno": "leave it out: a block at rest has the values of its Zeno point"
    },
    "StateMachine": dict.fromkeys(
        ("sm_data", "dt", "time_mode", "accelerate_with_jax"),
        "give states and transitions: StateMachine(['off', 'on'], [Transition('off', 'on', ...)])",
    ),
    "WhiteNoise": {
        "correlation_time": "it is dt here",
        "noise_power": "it is power = noise_power * correlation_time here, where the numbers that "
        "are held for dt have the variance power / dt",
        "num_samples": "leave it out: its numbers are held for dt, and not interpolated",
    },
}  # fmt: skip
"""block -> its argument there that has no counterpart -> what to do"""

ANYWAY = [
    ("LookupTable2d", "interpolation", "linear"),
    ("MatrixMultiplication", "n_in", 2),
    ("ScalarBroadcast", "m", None),
    ("ScalarBroadcast", "n", None),
]
"""block, argument and the only value that it has here"""


def as_here(
    block: str, options: dict[str, Any], known: Collection[str], placed: Mapping[str, Any]
) -> dict[str, Any]:
    """The arguments of a block by their names here; those that no tool has stay as they are.

    `placed` are the arguments that are given by position.

    Raises
    ------
    BlockParameterError
        For an argument that means something there and has no counterpart; the message says what to
        do. For one that is given by both names.
    """
    options = _filtered(block, _plain(block, options), placed)
    found: dict[str, Any] = {}
    for name, value in options.items():
        here = CALLED.get(block, {}).get(name)
        if name in known:
            found[name] = value
        elif name in GONE.get(block, {}):
            raise BlockParameterError(f"{block}: no option '{name}': {GONE[block][name]}")
        elif here is not None:
            if options.get(here) is not None or here in placed:
                raise BlockParameterError(
                    f"{block}: '{name}' is called '{here}' here; give one of them"
                )
            found[here] = value
        elif not _means_nothing(block, name, value):
            found[name] = value  # which is refused
    return found


def _means_nothing(block: str, name: str, value: Any) -> bool:
    """Whether a block has the argument there, with a value that changes nothing; BlockParameterError
    for another value.
    """
    blocks, values, advice = OFF.get(name, ("-", (), ""))
    if blocks and block not in blocks.split():
        return False
    if not any(_same(value, v) for v in values):
        raise BlockParameterError(f"{block}: {name} = {value!r}: {advice}")
    return True


def _same(value: Any, other: Any) -> bool:
    return value is other or (type(value) is type(other) and bool(value == other))


def _plain(block: str, options: dict[str, Any]) -> dict[str, Any]:
    """The options without those that say what a block is here anyway."""
    for of, name, value in ANYWAY:
        if block == of and name in options and _same(options[name], value):
            options = {key: given for key, given in options.items() if key != name}
    return options


def _filtered(block: str, options: dict[str, Any], placed: Mapping[str, Any]) -> dict[str, Any]:
    """The options without the type of the filter of a sampled derivative: it is the backward one
    here. A block has other defaults there, so what they concern must be given.
    """
    if "filter_type" not in options or block not in ("DerivativeDiscrete", "PIDDiscrete"):
        return options
    rest = {name: value for name, value in options.items() if name != "filter_type"}
    kind, given = options["filter_type"], {**placed, **rest}
    if kind == "none" and _without_filter(block, given, placed):
        return {name: value for name, value in rest.items() if name != "filter_coefficient"}
    if kind == "backward":
        if not given.keys() & {"filter_coefficient", "n"}:
            raise BlockParameterError(
                f"{block}: filter_type = 'backward': say filter_coefficient too; "
                "pycollimator has 1.0 without it"
            )
        return rest
    raise BlockParameterError(
        f"{block}: filter_type = {kind!r}: the filter is 'backward' here; choose its coefficient"
        + ("; without a filter say kd=0.0" if block == "PIDDiscrete" else "")
    )


def _without_filter(block: str, given: Mapping[str, Any], placed: Mapping[str, Any]) -> bool:
    """Whether a block has no filter here."""
    if block == "DerivativeDiscrete":
        return "filter_coefficient" not in placed
    kd = given.get("kd")  # 1.0 there if it is left out
    return isinstance(kd, (int, float)) and kd == 0.0
