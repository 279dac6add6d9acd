"""`Free`: a parameter that a fit may change, with its start value and its bounds."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from saltus.errors import ModelError

__all__ = ["Free", "frees_of", "with_start"]


@dataclass(frozen=True)
class Free:
    """A parameter or start value that `fit` may change.

    Parameters
    ----------
    start : float, optional
        The value at which the fit begins. By default that of the context, if it lies within the
        bounds, or otherwise the middle of the bounds.
    lower, upper : float
        The bounds; the fit stays within them.
    log : bool
        Fit the logarithm of the parameter, so that it stays positive and a step is a factor. Its
        confidence interval is then positive too, and not symmetric.

    Raises
    ------
    ModelError
        If a value is not a number, the start is outside of the bounds, the lower bound is not below
        the upper one, or a parameter with ``log=True`` is not positive.

    Examples
    --------
    >>> saltus.Free(0.8, 0.1, 1.0)
    Free(start=0.8, lower=0.1, upper=1.0, log=False)
    """

    start: float | None = None
    lower: float = -math.inf
    upper: float = math.inf
    log: bool = False

    def __post_init__(self) -> None:
        for name in ("start", "lower", "upper"):
            value = getattr(self, name)
            if value is not None or name != "start":
                object.__setattr__(self, name, _number(name, value))
        if not self.lower < self.upper:
            raise ModelError(
                f"expected a lower bound below the upper bound, found {self.lower:g} and "
                f"{self.upper:g}; a value that is known belongs into the context"
            )
        if self.start is not None:
            self._require_possible(self.start)
        if self.log and self.upper <= 0.0:
            raise ModelError(f"log=True needs an upper bound above 0, found {self.upper:g}")

    def _require_possible(self, start: float) -> None:
        if not math.isfinite(start):
            raise ModelError(f"expected a finite start value, found {start}")
        if not self.lower <= start <= self.upper:
            raise ModelError(
                f"the start value {start:g} is outside of the bounds {self.lower:g} to "
                f"{self.upper:g}; change one of them"
            )
        if self.log and start <= 0.0:
            raise ModelError(f"log=True needs a start value above 0, found {start:g}")


def with_start(free: Free, value: float) -> Free:
    """The same with a start: its own, or `value` of the context, or the middle of the bounds.

    A value at a bound is no start, because the fit could hardly leave it.
    """
    if free.start is not None:
        return free
    least = max(free.lower, 0.0) if free.log else free.lower
    if least < value < free.upper:
        return replace(free, start=value)
    middle = math.sqrt(least * free.upper) if free.log else (free.lower + free.upper) / 2.0
    if not math.isfinite(middle) or (free.log and middle == 0.0):
        raise ModelError(
            f"the value {value:g} of the context is no start within the bounds {free.lower:g} to "
            f"{free.upper:g}; give one: saltus.Free(start, lower, upper)"
        )
    return replace(free, start=middle)


def _number(what: str, value: Any) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ModelError(f"{what}: expected a number, found {value!r}") from None
    if math.isnan(number):
        raise ModelError(f"{what}: expected a number, found {value!r}")
    return number


def frees_of(parameters: Any, where: str = "fit: parameters") -> dict[str, Free]:
    """The parameters of a fit by name, from a list of names or a dict as `fit` takes it. `where`
    begins the messages of refusals.
    """
    if isinstance(parameters, str):
        parameters = [parameters]
    if isinstance(parameters, (list, tuple)) and all(isinstance(name, str) for name in parameters):
        if len(set(parameters)) < len(parameters):
            raise ModelError(f"{where}: a parameter is named twice in {list(parameters)!r}")
        parameters = dict.fromkeys(parameters)
    if not isinstance(parameters, Mapping) or not all(isinstance(n, str) for n in parameters):
        raise ModelError(
            f"{where}: expected a dict of names with start values or bounds, or a list of names, "
            f"found {parameters!r}"
        )
    return {name: _free(f"{where}: '{name}'", given) for name, given in parameters.items()}


def _free(where: str, given: Any) -> Free:
    try:
        if isinstance(given, Free):
            return given
        if given is None:
            return Free()
        if isinstance(given, (tuple, list)):
            if len(given) != 2:
                raise ModelError(f"expected (lower, upper), found {given!r}")
            return Free(None, *given)
        return Free(given)
    except ModelError as error:
        raise ModelError(
            f"{where}: {error}. Expected a start value, (lower, upper), None or "
            "saltus.Free(start, lower, upper)"
        ) from None
