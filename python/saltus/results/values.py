"""The values of dense output at given times."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from saltus._core import known_names
from saltus.errors import ModelError
from saltus.results.record import same

if TYPE_CHECKING:
    from saltus.results.record import Record

__all__ = ["Values", "values_at"]


class Values(Mapping[str, Any]):
    """The recorded signals at the times asked for, by name, and the continuous state there.

    ``results(t)`` returns it. For a number `t` a scalar signal is a number and a vector an array;
    for an array of times the first dimensions of each are those of `t`.

    Attributes
    ----------
    time : float or ndarray
        [s] The given times.
    continuous_state : ndarray
        The state of all blocks, in the order of the context; the last axis counts the states.

    Examples
    --------
    >>> import saltus
    >>> solution = saltus.solve(lambda t, x: [1.0], (0, 2), [0.0], dense_output=True)
    >>> values = solution([0.5, 1.5])
    >>> values["x"].shape, list(values)
    ((2, 1), ['x'])
    """

    def __init__(self, time: Any, continuous_state: np.ndarray, outputs: dict[str, Any]):
        self.time = time
        self.continuous_state = continuous_state
        self._outputs = outputs

    def __getitem__(self, name: str) -> Any:
        try:
            return self._outputs[name]
        except KeyError:
            raise ModelError(
                f"nothing was recorded under {name!r}{known_names(str(name), list(self))}"
            ) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._outputs)

    def __len__(self) -> int:
        return len(self._outputs)

    def __contains__(self, name: object) -> bool:
        return name in self._outputs

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Values) and same(vars(self), vars(other))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        entries = [("continuous_state", self.continuous_state), *self._outputs.items()]
        lines = [f"  {name} = {np.array2string(np.asarray(v), prefix='  ')}" for name, v in entries]
        return "\n".join([f"<Values at t = {self.time} s", *lines]) + ">"


def values_at(record: Record, t: ArrayLike, side: str, derivatives: bool = False) -> Values:
    """Reads the dense output of a run, or its derivatives, with the parameter as the last axis."""
    if side not in ("left", "right"):
        raise ModelError(f"side: unknown side {side!r}{known_names(str(side), ['left', 'right'])}")
    if not record.dense:
        if hasattr(record, "events"):  # kept data, whose call raises with the reason
            record.at([], False)
        raise ModelError(
            "this run kept no dense output, so there are values at its rows only; run it with "
            "dense_output=True, or say with save_at at which times rows are wanted"
        )
    try:
        times = np.asarray(t, dtype=float)
    except (TypeError, ValueError):
        raise ModelError(f"expected a time or an array of times in seconds, found {t!r}") from None
    read = record.sensitivities_at if derivatives else record.at
    state, outputs = read(times.ravel().tolist(), side == "left")

    def shaped(array: np.ndarray) -> Any:
        return array.reshape(times.shape + array.shape[1:])[()]

    return Values(times[()], shaped(state), {name: shaped(a) for name, a in outputs.items()})
