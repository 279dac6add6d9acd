"""`Setting`: all that the functions of a system read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.operating.places import Place, open_inputs, split_entry
from saltus.system import System

__all__ = ["Setting", "held", "named_values"]


@dataclass(frozen=True)
class Setting:
    """A context, and the values of open inputs by the names of their ports."""

    context: _core.Context
    inputs: dict[str, Any]

    def put(self, places: Sequence[Place], values: np.ndarray) -> Setting:
        """The same with these values."""
        context, inputs = self.context, dict(self.inputs)
        for place, value in zip(places, values, strict=True):
            if place.kind != "input":
                context = _core.with_entry(context, place.name, np.array([value]))
            elif place.index is None:
                inputs[place.name] = float(value)
            else:
                port = split_entry(place.name)[0]
                inputs[port] = inputs[port].copy()
                inputs[port][place.index] = value
        return Setting(context, inputs)


def named_values(where: str, given: Any) -> dict[str, Any]:
    """A dict of names with values or None, also from a list of names."""
    if isinstance(given, (list, tuple)) and all(isinstance(name, str) for name in given):
        return dict.fromkeys(given)
    if not isinstance(given, Mapping) or not all(isinstance(name, str) for name in given):
        raise ModelError(
            f"{where}: expected a dict of names with values, or a list of names, found {given!r}"
        )
    return dict(given)


def held(where: str, system: System, context: _core.Context, values: dict[str, Any]) -> Setting:
    """A context with the values of `hold`, and those of open inputs."""
    setting = Setting(context, {})
    for name, value in values.items():
        if value is None:
            if name not in system.input_names:
                _core.find_entry(context, name)  # refuses an unknown name
            continue
        setting = _with(where, system, setting, name, value)
    return setting


def _with(where: str, system: System, setting: Setting, name: str, value: Any) -> Setting:
    try:
        numbers = np.array(value, dtype=float)
    except (TypeError, ValueError):
        raise ModelError(f"{where}: '{name}': expected numbers, found {value!r}") from None
    if not np.all(np.isfinite(numbers)):
        raise ModelError(f"{where}: '{name}': expected finite numbers, found {value!r}")
    if name in system.input_names:
        inputs = setting.inputs | {name: numbers if numbers.ndim else float(numbers)}
        return replace(setting, inputs=inputs)
    try:
        context = _core.with_entry(setting.context, name, np.atleast_1d(numbers))
    except ModelError as error:
        raise ModelError(f"{where}: {error}{open_inputs(system, name)}") from None
    return replace(setting, context=context)
