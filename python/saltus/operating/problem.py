"""`Problem`: the residuals of a search for an operating point, with their Jacobian."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from saltus import _core
from saltus.errors import ModelError, SimulationError
from saltus.linearization import linearizer_of
from saltus.operating.places import Place
from saltus.operating.setting import Setting
from saltus.operating.targets import Target
from saltus.system import System

__all__ = ["Point", "Problem", "Reader"]

EPS = float(np.finfo(float).eps)
ROUNDINGS = 16.0
"""of each term of a rate or an output"""


class Reader:
    """Linearisations of one system. A new value of an open input needs a new plan."""

    def __init__(
        self,
        system: System,
        parameters: Sequence[str],
        signals: list[tuple[str, System, int]],
        python: str,
    ):
        self.system, self.parameters, self.signals = system, list(parameters), signals
        self.python = python
        self._made: dict[bool, tuple[dict[str, bytes], _core.Linearizer]] = {}

    def at(self, setting: Setting, one_sided: bool = True) -> _core.Linearization:
        """The rates, the outputs and their derivatives. At a kink those of the present side."""
        ports = {name: np.array(value).tobytes() for name, value in setting.inputs.items()}
        known = self._made.get(one_sided)
        if known is None or known[0] != ports:
            named = [*setting.inputs.items(), *((name, None) for name in self.parameters)]
            made = linearizer_of(self.system, named, self.signals, one_sided, self.python)
            known = self._made[one_sided] = (ports, made)
        return known[1].at(setting.context)


class Point(NamedTuple):
    """Values of the unknowns, with the residuals there."""

    values: np.ndarray
    """(n,)"""
    residual: np.ndarray
    """(m,) found - wanted"""
    jacobian: np.ndarray
    """(m, n)"""
    rounding: np.ndarray
    """(m,) the rounding of the residuals by that of all states and inputs"""
    matrices: _core.Linearization


class Problem:
    """r(v) = 0 for the unknowns v at `places`: rates and outputs are as the targets say."""

    def __init__(
        self, reader: Reader, setting: Setting, places: Sequence[Place], targets: Sequence[Target]
    ):
        self.reader, self.setting = reader, setting
        self.places, self.targets = list(places), list(targets)
        self.evaluations = 0
        self.failed: Exception | None = None

    def at(self, values: np.ndarray) -> Point:
        """Raises ModelError or SimulationError where the system has no finite rates."""
        self.evaluations += 1
        with np.errstate(all="ignore"):  # beyond the domain of a function
            found = self.reader.at(self.setting.put(self.places, values))
        at, columns = found.time, [self._column(place, found) for place in self.places]
        a, c = np.hstack([found.A, found.B]), np.hstack([found.C, found.D])
        rows = [(found.xdot if t.is_rate else found.y)[t.index] - t.value for t in self.targets]
        by = [(a if t.is_rate else c)[t.index, columns] for t in self.targets]
        for target, row in zip(self.targets, rows, strict=True):
            if not np.isfinite(row):
                raise ModelError(f"t = {at} s: '{target.name}' is {row}; expected a finite number")
        jacobian = np.reshape(by, (len(rows), len(columns)))
        return Point(np.array(values), np.array(rows), jacobian, self._rounding(a, c, found), found)

    def tried(self, values: np.ndarray) -> Point | None:
        """The same, or None where it fails."""
        try:
            return self.at(values)
        except (ModelError, SimulationError) as error:
            self.failed = error
            return None

    def _rounding(self, a: np.ndarray, c: np.ndarray, found: _core.Linearization) -> np.ndarray:
        all_values = np.abs(np.concatenate([found.x, found.u]))
        terms = [np.abs((a if t.is_rate else c)[t.index]) @ all_values for t in self.targets]
        return ROUNDINGS * EPS * np.array(terms)

    def _column(self, place: Place, found: _core.Linearization) -> int:
        if place.kind == "state":
            assert place.index is not None
            return place.index
        return len(found.states) + found.inputs.index(place.name)
