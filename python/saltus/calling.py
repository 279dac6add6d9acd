"""The arguments of a callback, named where its signature does not take them."""

from __future__ import annotations

import inspect
import os
from collections.abc import Callable, Sequence
from types import TracebackType
from typing import Any

from saltus.errors import ModelError

__all__ = ["refuse_signature", "refuse_writing"]

NAMED = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)


def refuse_signature(
    what: str,
    function: Callable[..., Any],
    positional: Sequence[str],
    keywords: Sequence[str],
    error: TypeError,
) -> None:
    """ModelError where `function` cannot be called with these arguments; `error` is its cause."""
    try:
        signature = inspect.signature(function)
    except (TypeError, ValueError):  # some functions written in C have no signature
        return
    try:
        signature.bind(*positional, **dict.fromkeys(keywords))
    except TypeError:
        name = getattr(function, "__name__", type(function).__name__)
        expected = ", ".join([*positional, *(["*", *keywords] if keywords else [])])
        hint = _hint(signature, positional, keywords)
        raise ModelError(
            f"{what}: expected {name}({expected}), found {name}{signature}{_place(function)}{hint}"
        ) from error


def refuse_writing(what: str, error: ValueError, trace: TracebackType | None) -> None:
    """ModelError where a callback wrote to an array in place that it may only read."""
    if "read-only" not in str(
        error
    ):  # of NumPy: "assignment destination is read-only", "output ..."
        return
    at, last = "", trace
    while last is not None:
        file = os.path.basename(last.tb_frame.f_code.co_filename)
        at, last = f" at {file}:{last.tb_lineno}", last.tb_next
    raise ModelError(
        f"{what} wrote to an array that may only be read{at}: the state, the inputs and the "
        "parameters that a callback gets never change. Take a copy, `x = "
        "state.continuous_state.copy()` or `x = x.copy()`, and return what it becomes; a reset map "
        "or an update returns `state.with_continuous_state(x)`"
    ) from error.with_traceback(trace)


def _place(function: Any) -> str:
    """' at ball.py:12', where it is known."""
    function = inspect.unwrap(getattr(function, "func", function))  # of a functools.partial
    for one in (function, type(function).__call__):
        code = getattr(one, "__code__", None)
        if code is not None:
            return f" at {os.path.basename(code.co_filename)}:{code.co_firstlineno}"
    return ""


def _hint(signature: inspect.Signature, positional: Sequence[str], keywords: Sequence[str]) -> str:
    taken = signature.parameters.values()
    names = {parameter.name for parameter in taken if parameter.kind in NAMED}
    takes_any = any(parameter.kind is inspect.Parameter.VAR_KEYWORD for parameter in taken)
    left = [] if takes_any else [name for name in keywords if name not in names]
    if left:
        return (
            f"; it gets every parameter of the block by keyword: take {_listed(left)} by name, or "
            "all of them as **parameters"
        )
    alone = inspect.Parameter.KEYWORD_ONLY
    missing = [p.name for p in taken if p.kind is alone and p.default is p.empty]
    missing = [name for name in missing if name not in keywords]
    if missing:
        return f"; the block declares no parameter {_listed(missing)}: declare_dynamic_parameter"
    if len(positional) > 2:
        return "; inputs come by position, those that requires_inputs names"
    return ""


def _listed(names: Sequence[str]) -> str:
    return ", ".join(f"'{name}'" for name in names)
