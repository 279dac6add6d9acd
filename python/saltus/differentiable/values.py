"""`RunValues`: what a differentiable run returns, with the same shapes for all parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

__all__ = ["RunValues", "leaves", "mapped", "with_leaves"]


class RunValues(NamedTuple):
    """The values of a run, as arrays of JAX or PyTorch whose shapes are known before the run.

    Examples
    --------
    >>> values = saltus.RunValues({}, [0.0, 1.0], [], 12.0, {"bounce": [1.4, 4.0]})
    >>> values.events["bounce"]
    [1.4, 4.0]
    """

    outputs: dict[str, Any]
    """the recorded signals at the times of `save_at`: (times,) of a scalar, (times, entries) of a
    vector. At the time of an event it is the value after it
    """
    continuous_state: Any
    """(states,) at the end of the run, in the order of the context"""
    discrete_state: Any
    """(states,) at the end of the run"""
    end_time: Any
    """() [s] the end of the time span, or the time of the guard that ended the run"""
    events: dict[str, Any]
    """(count,) [s] the times of the first events of each name"""


def leaves(values: RunValues) -> Iterator[tuple[str, Any]]:
    """(name, array) of each value, in a fixed order."""
    yield from values.outputs.items()
    yield "continuous_state", values.continuous_state
    yield "discrete_state", values.discrete_state
    yield "end_time", values.end_time
    yield from values.events.items()


def with_leaves(values: RunValues, arrays: Iterable[Any]) -> RunValues:
    """The same names with other arrays, given in the order of `leaves`."""
    rest = iter(arrays)
    outputs = {name: next(rest) for name in values.outputs}
    ends = next(rest), next(rest), next(rest)
    return RunValues(outputs, *ends, {name: next(rest) for name in values.events})


def mapped(function: Callable[[Any], Any], values: RunValues) -> RunValues:
    """The same names with `function` of each array."""
    return with_leaves(values, [function(array) for _, array in leaves(values)])
