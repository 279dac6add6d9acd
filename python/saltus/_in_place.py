"""Functions that fill an array called `out` in place of returning one."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

__all__ = ["fills_out"]


def fills_out(function: Callable[..., Any]) -> bool:
    """Whether `function` has an argument called `out` that has to be given.

    An argument with a default, as NumPy's functions have, does not count.
    """
    code = getattr(function, "__code__", None)
    if code is not None and "out" not in code.co_varnames:
        return False
    try:
        out = inspect.signature(function).parameters.get("out")
    except (TypeError, ValueError):  # some functions written in C have no signature
        return False
    named = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
    return out is not None and out.default is inspect.Parameter.empty and out.kind in named
