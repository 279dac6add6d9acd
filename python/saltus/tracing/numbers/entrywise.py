"""`apply`: an operation on numbers and arrays, entry by entry."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus.tracing.numbers.arrays import as_array, objects_of, wrapped
from saltus.tracing.numbers.scalars import SCALARS, is_number
from saltus.tracing.numbers.symbol import Symbol
from saltus.tracing.refusal import refuse

__all__ = ["apply"]


def _bitwise(name: str, logical: str) -> None:
    """& | ^ ~ of truths; of integers they are refused."""

    def function(*arguments: Any) -> Any:
        if not any(type(a) is Symbol for a in arguments):
            return {"and": np.bitwise_and, "or": np.bitwise_or, "xor": np.bitwise_xor,
                    "invert": np.invert}[name](*arguments)  # fmt: skip
        kinds = {a.kind if type(a) is Symbol else as_array(a).kind for a in arguments}
        if kinds != {"b"}:
            refuse(f"computes bitwise ({name}) with integers or reals", "use arithmetic")
        if name == "invert" and arguments[0].python:
            refuse("inverts a Python bool by ~, which gives -1 or -2", "use np.logical_not")
        return SCALARS[logical](*arguments)

    SCALARS[name] = function


for _name, _logical in (
    ("and", "logical_and"), ("or", "logical_or"), ("xor", "logical_xor"), ("invert", "logical_not")
):  # fmt: skip
    _bitwise(_name, _logical)

_ON_ARRAYS: dict[str, Any] = {}


def _on_arrays(name: str, count: int) -> Any:
    """SCALARS[name], broadcast over arrays of objects by numpy."""
    if name not in _ON_ARRAYS:
        _ON_ARRAYS[name] = np.frompyfunc(SCALARS[name], count, 1)
    return _ON_ARRAYS[name]


def apply(name: str, *arguments: Any) -> Any:
    """The operation on numbers and arrays of any shapes that broadcast."""
    for a in arguments:
        if not is_number(a):
            break
    else:
        return SCALARS[name](*arguments)
    parts = [objects_of(as_array(a)) for a in arguments]
    return wrapped(_on_arrays(name, len(parts))(*parts))
