"""`Question`: the arguments of `trim`, checked, and their names found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus import _core
from saltus._engine import core_context
from saltus._whole import is_whole
from saltus.errors import ModelError
from saltus.fitting.free import Free, frees_of
from saltus.operating.begin import begun, fixed_value
from saltus.operating.outcome import outcome
from saltus.operating.places import Place, place_of, split_entry, state_names
from saltus.operating.point import OperatingPoint
from saltus.operating.problem import Problem, Reader
from saltus.operating.search import search
from saltus.operating.setting import Setting, held, named_values
from saltus.operating.targets import rates_wanted, signals_wanted, wanted_outputs
from saltus.system import System

__all__ = ["Question", "question_of"]


@dataclass(frozen=True)
class Question:
    """What is asked of a search."""

    where: str
    problem: Problem
    frees: tuple[Free, ...]
    start: np.ndarray
    """(n,)"""
    tolerance: float
    max_nfev: int | None

    @property
    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        lower = np.array([free.lower for free in self.frees])
        return lower, np.array([free.upper for free in self.frees])

    def answer(self, start: np.ndarray) -> OperatingPoint:
        """The operating point that the search finds from a start."""
        try:
            found = search(self.problem, start, self.bounds, self.tolerance, self.max_nfev)
        except ModelError as error:
            told = str(error).removeprefix("linearize: ")
            raise ModelError(f"{self.where}: at the start values: {told}") from None
        return outcome(self.problem, found, self.bounds)


def question_of(
    where: str,
    system: System,
    free: Any,
    hold: Any,
    derivatives: Any,
    outputs: Any,
    context: _core.Context | None,
    python: str,
    tolerance: float,
    max_nfev: int | None,
) -> Question:
    """Checks the arguments of `trim`, and finds its names."""
    if not isinstance(system, System):
        raise ModelError(f"{where}: expected a system, found {system!r}")
    _require_numbers(where, tolerance, max_nfev)
    base = core_context(system.create_context() if context is None else context)
    held_values = named_values(f"{where}: hold", hold)
    setting = held(f"{where}: hold", system, base, held_values)
    fixed = [
        place_of(f"{where}: hold", system, base, n) for n in _single(system, base, held_values)
    ]
    names = state_names(base)
    given = frees_of(_default(names, fixed) if free is None else free, f"{where}: free")
    places = [place_of(f"{where}: free", system, base, name) for name in given]
    _refuse_overlap(where, places, fixed)
    _require_values(where, system, setting, given)
    frees = tuple(
        begun(where, system, setting, p, f) for p, f in zip(places, given.values(), strict=True)
    )
    start = np.array([one.start for one in frees], dtype=float)
    setting = setting.put(places, start)
    _require_motion(where, system, setting, base, python)
    wanted, signals = signals_wanted(where, system, {} if outputs is None else outputs)
    parameters = [place.name for place in places if place.kind == "parameter"]
    reader = Reader(system, parameters, signals, python)
    targets = rates_wanted(where, system, base, names, derivatives)
    if wanted:
        targets += wanted_outputs(where, reader.at(setting).outputs, wanted)
    if not places or not targets:
        raise ModelError(
            f"{where}: '{system.name}' has {len(places)} free values and {len(targets)} equations; "
            "expected one of each or more: name what is free, and outputs or derivatives"
        )
    return Question(
        where, Problem(reader, setting, places, targets), frees, start, tolerance, max_nfev
    )


def _require_values(where: str, system: System, setting: Setting, free: Mapping[str, Free]) -> None:
    """Each open input has a value: it is free, held or fixed."""
    given = {split_entry(name)[0] for name in free} | set(free) | set(setting.inputs)
    for port in system.input_ports:
        if port.name not in given and fixed_value(port, setting.context) is None:
            raise ModelError(
                f"{where}: input '{port.name}' of '{system.name}' is open and has no value; "
                f"expected it in free or as hold={{'{port.name}': 0.0}}, or a call of fix_value"
            )


def _require_motion(
    where: str, system: System, setting: Setting, base: _core.Context, python: str
) -> None:
    """Refuses a context in which a block is at rest: a value written there would release it."""
    firings = base.to_dict().get("continuation", {}).get("firings", [])
    if any(firing["holding"] for firing in firings):
        try:
            Reader(system, [], [], python).at(Setting(base, setting.inputs))
        except ModelError as error:
            raise ModelError(f"{where}: {str(error).removeprefix('linearize: ')}") from None


def _default(names: Sequence[str], fixed: Sequence[Place]) -> list[str]:
    held_states = {place.index for place in fixed if place.kind == "state"}
    return [name for i, name in enumerate(names) if i not in held_states]


def _single(system: System, context: _core.Context, names: Mapping[str, Any]) -> list[str]:
    """The names of one number: a vector that is held cannot be free as a whole."""
    ports = system.input_names
    return [n for n in names if n in ports or _core.find_entry(context, n) == 1]


def _refuse_overlap(where: str, places: Sequence[Place], fixed: Sequence[Place]) -> None:
    """Two names may mean one number: 'x[0]' and 'height'."""
    seen: dict[Any, str] = {}
    for place in places:
        key = _key(place)
        if key in seen:
            raise ModelError(f"{where}: free: '{seen[key]}' and '{place.name}' are one value")
        seen[key] = place.name
    for place in fixed:
        if _key(place) in seen:
            raise ModelError(
                f"{where}: '{place.name}' is free and held; remove it from one of them"
            )


def _key(place: Place) -> Any:
    return (place.kind, place.index if place.kind == "state" else place.name)


def _require_numbers(where: str, tolerance: Any, max_nfev: Any) -> None:
    if not (isinstance(tolerance, (int, float, np.number)) and 0.0 < tolerance < 1.0):
        raise ModelError(
            f"{where}: tolerance: expected a number between 0 and 1, found {tolerance!r}"
        )
    if max_nfev is not None and not (is_whole(max_nfev) and max_nfev >= 1):
        raise ModelError(f"{where}: max_nfev: expected an integer of 1 or more, found {max_nfev!r}")
