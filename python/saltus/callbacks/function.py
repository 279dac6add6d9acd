"""One function of a block: the question to the tracer about it, and the trace that the engine
runs.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from saltus import _core

__all__ = ["Block", "core_trace", "outcome_of"]

Block = dict[str, Any]  # the facts of a block, or of a function of it

KINDS = {
    "jacobian": "matrix",
    "reset_map": "reset",
    "edge_reset": "reset",
    "event_input": "reset",
    "update": "update",
}
"""role of a function -> the tracer's word for it; functions of other roles return a vector"""

GUARDS = {"guard", "relation"}
"""roles of functions whose sign matters: a comparison gives its smooth difference"""


def outcome_of(block: Block, function: Block, trace: Callable[[Any], Any]) -> Any:
    """Traced or Refused; None for a compiled function, and for derivatives, which are called."""
    from saltus import tracing

    if function["compiled"] or function["role"] == "derivatives":
        return None
    if isinstance(function["function"], tracing.Known):
        return function["function"].outcome()
    outcome = trace(_signature(block, function))
    return tracing.as_guard(outcome) if function["role"] in GUARDS else outcome


def _signature(block: Block, function: Block) -> Any:
    from saltus import tracing

    return tracing.Signature(
        function=function["function"],
        owner=block["leaf"] if function["method"] else None,
        convention=function["convention"].name,
        block=block["path"],
        state_shape=tuple(block["state_shape"]),
        discrete_shape=tuple(block["discrete_shape"]),
        mode=block["mode"],
        x=block["x"],
        z=block["z"],
        parameters=block["parameters"],
        input_shapes=_input_shapes(block, function),
        inputs=function["inputs"],
        kind=KINDS.get(function["role"], "vector"),
        out=function["out"],
        out_shape=_out_shape(block, function),
        result_size=function["result_size"],
        result_shape=function["result_shape"],
    )


def _input_shapes(block: Block, function: Block) -> list[tuple[int, ...]]:
    """The shapes of the inputs; the weight of an event wire comes after them."""
    shapes: list[tuple[int, ...]] = list(block["input_shapes"])
    return [*shapes, ()] if function["role"] == "event_input" else shapes


def _out_shape(block: Block, function: Block) -> tuple[int, ...] | None:
    if not function["out"]:
        return None
    if function["role"] == "ode" and block["state_shape"]:
        return tuple(block["state_shape"])
    if function["role"] == "jacobian":
        return (len(block["x"]), len(block["x"]))
    shape: tuple[int, ...] | None = function["result_shape"]
    return shape


def core_trace(block: Block, function: Block, outcome: Any) -> _core.Trace | None:
    """The trace that the engine runs; None for a function that is called."""
    if not hasattr(outcome, "tape"):
        return None
    truths = outcome.boolean or function["role"] in GUARDS
    return _core.Trace(
        function["number"],
        outcome.tape,
        outcome.relations if truths else None,
        outcome.wrote_x,
        outcome.wrote_z,
        outcome.wrote_mode,
        function["role"] == "ode" and not _declares_jacobian(block),
    )


def _declares_jacobian(block: Block) -> bool:
    return any(f["role"] in ("jacobian", "sparse_jacobian") for f in block["functions"])
