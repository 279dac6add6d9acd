"""`Coordinates`: the parameters of a fit as the numbers that the optimizer changes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.fitting.experiment import Experiment
from saltus.fitting.free import Free, frees_of, with_start
from saltus.system import System

__all__ = ["Coordinates", "Place", "places_of", "require_entry"]


@dataclass(frozen=True)
class Place:
    """A parameter, with the experiment that it belongs to; None: all of them."""

    label: str
    """the name in the result"""
    name: str
    """the name in a context"""
    free: Free
    run: int | None = None


def require_entry(where: str, system: System, context: _core.Context, name: str) -> float:
    """The value of a parameter or start value. ModelError if it is not one number of a context."""
    try:
        size = _core.find_entry(context, name)
    except ModelError as error:
        raise ModelError(f"{where}: {error}{_attribute(system, name)}") from None
    if name.rpartition(".")[2] == "mode" and name not in context.parameters:
        raise ModelError(
            f"{where}: '{name}' is a mode, an integer; expected a parameter or a start value"
        )
    if size != 1:
        raise ModelError(f"{where}: '{name}' has {size} entries; name each, such as '{name}[0]'")
    return _value(context, name)


def _attribute(system: System, name: str) -> str:
    """A hint, if the name is that of an attribute of the system."""
    if not name.isidentifier() or name not in getattr(system, "__dict__", {}):
        return ""
    return (
        f". '{name}' is an attribute of '{system.name}', which a run does not vary; "
        f"make it a parameter by declare_dynamic_parameter('{name}', ...)"
    )


def _value(context: _core.Context, name: str) -> float:
    """The number under a name: what distinguishes a context from one with another number there."""
    plain = context.parameters.get(name)
    if plain is not None:
        return float(np.ravel(plain)[0])
    changed = _core.with_entry(context, name, np.array([_OTHER]))
    for kind in ("continuous_state", "discrete_state"):
        at = np.flatnonzero(getattr(changed, kind) != getattr(context, kind))
        if len(at):
            return float(getattr(context, kind)[at[0]])
    vectors = context.parameters
    for key, value in changed.parameters.items():
        at = np.flatnonzero(np.ravel(value) != np.ravel(vectors[key]))
        if len(at):
            return float(np.ravel(vectors[key])[at[0]])
    return _OTHER


_OTHER = 0.1234567890123e-3
"""a number that no context has by chance"""


def places_of(
    system: System,
    parameters: object,
    experiments: Sequence[Experiment],
    contexts: Sequence[_core.Context],
) -> list[Place]:
    """All parameters of a fit, each with a start value, in the order of the result."""
    places = []
    for name, free in frees_of(parameters).items():
        value = require_entry("fit", system, contexts[0], name)
        places.append(Place(name, name, _begun("fit", name, free, value)))
    for k, (each, context) in enumerate(zip(experiments, contexts, strict=True)):
        where = f"fit: {each.name}"
        for name, free in frees_of(dict(each.free)).items():
            value = require_entry(where, system, context, name)
            places.append(Place(f"{each.name}: {name}", name, _begun(where, name, free, value), k))
    if not places:
        raise ModelError("fit: parameters: expected at least one, found none")
    _refuse_twice(places, experiments, contexts)
    return places


def _begun(where: str, name: str, free: Free, value: float) -> Free:
    try:
        return with_start(free, value)
    except ModelError as error:
        raise ModelError(f"{where}: parameter '{name}': {error}") from None


def _refuse_twice(
    places: Sequence[Place], experiments: Sequence[Experiment], contexts: Sequence[_core.Context]
) -> None:
    """Two names may mean one number of a context: 'x[0]' and 'height'."""
    for k, (each, context) in enumerate(zip(experiments, contexts, strict=True)):
        used: list[tuple[str, _core.Context]] = []
        for name in [place.name for place in places if place.run in (None, k)]:
            changed = _core.with_entry(context, name, np.array([_OTHER]))
            for other, same in used:
                if same == changed:
                    raise ModelError(f"fit: {each.name}: '{other}' and '{name}' are one value")
            used.append((name, changed))
        for name in each.values:
            changed = _core.with_entry(context, name, np.array([_OTHER]))
            if any(same == changed for _, same in used):
                raise ModelError(
                    f"fit: {each.name}: '{name}' is fitted, and has a value in this experiment; "
                    "remove one of them"
                )


class Coordinates:
    """Values u of the optimizer for values p of parameters: u = p, or u = log p."""

    def __init__(self, places: Sequence[Place]):
        self.places = list(places)
        self.labels = [place.label for place in places]
        self.log = np.array([place.free.log for place in places])
        starts = [place.free.start for place in places]
        self.start = self.inner(np.array(starts, dtype=float))
        with np.errstate(divide="ignore", invalid="ignore"):
            self.lower = self.inner(np.array([place.free.lower for place in places]))
            self.upper = self.inner(np.array([place.free.upper for place in places]))

    def inner(self, values: np.ndarray) -> np.ndarray:
        """The numbers of the optimizer."""
        with np.errstate(divide="ignore"):
            logarithm = np.log(np.where(self.log, np.maximum(values, 0.0), 1.0))
        return np.where(self.log, logarithm, values)

    def outer(self, inner: np.ndarray) -> np.ndarray:
        """The values of the parameters."""
        with np.errstate(over="ignore"):
            return np.where(self.log, np.exp(np.where(self.log, inner, 0.0)), inner)

    def slope(self, values: np.ndarray) -> np.ndarray:
        """dp/du at values p."""
        return np.where(self.log, values, 1.0)

    def scale(self, u: np.ndarray) -> np.ndarray:
        """The unit in which the optimizer counts each number: its size at the start, or the width
        of its bounds, or 1. That of a logarithm is 1.
        """
        width = np.where(np.isfinite(self.upper - self.lower), self.upper - self.lower, 1.0)
        return np.where(self.log, 1.0, np.where(u == 0.0, width, np.abs(u)))

    def of_run(self, values: np.ndarray, run: int) -> dict[str, float]:
        """The values that one experiment has, by the names of its context."""
        return {
            place.name: float(value)
            for place, value in zip(self.places, values, strict=True)
            if place.run in (None, run)
        }

    def columns(self, run: int) -> list[int]:
        """The positions of the parameters of one experiment."""
        return [k for k, place in enumerate(self.places) if place.run in (None, run)]
