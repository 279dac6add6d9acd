"""Other values of a context by their names; imported when a context is given some."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus.errors import ModelError

__all__ = ["with_values"]


def with_values(context: _core.Context, values: Mapping[str, ArrayLike]) -> _core.Context:
    """The context with these start values, parameters and modes. ModelError."""
    if not isinstance(values, Mapping):
        raise ModelError(
            "create_context: values: expected a dict of names with values, "
            f'{{"ball.height": 5.0}}, found {values!r}'
        )
    for name, value in values.items():
        if not isinstance(name, str):
            raise ModelError(f"create_context: values: expected names, found {name!r}")
        context = _core.with_entry(context, name, _numbers(name, value))
    return context


def _numbers(name: str, value: ArrayLike) -> np.ndarray:
    found = None
    try:
        # a complex number would lose its imaginary part
        found = None if np.iscomplexobj(value) else np.ravel(np.asarray(value, dtype=float))
    except (TypeError, ValueError):
        pass
    if found is None:
        is_mode = name.rpartition(".")[2] == "mode"
        hint = "; a mode is given by its number" if is_mode else ""
        raise ModelError(
            f"create_context: values: '{name}': expected numbers, found {value!r}{hint}"
        )
    return found
