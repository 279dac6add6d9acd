"""Functions that take by name what they read: inputs, variables, parameters, `time`, `since`,
`state`.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus._core import known_names
from saltus.errors import BlockParameterError

__all__ = ["ENTERED", "FIRST", "Named", "Truth", "Words", "inputs_of_all"]

ENTERED = 0
"""the entry of the discrete state with the time at which the active state was entered"""
FIRST = 1
"""the entry of the discrete state with the first variable"""
OWN = {"time": ["time"], "since": ["time", "discrete_state"], "state": ["mode"]}
"""names that every function may take -> the values of the block behind them"""


@dataclass(frozen=True)
class Words:
    """The names that the functions of one block may take."""

    block: str
    states: int
    inputs: tuple[str, ...]
    variables: tuple[str, ...]
    parameters: tuple[str, ...]

    def all(self) -> tuple[str, ...]:
        return (*OWN, *self.inputs, *self.variables, *self.parameters)

    def values(
        self, time: Any, state: Any, read: Sequence[int], inputs: Sequence[Any], parameters: Any
    ) -> dict[str, Any]:
        """Name -> value, in a call of a callback that reads the inputs at some positions."""
        z = state.discrete_state
        known = {"time": time, "since": time - z[ENTERED], "state": state.mode, **parameters}
        known |= {self.inputs[k]: u for k, u in zip(read, inputs, strict=True)}
        return known | {name: z[FIRST + k] for k, name in enumerate(self.variables)}


class Named:
    """A function, and the names that it takes. BlockParameterError for one that is not known."""

    def __init__(self, words: Words, what: str, function: Callable[..., Any]):
        self.words, self.what, self.function = words, what, function
        self.names = _names_of(words, f"block '{words.block}': {what}", function)

    def __call__(self, known: dict[str, Any]) -> Any:
        return self.function(**{name: known[name] for name in self.names})

    def reads(self) -> list[str]:
        """The values that the function depends on, as `declare_output_port` takes them."""
        found = {value for name in self.names for value in OWN.get(name, [])}
        for names, value in (
            (self.words.variables, "discrete_state"),
            (self.words.inputs, "inputs"),
        ):
            if set(names) & set(self.names):
                found.add(value)
        return sorted(found)


class Truth(Named):
    """A function that returns a truth. BlockParameterError for one that returns a number: of
    u - 1.0 it would only be asked whether it is exactly zero.
    """

    def __call__(self, known: dict[str, Any]) -> Any:
        found = super().__call__(known)
        if isinstance(found, bool) or getattr(found, "dtype", None) == np.bool_:
            return found
        raise BlockParameterError(
            f"block '{self.words.block}': {self.what}: expected a truth, such as "
            f"`lambda u: u > 1.0`, found the number {found!r}"
        )


def inputs_of_all(words: Words, functions: Sequence[Named | None]) -> list[int]:
    """The positions of the inputs that some functions read."""
    read = {name for each in functions if each is not None for name in each.names}
    return [k for k, name in enumerate(words.inputs) if name in read]


def _names_of(words: Words, where: str, function: Callable[..., Any]) -> tuple[str, ...]:
    if not callable(function):
        raise BlockParameterError(f"{where}: expected a function, found {function!r}")
    try:
        arguments = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        raise BlockParameterError(
            f"{where}: the names that {function!r} takes are not known; wrap it in a lambda"
        ) from None
    if any(each.kind is each.VAR_KEYWORD for each in arguments):
        return words.all()
    names = tuple(each.name for each in arguments if each.default is each.empty)
    for name in names:
        if name not in words.all():
            raise BlockParameterError(
                f"{where}: there is no '{name}' to read{known_names(name, list(words.all()))}"
            )
    return names
