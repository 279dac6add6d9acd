"""Arguments of the blocks of pycollimator: their names here, or what to do in their place.

Imported when a block is given an argument that it does not have, not before.
"""

from __future__ import annotations

from collections.abc import Collection
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
OFF: dict[str, tuple[tuple[Any, ...], str]] = {
    "denominator_limit": ((None,), "keep the denominator from zero by a Saturate block"),
    "divide_by_zero_behavior": ((None,), "a quotient by zero is infinite, and ends a run"),
    "dtype": ((None, float, "float64", np.float64), "every value is a double; leave it out"),
    "enable_dynamic_lower_limit": ((False,), LIMIT),
    "enable_dynamic_upper_limit": ((False,), LIMIT),
    "enable_external_inertia_matrix": ((False,), "a rigid body has a constant inertia here"),
    "enable_external_initial_state": ((False,), "give the number initial_state"),
    "enable_external_mass": ((False,), "a rigid body has a constant mass here"),
    "enable_output_state_derivatives": ((False,), "compute them from its inputs"),
    "parameters": ((None, {}), "parameters belong to a LeafSystem of your own"),
    "shape": ((None, ()), "give an argument of this shape, such as mean=[0.0, 0.0]"),
    "start_time": ((0, None), "add an Offset behind it"),
    "ui_id": ((None,), "leave it out"),
}
"""argument -> values with which it means nothing, and what to do for others"""
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


def as_here(block: str, options: dict[str, Any], known: Collection[str]) -> dict[str, Any]:
    """The arguments of a block by their names here; those that no tool has stay as they are.

    Raises
    ------
    BlockParameterError
        For an argument that means something there and has no counterpart; the message says what to
        do. For one that is given by both names.
    """
    options = _plain(block, options)
    found: dict[str, Any] = {}
    for name, value in options.items():
        if name in known:
            found[name] = value
            continue
        advice = GONE.get(block, {}).get(name)
        if advice is not None:
            raise BlockParameterError(f"{block}: no option '{name}': {advice}")
        here = CALLED.get(block, {}).get(name)
        if here is None and name in OFF:
            values, advice = OFF[name]
            if not any(value is v or (type(value) is type(v) and value == v) for v in values):
                raise BlockParameterError(f"{block}: {name} = {value!r}: {advice}")
        elif here is None:
            found[name] = value  # which is refused
        elif options.get(here) is not None:
            raise BlockParameterError(
                f"{block}: '{name}' is called '{here}' here; give one of them"
            )
        else:
            found[here] = value
    return found


def _plain(block: str, options: dict[str, Any]) -> dict[str, Any]:
    """The options without those that say what a block is here anyway; the filter of a sampled
    derivative is the backward one here.
    """
    for of, name, value in ANYWAY:
        if block == of and name in options and options[name] == value:
            options = {key: given for key, given in options.items() if key != name}
    if "filter_type" not in options or block not in ("DerivativeDiscrete", "PIDDiscrete"):
        return options
    rest = {name: value for name, value in options.items() if name != "filter_type"}
    kind = options["filter_type"]
    if kind == "none" and (block == "DerivativeDiscrete" or not options.get("kd", 0.0)):
        return {name: value for name, value in rest.items() if name != "filter_coefficient"}
    if kind == "backward":
        return rest
    raise BlockParameterError(
        f"{block}: filter_type = {kind!r}: the filter is 'backward' here; choose its coefficient"
    )
