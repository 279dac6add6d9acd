"""The values at which a search begins."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.fitting.free import Free, with_start
from saltus.operating.places import Place, split_entry
from saltus.operating.setting import Setting
from saltus.system import InputPort, System

__all__ = ["begun", "fixed_value"]


def begun(where: str, system: System, setting: Setting, place: Place, free: Free) -> Free:
    """The bounds of a free value with its start."""
    if free.log:
        raise ModelError(f"{where}: free: '{place.name}': log=True belongs to fit; give bounds")
    try:
        return with_start(free, _value(where, system, setting, place))
    except ModelError as error:
        raise ModelError(f"{where}: free: '{place.name}': {error}") from None


def _value(where: str, system: System, setting: Setting, place: Place) -> float:
    if place.kind == "state":
        assert place.index is not None
        return float(setting.context.continuous_state[place.index])
    if place.kind == "parameter":
        return _parameter(setting.context, place.name)
    return _input(where, system, setting, place)


def _input(where: str, system: System, setting: Setting, place: Place) -> float:
    """The value of an open input: an entry of a vector that is held, the fixed one, or 0."""
    port, entry = split_entry(place.name) if place.index is not None else (place.name, None)
    if entry is not None:
        vector = np.atleast_1d(setting.inputs.get(port, []))
        if entry >= len(vector):
            raise ModelError(
                f"{where}: free: '{place.name}': expected the vector of the open input with "
                f"{entry + 1} entries or more, found {len(vector)}; give hold={{'{port}': [...]}}"
            )
        return float(vector[entry])
    value = fixed_value(system.input_ports[system.input_names.index(port)], setting.context)
    if np.ndim(value):
        raise ModelError(
            f"{where}: free: '{port}' is a vector; hold it, and free its entries '{port}[0]', ..."
        )
    return 0.0 if value is None else float(value)


def _parameter(context: _core.Context, name: str) -> float:
    """The value under the name of one number."""
    names = [known for known in context.parameters if known == name or known.endswith(f".{name}")]
    base, entry = split_entry(name)
    if not names and entry is not None:
        names = [n for n in context.parameters if n == base or n.endswith(f".{base}")]
    return float(np.ravel(context.parameters[names[0]])[entry or 0])


def fixed_value(port: InputPort, context: _core.Context) -> Any:
    """The value to which an open input was fixed, or None."""
    try:
        return port.eval(context)
    except ModelError:
        return None
