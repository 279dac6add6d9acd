"""`Target`: a rate or an output, and the value that it should have."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus import _core
from saltus._core import known_names
from saltus._engine import ports_of
from saltus._signals import signals_in
from saltus.errors import ModelError
from saltus.operating.places import place_of, split_entry
from saltus.operating.setting import named_values
from saltus.system import System

__all__ = ["Target", "rates_wanted", "signals_wanted", "wanted_outputs"]


@dataclass(frozen=True)
class Target:
    """One equation: the row `index` of the rates, or of the outputs, has this value."""

    name: str
    """'rate of angle', or 'y[1]'"""
    is_rate: bool
    index: int
    value: float


def rates_wanted(
    where: str, system: System, context: _core.Context, names: tuple[str, ...], given: Any
) -> list[Target]:
    """The rates of all states: 0, or as `given` says; None leaves one open."""
    values: dict[int, float | None] = dict.fromkeys(range(len(names)), 0.0)
    for name, value in named_values(f"{where}: derivatives", given).items():
        place = place_of(f"{where}: derivatives", system, context, name)
        if place.kind != "state":
            raise ModelError(
                f"{where}: derivatives: '{name}' is no continuous state"
                f"{known_names(name, list(names))}"
            )
        assert place.index is not None
        number = None if value is None else _number(f"{where}: derivatives: '{name}'", value)
        values[place.index] = number
    return [
        Target(f"rate of {names[i]}", True, i, value)
        for i, value in values.items()
        if value is not None
    ]


def signals_wanted(
    where: str, system: System, given: Any
) -> tuple[dict[str, Any], list[tuple[str, System, int]]]:
    """The wanted values by name, and the ports that have to be read; 'y[1]' is an entry of 'y'."""
    if not isinstance(given, Mapping):
        raise ModelError(f"{where}: outputs: expected a dict of names with values, found {given!r}")
    wanted = named_values(f"{where}: outputs", given)
    paths = list(dict.fromkeys(split_entry(name)[0] for name in wanted))
    return wanted, ports_of(signals_in(system, paths))


def wanted_outputs(where: str, names: list[str], wanted: Mapping[str, Any]) -> list[Target]:
    """The equations of the outputs. `names` are those of the rows of a linearisation."""
    rows = {name: i for i, name in enumerate(names)}
    targets = []
    for name, value in wanted.items():
        entries = [name] if name in rows else [n for n in names if split_entry(n)[0] == name]
        if not entries:
            raise ModelError(f"{where}: outputs: there is no '{name}'{known_names(name, names)}")
        numbers = np.atleast_1d(np.array(value, dtype=float))
        if len(numbers) != len(entries):
            raise ModelError(
                f"{where}: outputs: '{name}' has {len(entries)} entries, found {len(numbers)}"
            )
        for entry, number in zip(entries, numbers, strict=True):
            checked = _number(f"{where}: outputs: '{entry}'", number)
            targets.append(Target(entry, False, rows[entry], checked))
    return targets


def _number(what: str, value: Any) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = np.nan
    if not np.isfinite(number):
        raise ModelError(f"{what}: expected a finite number, found {value!r}")
    return number
