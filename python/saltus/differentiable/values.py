"""`RunValues`: what a differentiable run returns, with the same shapes for all parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

__all__ = ["RunValues"]


class RunValues(NamedTuple):
    """The values of a run, as arrays of JAX or PyTorch whose shapes are known before the run.

    Examples
    --------
    >>> from saltus.differentiable import RunValues
    >>> RunValues({}, [0.0, 1.0], [], 12.0, {}).end_time
    12.0
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

    def leaves(self) -> Iterator[tuple[str, Any]]:
        """(name, array) in a fixed order."""
        yield from self.outputs.items()
        yield "continuous_state", self.continuous_state
        yield "discrete_state", self.discrete_state
        yield "end_time", self.end_time
        yield from self.events.items()

    def with_leaves(self, values: Any) -> RunValues:
        """The same names with other arrays, given in the order of `leaves`."""
        rest = iter(values)
        outputs = {name: next(rest) for name in self.outputs}
        ends = next(rest), next(rest), next(rest)
        return RunValues(outputs, *ends, {name: next(rest) for name in self.events})

    def map(self, function: Callable[[Any], Any]) -> RunValues:
        """The same names with `function` of each array."""
        return self.with_leaves([function(array) for _, array in self.leaves()])
