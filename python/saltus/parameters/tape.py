"""An expression of parameters as a tape over the parameters of a diagram."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.parameter import Parameter, value_of
from saltus.tracing import refusal
from saltus.tracing.numbers import Symbol, array, as_array

__all__ = ["tape_of"]


def tape_of(
    what: str, expression: Parameter, declared: Mapping[int, tuple[int, Any]], size: int
) -> Any:
    """The tape that computes `size` values.

    `declared` has, for the `id` of each parameter of the diagram, its first place and its value.
    """
    graph = _core.Graph()

    def symbol(first: int, value: Any) -> Any:
        if np.ndim(value) == 0:
            return Symbol(graph, graph.parameter(first), python=True)
        return array([Symbol(graph, graph.parameter(first + i)) for i in range(np.size(value))])

    known = {key: symbol(first, value) for key, (first, value) in declared.items()}
    try:
        result = as_array(value_of(expression, known))
    except refusal.Refusal as reason:
        raise ModelError(f"{what}: its expression {reason}") from None
    numbers = list(result.data.flat)
    if len(numbers) == 1:
        numbers *= size
    nodes = [one.node if isinstance(one, Symbol) else graph.constant(one) for one in numbers]
    return graph.tape(nodes)
